// brick.c - voxels in bricks, as the `buffer` reader wants them (shared/brick.h).
#include "world/brick.h"

#include <string.h>

size_t pel_brick_count(size_t voxels) {
    return (voxels + BRICK_SIDE - 1) / BRICK_SIDE;
}

size_t pel_brick_element_bytes(size_t voxel_bytes) {
    return voxel_bytes == 1 ? 2 : voxel_bytes;
}

// The voxel `offset` beyond voxel `at` of a row, or the last one there is that way.
static size_t step(size_t at, int offset, size_t count) {
    ptrdiff_t index = (ptrdiff_t)at + offset;
    return index < 0 ? 0 : (size_t)index < count ? (size_t)index : count - 1;
}

// One row of a brick, whose voxel 0 is voxel x of a row of `width`.
static void fill_row(char *out, const char *row, size_t x, size_t width, size_t voxel_bytes,
                     int border) {
    size_t whole = BRICK_SIDE + 1 + (size_t)border;
    if (border) {
        memcpy(out, row + step(x, -1, width) * voxel_bytes, voxel_bytes);
        out += voxel_bytes;
    }
    size_t count = width - x < whole ? width - x : whole;
    memcpy(out, row + x * voxel_bytes, count * voxel_bytes);
    for (size_t i = count; i < whole; i++)
        memcpy(out + i * voxel_bytes, row + (width - 1) * voxel_bytes, voxel_bytes);
}

// The same for bytes, each with that of the `next` row behind it.
static void fill_row_of_twos(char *out, const char *row, const char *next, size_t x, size_t width,
                             int border) {
    for (int i = -border; i <= BRICK_SIDE + border; i++, out += 2) {
        size_t from = step(x, i, width);
        out[0] = row[from];
        out[1] = next[from];
    }
}

// One brick, from voxel (x, y) of the slices on.
static void fill_brick(char *out, const struct pel_brick_source *source, const size_t at[2]) {
    const size_t *dims = source->dims;
    int border = source->border;
    size_t element_bytes = pel_brick_element_bytes(source->voxel_bytes);
    size_t row_bytes = dims[0] * source->voxel_bytes, slice_bytes = dims[1] * row_bytes;
    memset(out, 0, (size_t)BRICK_VOXELS_OF(border) * element_bytes);
    out += BRICK_LEAD * element_bytes;
    for (int k = -border; k <= BRICK_SIDE + border; k++) {
        const char *slice =
            (const char *)source->slices + step(source->first, k, dims[2]) * slice_bytes;
        for (int j = -border; j <= BRICK_SIDE + border; j++) {
            const char *row = slice + step(at[1], j, dims[1]) * row_bytes;
            const char *next = slice + step(at[1], j + 1, dims[1]) * row_bytes;
            if (source->voxel_bytes == 1)
                fill_row_of_twos(out, row, next, at[0], dims[0], border);
            else
                fill_row(out, row, at[0], dims[0], source->voxel_bytes, border);
            out += BRICK_ROW_OF(border) * element_bytes;
        }
    }
}

void pel_brick_layer(void *out, const struct pel_brick_source *source) {
    char *brick = out;
    size_t bytes = BRICK_VOXELS_OF(source->border) * pel_brick_element_bytes(source->voxel_bytes);
    for (size_t y = 0; y < source->dims[1]; y += BRICK_SIDE)
        for (size_t x = 0; x < source->dims[0]; x += BRICK_SIDE, brick += bytes)
            fill_brick(brick, source, (size_t[2]){x, y});
}
