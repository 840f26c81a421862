// brick.h - how the `buffer` reader stores voxels, the same for host and kernels.
//
// A part's memory is cut into bricks of BRICK_SIDE^3 voxels. Each is stored with one voxel more along every axis, the
// first of the brick behind it, so that all eight corners of a cell lie in one brick, at fixed distances from the
// first: rows are a few cache lines apart instead of pages, and a ray across them touches as few as one along them.
//
//     brick      z * brick_slice + y * brick_row + x           bricks in order, x fastest
//     voxel      (z * BRICK_SIDE_STORED + y) * BRICK_SIDE_STORED + x    within a brick, x fastest
#ifndef SHARED_BRICK_H
#define SHARED_BRICK_H

#include "shared/types.h"

#define BRICK_BITS 4
#define BRICK_SIDE (1 << BRICK_BITS)

// Elements from one stored row and slice to the next, and from one brick to the next: whole cache lines of bytes.
#define BRICK_ROW (BRICK_SIDE + 1)
#define BRICK_SLICE (BRICK_ROW * BRICK_ROW)
#define BRICK_VOXELS 4928

SHARED_ASSERT(BRICK_SLICE * BRICK_ROW <= BRICK_VOXELS, brick_voxels);

#endif
