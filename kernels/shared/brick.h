// brick.h - how the `buffer` reader stores voxels, the same for host and kernels.
//
// A part's memory is cut into bricks of BRICK_SIDE^3 voxels. Each is stored with one voxel more along every axis, the
// first of the brick behind it, so that all eight corners of a cell lie in one brick, at fixed distances from the
// first: rows are a few cache lines apart instead of pages, and a ray across them touches as few as one along them.
//
//     brick      z * brick_slice + y * brick_row + x      bricks in order, x fastest
//     voxel      BRICK_LEAD + z * BRICK_SLICE + y * BRICK_ROW + x      within a brick, x fastest
//
// Voxels of one byte are stored in twos, each with the next one along y behind it, so that one load of four bytes
// fetches four corners. Wide loads may touch 12 bytes before and behind the voxels they are for.
#ifndef SHARED_BRICK_H
#define SHARED_BRICK_H

#include "shared/types.h"

#define BRICK_BITS 4
#define BRICK_SIDE (1 << BRICK_BITS)

// Elements from one stored row and slice to the next.
#define BRICK_ROW (BRICK_SIDE + 1)
#define BRICK_SLICE (BRICK_ROW * BRICK_ROW)

// Elements of a whole brick, some cache lines; and those before its first voxel.
#define BRICK_VOXELS 4928
#define BRICK_LEAD 8

SHARED_ASSERT(BRICK_LEAD + BRICK_SLICE * BRICK_ROW + 6 <= BRICK_VOXELS, brick_voxels);

#endif
