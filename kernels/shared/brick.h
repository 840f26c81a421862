// brick.h - how the `buffer` reader stores voxels, the same for host and kernels.
//
// A part's memory is cut into bricks of BRICK_SIDE^3 voxels. Each is stored with one voxel more
// along every axis, the first of the brick behind it, so that all eight corners of a cell lie in
// one brick, at fixed distances from the first: rows are a few cache lines apart instead of pages,
// and a ray across them touches as few as one along them. Bricks with a border have one more still,
// and one before the first: then the same holds for all voxels that the gradient in a cell is made
// of.
//
//     brick      z * brick_slice + y * brick_row + x      bricks in order, x fastest
//     voxel      FIRST + z * SLICE + y * ROW + x      within a brick, x fastest
//
// Voxels of one byte are stored in twos, each with the next one along y behind it, so that one load
// of four bytes fetches four corners. Wide loads may touch 12 bytes before and behind the voxels
// they are for.
#ifndef SHARED_BRICK_H
#define SHARED_BRICK_H

#include "shared/types.h"

#define BRICK_BITS 4
#define BRICK_SIDE (1 << BRICK_BITS)

// All of a brick, without or with a border (0 or 1). Elements from one stored row and slice to the
// next; of a whole brick, some cache lines; before the first one stored; and before voxel 0.
#define BRICK_ROW_OF(border) (BRICK_SIDE + 1 + 2 * (border))
#define BRICK_SLICE_OF(border) (BRICK_ROW_OF(border) * BRICK_ROW_OF(border))
#define BRICK_VOXELS_OF(border) (4928 + 1984 * (border))
#define BRICK_LEAD 8
#define BRICK_FIRST_OF(border)                                                                     \
    (BRICK_LEAD + (border) * (BRICK_SLICE_OF(border) + BRICK_ROW_OF(border) + 1))

// The most voxels of a part along x and along y, and along z, its border included: with them the
// places that kernels work out in floats are exact.
#define BRICK_ALONG_MAX (1 << 17)
#define BRICK_SLICES_MAX (1 << 15)

// Of bricks without a border.
#define BRICK_VOXELS BRICK_VOXELS_OF(0)

SHARED_ASSERT(BRICK_LEAD + BRICK_SLICE_OF(0) * BRICK_ROW_OF(0) + 6 <= BRICK_VOXELS_OF(0),
              brick_voxels);
SHARED_ASSERT(BRICK_LEAD + BRICK_SLICE_OF(1) * BRICK_ROW_OF(1) + 6 <= BRICK_VOXELS_OF(1),
              bordered_brick_voxels);
SHARED_ASSERT(BRICK_SLICES_MAX * BRICK_SLICE_OF(1) + BRICK_ALONG_MAX * (BRICK_ROW_OF(1) + 1) <
                  1 << 24,
              brick_places_in_floats);

#endif
