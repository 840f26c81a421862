// secondary.cl - rays that go on from a sample: to each lamp (shadows) and around its normal
// (ambient occlusion).
//
// Both ask how much light comes through all volumes along a line, as they are mixed in the picture.
// The rays leap over what is empty as those of the picture do, by cursors of their own. See
// docs/picture.md, "Shadows and ambient occlusion".
// Included by shade.cl.
#ifndef SECONDARY_CL
#define SECONDARY_CL

#include "classify.cl"
#include "gradient_opacity.cl"
#include "mix.cl"

#if SECONDARY
#define SECONDARY_DEPTH_MAX 12.0f // no more than e^-12 of the light comes from behind

// What secondary rays remember of each part.
struct obstacle {
    struct cursor cursor;
#if MODELS & MODELS_ISO
    real raw; // of the last sample, and its number
    integer at;
#endif
};

#if MODELS
#define IS_OBSTACLE(part)                                                                          \
    ((part)->model == MODEL_ABSORPTION || (part)->model == MODEL_PREINTEGRATED ||                  \
     (part)->model == MODEL_ISO)
#else
#define IS_OBSTACLE(part) true
#endif

// Places a cursor in a part along a secondary ray, which ends at `end`. Its samples lie in the
// middles of steps.
INLINE void begin_obstacle(struct obstacle *obstacle, __constant struct world *world,
                           __constant struct part *part, __global const uchar *cells,
                           const struct ray *ray, real end, float step_mm) {
    const struct ray ray_voxel = transform_ray(part->voxel_from_world, ray);
    struct span span = box_span(&ray_voxel, part->box_low, part->box_high);
#if CLIP
    clip_span(world, part, ray, &span);
#endif
    span.far = fmin(span.far, end);
    if (!IS_OBSTACLE(part))
        span.far = (real)(-1.0f);
    const real t_near = (real)(0.0f) + (0.5f - RAY_PHASE(world, ray)) * step_mm;
    struct cursor *cursor = &obstacle->cursor;
    *cursor = cursor_begin(world, part, &ray_voxel, &span, t_near, step_mm);
    if (any_lane(MASK(cursor->first < cursor->end)))
        cursor->next = cursor_leap(part, cells, cursor, cursor->first, (mask)(-1));
#if MODELS & MODELS_ISO
    obstacle->raw = (real)(0.0f);
    obstacle->at = (integer)(-2);
    // A surface lies between two samples, so the one before comes first.
    if (part->model == MODEL_ISO)
        cursor->next = max(cursor->next - 1, cursor->first);
#endif
}

#if MODELS & MODELS_ISO
// The depth of the surfaces that lie between the sample before and this one.
INLINE real cross_surfaces(__constant struct part *part, __global const uchar *cells,
                           struct obstacle *obstacle, integer i, real raw, mask present) {
#if VOXELS & VOXELS_F32
    present &= MASK(raw == raw);
#endif
    __constant const float *values = (__constant const float *)&part->surface_values;
    const mask known = present & MASK(obstacle->at == i - 1);
    real depth = (real)(0.0f);
    for (int n = 0; n < part->surface_count; n++) {
        const mask crossed = known & (MASK(obstacle->raw < values[n]) ^ MASK(raw < values[n]));
        const real surface = (real)(-log(fmax(1.0f - part->surfaces[n].w, 0x1p-24f)));
        depth += CHOOSE((real)(0.0f), surface, crossed);
    }
    obstacle->raw = CHOOSE(obstacle->raw, raw, present);
    obstacle->at = CHOOSE(obstacle->at, i, present);
    struct cursor *cursor = &obstacle->cursor;
    const integer least = max(cursor->next, i + 1);
    cursor->next = max(cursor_leap(part, cells, cursor, i + 1, present) - 1, least);
    return depth;
}
#endif

#if MODELS & MODELS_PREINTEGRATED
// The strength of a value that stays from one sample to the next.
INLINE real pair_strength(TABLE_SPACE const uint *table, __constant struct part *part, real raw) {
    const struct side side = find_side(part, raw);
    const real w = side.weight;
    const integer word = side.entry * ((PAIR_ENTRIES + 1) * 2) + (int)part->table;
    real depth = (real)(0.0f);
    for (int n = 0; n < 4; n++) {
        const integer at = word + ((n & 2 ? PAIR_ENTRIES : 0) + (n & 1)) * 2;
        depth += (n & 2 ? w : 1.0f - w) * (n & 1 ? w : 1.0f - w) * GATHER(float, LOAD_STRENGTH, at);
    }
#if STRENGTH_DEPTH
    return depth;
#else
    return 1.0f - exp(-depth);
#endif
}
#endif

// The strength of a part at a place of the ray, given in memory coordinates; 0 where it is not
// present.
INLINE real obstacle_strength(TABLE_SPACE const uint *table, __constant struct part *part,
                              MEMORY_PARAMETERS, const struct ray *ray, real x, real y, real z,
                              real raw, mask present) {
    const real zero = (real)(0.0f);
#if MODELS & MODELS_PREINTEGRATED
    if (part->model == MODEL_PREINTEGRATED) {
#if VOXELS & VOXELS_F32
        present &= MASK(raw == raw);
#endif
        return CHOOSE(zero, pair_strength(table, part, CHOOSE(zero, raw, present)), present);
    }
#endif
    const struct entry entry = find_entry(table, part, raw, &present);
    real strength = CHOOSE(zero, entry.strength, present);
#if STYLE
    if (part->styled && any_lane(MASK(strength > 0.0f))) {
        real slope;
        const struct vector normal =
            find_normal(MEMORY_ARGUMENTS, part, CHOOSE(zero, raw, present), x, y, z, &slope);
        strength = scale_strength(strength, style_factor(part, ray, &normal, slope));
    }
#endif
    return strength;
}

// Adds what a part has at a place, as the depth of a step of the picture.
INLINE void obstruct(__constant struct world *world, __constant struct part *part,
                     struct mixture *mixture, real strength) {
#if STRENGTH_DEPTH
    const real zero = (real)(0.0f);
    struct light none = {zero, zero, zero, zero};
    mix_add(mixture, &none, part, zero, zero, zero, strength);
#else
    // Here tables are of opacity, in `ordered` over a step of the part's own.
    const float strength_mm = MIXING == MIXING_ORDERED ? part->step_mm : world->step_mm;
    const real clear = AT_LEAST(1.0f - strength, (real)(0x1p-24f));
    mixture->depth -= log(clear) * (world->step_mm / strength_mm);
#endif
}

// Adds a part's sample i, at t of its cursor, to the mixture. Returns the depth of its surfaces,
// which are not mixed.
INLINE real meet(__constant struct world *world, TABLE_SPACE const uint *table,
                 __global const uchar *cells, MEMORY_PARAMETERS, struct obstacle *obstacle,
                 __constant struct part *part, const struct ray *ray, integer i, real t,
                 mask present, struct mixture *mixture) {
    struct cursor *cursor = &obstacle->cursor;
    const real x = cursor->ox + t * cursor->dx, y = cursor->oy + t * cursor->dy,
               z = cursor->oz + t * cursor->dz;
#if MASKED
    present &= mask_keeps(world, part, MEMORY_ARGUMENTS, x, y, z);
#endif
    const real raw = sample_part(MEMORY_ARGUMENTS, part, x, y, z).raw;
#if MODELS & MODELS_ISO
    if (part->model == MODEL_ISO)
        return cross_surfaces(part, cells, obstacle, i, raw, present);
#endif
    const real strength =
        obstacle_strength(table, part, MEMORY_ARGUMENTS, ray, x, y, z, raw, present);
    if (any_lane(MASK(strength > 0.0f)))
        obstruct(world, part, mixture, strength);
    else
        cursor->next = cursor_leap(part, cells, cursor, i + 1, present);
    return (real)(0.0f);
}

// The share of light that comes through along a ray of a sample, up to `end`, in the lanes that
// ask.
INLINE real light_through(__constant struct world *world, TABLE_SPACE const uint *table,
                          __global const uchar *cells, MEMORY_PARAMETERS, const struct ray *ray,
                          real end, float step_mm, mask asks) {
    struct obstacle obstacles[CAPACITY];
    int parts[CAPACITY], count = 0;
    integer i = (integer)(SAMPLE_NEVER), last = (integer)(0);
    const real far = CHOOSE((real)(-1.0f), end, asks);
    for (ulong met = PARTS_MET(world, ray, far); met != 0; met &= met - 1) {
        const int p = FIRST_PART(met);
        struct obstacle *obstacle = &obstacles[CAPACITY == 1 ? 0 : count];
        begin_obstacle(obstacle, world, &world->parts[p], cells, ray, far, step_mm);
        const integer next = obstacle->cursor.next, behind = obstacle->cursor.end;
        if (!any_lane(MASK(next < behind)))
            continue;
        parts[CAPACITY == 1 ? 0 : count++] = p;
        i = min(i, next);
        last = max(last, behind);
    }
    real depth = (real)(0.0f);
    mask alive = asks & MASK(i < last);
    while (any_lane(alive)) {
        struct mixture mixture = mix_begin();
        integer next = (integer)(SAMPLE_NEVER);
        for (int n = 0; n < COUNTED(count); n++) {
            __constant struct part *part = &world->parts[LISTED(parts, n)];
            struct cursor *cursor = &obstacles[n].cursor;
            mask present = alive & MASK(i >= cursor->next) & MASK(i < cursor->end);
            const real t = TO_REAL(cursor_clamp(cursor, i));
#if CLIP
            if (part->hole_count > 0)
                present &= clip_keeps(world, part, ray, (t + 0.5f) * step_mm);
#endif
            if (any_lane(present))
                depth += meet(world, table, cells, MEMORY_ARGUMENTS, &obstacles[n], part, ray, i, t,
                              present, &mixture);
            const integer own = max(cursor->next, i + 1);
            next = min(next, CHOOSE((integer)(SAMPLE_NEVER), own, MASK(own < cursor->end)));
        }
        depth += mix_depth(world, &mixture) * (step_mm / world->step_mm);
        i = CHOOSE(i, next, alive);
        alive &= MASK(i < last) & MASK(depth < SECONDARY_DEPTH_MAX);
    }
    return exp(-depth);
}
#endif

#endif
