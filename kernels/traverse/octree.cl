// octree.cl - skips by a min-max octree over the cells of CELL_VOXELS^3 voxels.
//
// The tree has no pointers: the node of level l that a position lies in follows from the position's
// bits (a linear octree; Gargantini 1982). occupancy.cl leaves in each cell the level of the
// largest empty node around it, so the descent from the root that a stackless traversal restarts at
// every step (Laine & Karras 2010 keep a stack for it) is a single look-up, and the ray leaves that
// node at once. Samples stay where they are, so the picture is the same.
// Included by span.cl.
#ifndef OCTREE_CL
#define OCTREE_CL

#include "shared/grid.h"
#include "traverse/leap.cl"

#define LOAD_NODE(at) cells[at]

// How many samples from x on lie before the ray leaves its node of 2^level cells, along one axis.
INLINE real samples_to_leave(real x, real delta, integer level) {
    const integer bits = level + CELL_BITS;
    const integer node = TO_INTEGER(x) >> bits;
    const integer plane = CHOOSE(node, node + 1, MASK(delta >= 0.0f)) << bits;
    return samples_to_plane(x, delta, plane);
}

// The next sample from i on that may be visible.
INLINE integer cursor_leap(__constant struct part *part, __global const uchar *cells,
                           const struct cursor *cursor, integer i) {
    i = max(i, cursor->next);
    const integer start = cursor_clamp(cursor, i);
    const real t = TO_REAL(start);
    const real x = cursor->ox + t * cursor->dx, y = cursor->oy + t * cursor->dy,
               z = cursor->oz + t * cursor->dz;
    const integer cell = (TO_INTEGER(z) >> CELL_BITS) * part->cell_slice +
                         (TO_INTEGER(y) >> CELL_BITS) * part->cell_row +
                         (TO_INTEGER(x) >> CELL_BITS) + (int)part->cells;
    // One more than the level; 0 where something may be visible.
    const integer found = TO_INTEGER(GATHER(uchar, LOAD_NODE, cell));
    const integer level = max(found, (integer)(1)) - 1;
    real count = samples_to_leave(x, cursor->dx, level);
    count = fmin(count, samples_to_leave(y, cursor->dy, level));
    count = fmin(count, samples_to_leave(z, cursor->dz, level));
    return leap_from(cursor, i, start, count, MASK(found > 0));
}

#endif
