// operation.c - crop, resample, downsample and convert: values and, above all, places.
#include "support/test.h"

#include <math.h>

static int warning_count;
static char warning[256];

static void on_warning(const char *message, void *user) {
    (void)user;
    warning_count++;
    snprintf(warning, sizeof warning, "%s", message);
}

// The world position of index (i, j, k).
static void world(double p[3], const struct pel_volume *volume, double i, double j, double k) {
    for (int r = 0; r < 3; r++) {
        const double *m = volume->world_from_voxel.m[r];
        p[r] = m[0] * i + m[1] * j + m[2] * k + m[3];
    }
}

static void assert_same_place(const struct pel_volume *a, const double at_a[3],
                              const struct pel_volume *b, const double at_b[3]) {
    double p[3], q[3];
    world(p, a, at_a[0], at_a[1], at_a[2]);
    world(q, b, at_b[0], at_b[1], at_b[2]);
    for (int c = 0; c < 3; c++)
        assert_float_equal(p[c], q[c], 1e-9);
}

// An oblique, left-handed frame with a slope; values are those of a linear ramp.
static struct pel_volume *make_ramp(const int dims[3], enum pel_voxel_type type) {
    struct pel_volume *volume = pel_volume_create("ramp", dims, type);
    const struct pel_matrix frame = {
        {{0.5, 0.1, 0, -7}, {0, -2, 0.3, 11}, {0.2, 0, 3, 1}, {0, 0, 0, 1}}};
    volume->world_from_voxel = frame;
    volume->slope = 2;
    volume->intercept = -3;
    strcpy(volume->unit, "HU");
    size_t n = 0;
    for (int k = 0; k < dims[2]; k++)
        for (int j = 0; j < dims[1]; j++)
            for (int i = 0; i < dims[0]; i++, n++) {
                int value = 4 * i + 8 * j + 16 * k;
                if (type == PEL_VOXEL_F32)
                    ((float *)volume->voxels)[n] = (float)value;
                else
                    ((uint8_t *)volume->voxels)[n] = (uint8_t)value;
            }
    return volume;
}

static void test_crop(void **state) {
    (void)state;
    struct pel_volume *source = make_ramp((int[]){5, 4, 3}, PEL_VOXEL_U8);
    struct pel_volume *crop = pel_volume_crop(source, (int[]){1, 2, 1}, (int[]){3, 2, 2});
    assert_non_null(crop);
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < 2; j++)
            for (int i = 0; i < 3; i++)
                assert_true(pel_volume_value(crop, i, j, k) ==
                            pel_volume_value(source, i + 1, j + 2, k + 1));
    assert_same_place(crop, (double[]){0, 0, 0}, source, (double[]){1, 2, 1});
    assert_same_place(crop, (double[]){2, 1, 1}, source, (double[]){3, 3, 2});
    assert_string_equal(crop->unit, "HU");
    assert_null(pel_volume_crop(source, (int[]){3, 0, 0}, (int[]){3, 1, 1}));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_null(pel_volume_crop(source, (int[]){-1, 0, 0}, (int[]){1, 1, 1}));
    assert_null(pel_volume_crop(source, (int[]){0, 0, 0}, (int[]){1, 0, 1}));
    pel_volume_destroy(crop);
    pel_volume_destroy(source);
}

static void test_resample(void **state) {
    (void)state;
    const int dims[3] = {5, 4, 3};
    struct pel_volume *source = make_ramp(dims, PEL_VOXEL_F32);
    const int fine[3] = {10, 8, 9};
    struct pel_volume *result = pel_volume_resample(source, fine);
    assert_non_null(result);
    // The cell extents are the same: from index -1/2 to n - 1/2.
    assert_same_place(result, (double[]){-0.5, -0.5, -0.5}, source, (double[]){-0.5, -0.5, -0.5});
    assert_same_place(result, (double[]){9.5, 7.5, 8.5}, source, (double[]){4.5, 3.5, 2.5});
    // Trilinear interpolation reproduces a linear ramp between the outer centres.
    for (int k = 0; k < fine[2]; k++)
        for (int j = 0; j < fine[1]; j++)
            for (int i = 0; i < fine[0]; i++) {
                double x = fmin(fmax((i + 0.5) / 2 - 0.5, 0), 4);
                double y = fmin(fmax((j + 0.5) / 2 - 0.5, 0), 3);
                double z = fmin(fmax((k + 0.5) / 3 - 0.5, 0), 2);
                assert_float_equal(pel_volume_value(result, i, j, k),
                                   2 * (4 * x + 8 * y + 16 * z) - 3, 1e-4);
            }
    pel_volume_destroy(result);
    // To its own size nothing changes, and an absent voxel does not spread.
    ((float *)source->voxels)[7] = NAN;
    result = pel_volume_resample(source, dims);
    assert_memory_equal(result->voxels, source->voxels, pel_volume_bytes(source));
    pel_volume_destroy(result);
    assert_null(pel_volume_resample(source, (int[]){5, 0, 3}));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    pel_volume_destroy(source);
}

static void test_resample_absent_and_labels(void **state) {
    (void)state;
    struct pel_volume *line = pel_volume_create("line", (int[]){3, 1, 1}, PEL_VOXEL_F32);
    memcpy(line->voxels, (float[]){1, NAN, 5}, 12);
    // Centres at 0 (clamped), 0.25, 0.75, 1.25, 1.75, 2 (clamped).
    struct pel_volume *result = pel_volume_resample(line, (int[]){6, 1, 1});
    const float *voxels = result->voxels;
    assert_true(voxels[0] == 1 && isnan(voxels[1]) && isnan(voxels[4]) && voxels[5] == 5);
    pel_volume_destroy(result);
    pel_volume_destroy(line);
    struct pel_volume *labels = pel_volume_create("labels", (int[]){2, 1, 1}, PEL_VOXEL_U8);
    memcpy(labels->voxels, (uint8_t[]){3, 9}, 2);
    labels->labels = true;
    result = pel_volume_resample(labels, (int[]){5, 1, 1});
    assert_true(result->labels);
    assert_memory_equal(result->voxels, ((uint8_t[]){3, 3, 9, 9, 9}), 5);
    pel_volume_destroy(result);
    pel_volume_destroy(labels);
}

static void test_downsample(void **state) {
    (void)state;
    struct pel_volume *source = make_ramp((int[]){5, 4, 1}, PEL_VOXEL_F32);
    struct pel_volume *result = pel_volume_downsample(source, 2);
    assert_non_null(result);
    assert_int_equal(result->dims[0], 3);
    assert_int_equal(result->dims[1], 2);
    assert_int_equal(result->dims[2], 1);
    // Block (1, 0): i in 2..3, j in 0..1; the mean of a ramp is its value in the middle.
    assert_float_equal(pel_volume_value(result, 1, 0, 0), 2 * (4 * 2.5 + 8 * 0.5) - 3, 1e-6);
    // The last block is cut short: i = 4 only.
    assert_float_equal(pel_volume_value(result, 2, 1, 0), 2 * (4 * 4 + 8 * 2.5) - 3, 1e-6);
    assert_same_place(result, (double[]){1, 0, 0}, source, (double[]){2.5, 0.5, 0});
    assert_same_place(result, (double[]){-0.5, -0.5, 0.5}, source, (double[]){-0.5, -0.5, 0.5});
    pel_volume_destroy(result);
    ((float *)source->voxels)[0] = NAN;
    result = pel_volume_downsample(source, 2);
    assert_true(isnan(pel_volume_value(result, 0, 0, 0)));
    assert_false(isnan(pel_volume_value(result, 1, 0, 0)));
    pel_volume_destroy(result);
    assert_null(pel_volume_downsample(source, 0));
    pel_volume_destroy(source);
}

static void test_convert_integers(void **state) {
    (void)state;
    struct pel_volume *source = pel_volume_create("ct", (int[]){4, 1, 1}, PEL_VOXEL_I16);
    memcpy(source->voxels, (int16_t[]){-1000, 0, 255, 3000}, 8);
    source->slope = 0.5;
    source->intercept = 10;
    warning_count = 0;
    struct pel_volume *bytes = pel_volume_convert(source, PEL_VOXEL_U8);
    assert_memory_equal(bytes->voxels, ((uint8_t[]){0, 0, 255, 255}), 4);
    assert_true(bytes->slope == 0.5 && bytes->intercept == 10);
    assert_int_equal(warning_count, 1);
    assert_string_equal(warning, "ct: 2 values do not fit uint8 and were clamped");
    struct pel_volume *floats = pel_volume_convert(source, PEL_VOXEL_F32);
    assert_true(pel_volume_value(floats, 3, 0, 0) == 1510);
    assert_int_equal(warning_count, 1);
    pel_volume_destroy(floats);
    pel_volume_destroy(bytes);
    pel_volume_destroy(source);
}

static void test_convert_floats(void **state) {
    (void)state;
    struct pel_volume *source = pel_volume_create("pet", (int[]){4, 1, 1}, PEL_VOXEL_F32);
    memcpy(source->voxels, (float[]){-0.5F, NAN, 0.25F, 1.5F}, 16);
    source->slope = 3;
    source->intercept = 1;
    warning_count = 0;
    struct pel_volume *words = pel_volume_convert(source, PEL_VOXEL_I16);
    const int16_t *raw = words->voxels;
    assert_true(raw[0] == -32768 && raw[3] == 32767);
    for (int i = 0; i < 4; i++)
        if (i != 1)
            assert_float_equal(pel_volume_value(words, i, 0, 0), pel_volume_value(source, i, 0, 0),
                               6.0 / 65535 / 2 + 1e-9);
    assert_int_equal(warning_count, 1); // of the absent voxel
    pel_volume_destroy(words);
    // A constant stays what it is.
    memcpy(source->voxels, (float[]){4, 4, 4, 4}, 16);
    words = pel_volume_convert(source, PEL_VOXEL_U8);
    assert_true(pel_volume_value(words, 2, 0, 0) == 13);
    pel_volume_destroy(words);
    pel_volume_destroy(source);
}

static void test_convert_colours(void **state) {
    (void)state;
    struct pel_volume *rgb = pel_volume_create("rgb", (int[]){2, 1, 1}, PEL_VOXEL_RGB8);
    memcpy(rgb->voxels, (uint8_t[]){10, 20, 30, 255, 255, 255}, 6);
    struct pel_volume *grey = pel_volume_convert(rgb, PEL_VOXEL_U8);
    // 2.126 + 14.304 + 2.166 = 18.596
    assert_memory_equal(grey->voxels, ((uint8_t[]){19, 255}), 2);
    struct pel_volume *rgba = pel_volume_convert(rgb, PEL_VOXEL_RGBA8);
    assert_memory_equal(rgba->voxels, ((uint8_t[]){10, 20, 30, 19, 255, 255, 255, 255}), 8);
    struct pel_volume *colour = pel_volume_convert(grey, PEL_VOXEL_RGB8);
    assert_memory_equal(colour->voxels, ((uint8_t[]){19, 19, 19, 255, 255, 255}), 6);
    pel_volume_destroy(colour);
    pel_volume_destroy(rgba);
    pel_volume_destroy(grey);
    pel_volume_destroy(rgb);
}

int main(void) {
    pel_on_warning(on_warning, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crop),
        cmocka_unit_test(test_resample),
        cmocka_unit_test(test_resample_absent_and_labels),
        cmocka_unit_test(test_downsample),
        cmocka_unit_test(test_convert_integers),
        cmocka_unit_test(test_convert_floats),
        cmocka_unit_test(test_convert_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
