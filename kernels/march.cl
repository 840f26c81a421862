// march.cl - the only sampled ray loop.
//
// A packet of rays is followed through all parts that they cross. Sample i of a ray lies at
// t_near + (i + phase) * step whatever is skipped, so skipping never changes the picture. The cost
// of a sample follows the parts that the packet is in (active.cl). Each part has a cursor; after
// samples in which nothing was visible the ray goes on to the least of the cursors' answers. Where
// AT_ONCE is 2, sample i and the one behind it are looked at together, then mixed one by one.
#ifndef MARCH_CL
#define MARCH_CL

#include "classify.cl"
#include "depth.cl"
#include "mix.cl"
#include "model.cl"
#include "order.cl"
#include "sight.cl"
#include "style.cl"
#if ADAPTIVE
#include "stride.cl"
#else
#include "even.cl"
#endif
#if PROBE
#include "probe_log.cl"
#endif

// Aims a sight at sample i of a part, or at the middle of the run that begins there, and clears the
// lanes of sight->present in which it is cut away or masked. Returns those that are not cut away.
INLINE mask aim(__constant struct world *world, MEMORY_PARAMETERS, const struct crossing *crossing,
                int c, __constant struct part *part, integer i, integer length, struct sight *sight) {
    const struct cursor *cursor = &crossing->cursors[c];
    const real t = RUN_PLACE(TO_REAL(cursor_clamp(cursor, i)), length, sight->present);
    sight->t = t;
    sight->x = cursor->ox + t * cursor->dx;
    sight->y = cursor->oy + t * cursor->dy;
    sight->z = cursor->oz + t * cursor->dz;
#if CLIP
    if (part->hole_count > 0) {
        const real number = SAMPLE_NUMBER(crossing, c, t);
        sight->present &= clip_keeps(world, part, &crossing->ray,
                                     crossing->t_first + number * world->step_mm);
    }
#endif
    const mask reached = sight->present;
#if MASKED
    if (any_lane(reached))
        sight->present &= mask_keeps(world, part, MEMORY_ARGUMENTS, sight->x, sight->y, sight->z);
#endif
    return reached;
}

// Adds to each mixture what the sight of its sample shows of a part, shaded where it is to be.
INLINE void mix_sights(__constant struct world *world, TABLE_SPACE const uint *table,
                       __global const uchar *cells, MEMORY_PARAMETERS, struct crossing *crossing,
                       int c, __constant struct part *part, integer length, struct sight *sights,
                       struct mixture *mixtures, struct light *layer) {
#pragma unroll
    for (int k = 0; k < AT_ONCE; k++) {
        struct sight *sight = &sights[k];
        real r, g, b;
        entry_colour(&sight->entry, &r, &g, &b);
#if VOXELS & VOXELS_RGBA
        if (IS_CLASS(part, VOXELS_RGBA)) {
            r = sight->sample.r;
            g = sight->sample.g;
            b = sight->sample.b;
        }
#endif
#if SHADING
        if (HAS_NORMALS(part))
            style(FRAME_ARGUMENTS, part, MEMORY_ARGUMENTS, &crossing->ray, crossing->t_first,
                  SAMPLE_NUMBER(crossing, c, sight->t), sight, &r, &g, &b);
#endif
#if PROBE
        log_colour(crossing, r, g, b);
#endif
        const real strength = RUN_STRENGTH(sight->entry.strength, length);
        mix_add(&mixtures[k], layer, part, r, g, b, CHOOSE((real)(0.0f), strength, sight->visible));
    }
}

// Follows the rays and returns the light they gather. Adds the samples taken to *samples.
INLINE struct light follow_rays(__constant struct world *world, TABLE_SPACE const uint *table,
                                __global const uchar *cells, MEMORY_PARAMETERS,
                                struct crossing *crossing, integer *samples) {
    const real zero = (real)(0.0f);
    struct light light = {zero, zero, zero, zero};
    struct active active;
    mask alive;
    integer i = begin_active(&active, crossing, &alive);
#if MIXING != MIXING_ORDERED
    integer last = active.last;
#endif
#if JOINS
    integer until = active.until;
#endif

#if MODELS
    struct gathered gathered;
    gathered_begin(&gathered, crossing);
    struct light *const layer = &gathered.media;
#else
    struct light *const layer = &light;
#endif

    struct runs runs = runs_begin();
    ulong expected = 0; // cursors whose last sample was seen, one bit each
    while (any_lane(alive)) {
#if MIXING == MIXING_ORDERED
        const real place = order_nearest(crossing);
        alive &= MASK(place < NOWHERE);
        active.count = crossing->count;
#elif CAPACITY > 1
        if (any_lane(alive & MASK(REACH(i) >= until))) {
            join_active(world, cells, &active, crossing, i, alive);
            until = active.until;
            last = active.last;
#if MODELS
            gathered_meet(&gathered, crossing);
#endif
        }
#endif
        const integer length = find_run(world, crossing, &runs, &i, alive);
        bool seen = false;
        struct mixture mixtures[AT_ONCE];
        integer taken[AT_ONCE];
#pragma unroll
        for (int k = 0; k < AT_ONCE; k++) {
            mixtures[k] = mix_begin();
            taken[k] = (integer)(0);
        }
        for (int a = 0; a < COUNTED(active.count); a++) {
            const int c = MIXING == MIXING_ORDERED ? a : LISTED(active.list, a);
            struct cursor *cursor = &crossing->cursors[c];
            __constant struct part *part = &world->parts[LISTED(crossing->parts, c)];
            struct sight sights[AT_ONCE];
            mask reached = (mask)(0), present = (mask)(0);
#pragma unroll
            for (int k = 0; k < AT_ONCE; k++) {
                sights[k].present = alive;
#if MIXING == MIXING_ORDERED
                sights[k].present &= MASK(order_place(crossing, c) == place);
#elif CAPACITY > 1
                sights[k].present &=
                    MASK(RUN_LAST(i + k, length) >= cursor->next) & MASK(i + k < cursor->end);
#else
                if (k > 0)
                    sights[k].present &= MASK(i + k < last);
#endif
                reached |= sights[k].present;
            }
            if (CAPACITY > 1 && !any_lane(reached))
                continue;
#if MIXING == MIXING_ORDERED
            i = cursor->next;
            cursor->next -= reached;
#endif
            reached = (mask)(0);
#pragma unroll
            for (int k = 0; k < AT_ONCE; k++) {
                reached |= aim(world, MEMORY_ARGUMENTS, crossing, c, part, i + k, length, &sights[k]);
                present |= sights[k].present;
                taken[k] -= sights[k].present;
                COUNT_SPARED(crossing, length, sights[k].present);
            }
            if (CLIP && !any_lane(reached))
                continue;
            if (MASKED && !any_lane(present)) {
                pass_over(part, cells, cursor, RUN_LAST(i + AT_ONCE - 1, length), reached);
                continue;
            }
            const mask visible = look(table, MEMORY_ARGUMENTS, part, expected >> c & 1, sights);
#if MODELS
            if (part->model != MODEL_ABSORPTION) {
                const struct spot spot = {part, cursor, c, i, present};
                seen |= any_lane(gather(world, table, cells, MEMORY_ARGUMENTS, &gathered, crossing,
                                        &light, &mixtures[0], &sights[0].sample, spot));
                continue;
            }
#endif
#if PROBE
            log_sample(crossing, c, i, length, sights[0].x, sights[0].y, sights[0].z,
                       sights[0].sample.raw, visible ? sights[0].entry.strength : 0, layer->a);
#endif
            expected &= ~(1UL << c);
            if (!any_lane(visible)) {
                pass_over(part, cells, cursor, RUN_LAST(i + AT_ONCE - 1, length), present);
                continue;
            }
            seen = true;
            expected |= 1UL << c;
            mix_sights(world, table, cells, MEMORY_ARGUMENTS, crossing, c, part, length, sights,
                       mixtures, layer);
        }

#if MIXING == MIXING_ORDERED
        *samples += taken[0];
        NOTE_DEPTH(crossing, &light, place / PLACES_PER_STEP);
        if (seen)
            alive &= MASK(light.a <= world->termination);
#else
#pragma unroll
        for (int k = 0; k < AT_ONCE; k++) { // on, where the ray still runs behind the one before
            *samples += CHOOSE((integer)(0), taken[k], alive);
            i = RUN_NEXT(i, length, alive);
            if (!seen)
                continue;
            if (k > 0)
                mixtures[k].depth = CHOOSE(zero, mixtures[k].depth, alive);
            mix_end(world, &mixtures[k], layer);
#if MODELS
            gathered_join(&gathered, &light);
#endif
            NOTE_DEPTH(crossing, &light, RUN_MIDDLE(i, length));
            alive &= MASK(light.a <= world->termination);
        }
        if (!seen)
            i = CHOOSE(i, leap(&active, crossing, i), alive);
        alive &= MASK(i < last);
#endif
    }
#if MODELS & MODELS_PROJECTION
    slip_in_projections(world, table, &gathered, crossing, &light);
#endif
    crossing->behind = samples_behind(crossing, i);
    return light;
}

#endif
