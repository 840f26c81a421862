// grid.cl - skips by a grid of cells of CELL_VOXELS^3 voxels.
//
// Each cell holds how far away the nearest cell is in which something may be visible: 0 for itself, else the
// Chebyshev distance in cells. A ray in a cell at distance d leaves the empty cube of 2 d - 1 cells at once
// (`distance`; Cohen & Sheffer 1994, proximity clouds), or the one cell it is in (`grid`; the DDA of Amanatides &
// Woo 1987, one cell a leap). Samples stay where they are, so the picture is the same.
// Included by span.cl.
#ifndef GRID_CL
#define GRID_CL

#include "shared/grid.h"
#include "traverse/leap.cl"

#define LOAD_CELL(at) cells[at]

// How many samples from x on lie before the ray leaves the cells within `reach` of its own, along one axis.
INLINE real samples_to_exit(real x, real delta, integer cell, integer reach) {
    const mask forward = MASK(delta >= 0.0f);
    const integer plane = CHOOSE(cell - reach + 1, cell + reach, forward) << CELL_BITS;
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
    const integer cx = TO_INTEGER(x) >> CELL_BITS, cy = TO_INTEGER(y) >> CELL_BITS,
                  cz = TO_INTEGER(z) >> CELL_BITS;
    const integer cell = cz * part->cell_slice + cy * part->cell_row + cx + (int)part->cells;
    const integer distance = TO_INTEGER(GATHER(uchar, LOAD_CELL, cell));
#if SKIP == SKIP_GRID
    const integer reach = min(distance, (integer)(1));
#else
    const integer reach = distance;
#endif
    real count = samples_to_exit(x, cursor->dx, cx, reach);
    count = fmin(count, samples_to_exit(y, cursor->dy, cy, reach));
    count = fmin(count, samples_to_exit(z, cursor->dz, cz, reach));
    return leap_from(cursor, i, start, count, MASK(distance > 0));
}

#endif
