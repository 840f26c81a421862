// brick.c - voxels in bricks, as the `buffer` reader wants them (shared/brick.h).
#include "world/brick.h"

#include <string.h>

size_t pel_brick_count(size_t voxels) {
    return (voxels + BRICK_SIDE - 1) / BRICK_SIDE;
}

static size_t at_most(size_t i, size_t last) {
    return i < last ? i : last;
}

size_t pel_brick_element_bytes(size_t voxel_bytes) {
    return voxel_bytes == 1 ? 2 : voxel_bytes;
}

// One row of a brick, from voxel x of a row of `width` voxels on.
static void fill_row(char *out, const char *row, size_t x, size_t width, size_t voxel_bytes) {
    size_t count = at_most(BRICK_ROW, width - x);
    memcpy(out, row + x * voxel_bytes, count * voxel_bytes);
    for (size_t i = count; i < BRICK_ROW; i++)
        memcpy(out + i * voxel_bytes, row + (width - 1) * voxel_bytes, voxel_bytes);
}

// The same for bytes, each with that of the `next` row behind it.
static void fill_row_of_twos(char *out, const char *row, const char *next, size_t x, size_t width) {
    for (size_t i = 0; i < BRICK_ROW; i++) {
        size_t from = at_most(x + i, width - 1);
        out[2 * i] = row[from];
        out[2 * i + 1] = next[from];
    }
}

// One brick, from voxel (x, y) of the slices on.
static void fill_brick(char *out, const char *slices, const size_t dims[3], size_t voxel_bytes,
                       const size_t at[2]) {
    size_t element_bytes = pel_brick_element_bytes(voxel_bytes);
    size_t row_bytes = dims[0] * voxel_bytes, slice_bytes = dims[1] * row_bytes;
    memset(out, 0, (size_t)BRICK_VOXELS * element_bytes);
    out += BRICK_LEAD * element_bytes;
    for (size_t k = 0; k <= BRICK_SIDE; k++) {
        const char *slice = slices + at_most(k, dims[2] - 1) * slice_bytes;
        for (size_t j = 0; j <= BRICK_SIDE; j++, out += BRICK_ROW * element_bytes) {
            const char *row = slice + at_most(at[1] + j, dims[1] - 1) * row_bytes;
            const char *next = slice + at_most(at[1] + j + 1, dims[1] - 1) * row_bytes;
            if (voxel_bytes == 1)
                fill_row_of_twos(out, row, next, at[0], dims[0]);
            else
                fill_row(out, row, at[0], dims[0], voxel_bytes);
        }
    }
}

void pel_brick_layer(void *out, const void *slices, const size_t dims[3], size_t voxel_bytes) {
    char *brick = out;
    for (size_t y = 0; y < dims[1]; y += BRICK_SIDE) {
        for (size_t x = 0; x < dims[0]; x += BRICK_SIDE) {
            fill_brick(brick, slices, dims, voxel_bytes, (size_t[2]){x, y});
            brick += BRICK_VOXELS * pel_brick_element_bytes(voxel_bytes);
        }
    }
}
