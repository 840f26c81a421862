// Tests of world/scene_auto.c: what is chosen for volumes whose histogram is known.
#include "support/test.h"

#include <math.h>

#include "world/scene_plan.h"

// `low_share` of the voxels have the value `low`, the others `high`; 10 x 10 x 10 voxels of 2 mm.
static struct pel_volume *make_volume(double low_share, float low, float high) {
    struct pel_volume *volume = pel_volume_create("two", (int[]){10, 10, 10}, PEL_VOXEL_F32);
    assert_non_null(volume);
    for (int i = 0; i < 1000; i++)
        ((float *)volume->voxels)[i] = i < 1000 * low_share ? low : high;
    for (int axis = 0; axis < 3; axis++)
        volume->world_from_voxel.m[axis][axis] = 2;
    return volume;
}

static struct pel_transfer *choose(const struct pel_volume *volume, const char *palette) {
    struct pel_statistics statistics;
    pel_volume_measure(volume, &statistics);
    struct pel_transfer *transfer = pel_scene_auto_transfer(volume, &statistics, palette);
    assert_non_null(transfer);
    return transfer;
}

static void test_two_values(void **state) {
    (void)state;
    struct pel_volume *volume = make_volume(0.6, 10, 110);
    struct pel_transfer *transfer = choose(volume, NULL);
    double rgba[4];
    pel_transfer_evaluate(transfer, 10, rgba);
    assert_float_equal(rgba[3], 0, 0);
    pel_transfer_evaluate(transfer, 110, rgba);
    assert_float_equal(rgba[3], 0.8, 1e-9);
    assert_float_equal(rgba[0], 1, 1e-9);
    // The box is a cube of 20 mm.
    assert_float_equal(transfer->opacity_unit_mm, 20.0 / 12, 1e-9);
    pel_transfer_destroy(transfer);
    pel_volume_destroy(volume);
}

// One voxel in a hundred: both percentiles are in the background, and still it is seen.
static void test_sparse(void **state) {
    (void)state;
    struct pel_volume *volume = make_volume(0.99, 0, 50);
    struct pel_transfer *transfer = choose(volume, "hot");
    double rgba[4];
    pel_transfer_evaluate(transfer, 0, rgba);
    assert_float_equal(rgba[3], 0, 0);
    pel_transfer_evaluate(transfer, 50, rgba);
    assert_float_equal(rgba[3], 0.8, 1e-9);
    pel_transfer_destroy(transfer);
    pel_volume_destroy(volume);
}

// One voxel in ten thousand does not move the window, even far off.
static void test_outliers(void **state) {
    (void)state;
    const float outliers[] = {1000, 1e5f, 1e6f};
    for (size_t i = 0; i < sizeof outliers / sizeof *outliers; i++) {
        struct pel_volume *volume = pel_volume_create("far", (int[]){100, 100, 1}, PEL_VOXEL_F32);
        for (int voxel = 0; voxel < 10000; voxel++)
            ((float *)volume->voxels)[voxel] = voxel % 2 ? 100 : 0;
        ((float *)volume->voxels)[77] = outliers[i];
        struct pel_transfer *transfer = choose(volume, NULL);
        double rgba[4];
        pel_transfer_evaluate(transfer, 100, rgba);
        // Percentiles of floats are as fine as 1/65536 of their range.
        assert_float_equal(rgba[3], 0.8, 0.1);
        pel_transfer_evaluate(transfer, 0, rgba);
        assert_float_equal(rgba[3], 0, 0);
        pel_transfer_destroy(transfer);
        pel_volume_destroy(volume);
    }
}

// No contrast, no voxels: still a valid function.
static void test_degenerate(void **state) {
    (void)state;
    const float values[] = {0, 7, -3e30f, 3e30f, NAN};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        struct pel_volume *volume = make_volume(1, values[i], 0);
        volume->unit[0] = '\0';
        struct pel_transfer *transfer = choose(volume, "grey");
        for (int point = 1; point < transfer->colour_count; point++)
            assert_true(transfer->colours[point - 1].value <= transfer->colours[point].value);
        assert_true(transfer->opacities[0].value <= transfer->opacities[1].value);
        assert_true(isfinite(transfer->opacities[1].value));
        pel_transfer_destroy(transfer);
        pel_volume_destroy(volume);
    }
}

// Hounsfield units and labels take presets made for them.
static void test_kinds(void **state) {
    (void)state;
    struct pel_volume *volume = make_volume(0.5, -1000, 1500);
    struct pel_transfer *bone = pel_transfer_preset("ct-bone");
    struct pel_transfer *transfer = choose(volume, NULL);
    assert_int_equal(transfer->colour_count, bone->colour_count);
    assert_float_equal(transfer->colours[0].value, bone->colours[0].value, 0);
    pel_transfer_destroy(transfer);
    transfer = choose(volume, "hot");
    assert_float_equal(transfer->colours[0].value, -1000, 0.1);
    pel_transfer_destroy(transfer);

    volume->labels = true;
    struct pel_transfer *labels = pel_transfer_preset("labels");
    transfer = choose(volume, "hot");
    assert_int_equal(transfer->colour_count, labels->colour_count);
    pel_transfer_destroy(transfer);
    pel_transfer_destroy(labels);
    pel_transfer_destroy(bone);
    pel_volume_destroy(volume);
}

// The alpha of colour images is their own opacity, over its whole range.
static void test_colour(void **state) {
    (void)state;
    struct pel_volume *volume = pel_volume_create("rgba", (int[]){2, 2, 2}, PEL_VOXEL_RGBA8);
    memset(volume->voxels, 200, 32);
    struct pel_transfer *transfer = choose(volume, NULL);
    assert_float_equal(transfer->opacities[0].value, 0, 0);
    assert_float_equal(transfer->opacities[1].value, 255, 0);
    pel_transfer_destroy(transfer);
    pel_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_values), cmocka_unit_test(test_sparse),
        cmocka_unit_test(test_outliers),   cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_kinds),      cmocka_unit_test(test_colour),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
