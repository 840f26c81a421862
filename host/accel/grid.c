// grid.c - the range of values in each cell of a slab.
//
// A voxel on a wall between cells belongs to both, because interpolation on either side needs it.
// So a slice is first reduced to ranges along x and y, and these are then merged into one or two
// layers of cells.
#include "accel/grid.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "volume/volume.h"

size_t pel_grid_cells(size_t voxels) {
    return (voxels + CELL_VOXELS - 1) / CELL_VOXELS;
}

bool pel_grid_init(struct pel_grid *grid, const size_t dims[3]) {
    size_t count = 1;
    for (int i = 0; i < 3; i++) {
        grid->dims[i] = dims[i];
        grid->cells[i] = pel_grid_cells(dims[i]);
        count *= grid->cells[i];
    }
    grid->range = pel_allocate(count, sizeof *grid->range);
    if (!grid->range)
        return false;
    for (size_t i = 0; i < count; i++) {
        grid->range[i][0] = INFINITY;
        grid->range[i][1] = -INFINITY;
    }
    return true;
}

void pel_grid_finish(struct pel_grid *grid) {
    free(grid->range);
    *grid = (struct pel_grid){.range = NULL};
}

// The ranges of one row's cells, in the type's own numbers; comparisons with NaN are false, so
// absent voxels drop out.
#define DEFINE_ROW(name, type)                                                                     \
    static void row_##name(float(*range)[2], const type *row, size_t width, size_t stride,         \
                           float factor) {                                                         \
        for (size_t first = 0, cell = 0; first < width; first += CELL_VOXELS, cell++) {            \
            size_t last = first + CELL_VOXELS < width ? first + CELL_VOXELS : width - 1;           \
            float low = INFINITY, high = -INFINITY;                                                \
            for (size_t x = first; x <= last; x++) {                                               \
                float value = (float)row[x * stride];                                              \
                low = value < low ? value : low;                                                   \
                high = value > high ? value : high;                                                \
            }                                                                                      \
            range[cell][0] = low * factor;                                                         \
            range[cell][1] = high * factor;                                                        \
        }                                                                                          \
    }

DEFINE_ROW(u8, uint8_t)
DEFINE_ROW(u16, uint16_t)
DEFINE_ROW(f32, float)

static void merge(float (*into)[2], float (*from)[2], size_t count) {
    for (size_t i = 0; i < count; i++) {
        into[i][0] = fminf(into[i][0], from[i][0]);
        into[i][1] = fmaxf(into[i][1], from[i][1]);
    }
}

// Merges what was found at voxel `at` of an axis into its cells there: one, or two on a wall.
static void merge_at(float (*cells)[2], size_t stride, size_t cell_count, size_t at,
                     float (*from)[2], size_t count) {
    size_t cell = at / CELL_VOXELS;
    if (cell < cell_count)
        merge(cells + cell * stride, from, count);
    if (at % CELL_VOXELS == 0 && cell > 0)
        merge(cells + (cell - 1) * stride, from, count);
}

void pel_grid_add_slice(struct pel_grid *grid, size_t z, const void *slice, int class_index,
                        float factor) {
    size_t width = grid->dims[0], columns = grid->cells[0];
    // A row of cells fits the stack for any volume that can be, with its border.
    float row[(PEL_DIMENSION_MAX + 2) / CELL_VOXELS + 1][2];
    for (size_t y = 0; y < grid->dims[1]; y++) {
        const char *start = slice;
        switch (class_index) {
        case 0:
            row_u8(row, (const uint8_t *)start + y * width, width, 1, factor);
            break;
        case 1:
            row_u16(row, (const uint16_t *)(const void *)start + y * width, width, 1, factor);
            break;
        case 2:
            row_f32(row, (const float *)(const void *)start + y * width, width, 1, factor);
            break;
        default:
            // The value of a colour is its alpha.
            row_u8(row, (const uint8_t *)start + 4 * y * width + 3, width, 4, factor);
            break;
        }
        size_t slice_cells = columns * grid->cells[1];
        for (int layer = 0; layer < 2; layer++) {
            size_t cell_z = z / CELL_VOXELS;
            if (layer == 1 && (z % CELL_VOXELS != 0 || cell_z-- == 0))
                break;
            if (cell_z < grid->cells[2])
                merge_at(grid->range + cell_z * slice_cells, columns, grid->cells[1], y, row,
                         columns);
        }
    }
}
