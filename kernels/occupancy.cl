// occupancy.cl - from a transfer function to the cells of a part in which something may be visible.
//
// The first pass compares each cell's range of values with the table: a count of visible entries up
// to each one answers whether a range holds any with two look-ups. What the passes after it make of
// that depends on the way to skip: distances.cl, nodes.cl, bricks.cl or bins.cl.
//
// Included by span.cl, because a program of their own would cost another half second of a cold
// start; and nothing is in it that its variant does not ask for, because all passes and optical
// models together cost a cold start a tenth of its time.
#ifndef OCCUPANCY_CL
#define OCCUPANCY_CL

#include "shared/grid.h"
#include "shared/world.h"

// Cells of a part along x, y and z.
struct cell_dims {
    int x, y, z;
};

// The range of the values that samples in cells up to `reach` away from cell i may have. A cubic filter reads a voxel more on
// each side, so its cells have a share in their neighbours; and Catmull & Rom's weights, whose
// absolute values add up to at most 5/4 along an axis, lead out of the range of the voxels by at
// most ((5/4)^3 - 1) / 2 of it on either side.
static float2 reachable(__constant struct part *part, __global const float2 *ranges,
                        struct cell_dims dims, int i, int reach) {
    reach += part->filter & FILTERS_CUBIC ? 1 : 0;
    if (reach == 0)
        return ranges[i];
    const int x = i % dims.x, y = i / dims.x % dims.y, z = i / part->cell_slice;
    float2 range = (float2)(INFINITY, -INFINITY);
    for (int nz = max(z - reach, 0); nz <= min(z + reach, dims.z - 1); nz++)
        for (int ny = max(y - reach, 0); ny <= min(y + reach, dims.y - 1); ny++)
            for (int nx = max(x - reach, 0); nx <= min(x + reach, dims.x - 1); nx++) {
                const float2 near = ranges[nz * part->cell_slice + ny * part->cell_row + nx];
                range = (float2)(fmin(range.x, near.x), fmax(range.y, near.y));
            }
    const float beyond =
        part->filter == FILTERS_CATMULL_ROM ? (range.y - range.x) * (61.0f / 128.0f) : 0.0f;
    return range.x > range.y ? range : (float2)(range.x - beyond, range.y + beyond);
}

#if MODELS & MODELS_ISO
// Whether a surface of the part may lie in a cell with a range of values.
static bool has_surface(__constant struct part *part, float2 range) {
    __constant const float *values = (__constant const float *)&part->surface_values;
    for (int n = 0; n < part->surface_count; n++) {
        const float slack = 1e-5f * (range.y - range.x + fabs(values[n]));
        if (values[n] >= range.x - slack && values[n] <= range.y + slack)
            return true;
    }
    return false;
}
#endif

// Whether something may be visible in a cell with a range of values. An extremum is moved by all values that it does not
// outdo, and a mean by all.
static bool occupied(__constant struct part *part, float2 range, __global const uint *counts,
                     bool linear) {
    // A cell without any value has its ends the wrong way round.
    if (range.x > range.y)
        return false;
#if MODELS & MODELS_ISO
    if (part->model == MODEL_ISO)
        return has_surface(part, range);
#endif
#if MODELS & MODELS_PROJECTION
    if (part->model == MODEL_AVERAGE)
        return true;
#endif
    const float a = range.x * part->table_scale + part->table_bias;
    const float b = range.y * part->table_scale + part->table_bias;
    // Interpolation rounds; one value everywhere does not.
    const float slack = range.x < range.y ? 1e-3f : 0.0f;
    const float low = clamp(fmin(a, b) - slack, 0.0f, part->table_last);
    const float high = clamp(fmax(a, b) + slack, 0.0f, part->table_last);
    const bool between = linear && !part->table_nearest;
    int first = between ? (int)low : (int)(low + 0.5f);
    int last = between ? (int)ceil(high) : (int)(high + 0.5f);
#if MODELS & MODELS_PROJECTION
    if (part->model == MODEL_MIP)
        first = 0;
    if (part->model == MODEL_MINIP)
        last = (int)part->table_last;
#endif
    return counts[last + 1] > counts[first];
}

// Whether something may be visible in cell i of a part's `count`; 0 when it may. There are many, so divisions are left to
// those that need them.
static uchar find_cell(__constant struct world *world, __constant struct part *part,
                       __global const float2 *ranges, __global const uint *counts, uint count,
                       int i, bool linear, uchar empty) {
#if MASKED
    if (mask_empties(world, part, ranges, i % part->cell_row, i % part->cell_slice / part->cell_row, i / part->cell_slice))
        return empty;
#endif
    float2 range = ranges[part->ranges + i];
#if FILTERS & FILTERS_CUBIC
    if (part->filter & FILTERS_CUBIC) {
        const struct cell_dims dims = {part->cell_row, part->cell_slice / part->cell_row,
                                       (int)count / part->cell_slice};
        range = reachable(part, ranges + part->ranges, dims, i, 0);
    }
#endif
    return occupied(part, range, counts + part->visible, linear) ? 0 : empty;
}

#if SKIP == SKIP_GRID || SKIP == SKIP_DISTANCE
#include "distances.cl"
#elif SKIP == SKIP_OCTREE
#include "nodes.cl"
#elif SKIP == SKIP_BVH || SKIP == SKIP_BLOCKS
#include "bricks.cl"
#endif
#if SKIP == SKIP_BLOCKS
#include "bins.cl"
#endif
#if ADAPTIVE
#include "stride_cells.cl"
#endif

// One pass over the `count` cells of a part, from `in` to `out`, in which empty cells hold `empty`
// at first. `linear` tells that the kernel interpolates between table entries. One kernel for all
// passes, because each one more costs a cold start an eighth of a second.
__kernel void occupancy(__constant struct world *world, __global const float2 *ranges,
                        __global const uint *visible, __global const uchar *in, __global uchar *out,
                        const uint part_index, const uint count, const uint linear, const uint pass,
                        const uint empty) {
    const uint i = get_global_id(0);
    if (i >= count)
        return;
    __constant struct part *part = &world->parts[part_index];
    if (pass == PASS_OCCUPY) {
        out[part->cells + i] = find_cell(world, part, ranges, visible, count, (int)i, linear, (uchar)empty);
        return;
    }
    const struct cell_dims dims = {part->cell_row, part->cell_slice / part->cell_row,
                                   (int)count / part->cell_slice};
    in += part->cells;
#if SKIP == SKIP_BLOCKS
    // `empty` says how large a sub-block is, or that no data are to be stored as well.
    if (pass == PASS_SEEN) {
        keep_seen(part, in, out, dims, (int)i, (int)empty);
        return;
    }
#endif
    out += part->cells;
#if ADAPTIVE
    if (pass == PASS_STRIDE) {
        out[i] = find_stride(world, part, ranges, visible, dims, (int)i);
        return;
    }
#endif
#if SKIP == SKIP_BLOCKS
    if (pass == PASS_VISIBLE)
        out[i] = visible_bins(part, visible + part->visible);
    else if (pass == PASS_CORNER)
        out[i] = occupied(part, reachable(part, ranges + part->ranges, dims, 0, 0), visible + part->visible, linear);
    else
        out[i] = find_bins(part, ranges + part->ranges, dims, (int)i, (int)(pass - PASS_BINS), empty);
#endif
#if SKIP == SKIP_GRID || SKIP == SKIP_DISTANCE
    spread(part, in, out, dims, (int)i, pass);
#elif SKIP == SKIP_OCTREE
    if (pass == PASS_NAME)
        out[i] = name_node(part, in, dims, (int)i);
    else
        merge(part, out, dims, (int)i, (int)(pass - PASS_MERGE));
#elif SKIP == SKIP_BVH
    out[i] = find_brick(part, in, dims, (int)i, (int)(pass - PASS_BRICK));
#endif
}

#endif
