// distances.cl - from the empty cells of a part to each one's distance from something that may be
// visible.
//
// The Chebyshev distance separates: D(x) = min over k of max(|k|, D(x + k)), one axis after the
// other. Along x, where there is nothing but 0 and CELL_DISTANCE_MAX before, a row is swept to and
// fro. Along y and z, 16 cells that lie beside each other look further and further away, one cell
// in both directions at a time, until none of them can come nearer.
//
// The last 16 cells of a row may have some in common with those before. Of a row with fewer, what
// is loaded behind its end, in the buffer's slack (CELL_SLACK) at the last, counts for nothing.
// Included by occupancy.cl.
#ifndef DISTANCES_CL
#define DISTANCES_CL

#include "shared/grid.h"

#define CELL_NUMBERS ((uchar16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

// PoCL makes sixteen stores of a vstore16 of bytes.
typedef uchar16 loose_cells __attribute__((aligned(1)));

// Stores 16 cells of a row, or all of a shorter one.
OUTLINE void store_cells(uchar16 cells, __global uchar *out, int width) {
    if (width >= 16) {
        *(__global loose_cells *)out = cells;
        return;
    }
    uchar each[16];
    vstore16(cells, 0, each);
    for (int n = 0; n < width; n++)
        out[n] = each[n];
}

// Cells that learn from those before them: by steps of 1, 2, 4 and 8, and then from `carry`, the
// one before all.
OUTLINE uchar16 sweep_up(uchar16 v, uchar carry) {
    const uchar far = CELL_DISTANCE_MAX;
    const uchar8 beyond = (uchar8)(far);
    v = min(v, (uchar16)(far, v.s01234567, v.s89ab, v.scd, v.se) + (uchar16)(1));
    v = min(v, (uchar16)(far, far, v.s01234567, v.s89ab, v.scd) + (uchar16)(2));
    v = min(v, (uchar16)(beyond.lo, v.s01234567, v.s89ab) + (uchar16)(4));
    v = min(v, (uchar16)(beyond, v.s01234567) + (uchar16)(8));
    return min(v, CELL_NUMBERS + (uchar16)(carry + 1));
}

// Spreads distances along x, to and fro.
OUTLINE void spread_along(__global const uchar *in, __global uchar *out, int width) {
    const int last = max(width - 16, 0);
    for (int x = 0; x < width; x += 16) {
        const int at = min(x, last);
        const uchar before = at > 0 ? out[at - 1] : (uchar)(CELL_DISTANCE_MAX);
        store_cells(sweep_up(vload16(0, in + at), before), out + at, width);
    }
    for (int x = last; x > -16; x -= 16) {
        const int at = max(x, 0);
        uchar16 v = vload16(0, out + at);
        v = select((uchar16)(CELL_DISTANCE_MAX), v, CELL_NUMBERS < (uchar16)(min(width, 16)));
        const uchar behind = at < last ? out[at + 16] : (uchar)(CELL_DISTANCE_MAX);
        v = sweep_up(v.sfedcba9876543210, behind).sfedcba9876543210;
        store_cells(v, out + at, width);
    }
}

// Whether one of 16 cells is further than r from what is known.
static bool any_beyond(uchar16 distance, int r) {
    const ulong2 words = as_ulong2(distance > (uchar16)(r));
    return (words.x | words.y) != 0;
}

// Spreads distances to row i along y or z, from rows that are `stride` cells apart, with so many
// before it and after it.
OUTLINE void spread_across(__global const uchar *in, __global uchar *out, int width, int stride,
                          int rows_before, int rows_after) {
    const int last = max(width - 16, 0);
    for (int x = 0; x < width; x += 16) {
        const int at = min(x, last);
        __global const uchar *before = in + at, *after = in + at;
        uchar16 nearest = vload16(0, before), found = nearest;
        found = select((uchar16)(0), found, CELL_NUMBERS < (uchar16)(min(width, 16)));
        // Behind the last row there is that row again, which changes nothing.
        for (int r = 1; r <= CELL_DISTANCE_MAX && any_beyond(found, r); r++) {
            before -= r <= rows_before ? stride : 0;
            after += r <= rows_after ? stride : 0;
            nearest = min(nearest, min(vload16(0, before), vload16(0, after)));
            found = min(found, max(nearest, (uchar16)(r)));
        }
        store_cells(found, out + at, width);
    }
}

// One pass over row i.
static void spread(__global const uchar *in, __global uchar *out, struct cell_dims dims, int i,
                   int pass) {
    const int y = i % dims.y, z = i / dims.y;
    if (z >= dims.z)
        return;
    in += i * dims.x;
    out += i * dims.x;
    if (pass == PASS_ROW)
        spread_along(in, out, dims.x);
    else if (pass == PASS_COLUMN)
        spread_across(in, out, dims.x, dims.x, y, dims.y - 1 - y);
    else
        spread_across(in, out, dims.x, dims.x * dims.y, z, dims.z - 1 - z);
}

#endif
