// segment.cl - absorption between one sample and the next, from a table of pairs of values.
//
// Entry (f, b) of the table holds what a step shows whose value goes evenly from f to b, so that a
// shell thinner than a step is not missed (pre-integration: Engel, Kraus & Ertl 2001): its optical
// depth and its colour.
#ifndef SEGMENT_CL
#define SEGMENT_CL

#include "mix.cl"
#include "model/gathered.cl"
#include "model/surface.cl"

#if MODELS & MODELS_PREINTEGRATED
// What the step before the spot shows. Colours are weighted by strength, as those of entries that
// show nothing mean nothing.
INLINE mask gather_segment(__constant struct world *world, TABLE_SPACE const uint *table,
                           MEMORY_PARAMETERS, const struct crossing *crossing,
                           const struct gathered *gathered, const struct spot *spot, real raw,
                           real *strength, real *r, real *g, real *b) {
    mask known;
    const real before = raw_before(world, MEMORY_ARGUMENTS, crossing, gathered, spot, &known);
    // Lanes without a value look up something that exists.
    const real back = CHOOSE((real)(0.0f), raw, spot->present);
    const struct side front_side = find_side(spot->part, CHOOSE(back, before, known));
    const struct side back_side = find_side(spot->part, back);
    const integer word = (front_side.entry * PAIR_ENTRIES + back_side.entry) * 2 + (int)spot->part->table;
    real weights[4], sum = (real)(0.0f);
    for (int n = 0; n < 4; n++) {
        const integer at = word + ((n & 2 ? PAIR_ENTRIES : 0) + (n & 1)) * 2;
        const real across = n & 2 ? front_side.weight : 1.0f - front_side.weight;
        const real along = n & 1 ? back_side.weight : 1.0f - back_side.weight;
        weights[n] = across * along * GATHER(float, LOAD_STRENGTH, at);
        sum += weights[n];
    }
    const mask visible = spot->present & MASK(sum > 0.0f);
#if STRENGTH_DEPTH
    *strength = CHOOSE((real)(0.0f), sum, visible);
#else
    *strength = CHOOSE((real)(0.0f), 1.0f - exp(-sum), visible);
#endif
    *r = *g = *b = (real)(0.0f);
    if (!any_lane(visible))
        return visible;
    const real share = 1.0f / fmax(sum, FLT_MIN);
    for (int n = 0; n < 4; n++) {
        const integer at = word + ((n & 2 ? PAIR_ENTRIES : 0) + (n & 1)) * 2;
        const integer colour = GATHER(int, LOAD_COLOUR, at);
        *r += weights[n] * share * ten_bits(colour, 0);
        *g += weights[n] * share * ten_bits(colour, 10);
        *b += weights[n] * share * ten_bits(colour, 20);
    }
    return visible;
}
#endif

#endif
