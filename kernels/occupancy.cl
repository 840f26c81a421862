// occupancy.cl - from a transfer function to the cells of a part in which something may be visible.
//
// The first pass compares each cell's range of values with the table: the first visible entry from
// each one on answers with one look-up whether a range holds any. What the passes after it make of
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

// The range of the values that samples in cell i may have. A cubic filter reads a voxel more on
// each side, so its cells have a share in their neighbours; and Catmull & Rom's weights, whose
// absolute values add up to at most 5/4 along an axis, lead out of the range of the voxels by at
// most ((5/4)^3 - 1) / 2 of it on either side.
static float2 reachable(__constant struct part *part, __global const float2 *ranges,
                        struct cell_dims dims, int i) {
    if (!(part->filter & FILTERS_CUBIC))
        return ranges[i];
    const int x = i % dims.x, y = i / dims.x % dims.y, z = i / part->cell_slice;
    float2 range = (float2)(INFINITY, -INFINITY);
    for (int nz = max(z - 1, 0); nz <= min(z + 1, dims.z - 1); nz++)
        for (int ny = max(y - 1, 0); ny <= min(y + 1, dims.y - 1); ny++)
            for (int nx = max(x - 1, 0); nx <= min(x + 1, dims.x - 1); nx++) {
                const float2 near = ranges[nz * part->cell_slice + ny * part->cell_row + nx];
                range = (float2)(fmin(range.x, near.x), fmax(range.y, near.y));
            }
    const float beyond =
        part->filter == FILTERS_CATMULL_ROM ? (range.y - range.x) * (61.0f / 128.0f) : 0.0f;
    return range.x > range.y ? range : (float2)(range.x - beyond, range.y + beyond);
}

#if MODELS & MODELS_ISO
// The lanes in whose range of values a surface of the part may lie.
static mask has_surface(__constant struct part *part, real low, real high) {
    __constant const float *values = (__constant const float *)&part->surface_values;
    mask found = (mask)(0);
    for (int n = 0; n < part->surface_count; n++) {
        const real slack = 1e-5f * (high - low + fabs(values[n]));
        found |= MASK(values[n] >= low - slack) & MASK(values[n] <= high + slack);
    }
    return found;
}
#endif

#define LOAD_VISIBLE(at) (int)next[at]

// The lanes in whose range of values something may be visible. An extremum is moved by all values
// that it does not outdo, and a mean by all.
static mask occupied(__constant struct part *part, real low, real high, __global const uint *next,
                     bool linear) {
    // A cell without any value has its ends the wrong way round.
    const mask some = MASK(low <= high);
#if MODELS & MODELS_ISO
    if (part->model == MODEL_ISO)
        return some & has_surface(part, low, high);
#endif
#if MODELS & MODELS_PROJECTION
    if (part->model == MODEL_AVERAGE)
        return some;
#endif
    // Interpolation rounds; one value everywhere does not.
    const real slack = CHOOSE((real)(0.0f), (real)(1e-3f), MASK(low < high));
    const bool between = linear && !part->table_nearest;
    const float shift = between ? 0.0f : 0.5f, bias = part->table_bias + shift;
    const real a = CHOOSE((real)(0.0f), low, some) * part->table_scale + bias;
    const real b = CHOOSE((real)(0.0f), high, some) * part->table_scale + bias;
    const real end = (real)(part->table_last + shift);
    const real least = AT_MOST(AT_LEAST(AT_MOST(a, b) - slack, 0.0f), end);
    const real most = AT_MOST(AT_LEAST(AT_LEAST(a, b) + slack, 0.0f), end);
    integer first = TO_INTEGER(least), last = TO_INTEGER(most);
    if (between)
        last = CHOOSE(last, last + 1, MASK(TO_REAL(last) < most));
#if MODELS & MODELS_PROJECTION
    if (part->model == MODEL_MIP)
        first = (integer)(0);
    if (part->model == MODEL_MINIP)
        last = TO_INTEGER(end);
#endif
    // Cells in empty space are many, and often one look-up does for all.
    if (LANES > 1 && (int)next[least_lane(first)] > -least_lane(-last))
        return (mask)(0);
    return some & MASK(GATHER(int, LOAD_VISIBLE, first) <= last);
}

#define LOAD_LOW(at) ranges[at].x
#define LOAD_HIGH(at) ranges[at].y
#define LANE_NUMBER(lane) lane

#if LANES > 1
// PoCL makes a store for each element of vstore's bytes, wherever they are.
typedef LANES_JOIN(uchar, LANES) loose_bytes __attribute__((aligned(1)));
#endif

// The ranges of values of LANES cells from cell `at` on, and those of the last one again behind a
// part's `count`.
INLINE void load_ranges(real *low, real *high, __global const float2 *ranges, int at, int count) {
#if LANES > 1
    if (at + LANES <= count) {
        const real one = LANES_JOIN(vload, LANES)(0, (__global const float *)(ranges + at));
        const real two = LANES_JOIN(vload, LANES)(1, (__global const float *)(ranges + at));
        *low = (real)(one.even, two.even);
        *high = (real)(one.odd, two.odd);
        return;
    }
#endif
    const integer cell = min((integer)(LANE_NUMBERS(LANE_NUMBER)) + at, (integer)(count - 1));
    *low = GATHER(float, LOAD_LOW, cell);
    *high = GATHER(float, LOAD_HIGH, cell);
}

#if FILTERS & FILTERS_CUBIC
// Likewise, where a cubic filter reaches into other cells.
static void load_reachable(real *low, real *high, __constant struct part *part,
                           __global const float2 *ranges, int at, int count) {
    float lows[LANES], highs[LANES];
    const struct cell_dims dims = {part->cell_row, part->cell_slice / part->cell_row,
                                   count / part->cell_slice};
    for (int lane = 0; lane < LANES; lane++) {
        const float2 range = reachable(part, ranges, dims, min(at + lane, count - 1));
        lows[lane] = range.x;
        highs[lane] = range.y;
    }
    *low = LOAD_LANES(lows);
    *high = LOAD_LANES(highs);
}
#endif

// Leaves 0 in those of LANES cells from cell `at` on, of a part's `count`, in which something may
// be visible, else `empty`.
OUTLINE void find_cells(__constant struct world *world, __constant struct part *part,
                       __global const float2 *values, __global const uint *next,
                       __global uchar *out, int at, int count, bool linear, uint empty) {
    real low, high;
#if FILTERS & FILTERS_CUBIC
    if (part->filter & FILTERS_CUBIC)
        load_reachable(&low, &high, part, values + part->ranges, at, count);
    else
#endif
        load_ranges(&low, &high, values + part->ranges, at, count);
    const mask seen = occupied(part, low, high, next + part->visible, linear);
    const integer found = CHOOSE((integer)((int)empty), (integer)(0), seen);
#if LANES > 1 && !MASKED
    if (at + LANES <= count) {
        *(__global loose_bytes *)(out + at) = LANES_JOIN(convert_uchar, LANES)(found);
        return;
    }
#endif
    int cells[LANES];
    STORE_LANES(found, cells);
    for (int lane = 0; lane < LANES && at + lane < count; lane++) {
#if MASKED
        const int i = at + lane;
        if (cells[lane] == 0 && mask_empties(world, part, values, i % part->cell_row,
                                             i % part->cell_slice / part->cell_row, i / part->cell_slice))
            cells[lane] = (int)empty;
#endif
        out[at + lane] = (uchar)cells[lane];
    }
}

#if SKIP == SKIP_DISTANCE
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
// passes that this way to skip needs, because each one more costs a cold start an eighth of a
// second.
__kernel void occupancy(__constant struct world *world, __global const float2 *ranges,
                        __global const uint *visible, __global const uchar *in, __global uchar *out,
                        const uint part_index, const uint count, const uint linear, const uint pass,
                        const uint empty) {
    const uint i = get_global_id(0);
    if (i >= count)
        return;
    __constant struct part *part = &world->parts[part_index];
    if (pass == PASS_OCCUPY) {
        const int end = min((int)i * CELL_CHUNK + CELL_CHUNK, (int)count);
        for (int at = (int)i * CELL_CHUNK; at < end; at += LANES)
            find_cells(world, part, ranges, visible, out + part->cells, at, (int)count, linear, empty);
        return;
    }
#if SKIP > SKIP_GRID || ADAPTIVE
    const struct cell_dims dims = {part->cell_row, part->cell_slice / part->cell_row,
                                   (int)count / part->cell_slice};
    __global const uchar *cells = in + part->cells;
#endif
#if SKIP == SKIP_BLOCKS
    // `empty` says how large a sub-block is, or that no data are to be stored as well.
    if (pass == PASS_SEEN) {
        keep_seen(part, cells, out, dims, (int)i, (int)empty);
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
        out[i] = corner_visible(part, ranges + part->ranges, visible + part->visible, dims, linear);
    else if (pass >= PASS_BINS)
        out[i] = find_bins(part, ranges + part->ranges, dims, (int)i, (int)(pass - PASS_BINS), empty);
#elif SKIP == SKIP_BVH
    out[i] = find_brick(part, cells, dims, (int)i, (int)(pass - PASS_BRICK));
#elif SKIP == SKIP_OCTREE
    if (pass == PASS_NAME)
        name_nodes(part, cells, out, dims, (int)i);
    else
        merge(part, out, dims, (int)i, (int)(pass - PASS_MERGE));
#elif SKIP == SKIP_DISTANCE
    spread(cells, out, dims, (int)i, (int)pass);
#endif
}

#endif
