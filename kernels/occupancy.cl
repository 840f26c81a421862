// occupancy.cl - from a transfer function to the cells of a part in which something may be visible.
//
// `occupy` compares each cell's range of values with the table: a count of visible entries up to each one answers
// whether a range holds any with two look-ups. `spread` turns that into distances, one axis at a time: the Chebyshev
// distance separates, D(x) = min over k of max(|k|, D(x + k)).
//
// Included by render.cl, because a program of their own would cost another half second of a cold start.
#ifndef OCCUPANCY_CL
#define OCCUPANCY_CL

#include "shared/grid.h"
#include "shared/world.h"

// Cells of a part along x, y and z.
struct cell_dims {
    int x, y, z;
};

static struct cell_dims cell_dims(__constant struct part *part, uint count) {
    const struct cell_dims dims = {part->cell_row, part->cell_slice / part->cell_row,
                                   (int)count / part->cell_slice};
    return dims;
}

// Writes 0 for a cell in which something may be visible, else the largest distance. `count` is the number of the
// part's cells; `linear` tells that the kernel interpolates between entries.
__kernel void occupy(__constant struct world *world, __global const float2 *ranges,
                     __global const uint *visible, __global uchar *cells, const uint part_index,
                     const uint count, const uint linear) {
    const uint i = get_global_id(0);
    if (i >= count)
        return;
    __constant struct part *part = &world->parts[part_index];
    const float2 range = ranges[part->ranges + i];
    uchar distance = CELL_DISTANCE_MAX;
    // A cell without any value has its ends the wrong way round.
    if (range.x <= range.y) {
        const float a = range.x * part->table_scale + part->table_bias;
        const float b = range.y * part->table_scale + part->table_bias;
        // Interpolation rounds; one value everywhere does not.
        const float slack = range.x < range.y ? 1e-3f : 0.0f;
        const float low = clamp(fmin(a, b) - slack, 0.0f, part->table_last);
        const float high = clamp(fmax(a, b) + slack, 0.0f, part->table_last);
        const bool between = linear && !part->table_nearest;
        const int first = between ? (int)low : (int)(low + 0.5f);
        const int last = between ? (int)ceil(high) : (int)(high + 0.5f);
        __global const uint *counts = visible + part->visible;
        if (counts[last + 1] > counts[first])
            distance = 0;
    }
    cells[part->cells + i] = distance;
}

// Spreads distances along one axis (0, 1, 2), from `in` to `out`.
__kernel void spread(__constant struct world *world, __global const uchar *in, __global uchar *out,
                     const uint part_index, const uint count, const uint axis) {
    const uint i = get_global_id(0);
    if (i >= count)
        return;
    __constant struct part *part = &world->parts[part_index];
    const struct cell_dims dims = cell_dims(part, count);
    const int x = (int)i % dims.x, y = (int)i / dims.x % dims.y, z = (int)i / part->cell_slice;
    const int at = axis == 0 ? x : axis == 1 ? y : z;
    const int size = axis == 0 ? dims.x : axis == 1 ? dims.y : dims.z;
    const int stride = axis == 0 ? 1 : axis == 1 ? part->cell_row : part->cell_slice;
    __global const uchar *cell = in + part->cells + i;
    int best = *cell;
    for (int k = 1; k < best; k++) {
        if (at - k >= 0)
            best = min(best, max(k, (int)cell[-k * stride]));
        if (at + k < size)
            best = min(best, max(k, (int)cell[k * stride]));
        if (at - k < 0 && at + k >= size)
            break;
    }
    out[part->cells + i] = (uchar)best;
}

#endif
