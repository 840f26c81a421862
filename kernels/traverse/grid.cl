// grid.cl - skips by a grid of cells.
//
// Each cell holds how far away the nearest cell is in which something may be visible: 0 for itself,
// else the Chebyshev distance in cells. A ray in a cell at distance d leaves the empty cube of
// 2 d - 1 cells at once (`distance`; Cohen & Sheffer 1994, proximity clouds), or the one cell it is
// in (`grid`; the DDA of Amanatides & Woo 1987, one cell a leap).
// Included by cells.cl.
#ifndef GRID_CL
#define GRID_CL

// How many samples from x on lie before the ray leaves the cells nearer to its own than `distance`,
// along one axis.
INLINE real samples_to_leave(real x, real delta, integer distance) {
#if SKIP == SKIP_GRID
    const integer reach = (integer)(1);
#else
    const integer reach = distance;
#endif
    const integer cell = TO_INTEGER(x) >> CELL_BITS;
    const mask forward = MASK(delta >= 0.0f);
    return samples_to_plane(x, delta, CHOOSE(cell - reach + 1, cell + reach, forward) << CELL_BITS);
}

#endif
