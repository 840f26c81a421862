// brick.c - voxels in bricks, as the `buffer` reader wants them (shared/brick.h).
#include "world/brick.h"

#include <string.h>

size_t pel_brick_count(size_t voxels) {
    return (voxels + BRICK_SIDE - 1) / BRICK_SIDE;
}

static size_t at_most(size_t i, size_t last) {
    return i < last ? i : last;
}

// One row of a brick, from voxel x of a row of `width` voxels on.
static void fill_row(char *out, const char *row, size_t x, size_t width, size_t voxel_bytes) {
    size_t count = at_most(BRICK_ROW, width - x);
    memcpy(out, row + x * voxel_bytes, count * voxel_bytes);
    for (size_t i = count; i < BRICK_ROW; i++)
        memcpy(out + i * voxel_bytes, row + (width - 1) * voxel_bytes, voxel_bytes);
}

void pel_brick_layer(void *out, const void *slices, const size_t dims[3], size_t voxel_bytes) {
    size_t row_bytes = dims[0] * voxel_bytes, slice_bytes = dims[1] * row_bytes;
    char *brick = out;
    for (size_t y = 0; y < dims[1]; y += BRICK_SIDE) {
        for (size_t x = 0; x < dims[0]; x += BRICK_SIDE) {
            char *to = brick;
            for (size_t k = 0; k <= BRICK_SIDE; k++) {
                const char *slice = (const char *)slices + at_most(k, dims[2] - 1) * slice_bytes;
                for (size_t j = 0; j <= BRICK_SIDE; j++, to += BRICK_ROW * voxel_bytes)
                    fill_row(to, slice + at_most(y + j, dims[1] - 1) * row_bytes, x, dims[0],
                             voxel_bytes);
            }
            memset(to, 0, (size_t)(BRICK_VOXELS - BRICK_ROW * BRICK_SLICE) * voxel_bytes);
            brick += BRICK_VOXELS * voxel_bytes;
        }
    }
}
