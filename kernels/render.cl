// render.cl - the only sampled ray loop.
//
// A work-item follows one packet of rays through all parts that they cross. Sample i of a ray lies
// at t_near + (i + phase) * step whatever is skipped, so skipping never changes the picture. The
// cost of a sample follows the parts that the packet is in (active.cl). Each part has a cursor;
// after a sample in which nothing was visible the ray goes on to the least of the cursors' answers.
#include "classify.cl"
#include "depth.cl"
#include "mix.cl"
#include "model.cl"
#include "order.cl"
#include "pixel.cl"
#include "shade.cl"
#include "shared/tiles.h"
#include "sight.cl"
#include "span.cl"
#include "style.cl"
#if ADAPTIVE
#include "stride.cl"
#else
#include "even.cl"
#endif
#if DEBUG
#include "debug.cl"
#endif
#if MODELS & MODELS_EMISSION
#include "exact.cl"
#endif
#if PROBE
#include "probe_log.cl"
#endif
#if SUPERSAMPLING
#include "resolve.cl"
#endif

#ifndef GROUP_ROWS
#define GROUP_ROWS 1 // packets above each other in a work-group
#endif
#ifndef DEBUG
#define DEBUG 0 // 1: a number of each ray in place of its light
#endif

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
        struct mixture mixture = mix_begin();
        for (int a = 0; a < COUNTED(active.count); a++) {
            const int c = MIXING == MIXING_ORDERED ? a : LISTED(active.list, a);
            struct cursor *cursor = &crossing->cursors[c];
            __constant struct part *part = &world->parts[LISTED(crossing->parts, c)];
            mask present = alive;
#if MIXING == MIXING_ORDERED
            present &= MASK(order_place(crossing, c) == place);
            i = cursor->next;
#elif CAPACITY > 1
            present &= MASK(RUN_LAST(i, length) >= cursor->next) & MASK(i < cursor->end);
#endif
#if CAPACITY > 1
            if (!any_lane(present))
                continue;
#endif
            const real t = RUN_PLACE(TO_REAL(cursor_clamp(cursor, i)), length, present);
#if MIXING == MIXING_ORDERED
            cursor->next -= present;
#endif
#if CLIP
            if (part->hole_count > 0) {
                const real number = SAMPLE_NUMBER(crossing, c, t);
                present &= clip_keeps(world, part, &crossing->ray,
                                      crossing->t_first + number * world->step_mm);
                if (!any_lane(present))
                    continue;
            }
#endif
            const real x = cursor->ox + t * cursor->dx, y = cursor->oy + t * cursor->dy,
                       z = cursor->oz + t * cursor->dz;
#if MASKED
            const mask reached = present;
            present &= mask_keeps(world, part, MEMORY_ARGUMENTS, x, y, z);
            if (!any_lane(present)) {
                pass_over(part, cells, cursor, RUN_LAST(i, length), reached);
                continue;
            }
#endif
            *samples -= present;
            COUNT_SPARED(crossing, length, present);
            struct sight sight;
            look(table, MEMORY_ARGUMENTS, part, x, y, z, &present, expected >> c & 1, &sight);
#if MODELS
            if (part->model != MODEL_ABSORPTION) {
                const struct spot spot = {part, cursor, c, i, present};
                seen |= any_lane(gather(world, table, cells, MEMORY_ARGUMENTS, &gathered, crossing,
                                        &light, &mixture, &sight.sample, spot));
                continue;
            }
#endif
#if PROBE
            log_sample(crossing, c, i, length, x, y, z, sight.sample.raw,
                       sight.visible ? sight.entry.strength : 0, layer->a);
#endif
            expected &= ~(1UL << c);
            if (!any_lane(sight.visible)) {
                pass_over(part, cells, cursor, RUN_LAST(i, length), present);
                continue;
            }
            seen = true;
            expected |= 1UL << c;
            real r, g, b;
            entry_colour(&sight.entry, &r, &g, &b);
#if VOXELS & VOXELS_RGBA
            if (IS_CLASS(part, VOXELS_RGBA)) {
                r = sight.sample.r;
                g = sight.sample.g;
                b = sight.sample.b;
            }
#endif
#if SHADING
            if (HAS_NORMALS(part))
                style(FRAME_ARGUMENTS, part, MEMORY_ARGUMENTS, &crossing->ray, crossing->t_first,
                      SAMPLE_NUMBER(crossing, c, t), x, y, z, &sight, &r, &g, &b);
#endif
#if PROBE
            log_colour(crossing, r, g, b);
#endif
            mix_add(&mixture, layer, part, r, g, b,
                    CHOOSE(zero, RUN_STRENGTH(sight.entry.strength, length), sight.visible));
        }

#if MIXING == MIXING_ORDERED
        NOTE_DEPTH(crossing, &light, place / PLACES_PER_STEP);
        if (seen)
            alive &= MASK(light.a <= world->termination);
#else
        i = RUN_NEXT(i, length, alive); // on, where the ray still runs
        if (seen) {
            mix_end(world, &mixture, layer);
#if MODELS
            gathered_join(&gathered, &light);
#endif
            NOTE_DEPTH(crossing, &light, RUN_MIDDLE(i, length));
            alive &= MASK(light.a <= world->termination);
        } else {
            i = CHOOSE(i, leap(&active, crossing, i), alive);
        }
        alive &= MASK(i < last);
#endif
    }
#if MODELS & MODELS_PROJECTION
    slip_in_projections(world, table, &gathered, crossing, &light);
#endif
    crossing->behind = samples_behind(crossing, i);
    return light;
}

#include "packet.cl"
#include "glasses.cl"

// Renders the tiles from `first_tile` on, one packet per work-item. Writes premultiplied RGBA, rows
// from the top, and each packet's numbers of samples (SAMPLE_COUNTS). A work-item of two eyes leaves
// the second one's numbers behind those of all packets of its tile.
__kernel void render(__constant struct world *world, TABLE_SPACE const uint *table,
                     __global float4 *picture, __global uint *sample_counts, const uint first_tile,
                     __global const uchar *cells RAY_PARAMETERS STRIDE_PARAMETER,
                     MEMORY_PARAMETERS) {
    const uint packets_per_row = TILE_PX / PACKET_W;
    const uint packets_per_tile = packets_per_row * (TILE_PX / PACKET_H);
    const uint packet = get_global_id(0) % packets_per_tile;
    const uint turn = get_global_id(0) / packets_per_tile + first_tile;
    const struct tile_place tile =
        tile_at(EYES == EYES_BOTH ? turn / 2 : turn, world->tiles_x, world->tiles_y);
    // Packets run down GROUP_ROWS rows, a work-group's height, before they go on to the right.
    const uint band = packet / (packets_per_row * GROUP_ROWS),
               place = packet % (packets_per_row * GROUP_ROWS);
    const uint column = place / GROUP_ROWS, row = band * GROUP_ROWS + place % GROUP_ROWS;
    const int left = tile.x * TILE_PX + (int)column * PACKET_W;
    const int top = tile.y * TILE_PX + (int)row * PACKET_H;
    const uint eyes = EYES == EYES_MERGED ? 2 : 1;
    __global uint *counts = &sample_counts[(turn * eyes * packets_per_tile + packet) * SAMPLE_COUNTS];
    __global uint *second_counts = counts + (eyes - 1) * packets_per_tile * SAMPLE_COUNTS;
    for (int n = 0; n < SAMPLE_COUNTS; n++)
        counts[n] = second_counts[n] = earlier_samples(world, counts[n] RAY_ARGUMENTS);
    if (left >= world->width || top >= world->height)
        return;

#if EYES == EYES_MERGED
    struct light light = {(real)(0.0f), (real)(0.0f), (real)(0.0f), (real)(0.0f)}, first = light;
    for (int side = 0; side < 2; side++) {
        first = light;
        const struct ray ray = pixel_rays(world, side, left, top RAY_ARGUMENTS);
        light = packet_light(world, table, cells STRIDE_ARGUMENT, MEMORY_ARGUMENTS, &ray, left, top, picture,
                             side ? second_counts : counts);
    }
    store_merged(world, picture, left, top, &first, &light);
#else
    const int eye = EYES == EYES_BOTH ? (int)(turn % 2) : 0;
    const struct ray ray = pixel_rays(world, eye, left, top RAY_ARGUMENTS);
    if (!any_lane(RAY_RUNS(&ray)))
        return;
    struct light light =
        packet_light(world, table, cells STRIDE_ARGUMENT, MEMORY_ARGUMENTS, &ray, left, top, picture, counts);
#if !DEBUG
    add_background(&light, world);
#endif
    store_pixels(world, picture, eye, left, top, &ray, &light);
#endif
}

#if PROBE
#include "probe.cl"
#endif
