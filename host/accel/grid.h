// grid.h - the range of values in each cell of a slab, from which a transfer function tells what is
// empty.
#ifndef PEL_ACCEL_GRID_H
#define PEL_ACCEL_GRID_H

#include <stdbool.h>
#include <stddef.h>

#include "shared/grid.h"

// Ranges of stored voxels over cells (shared/grid.h), filled slice by slice.
struct pel_grid {
    size_t side, margin; // voxels along a cell's side, and those around it that count, too
    size_t dims[3];      // stored voxels along x, y, z
    size_t cells[3];     // cells along x, y, z
    float (*range)[2]; // owned; least and greatest value of each cell; least > greatest: all absent
};

// Ends of a cell's range that stand for any value.
#define PEL_GRID_ENDLESS 1e30F

// The number of cells of `side` voxels over `voxels` stored voxels along one axis.
size_t pel_grid_cells(size_t voxels, size_t side);

// Prepares for a slab of dims[0] x dims[1] x dims[2] stored voxels, border included, and cells of
// at least CELL_VOXELS voxels a side. False: MEMORY.
bool pel_grid_init(struct pel_grid *grid, const size_t dims[3], size_t side, size_t margin);
void pel_grid_finish(struct pel_grid *grid);

// Takes stored slice z, dims[0] x dims[1] voxels of the class with index `class_index` (the bit of
// VOXELS_*), whose value is scaled by `factor` as the reader will scale it.
void pel_grid_add_slice(struct pel_grid *grid, size_t z, const void *slice, int class_index,
                        float factor);

#endif
