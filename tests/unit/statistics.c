// statistics.c - measures checked against values worked out by hand or by sorting.
#include "support/test.h"

#include <math.h>

static struct pel_volume *make(int count, enum pel_voxel_type type) {
    return pel_volume_create("test", (int[]){count, 1, 1}, type);
}

static void test_bytes(void **state) {
    (void)state;
    struct pel_volume *volume = make(5, PEL_VOXEL_U8);
    memcpy(volume->voxels, (uint8_t[]){10, 20, 20, 40, 60}, 5);
    struct pel_statistics s;
    pel_volume_measure(volume, &s);
    assert_true(s.min == 10 && s.max == 60 && s.count == 5 && s.absent_count == 0);
    assert_float_equal(s.mean, 30, 1e-12);
    // ((-20)^2 + (-10)^2 + (-10)^2 + 10^2 + 30^2) / 5 = 320
    assert_float_equal(s.deviation, sqrt(320), 1e-12);
    assert_true(s.percentiles[0] == 10 && s.percentiles[20] == 10 && s.percentiles[21] == 20);
    assert_true(s.percentiles[60] == 20 && s.percentiles[61] == 40 && s.percentiles[80] == 40);
    assert_true(s.percentiles[81] == 60 && s.percentiles[100] == 60);
    // 20 lies at 10/50 of the range: bin 51; 40 at 30/50: bin 153.
    assert_true(s.histogram[0] == 1 && s.histogram[51] == 2 && s.histogram[153] == 1);
    assert_true(s.histogram[255] == 1);
    pel_volume_destroy(volume);
}

static void test_negative_slope(void **state) {
    (void)state;
    struct pel_volume *volume = make(4, PEL_VOXEL_I16);
    memcpy(volume->voxels, (int16_t[]){-1000, 0, 0, 3000}, 8);
    volume->slope = -2;
    volume->intercept = 5;
    struct pel_statistics s;
    pel_volume_measure(volume, &s);
    assert_true(s.min == -5995 && s.max == 2005);
    assert_float_equal(s.mean, -2 * 500 + 5, 1e-9);
    assert_true(s.percentiles[25] == -5995 && s.percentiles[26] == 5 && s.percentiles[75] == 5);
    assert_true(s.percentiles[76] == 2005);
    assert_true(s.histogram[0] == 1 && s.histogram[255] == 1);
    assert_true(s.histogram[6000 * 256 / 8000] == 2);
    pel_volume_destroy(volume);
}

static void test_one_value(void **state) {
    (void)state;
    const enum pel_voxel_type types[] = {PEL_VOXEL_U8, PEL_VOXEL_F32};
    for (int i = 0; i < 2; i++) {
        struct pel_volume *volume = make(3, types[i]);
        memset(volume->voxels, 0, pel_volume_bytes(volume));
        volume->intercept = 7;
        struct pel_statistics s;
        pel_volume_measure(volume, &s);
        assert_true(s.min == 7 && s.max == 7 && s.mean == 7 && s.deviation == 0);
        assert_true(s.percentiles[0] == 7 && s.percentiles[50] == 7 && s.percentiles[100] == 7);
        assert_true(s.histogram[0] == 3);
        pel_volume_destroy(volume);
    }
}

static int ascending(const void *a, const void *b) {
    float left = *(const float *)a, right = *(const float *)b;
    return left < right ? -1 : left > right;
}

static void test_floats_against_sorting(void **state) {
    (void)state;
    enum { COUNT = 10000, ABSENT = 123 };
    struct pel_volume *volume = make(COUNT + ABSENT, PEL_VOXEL_F32);
    float *voxels = volume->voxels, *sorted = malloc(COUNT * sizeof *sorted);
    uint64_t seed = 5;
    double sum = 0;
    for (int i = 0; i < COUNT; i++) {
        double x = test_random(&seed);
        voxels[i] = sorted[i] = (float)(x * x * 100 - 20);
        sum += voxels[i];
    }
    for (int i = COUNT; i < COUNT + ABSENT; i++)
        voxels[i] = NAN;
    qsort(sorted, COUNT, sizeof *sorted, ascending);
    struct pel_statistics s;
    pel_volume_measure(volume, &s);
    assert_int_equal(s.count, COUNT);
    assert_int_equal(s.absent_count, ABSENT);
    assert_true(s.min == sorted[0] && s.max == sorted[COUNT - 1]);
    assert_float_equal(s.mean, sum / COUNT, 1e-9);
    double error = (s.max - s.min) / 65536;
    for (int p = 1; p <= 100; p++)
        assert_true(fabs(s.percentiles[p] - sorted[p * COUNT / 100 - 1]) <= error);
    uint64_t total = 0;
    for (int bin = 0; bin < PEL_HISTOGRAM_BINS; bin++)
        total += s.histogram[bin];
    assert_int_equal(total, COUNT);
    free(sorted);
    pel_volume_destroy(volume);
}

static void test_nothing_present(void **state) {
    (void)state;
    struct pel_volume *volume = make(2, PEL_VOXEL_F32);
    memcpy(volume->voxels, (float[]){NAN, NAN}, 8);
    struct pel_statistics s;
    pel_volume_measure(volume, &s);
    assert_true(s.min == 0 && s.max == 0 && s.count == 0 && s.absent_count == 2);
    pel_volume_destroy(volume);
}

static void test_colours(void **state) {
    (void)state;
    struct pel_volume *rgb = make(2, PEL_VOXEL_RGB8), *rgba = make(2, PEL_VOXEL_RGBA8);
    memcpy(rgb->voxels, (uint8_t[]){100, 0, 0, 0, 100, 0}, 6);
    memcpy(rgba->voxels, (uint8_t[]){255, 255, 255, 9, 0, 0, 0, 30}, 8);
    struct pel_statistics s;
    pel_volume_measure(rgb, &s);
    assert_float_equal(s.min, 21.26, 1e-5);
    assert_float_equal(s.max, 71.52, 1e-5);
    pel_volume_measure(rgba, &s);
    assert_true(s.min == 9 && s.max == 30);
    pel_volume_destroy(rgb);
    pel_volume_destroy(rgba);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes),           cmocka_unit_test(test_negative_slope),
        cmocka_unit_test(test_one_value),       cmocka_unit_test(test_floats_against_sorting),
        cmocka_unit_test(test_nothing_present), cmocka_unit_test(test_colours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
