// brick.c - voxels in bricks are where shared/brick.h says, with their neighbours beside them.
#include "world/brick.h"

#include <stdint.h>
#include <stdlib.h>

#include "support/test.h"

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

// Every voxel of every brick, also beyond the volume's end, where the last one repeats.
static void check_volume(const size_t dims[3]) {
    size_t bricks[3], count = dims[0] * dims[1] * dims[2];
    for (int i = 0; i < 3; i++)
        bricks[i] = pel_brick_count(dims[i]);
    uint32_t *voxels = malloc(count * sizeof *voxels);
    size_t layer_voxels = bricks[0] * bricks[1] * BRICK_VOXELS;
    uint32_t *layer = malloc(layer_voxels * sizeof *layer);
    assert_non_null(voxels);
    assert_non_null(layer);
    for (size_t i = 0; i < count; i++)
        voxels[i] = (uint32_t)(i * 2654435761u);
    for (size_t bz = 0; bz < bricks[2]; bz++) {
        size_t left = dims[2] - bz * BRICK_SIDE;
        size_t slices[3] = {dims[0], dims[1], least(left, BRICK_SIDE + 1)};
        pel_brick_layer(layer, voxels + bz * BRICK_SIDE * dims[0] * dims[1], slices,
                        sizeof *voxels);
        for (size_t b = 0; b < bricks[0] * bricks[1]; b++) {
            for (size_t i = 0; i < (size_t)BRICK_SLICE * BRICK_ROW; i++) {
                size_t x = b % bricks[0] * BRICK_SIDE + i % BRICK_ROW;
                size_t y = b / bricks[0] * BRICK_SIDE + i / BRICK_ROW % BRICK_ROW;
                size_t z = bz * BRICK_SIDE + i / BRICK_SLICE;
                size_t voxel = (least(z, dims[2] - 1) * dims[1] + least(y, dims[1] - 1)) * dims[0] +
                               least(x, dims[0] - 1);
                assert_int_equal(layer[b * BRICK_VOXELS + i], voxels[voxel]);
            }
        }
    }
    free(voxels);
    free(layer);
}

static void voxels_and_neighbours(void **state) {
    (void)state;
    check_volume((size_t[3]){40, 19, 35});
    check_volume((size_t[3]){3, 3, 3});
    check_volume((size_t[3]){16, 17, 33});
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
