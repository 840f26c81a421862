// widen.c - wide numbers become the narrowest type that holds them, and a warning counts the rest.
#include "support/test.h"

#include <math.h>

#include "volume/widen.h"

static char warning[512];
static int warning_count;

static void keep_warning(const char *message, void *user) {
    (void)user;
    snprintf(warning, sizeof warning, "%s", message);
    warning_count++;
}

static int reset(void **state) {
    (void)state;
    warning_count = 0;
    pel_on_warning(keep_warning, NULL);
    return 0;
}

static void test_small_integers_stay_exact(void **state) {
    (void)state;
    const int32_t values[] = {-32768, 0, 32767};
    struct pel_volume *volume =
        pel_volume_from_wide("x", (const int[]){3, 1, 1}, PEL_WIDE_I32, values);
    assert_non_null(volume);
    assert_int_equal(volume->type, PEL_VOXEL_I16);
    assert_int_equal(((int16_t *)volume->voxels)[0], -32768);
    assert_int_equal(((int16_t *)volume->voxels)[2], 32767);
    assert_int_equal(warning_count, 0);
    pel_volume_destroy(volume);

    const uint64_t positive[] = {0, 40000, 65535};
    volume = pel_volume_from_wide("x", (const int[]){1, 3, 1}, PEL_WIDE_U64, positive);
    assert_int_equal(volume->type, PEL_VOXEL_U16);
    assert_int_equal(((uint16_t *)volume->voxels)[1], 40000);
    assert_int_equal(((uint16_t *)volume->voxels)[2], 65535);
    assert_int_equal(warning_count, 0);
    pel_volume_destroy(volume);
}

static void test_large_integers_become_floats(void **state) {
    (void)state;
    const int32_t exact[] = {-40000, 16777216, 33554432};
    struct pel_volume *volume =
        pel_volume_from_wide("x", (const int[]){3, 1, 1}, PEL_WIDE_I32, exact);
    assert_int_equal(volume->type, PEL_VOXEL_F32);
    assert_true(((float *)volume->voxels)[0] == -40000);
    assert_true(((float *)volume->voxels)[2] == 33554432);
    assert_int_equal(warning_count, 0);
    pel_volume_destroy(volume);

    const int64_t inexact[] = {INT64_MIN, 16777217, -16777217, 5};
    volume = pel_volume_from_wide("lab", (const int[]){2, 2, 1}, PEL_WIDE_I64, inexact);
    assert_true(((float *)volume->voxels)[0] == -0x1p63f);
    assert_true(((float *)volume->voxels)[3] == 5);
    assert_int_equal(warning_count, 1);
    assert_string_equal(warning, "lab: 2 of 4 values were rounded from int64 to float32");
    pel_volume_destroy(volume);

    const uint64_t huge[] = {UINT64_MAX};
    volume = pel_volume_from_wide("x", (const int[]){1, 1, 1}, PEL_WIDE_U64, huge);
    assert_true(((float *)volume->voxels)[0] == 0x1p64f);
    assert_int_equal(warning_count, 2);
    pel_volume_destroy(volume);
}

static void test_doubles(void **state) {
    (void)state;
    const double values[] = {0.5, 0.1, NAN, INFINITY, 1e300, -2};
    struct pel_volume *volume =
        pel_volume_from_wide("d", (const int[]){6, 1, 1}, PEL_WIDE_F64, values);
    const float *voxels = volume->voxels;
    assert_int_equal(volume->type, PEL_VOXEL_F32);
    assert_true(voxels[0] == 0.5f && voxels[1] == 0.1f && voxels[5] == -2);
    assert_true(isnan(voxels[2]) && isnan(voxels[3]) && isnan(voxels[4]));
    // 0.1 is rounded and 1e300 is lost; NaN and Inf were absent before.
    assert_string_equal(warning, "d: 2 of 6 values were rounded from float64 to float32");
    pel_volume_destroy(volume);
}

static void test_selection_of_a_channel(void **state) {
    (void)state;
    // Two voxels by two, three big-endian 16-bit channels side by side: take the second.
    const unsigned char block[] = {0, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6,
                                   0, 7, 0, 8, 0, 9, 1, 0, 1, 1, 1, 2};
    struct pel_selection selection = {.dims = {2, 2, 1},
                                      .element = PEL_ELEMENT_U16,
                                      .first = 1,
                                      .stride = {3, 6, 12},
                                      .components = 1,
                                      .swap = true};
    struct pel_volume *volume = pel_volume_select("x", &selection, block);
    assert_int_equal(volume->type, PEL_VOXEL_U16);
    const uint16_t expected[] = {2, 5, 8, 257};
    assert_memory_equal(volume->voxels, expected, sizeof expected);
    pel_volume_destroy(volume);
}

static void test_selection_of_planar_colours(void **state) {
    (void)state;
    const unsigned char block[] = {1, 2, 11, 12, 21, 22};
    struct pel_selection selection = {.dims = {2, 1, 1},
                                      .element = PEL_ELEMENT_U8,
                                      .stride = {1, 2, 2},
                                      .components = 3,
                                      .component_stride = 2};
    struct pel_volume *volume = pel_volume_select("x", &selection, block);
    assert_int_equal(volume->type, PEL_VOXEL_RGB8);
    const unsigned char expected[] = {1, 11, 21, 2, 12, 22};
    assert_memory_equal(volume->voxels, expected, sizeof expected);
    pel_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_small_integers_stay_exact, reset),
        cmocka_unit_test_setup(test_large_integers_become_floats, reset),
        cmocka_unit_test_setup(test_doubles, reset),
        cmocka_unit_test_setup(test_selection_of_a_channel, reset),
        cmocka_unit_test_setup(test_selection_of_planar_colours, reset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
