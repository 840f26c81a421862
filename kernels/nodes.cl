// nodes.cl - from the empty cells of a part to those of an octree's nodes.
//
// The passes go up the levels of the octree, each over the nodes of one level, and a last one
// brings down to every cell the largest empty node around it: a cell holds 0 where something may be
// visible, else one more than that node's level. Included by occupancy.cl.
#ifndef NODES_CL
#define NODES_CL

// Work-item i joins what the eight children of each node found, along the i-th row of a level's
// nodes. Nothing else writes to a node's first cell, and only this reads it. What lies outside the
// part counts as empty.
static void merge(__constant struct part *part, __global uchar *cells, struct cell_dims dims, int i,
                  int level) {
    const int size = 1 << level, half_size = size >> 1, rows = (dims.y + size - 1) >> level;
    const int y = i % rows * size, z = i / rows * size;
    if (z >= dims.z)
        return;
    cells += z * part->cell_slice + y * part->cell_row;
    const int down = y + half_size < dims.y ? half_size * part->cell_row : 0,
              behind = z + half_size < dims.z ? half_size * part->cell_slice : 0;
    for (int x = 0; x < dims.x; x += size) {
        const int right = x + half_size < dims.x ? half_size : 0;
        // Where there is no other child, it is the first one once more.
        __global const uchar *near = cells + x, *far = near + behind;
        const uchar8 children =
            (uchar8)(near[0], near[right], near[down], near[down + right], far[0], far[right], far[down],
                     far[down + right]);
        const uchar4 four = min(children.lo, children.hi);
        const uchar2 two = min(four.lo, four.hi);
        if (two.x >= level && two.y >= level)
            cells[x] = (uchar)(level + 1);
    }
}

// Along the i-th row, one more than the level of the largest empty node around each cell, whose
// first cells know.
static void name_nodes(__constant struct part *part, __global const uchar *cells, __global uchar *out,
                       struct cell_dims dims, int i) {
    const int y = i % dims.y, z = i / dims.y;
    if (z >= dims.z)
        return;
    out += z * part->cell_slice + y * part->cell_row;
    for (int x = 0; x < dims.x;) {
        int level = 0;
        while (cells[(z >> level << level) * part->cell_slice + (y >> level << level) * part->cell_row +
                     (x >> level << level)] > level)
            level++;
        // The rest of the node lies in no larger one either.
        const int bits = max(level - 1, 0), end = min(((x >> bits) + 1) << bits, dims.x);
        for (; x < end; x++)
            out[x] = (uchar)level;
    }
}

#endif
