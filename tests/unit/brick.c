// brick.c - voxels in bricks are where shared/brick.h says, with their neighbours beside them.
#include "world/brick.h"

#include <stdint.h>
#include <stdlib.h>

#include "support/test.h"

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

static uint32_t read_voxel(const uint8_t *bytes, size_t voxel_bytes) {
    uint32_t value = 0;
    for (size_t i = 0; i < voxel_bytes; i++)
        value |= (uint32_t)bytes[i] << (8 * i);
    return value;
}

// Every element of every brick, also beyond the volume's end, where the last one repeats.
static void check_volume(const size_t dims[3], size_t voxel_bytes) {
    size_t bricks[3], count = dims[0] * dims[1] * dims[2];
    for (int i = 0; i < 3; i++)
        bricks[i] = pel_brick_count(dims[i]);
    size_t element_bytes = pel_brick_element_bytes(voxel_bytes);
    uint8_t *voxels = malloc(count * voxel_bytes);
    uint8_t *layer = malloc(bricks[0] * bricks[1] * BRICK_VOXELS * element_bytes);
    assert_non_null(voxels);
    assert_non_null(layer);
    for (size_t i = 0; i < count * voxel_bytes; i++)
        voxels[i] = (uint8_t)(i * 2654435761u >> 13);
    for (size_t bz = 0; bz < bricks[2]; bz++) {
        size_t left = dims[2] - bz * BRICK_SIDE;
        size_t slices[3] = {dims[0], dims[1], least(left, BRICK_SIDE + 1)};
        pel_brick_layer(layer, voxels + bz * BRICK_SIDE * dims[0] * dims[1] * voxel_bytes, slices,
                        voxel_bytes);
        for (size_t i = 0; i < bricks[0] * bricks[1] * BRICK_SLICE * BRICK_ROW; i++) {
            size_t brick = i / (BRICK_SLICE * BRICK_ROW), inside = i % (BRICK_SLICE * BRICK_ROW);
            const uint8_t *element =
                layer + (brick * BRICK_VOXELS + BRICK_LEAD + inside) * element_bytes;
            size_t x = brick % bricks[0] * BRICK_SIDE + inside % BRICK_ROW;
            size_t y = brick / bricks[0] * BRICK_SIDE + inside / BRICK_ROW % BRICK_ROW;
            size_t z = bz * BRICK_SIDE + inside / BRICK_SLICE;
            for (size_t part = 0; part < element_bytes / voxel_bytes; part++) {
                size_t row = least(z, dims[2] - 1) * dims[1] + least(y + part, dims[1] - 1);
                size_t voxel = row * dims[0] + least(x, dims[0] - 1);
                assert_int_equal(read_voxel(element + part, voxel_bytes),
                                 read_voxel(voxels + voxel * voxel_bytes, voxel_bytes));
            }
        }
    }
    free(voxels);
    free(layer);
}

static void voxels_and_neighbours(void **state) {
    (void)state;
    for (size_t voxel_bytes = 1; voxel_bytes <= 4; voxel_bytes *= 2) {
        check_volume((size_t[3]){40, 19, 35}, voxel_bytes);
        check_volume((size_t[3]){3, 3, 3}, voxel_bytes);
        check_volume((size_t[3]){16, 17, 33}, voxel_bytes);
    }
}

static void counts(void **state) {
    (void)state;
    assert_int_equal(pel_brick_count(3), 1);
    assert_int_equal(pel_brick_count(16), 1);
    assert_int_equal(pel_brick_count(17), 2);
    assert_int_equal(pel_brick_count(258), 17);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(voxels_and_neighbours),
        cmocka_unit_test(counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
