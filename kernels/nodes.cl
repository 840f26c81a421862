// nodes.cl - from the empty cells of a part to those of an octree's nodes.
//
// The passes go up the levels of the octree, each over the nodes of one level, and a last one brings
// down to every cell the largest empty node around it: a cell holds 0 where something may be visible,
// else one more than that node's level.
// Included by occupancy.cl.
#ifndef NODES_CL
#define NODES_CL

// Work-item i joins what the eight children of node i of a level found. Nothing else writes to the
// node's first cell, and only this reads it. What lies outside the part counts as empty.
static void merge(__constant struct part *part, __global uchar *cells, struct cell_dims dims, int i,
                  int level) {
    const int size = 1 << level, half_size = size >> 1;
    const int columns = (dims.x + size - 1) >> level, rows = (dims.y + size - 1) >> level;
    const int x = i % columns * size, y = i / columns % rows * size, z = i / columns / rows * size;
    if (z >= dims.z)
        return;
    bool empty = true;
    for (int child = 0; child < 8; child++) {
        const int cx = x + (child & 1 ? half_size : 0), cy = y + (child & 2 ? half_size : 0),
                  cz = z + (child & 4 ? half_size : 0);
        if (cx < dims.x && cy < dims.y && cz < dims.z)
            empty = empty && cells[cz * part->cell_slice + cy * part->cell_row + cx] >= level;
    }
    if (empty)
        cells[z * part->cell_slice + y * part->cell_row + x] = (uchar)(level + 1);
}

// One more than the level of the largest empty node around cell i, whose first cells know.
static uchar name_node(__constant struct part *part, __global const uchar *cells,
                       struct cell_dims dims, int i) {
    const int x = i % dims.x, y = i / dims.x % dims.y, z = i / part->cell_slice;
    int level = 0;
    while (cells[(z >> level << level) * part->cell_slice + (y >> level << level) * part->cell_row +
                 (x >> level << level)] > level)
        level++;
    return (uchar)level;
}

#endif
