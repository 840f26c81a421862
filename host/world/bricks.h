// bricks.h - bricks of a volume, and the hierarchy over their clusters.
#ifndef PEL_WORLD_BRICKS_H
#define PEL_WORLD_BRICKS_H

#include "accel/bvh.h"
#include "accel/cluster.h"
#include "pellucid.h"

// The largest cluster, in bricks along a side. Larger ones save next to nothing and cost a search
// through all bricks each.
enum { PEL_CLUSTER_LARGEST = 16 };

// Voxels along a side of a brick where the scene leaves it open (docs/performance.md).
// Those of sub-blocks are the ones of Derin et al. 2021.
enum { PEL_BRICK_SIZE = 16, PEL_SUB_BLOCK_SIZE = 8 };

// Settings with the defaults of a way to skip filled in.
struct pel_brick_settings pel_bricks_resolve(const struct pel_brick_settings *settings,
                                             enum pel_skip skip);

// False (ARGUMENT) unless the size is one that there is.
bool pel_bricks_check(const struct pel_brick_settings *settings);

// Writes the 2 * count - 1 nodes over clusters, in voxels of a part's memory. False: MEMORY.
bool pel_bricks_build(struct bvh_node *nodes, const struct pel_clusters *clusters, int brick_size);

#endif
