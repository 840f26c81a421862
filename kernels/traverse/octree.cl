// octree.cl - skips by a min-max octree over the cells.
//
// The tree has no pointers: the node of level l that a position lies in follows from the position's
// bits (a linear octree; Gargantini 1982). occupancy.cl leaves in each cell one more than the level
// of the largest empty node around it, so the descent from the root that a stackless traversal
// restarts at every step (Laine & Karras 2010 keep a stack for it) is a single look-up, and the ray
// leaves that node at once.
// Included by cells.cl.
#ifndef OCTREE_CL
#define OCTREE_CL

// How many samples from x on lie before the ray leaves its node of 2^(number - 1) cells, along one
// axis.
INLINE real samples_to_leave(real x, real delta, integer number) {
    const integer bits = max(number, (integer)(1)) - 1 + CELL_BITS;
    const integer node = TO_INTEGER(x) >> bits;
    return samples_to_plane(x, delta, CHOOSE(node, node + 1, MASK(delta >= 0.0f)) << bits);
}

#endif
