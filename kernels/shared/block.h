// block.h - two-level sparse blocks of a part (Derin et al. 2021), the same for host and kernels.
//
// The part's memory is cut into sub-blocks, cubes of 8 voxels a side or as bricks.size says, and
// these into blocks of BLOCK_SIDE^3. A block is stored where it has a sub-block with something in
// it, and knows the blocks beside it. Its sub-blocks are addressed by 8 bits: each place in it has
// the number of one of those that are stored, or BLOCK_ABSENT. Of each stored sub-block one byte
// tells the bins that values in it touch, of BLOCK_BINS over the transfer function's table. One
// buffer has it all:
//
//     struct block_grid grids[WORLD_PART_MAX]
//     of each part:  struct bvh_node nodes[]     over its blocks; above the two bits of each axis, the bins below it
//                    struct block blocks[]
//                    u32 places[]                where each stored sub-block lies, x fastest, among all of the part's
//                    uchar seen[]                its bins, or 0 while nothing in it can be seen
//                    uchar bins[]                its bins
#ifndef SHARED_BLOCK_H
#define SHARED_BLOCK_H

#include "shared/bvh.h"

#define BLOCK_SIDE 6
#define BLOCK_PLACES (BLOCK_SIDE * BLOCK_SIDE * BLOCK_SIDE)
#define BLOCK_ABSENT 255
#define BLOCK_BINS 8
#define BLOCK_BINS_ALL 255

// The number of bits of a node's axis that are the axis.
#define BLOCK_AXIS_BITS 2

// Where in `place` each coordinate of a block is.
#define BLOCK_PLACE_BITS 10

struct block {
    u32 place;        // x, y and z of the block, BLOCK_PLACE_BITS each
    u32 first;        // number of its first stored sub-block
    u32 bins;         // those of all its sub-blocks
    i32 beside[27];   // numbers of the blocks around it, x fastest, itself in the middle; or -1
    u32 numbers[BLOCK_PLACES / 4]; // a byte for each place in it, x fastest
};

// Words from one block to the next, and of its members.
#define BLOCK_WORDS 84
#define BLOCK_FIRST 1
#define BLOCK_BINS_WORD 2
#define BLOCK_BESIDE 3
#define BLOCK_NUMBERS 30

SHARED_ASSERT(sizeof(struct block) == 4 * BLOCK_WORDS, block_size);
SHARED_ASSERT(BLOCK_PLACES <= BLOCK_ABSENT, block_places);

struct block_grid {
    u32 nodes;   // byte of the buffer at which they begin; 0: nothing is stored
    u32 blocks;  // likewise
    u32 places;  // likewise
    u32 seen;    // likewise
    u32 stored;  // sub-blocks
    u32 visible; // bins of which something can be seen
    i32 bits;    // a sub-block has 2^bits voxels along a side
    i32 pad;
};

SHARED_ASSERT(sizeof(struct block_grid) == 32, block_grid_size);

#endif
