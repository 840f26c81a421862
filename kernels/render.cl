// render.cl - the kernel: one packet of rays for each work-item.
#include "march.cl"
#include "pixel.cl"
#include "shared/tiles.h"
#if DEBUG
#include "debug.cl"
#endif
#if MODELS & MODELS_EMISSION
#include "exact.cl"
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
