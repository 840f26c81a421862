// brick.c - voxels in bricks are where shared/brick.h says, with their neighbours beside them.
#include "world/brick.h"

#include <stdint.h>
#include <stdlib.h>

#include "support/test.h"

// The voxel `offset` behind `at`, or the last one there is that way.
static size_t near(size_t at, size_t offset, size_t before, size_t count) {
    size_t index = at + offset < before ? 0 : at + offset - before;
    return index < count ? index : count - 1;
}

static uint32_t read_voxel(const uint8_t *bytes, size_t voxel_bytes) {
    uint32_t value = 0;
    for (size_t i = 0; i < voxel_bytes; i++)
        value |= (uint32_t)bytes[i] << (8 * i);
    return value;
}

// Every element of every brick of a layer, also beyond the volume's end, where the last one
// repeats.
static void check_layer(const uint8_t *layer, const uint8_t *voxels, const size_t dims[3],
                        size_t voxel_bytes, size_t border, size_t bz) {
    size_t row = BRICK_ROW_OF(border), across = pel_brick_count(dims[0]);
    size_t element_bytes = pel_brick_element_bytes(voxel_bytes);
    for (size_t i = 0; i < across * pel_brick_count(dims[1]) * row * row * row; i++) {
        size_t brick = i / (row * row * row), inside = i % (row * row * row);
        const uint8_t *element =
            layer + (brick * BRICK_VOXELS_OF(border) + BRICK_LEAD + inside) * element_bytes;
        size_t x = near(brick % across * BRICK_SIDE, inside % row, border, dims[0]);
        size_t z = near(bz * BRICK_SIDE, inside / (row * row), border, dims[2]);
        for (size_t part = 0; part < element_bytes / voxel_bytes; part++) {
            size_t y =
                near(brick / across * BRICK_SIDE, inside / row % row + part, border, dims[1]);
            size_t voxel = (z * dims[1] + y) * dims[0] + x;
            assert_int_equal(read_voxel(element + part, voxel_bytes),
                             read_voxel(voxels + voxel * voxel_bytes, voxel_bytes));
        }
    }
}

// All layers, each from as few slices as it takes.
static void check_volume(const size_t dims[3], size_t voxel_bytes, size_t border) {
    size_t slice_bytes = dims[0] * dims[1] * voxel_bytes, bytes = slice_bytes * dims[2];
    uint8_t *voxels = malloc(bytes);
    uint8_t *layer = malloc(pel_brick_count(dims[0]) * pel_brick_count(dims[1]) *
                            BRICK_VOXELS_OF(border) * pel_brick_element_bytes(voxel_bytes));
    assert_non_null(voxels);
    assert_non_null(layer);
    for (size_t i = 0; i < bytes; i++)
        voxels[i] = (uint8_t)(i * 2654435761u >> 13);
    for (size_t bz = 0; bz < pel_brick_count(dims[2]); bz++) {
        size_t before = bz > 0 ? border : 0, first = bz * BRICK_SIDE - before;
        size_t left = dims[2] - first, most = before + BRICK_SIDE + 1 + border;
        const struct pel_brick_source source = {
            .slices = voxels + first * slice_bytes,
            .dims = {dims[0], dims[1], left < most ? left : most},
            .first = before,
            .voxel_bytes = voxel_bytes,
            .border = (int)border};
        pel_brick_layer(layer, &source);
        check_layer(layer, voxels, dims, voxel_bytes, border, bz);
    }
    free(voxels);
    free(layer);
}

static void voxels_and_neighbours(void **state) {
    (void)state;
    for (size_t n = 0; n < 6; n++) {
        size_t voxel_bytes = (size_t)1 << n / 2, border = n % 2;
        check_volume((size_t[3]){40, 19, 35}, voxel_bytes, border);
        check_volume((size_t[3]){3, 3, 3}, voxel_bytes, border);
        check_volume((size_t[3]){16, 17, 33}, voxel_bytes, border);
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
