// grid.c - the range of values in each cell of a slab.
//
// A voxel on a wall between cells belongs to both, because interpolation on either side needs it;
// with a margin, one near a wall does, too. So each row is reduced to ranges along x, and these are
// then merged into the cells along y and z that it counts for.
#include "accel/grid.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "volume/volume.h"

size_t pel_grid_cells(size_t voxels, size_t side) {
    return (voxels + side - 1) / side;
}

bool pel_grid_init(struct pel_grid *grid, const size_t dims[3], size_t side, size_t margin) {
    size_t count = 1;
    grid->side = side;
    grid->margin = margin;
    for (int i = 0; i < 3; i++) {
        grid->dims[i] = dims[i];
        grid->cells[i] = pel_grid_cells(dims[i], side);
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
    static void row_##name(float(*range)[2], const struct pel_grid *grid, const type *row,         \
                           size_t stride, float factor) {                                          \
        size_t width = grid->dims[0], margin = grid->margin;                                       \
        for (size_t start = 0, cell = 0; start < width; start += grid->side, cell++) {             \
            size_t first = start > margin ? start - margin : 0, end = start + grid->side + margin; \
            size_t last = end < width ? end : width - 1;                                           \
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
        into[i][0] = from[i][0] < into[i][0] ? from[i][0] : into[i][0];
        into[i][1] = from[i][1] > into[i][1] ? from[i][1] : into[i][1];
    }
}

// The first and the last cell along an axis of `count` cells that voxel `at` counts for: one, or
// more on a wall and near it.
static void cells_at(const struct pel_grid *grid, size_t at, size_t count, size_t *first,
                     size_t *last) {
    size_t behind = grid->side + grid->margin;
    *first = at > behind ? (at - behind + grid->side - 1) / grid->side : 0;
    *last = (at + grid->margin) / grid->side;
    if (*last >= count)
        *last = count - 1;
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
            row_u8(row, grid, (const uint8_t *)start + y * width, 1, factor);
            break;
        case 1:
            row_u16(row, grid, (const uint16_t *)(const void *)start + y * width, 1, factor);
            break;
        case 2:
            row_f32(row, grid, (const float *)(const void *)start + y * width, 1, factor);
            break;
        default:
            // The value of a colour is its alpha.
            row_u8(row, grid, (const uint8_t *)start + 4 * y * width + 3, 4, factor);
            break;
        }
        size_t first[2], last[2];
        cells_at(grid, y, grid->cells[1], &first[0], &last[0]);
        cells_at(grid, z, grid->cells[2], &first[1], &last[1]);
        for (size_t cell_z = first[1]; cell_z <= last[1]; cell_z++)
            for (size_t cell_y = first[0]; cell_y <= last[0]; cell_y++)
                merge(grid->range + (cell_z * grid->cells[1] + cell_y) * columns, row, columns);
    }
}
