// mix.cl - how volumes that overlap share a sample.
//
// What is visible at one sample is put into a mixture, one part after the other in the order of the
// scene's list, and the mixture then becomes a layer behind the light gathered so far.
// docs/mixing.md defines each way; the constructive ones are those of Ricci 1973 and Chen & Tucker
// 2000 on extinctions, that is, on the opacity of a length that tends to nothing, so that the
// picture does not depend on the step.
#ifndef MIX_CL
#define MIX_CL

#include "pixel.cl"
#include "span.cl"

// 1: one part hides all others, 0: colours are the mean of all, weighted by depth.
#define MIXING_WINNER (MIXING == MIXING_MAX || MIXING == MIXING_PRIORITY)

// The parts of one sample, as optical depths; unused where each part is a layer of its own.
struct mixture {
    real r, g, b;  // colours times their weights
    real weight;   // the sum of these
    real depth;    // of the whole
    real rank;     // of the winner
    integer count; // parts that are visible
};

// Puts a layer of straight colour and opacity a behind what has been gathered.
INLINE void light_add(struct light *light, real r, real g, real b, real a) {
    const real weight = (1.0f - light->a) * a;
    light->r += weight * r;
    light->g += weight * g;
    light->b += weight * b;
    light->a += weight;
}

INLINE struct mixture mix_begin(void) {
    const real zero = (real)(0.0f);
    const struct mixture mixture = {zero, zero, zero, zero, zero, (real)(-1.0f), (integer)(0)};
    return mixture;
}

#if MIXING_WINNER
// The part takes the place of the one before where it ranks higher.
INLINE void mix_compete(struct mixture *mixture, real rank, real r, real g, real b, real depth) {
    mask wins = MASK(rank > mixture->rank) & MASK(depth > 0.0f);
#if MIXING == MIXING_PRIORITY
    // The first that is there wins. The least rank would see to that, but llvmpipe takes none for
    // greater.
    wins |= MASK(mixture->depth <= 0.0f) & MASK(depth > 0.0f);
#endif
    mixture->rank = CHOOSE(mixture->rank, rank, wins);
    mixture->r = CHOOSE(mixture->r, r, wins);
    mixture->g = CHOOSE(mixture->g, g, wins);
    mixture->b = CHOOSE(mixture->b, b, wins);
    mixture->depth = CHOOSE(mixture->depth, depth, wins);
}
#endif

// Adds a part's straight colour and strength at the sample; 0 in lanes where it is not visible.
INLINE void mix_add(struct mixture *mixture, struct light *light, __constant struct part *part,
                    real r, real g, real b, real strength) {
#if !STRENGTH_DEPTH
    if (AT_ONCE == 1) {
        light_add(light, r, g, b, strength);
    } else { // the only part's, whose turn comes in mix_end
        mixture->r = r;
        mixture->g = g;
        mixture->b = b;
        mixture->depth = strength;
    }
#elif MIXING_WINNER
    mix_compete(mixture, MIXING == MIXING_MAX ? strength : (real)(part->rank), r, g, b, strength);
#else
    // With `difference` the others only take away.
    const bool taken_away = MIXING == MIXING_DIFFERENCE && part->medium > 0;
    const real weight = taken_away ? (real)(0.0f) : strength;
    mixture->r += weight * r;
    mixture->g += weight * g;
    mixture->b += weight * b;
    mixture->weight += weight;
#if MIXING == MIXING_UNION
    mixture->depth = fmax(mixture->depth, strength);
#elif MIXING == MIXING_INTERSECTION
    const mask visible = MASK(strength > 0.0f), first = MASK(mixture->count == 0);
    const real least = CHOOSE(fmin(mixture->depth, strength), strength, first);
    mixture->depth = CHOOSE(mixture->depth, least, visible);
    mixture->count -= visible;
#else
    mixture->depth += taken_away ? -strength : strength;
#endif
#endif
}

// The optical depth of one step of the whole mixture.
INLINE real mix_depth(__constant struct world *world, const struct mixture *mixture) {
#if MIXING == MIXING_INTERSECTION
    // A part that is not there, or not visible, has no depth at all.
    return CHOOSE((real)(0.0f), mixture->depth, MASK(mixture->count == world->medium_count));
#elif MIXING == MIXING_DIFFERENCE
    return fmax(mixture->depth, 0.0f);
#else
    return mixture->depth;
#endif
}

// Puts what the mixture makes of its parts behind what has been gathered.
INLINE void mix_end(__constant struct world *world, const struct mixture *mixture,
                    struct light *light) {
#if STRENGTH_DEPTH
    real share = (real)(1.0f);
#if !MIXING_WINNER
    share = 1.0f / fmax(mixture->weight, FLT_MIN);
#endif
    light_add(light, mixture->r * share, mixture->g * share, mixture->b * share,
              1.0f - exp(-mix_depth(world, mixture)));
#else
    if (AT_ONCE > 1)
        light_add(light, mixture->r, mixture->g, mixture->b, mixture->depth);
#endif
}

#endif
