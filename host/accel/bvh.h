// bvh.h - a bounding volume hierarchy over boxes.
#ifndef PEL_ACCEL_BVH_H
#define PEL_ACCEL_BVH_H

#include <stdbool.h>
#include <stddef.h>

#include "accel/box.h"
#include "shared/bvh.h"

// The most boxes a hierarchy is built over, so that a balanced one is never too deep.
#define PEL_BVH_BOXES ((size_t)1 << 28)

// Builds the hierarchy over `count` boxes, at least one, with one box in each leaf: writes
// 2 * count - 1 nodes. False: MEMORY.
bool pel_bvh_build(struct bvh_node *nodes, const struct pel_box *boxes, size_t count);

#endif
