// bvh.h - a bounding volume hierarchy in one array, the same for host and kernels.
//
// Nodes lie in depth-first order: an inner node's left child follows it. Each node has the box of
// what is below it.
//
//     0 inner, link 4
//     1   inner, link 3
//     2     leaf
//     3     leaf
//     4   leaf
#ifndef SHARED_BVH_H
#define SHARED_BVH_H

#include "shared/types.h"

struct bvh_node {
    float low[3];
    i32 link; // of an inner node: its right child's index; of a leaf: -1 minus the number of its
              // box
    float high[3];
    i32 axis; // 0, 1, 2: along which the children of an inner node lie; the left one is the lower
};

SHARED_ASSERT(sizeof(struct bvh_node) == 32, bvh_node_size);

// No leaf is deeper than this below the root, so that a traversal's stack holds one entry more at
// most.
#define BVH_DEPTH_MAX 31

#endif
