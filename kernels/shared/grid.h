// grid.h - the grid of cells over a part's memory, the same for host and kernels.
//
// A cell has CELL_VOXELS voxels along a side, or those of a brick where bricks come from a pool.
//
// Cell (x,y,z) is for sample positions CELL_VOXELS * x <= p < CELL_VOXELS * (x + 1) in memory
// coordinates (and so on), whose interpolation needs the voxels CELL_VOXELS * x ..
// CELL_VOXELS * (x + 1), both included.
#ifndef SHARED_GRID_H
#define SHARED_GRID_H

#include "shared/brick.h"

#if defined(POOL) && POOL
#define CELL_BITS BRICK_BITS
#else
#define CELL_BITS 2
#endif
#define CELL_VOXELS (1 << CELL_BITS)

// No distance is larger than this, in cells.
#define CELL_DISTANCE_MAX 31

// Bytes behind all cells that may be read with the last of them.
#define CELL_SLACK 15

// Cells of which one work-item finds out whether they are empty.
#define CELL_CHUNK 16

// Which pass over the cells finds the empty ones, PASS_OCCUPY, by CELL_CHUNK a work-item. PASS_ROW,
// PASS_COLUMN and PASS_SLICE spread distances along x, y and z. For an octree, pass PASS_MERGE + l
// joins eight empty nodes of the level below to one of level l, in the node's first cell, and
// PASS_NAME tells every cell of the largest node that it lies in. Each row of cells, or of nodes,
// is one work-item's. Pass PASS_BRICK + b finds the bricks of 2^b cells along a side, one after the
// other, in which some cell is not empty.
//
// For blocks (shared/block.h), PASS_VISIBLE finds the bins of the table of which something can be
// seen and PASS_CORNER whether the value around the part's first corner can, each in one byte;
// PASS_BINS + b, the bins that the values of each such brick touch; and PASS_SEEN keeps those of
// the stored sub-blocks in which some cell is not empty.
//
// PASS_STRIDE finds how long a run of samples may be that begins in each cell
// (kernels/stride_cells.cl).
#define PASS_ROW 0
#define PASS_COLUMN 1
#define PASS_SLICE 2
#define PASS_OCCUPY 3
#define PASS_NAME 4
#define PASS_VISIBLE 5
#define PASS_CORNER 6
#define PASS_SEEN 7
#define PASS_STRIDE 8
#define PASS_MERGE 16
#define PASS_BRICK 32
#define PASS_BINS 48

#endif
