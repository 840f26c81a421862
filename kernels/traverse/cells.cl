// cells.cl - skips by one byte for each cell of CELL_VOXELS^3 voxels: 0 where something may be
// visible, else how much around it is empty, which grid.cl and octree.cl read each in its own way.
//
// To look into another cell costs a quarter of a sample, so a packet leaps on until one of its rays
// has come to something, and takes its next sample there. Samples stay where they are, so the
// picture is the same.
// Included by span.cl.
#ifndef CELLS_CL
#define CELLS_CL

#include "shared/grid.h"
#include "traverse/leap.cl"
#if SKIP == SKIP_OCTREE
#include "traverse/octree.cl"
#else
#include "traverse/grid.cl"
#endif

#define LOAD_CELL(at) cells[at]

// The lanes in which each cell of a ray has a sample in itself or beside itself. Where something
// can be visible between two samples, only they may go from one empty cell to the next: the values
// of cells that touch are one range.
INLINE mask touches_cells(const struct cursor *cursor) {
    return MASK(fabs(cursor->dx) <= CELL_VOXELS) & MASK(fabs(cursor->dy) <= CELL_VOXELS) &
           MASK(fabs(cursor->dz) <= CELL_VOXELS);
}

// The next sample from i on that may be visible, in the lanes that ask.
INLINE integer cursor_leap(__constant struct part *part, __global const uchar *cells,
                           const struct cursor *cursor, integer i, mask asks) {
    i = max(max(i, cursor->next), cursor->first);
    asks &= MASK(i < cursor->end);
    while (any_lane(asks)) {
        const struct place place = cursor_place(cursor, i);
        const integer cell = place_cell(part, &place);
        const integer empty = TO_INTEGER(GATHER(uchar, LOAD_CELL, cell));
        const mask leaps = MASK(empty > 0);
        if (!any_lane(leaps & asks))
            break;
        real count = samples_to_leave(place.x, cursor->dx, empty);
        count = AT_MOST(count, samples_to_leave(place.y, cursor->dy, empty));
        count = AT_MOST(count, samples_to_leave(place.z, cursor->dz, empty));
        i += CHOOSE((integer)(0), whole_leap(count), leaps & MASK(i < cursor->end));
        if (any_lane(asks & ~leaps))
            break;
        asks &= MASK(i < cursor->end);
#if MODELS & (MODELS_ISO | MODELS_PREINTEGRATED)
        asks &= touches_cells(cursor);
#endif
    }
    return CHOOSE((integer)(SAMPLE_NEVER), i, MASK(i < cursor->end));
}

#endif
