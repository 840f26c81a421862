// brick.h - voxels in bricks, as the `buffer` reader wants them (shared/brick.h).
#ifndef PEL_WORLD_BRICK_H
#define PEL_WORLD_BRICK_H

#include <stddef.h>

#include "shared/brick.h"

// The number of bricks over `voxels` stored voxels along one axis.
size_t pel_brick_count(size_t voxels);

// The bytes of a stored element, for voxels of `voxel_bytes`: voxels of one byte are stored in
// twos.
size_t pel_brick_element_bytes(size_t voxel_bytes);

// Writes one layer of bricks to `out`: pel_brick_count(dims[0]) * pel_brick_count(dims[1]) of
// BRICK_VOXELS elements. `slices` are the first BRICK_SIDE + 1 slices of the layer, dims[0] x
// dims[1] voxels of `voxel_bytes` each, or dims[2] of them where there are fewer. Beyond the last
// voxel bricks repeat it.
void pel_brick_layer(void *out, const void *slices, const size_t dims[3], size_t voxel_bytes);

#endif
