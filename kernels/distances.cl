// distances.cl - from the empty cells of a part to how far each is from one that is not.
//
// Three passes, one axis at a time and a row of cells at a time: the Chebyshev distance separates,
// D(x) = min over k of max(|k|, D(x + k)).
// Included by occupancy.cl.
#ifndef DISTANCES_CL
#define DISTANCES_CL

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

#endif
