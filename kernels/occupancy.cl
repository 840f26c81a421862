// occupancy.cl - from a transfer function to the cells of a part in which something may be visible.
//
// The first pass compares each cell's range of values with the table: a count of visible entries up
// to each one answers whether a range holds any with two look-ups. Three more turn that into
// distances, one axis at a time and a row of cells at a time: the Chebyshev distance separates,
// D(x) = min over k of max(|k|, D(x + k)). For an octree the passes go up its levels instead, each over the nodes of one level,
// and a last one brings down to every cell the largest empty node around it: a cell holds 0 where
// something may be visible, else one more than that node's level.
//
// Included by render.cl, because a program of their own would cost another half second of a cold
// start.
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

// Whether something may be visible in a cell with a range of values. An extremum is moved by all values that it does not
// outdo, and a mean by all.
static bool occupied(__constant struct part *part, float2 range, __global const uint *counts,
                     bool linear) {
    // A cell without any value has its ends the wrong way round.
    if (range.x > range.y)
        return false;
    if (part->model == MODEL_ISO)
        return has_surface(part, range);
    if (part->model == MODEL_AVERAGE)
        return true;
    const float a = range.x * part->table_scale + part->table_bias;
    const float b = range.y * part->table_scale + part->table_bias;
    // Interpolation rounds; one value everywhere does not.
    const float slack = range.x < range.y ? 1e-3f : 0.0f;
    const float low = clamp(fmin(a, b) - slack, 0.0f, part->table_last);
    const float high = clamp(fmax(a, b) + slack, 0.0f, part->table_last);
    const bool between = linear && !part->table_nearest;
    int first = between ? (int)low : (int)(low + 0.5f);
    int last = between ? (int)ceil(high) : (int)(high + 0.5f);
    if (part->model == MODEL_MIP)
        first = 0;
    if (part->model == MODEL_MINIP)
        last = (int)part->table_last;
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
    if (part->filter & FILTERS_CUBIC) {
        const struct cell_dims dims = {part->cell_row, part->cell_slice / part->cell_row,
                                       (int)count / part->cell_slice};
        range = reachable(part, ranges + part->ranges, dims, i, 0);
    }
    return occupied(part, range, counts + part->visible, linear) ? 0 : empty;
}

// Where a row of cells begins that runs along one axis (0, 1, 2), and how it goes on.
struct cell_row {
    int start, stride, count;
};

// One way along a row. What a cell is told from behind is the least of max(k, distance of the k-th cell behind it), which
// grows by no more than one from cell to cell: it stays what it was, v, as long as a cell with no more than v is no
// further than v away. `last` has where each distance was met last.
static void spread_one_way(__global const uchar *in, __global uchar *out, struct cell_row row, bool back) {
    short last[CELL_DISTANCE_MAX + 1];
    for (int d = 0; d <= CELL_DISTANCE_MAX; d++)
        last[d] = -CELL_DISTANCE_MAX - 1;
    int best = CELL_DISTANCE_MAX, met = -CELL_DISTANCE_MAX - 1;
    for (int n = 0; n < row.count; n++) {
        const int at = row.start + (back ? row.count - 1 - n : n) * row.stride;
        const int own = in[at];
        last[own] = (short)n;
        if (own <= best) {
            best = own;
            met = n;
        } else if (n - met > best && best < CELL_DISTANCE_MAX) {
            best++;
            met = max(met, (int)last[best]);
        }
        out[at] = (uchar)(back ? min(best, (int)out[at]) : best);
    }
}

// Spreads distances along the i-th row of an axis, both ways.
static void spread(__constant struct part *part, __global const uchar *in, __global uchar *out,
                   struct cell_dims dims, int i, uint axis) {
    struct cell_row row = {i * dims.x, 1, dims.x};
    int rows = dims.y * dims.z;
    if (axis == 1) {
        row.start = i / dims.x * part->cell_slice + i % dims.x;
        row.stride = part->cell_row;
        row.count = dims.y;
        rows = dims.x * dims.z;
    } else if (axis == 2) {
        row.start = i;
        row.stride = part->cell_slice;
        row.count = dims.z;
        rows = dims.x * dims.y;
    }
    if (i >= rows)
        return;
    spread_one_way(in, out, row, false);
    spread_one_way(in, out, row, true);
}

// 1 when brick i, of 2^bits cells along a side, has a cell that is not empty.
static uchar find_brick(__constant struct part *part, __global const uchar *cells,
                        struct cell_dims dims, int i, int bits) {
    const int size = 1 << bits;
    const int columns = (dims.x + size - 1) >> bits, rows = (dims.y + size - 1) >> bits;
    const int left = i % columns << bits, top = i / columns % rows << bits,
              front = i / columns / rows << bits;
    const int right = min(left + size, dims.x), bottom = min(top + size, dims.y),
              back = min(front + size, dims.z);
    for (int z = front; z < back; z++)
        for (int y = top; y < bottom; y++)
            for (int x = left; x < right; x++)
                if (!cells[z * part->cell_slice + y * part->cell_row + x])
                    return 1;
    return 0;
}

#if SKIP == SKIP_BLOCKS
#include "bins.cl"
#endif

#include "nodes.cl"
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
    else if (pass >= PASS_BINS)
        out[i] = find_bins(part, ranges + part->ranges, dims, (int)i, (int)(pass - PASS_BINS), empty);
    else
#endif
    if (pass == PASS_NAME)
        out[i] = name_node(part, in, dims, (int)i);
    else if (pass >= PASS_BRICK)
        out[i] = find_brick(part, in, dims, (int)i, (int)(pass - PASS_BRICK));
    else if (pass > PASS_MERGE)
        merge(part, out, dims, (int)i, (int)(pass - PASS_MERGE));
    else
        spread(part, in, out, dims, (int)i, pass);
}

#endif
