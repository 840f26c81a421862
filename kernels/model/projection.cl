// projection.cl - one value for a whole ray: `mip`, `minip` and `average`.
//
// It is known at the end only. A projection therefore remembers the light that was gathered before
// its place, and is slipped in behind that in the end.
#ifndef PROJECTION_CL
#define PROJECTION_CL

#include "model/gathered.cl"

#if MODELS & MODELS_PROJECTION
#define IS_PROJECTION(part)                                                                        \
    ((part)->model == MODEL_MIP || (part)->model == MODEL_MINIP || (part)->model == MODEL_AVERAGE)

// The spot's value becomes the projection's, or a part of it.
INLINE void gather_projection(struct gathered *gathered, const struct light *light,
                              const struct spot *spot, const struct sample *sample) {
    struct projection *projection = &gathered->projections[spot->c];
    const int model = spot->part->model;
    // A mean stands where the part begins; an extremum replaces what there was.
    const mask first = spot->present & MASK(projection->at < 0);
    const bool up = (model == MODEL_MIP) == (spot->part->table_scale >= 0.0f);
    const mask beyond = up ? MASK(sample->raw > projection->raw) : MASK(sample->raw < projection->raw);
    const bool mean = model == MODEL_AVERAGE;
    const mask moved = mean ? first : first | (spot->present & beyond);
    const mask taken = mean ? spot->present : moved;
    const real kept = (real)(mean ? 1.0f : 0.0f);
    projection->count = CHOOSE(projection->count, kept * projection->count + 1.0f, taken);
    projection->raw = CHOOSE(projection->raw, kept * projection->raw + sample->raw, taken);
    projection->at = CHOOSE(projection->at, spot->i, moved);
    projection->front.r = CHOOSE(projection->front.r, light->r, moved);
    projection->front.g = CHOOSE(projection->front.g, light->g, moved);
    projection->front.b = CHOOSE(projection->front.b, light->b, moved);
    projection->front.a = CHOOSE(projection->front.a, light->a, moved);
#if VOXELS & VOXELS_RGBA
    projection->r = CHOOSE(projection->r, kept * projection->r + sample->r, taken);
    projection->g = CHOOSE(projection->g, kept * projection->g + sample->g, taken);
    projection->b = CHOOSE(projection->b, kept * projection->b + sample->b, taken);
#endif
}

// What a part's projection looks like.
INLINE struct light projection_layer(TABLE_SPACE const uint *table, __constant struct part *part,
                                     const struct projection *projection) {
    mask present = (mask)(-1);
    const real share = 1.0f / AT_LEAST(projection->count, (real)(1.0f));
    const struct entry entry = find_entry(table, part, projection->raw * share, &present);
    struct light layer;
    layer.a = entry.strength;
    entry_colour(&entry, &layer.r, &layer.g, &layer.b);
#if VOXELS & VOXELS_RGBA
    if (IS_CLASS(part, VOXELS_RGBA)) {
        layer.r = projection->r * share;
        layer.g = projection->g * share;
        layer.b = projection->b * share;
    }
#endif
    layer.r *= layer.a;
    layer.g *= layer.a;
    layer.b *= layer.a;
    return layer;
}

// Slips a layer in between the light `front` and all that was gathered after it.
INLINE void slip_in(struct light *light, const struct light *front, const struct light *layer,
                    mask where) {
    const real clear = 1.0f - front->a, through = 1.0f - layer->a;
    light->r = CHOOSE(light->r, front->r + clear * layer->r + through * (light->r - front->r), where);
    light->g = CHOOSE(light->g, front->g + clear * layer->g + through * (light->g - front->g), where);
    light->b = CHOOSE(light->b, front->b + clear * layer->b + through * (light->b - front->b), where);
    light->a = CHOOSE(light->a, front->a + clear * layer->a + through * (light->a - front->a), where);
}

// Gives the ray its projections, the farthest first, so that what the others remember stays right.
INLINE void slip_in_projections(__constant struct world *world, TABLE_SPACE const uint *table,
                         struct gathered *gathered, const struct crossing *crossing,
                         struct light *light) {
    for (int round = 0; round < COUNTED(crossing->count); round++) {
        integer farthest = (integer)(-1), which = (integer)(-1);
        for (int c = 0; c < COUNTED(crossing->count); c++) {
            const integer at = gathered->projections[c].at;
            const mask farther = MASK(at >= 0) & MASK(at >= farthest);
            farthest = CHOOSE(farthest, at, farther);
            which = CHOOSE(which, (integer)(c), farther);
        }
        for (int c = 0; c < COUNTED(crossing->count); c++) {
            struct projection *projection = &gathered->projections[c];
            const mask chosen = MASK(which == c);
            if (!any_lane(chosen))
                continue;
            __constant struct part *part = &world->parts[LISTED(crossing->parts, c)];
            const struct light layer = projection_layer(table, part, projection);
            slip_in(light, &projection->front, &layer, chosen);
            projection->at = CHOOSE(projection->at, (integer)(-1), chosen);
        }
    }
}
#endif

#endif
