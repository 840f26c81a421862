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

// Where the voxels of a layer of bricks come from: `slices` of dims[0] x dims[1] voxels of
// `voxel_bytes` each, dims[2] of them. `first` is the layer's first; with a border there is one
// before it, unless it is the volume's. From it on there are BRICK_SIDE + 1 + border, or all that
// are left.
struct pel_brick_source {
    const void *slices;
    size_t dims[3], first, voxel_bytes;
    int border; // 0 or 1
};

// Writes one layer of bricks to `out`: pel_brick_count(dims[0]) * pel_brick_count(dims[1]) of
// BRICK_VOXELS_OF(border) elements. Beyond the first and the last voxel bricks repeat it.
void pel_brick_layer(void *out, const struct pel_brick_source *source);

#endif
