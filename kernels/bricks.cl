// bricks.cl - from the empty cells of a part to its active bricks.
// Included by occupancy.cl.
#ifndef BRICKS_CL
#define BRICKS_CL

// The cells from `low` on and before `high` along each axis.
struct cell_box {
    struct cell_dims low, high;
};

// Finds those of brick i, which has 2^bits cells along a side unless the part ends in it.
static void brick_cells(struct cell_dims dims, int i, int bits, struct cell_box *box) {
    const int size = 1 << bits;
    const int columns = (dims.x + size - 1) >> bits, rows = (dims.y + size - 1) >> bits;
    box->low.x = i % columns << bits;
    box->low.y = i / columns % rows << bits;
    box->low.z = i / columns / rows << bits;
    box->high.x = min(box->low.x + size, dims.x);
    box->high.y = min(box->low.y + size, dims.y);
    box->high.z = min(box->low.z + size, dims.z);
}

// 1 when brick i, of 2^bits cells along a side, has a cell that is not empty.
static uchar find_brick(__constant struct part *part, __global const uchar *cells,
                        struct cell_dims dims, int i, int bits) {
    struct cell_box box;
    brick_cells(dims, i, bits, &box);
    for (int z = box.low.z; z < box.high.z; z++)
        for (int y = box.low.y; y < box.high.y; y++)
            for (int x = box.low.x; x < box.high.x; x++)
                if (!cells[z * part->cell_slice + y * part->cell_row + x])
                    return 1;
    return 0;
}

#endif
