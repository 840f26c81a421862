// blocks.h - two-level sparse blocks over the sub-blocks of a part (shared/block.h; Derin et al.
// 2021).
#ifndef PEL_ACCEL_BLOCKS_H
#define PEL_ACCEL_BLOCKS_H

#include <stdbool.h>
#include <stddef.h>

#include "shared/block.h"

struct pel_blocks {
    struct block *list;     // owned
    size_t count;           //
    struct bvh_node *nodes; // owned; 2 * count - 1 over the blocks, in voxels, with their bins
    uint32_t *places;       // owned; of each stored sub-block: its place, x fastest, among all
    uint8_t *bins;          // owned; and its bins
    size_t stored;
};

// Stores the sub-blocks whose bins are not 0 of dims[0] x dims[1] x dims[2], x fastest, each of
// `side` voxels along a side. Unless they `walk`, no block knows of another. False: MEMORY, and
// ARGUMENT for a part of more blocks along an axis than a place has bits for.
bool pel_blocks_build(struct pel_blocks *blocks, const uint8_t *bins, const size_t dims[3],
                      int side, bool walk);
void pel_blocks_finish(struct pel_blocks *blocks);

#endif
