// bricks.cl - from the empty cells of a part to its active bricks.
// Included by occupancy.cl.
#ifndef BRICKS_CL
#define BRICKS_CL

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

#endif
