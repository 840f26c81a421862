// bins.cl - what the sub-blocks of traverse/blocks.cl are culled by: bins of values.
//
// The entries of a part's table are divided into BLOCK_BINS bins. A sub-block has one bit for each
// bin that values in it touch (Derin et al. 2021, section 2.3), and none where the value around the
// part's first corner fills it: there are no data. That does not depend on what can be seen, so an
// edit of the transfer function costs no more than to find the visible bins, and a look at the
// cells of the stored sub-blocks. Included by occupancy.cl, behind bricks.cl.
#ifndef BINS_CL
#define BINS_CL

#include "shared/block.h"

// The bins that entries from low to high are in, one bit each.
static uint bins_between(__constant struct part *part, float low, float high) {
    const float per_entry = BLOCK_BINS / (part->table_last + 1.0f);
    const int first = (int)clamp(floor(low * per_entry), 0.0f, BLOCK_BINS - 1.0f);
    const int last = (int)clamp(floor(high * per_entry), 0.0f, BLOCK_BINS - 1.0f);
    return (2u << last) - (1u << first);
}

// The bins of which something can be seen. An entry before which a bin ends belongs to it, too,
// because what is between entries is interpolated.
static uchar visible_bins(__constant struct part *part, __global const uint *next) {
    uint bins = 0;
    if (part->model == MODEL_AVERAGE)
        return BLOCK_BINS_ALL;
    if (part->model == MODEL_ISO) {
        __constant const float *values = (__constant const float *)&part->surface_values;
        for (int n = 0; n < part->surface_count; n++) {
            const float entry = values[n] * part->table_scale + part->table_bias;
            const float slack = 1e-4f * (fabs(values[n] * part->table_scale) + part->table_last);
            bins |= bins_between(part, entry - slack, entry + slack);
        }
        return (uchar)bins;
    }
    const float entries = (part->table_last + 1.0f) / BLOCK_BINS;
    for (int bin = 0; bin < BLOCK_BINS; bin++) {
        int first = (int)floor((float)bin * entries);
        int last = (int)fmin(ceil((float)(bin + 1) * entries), part->table_last);
        if (part->model == MODEL_MIP)
            first = 0;
        if (part->model == MODEL_MINIP)
            last = (int)part->table_last;
        if ((int)next[first] <= last)
            bins |= 1u << bin;
    }
    return (uchar)bins;
}

// The bins that the values of brick i touch, which has 2^bits cells along a side. With `whole`,
// what is no data, too.
static uchar find_bins(__constant struct part *part, __global const float2 *ranges,
                       struct cell_dims dims, int i, int bits, bool whole) {
    struct cell_box box;
    brick_cells(dims, i, bits, &box);
    const float2 corner = reachable(part, ranges, dims, 0);
    bool data = whole;
    uint bins = 0;
    for (int z = box.low.z; z < box.high.z; z++)
        for (int y = box.low.y; y < box.high.y; y++)
            for (int x = box.low.x; x < box.high.x; x++) {
                const float2 range = reachable(part, ranges, dims,
                                               z * part->cell_slice + y * part->cell_row + x);
                if (range.x > range.y)
                    continue;
                const float a = range.x * part->table_scale + part->table_bias;
                const float b = range.y * part->table_scale + part->table_bias;
                // Interpolation rounds.
                bins |= bins_between(part, fmin(a, b) - 1e-3f, fmax(a, b) + 1e-3f);
                data |= range.x != range.y || corner.x != corner.y || range.x != corner.x;
            }
    return data ? (uchar)bins : (uchar)0;
}

// Leaves stored sub-block i of the part its bins, or none where all its cells, 2^bits along a side,
// are empty now.
static void keep_seen(__constant struct part *part, __global const uchar *cells,
                      __global uchar *blocks, struct cell_dims dims, int i, int bits) {
    __global const struct block_grid *grid =
        &((__global const struct block_grid *)blocks)[part->number];
    if (i >= (int)grid->stored)
        return;
    __global const uint *places = (__global const uint *)(blocks + grid->places);
    __global uchar *seen = blocks + grid->seen;
    const uchar bins = seen[grid->stored + i];
    seen[i] = find_brick(part, cells, dims, (int)places[i], bits) ? bins : (uchar)0;
}

// Whether the value around a part's first corner can be seen.
static uchar corner_visible(__constant struct part *part, __global const float2 *ranges,
                            __global const uint *next, struct cell_dims dims, bool linear) {
    const float2 range = reachable(part, ranges, dims, 0);
    return any_lane(occupied(part, (real)(range.x), (real)(range.y), next, linear));
}

#endif
