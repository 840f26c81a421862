// hypertexture.c - a volume without voxels is a volume all the same: whoever asks for voxels is
// told that there are none.
#include <math.h>

#include "support/test.h"

static struct pel_volume *create(void) {
    struct pel_volume *volume = pel_volume_hypertexture("fireball", NULL, false);
    if (!volume)
        fail_msg("%s", pel_error_message());
    assert_null(volume->voxels);
    return volume;
}

static void expect_refused(struct pel_volume *volume, const char *why) {
    assert_null(volume);
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    if (!strstr(pel_error_message(), why))
        fail_msg("'%s' does not say '%s'", pel_error_message(), why);
}

static void test_values(void **state) {
    (void)state;
    struct pel_volume *volume = create();
    struct pel_statistics statistics;
    pel_volume_measure(volume, &statistics);
    assert_true(statistics.min == 0 && statistics.max == 1 && statistics.percentiles[25] == 0.25);
    assert_true(isnan(pel_volume_value(volume, 1, 2, 3)));
    pel_volume_destroy(volume);
}

static void test_no_voxels(void **state) {
    (void)state;
    struct pel_volume *volume = create();
    const int first[3] = {0, 0, 0}, dims[3] = {4, 4, 4};
    const char *why = "'fireball' is a hypertexture, which has no voxels until it is baked";
    expect_refused(pel_volume_crop(volume, first, dims), why);
    expect_refused(pel_volume_resample(volume, dims), why);
    expect_refused(pel_volume_downsample(volume, 2), why);
    expect_refused(pel_volume_convert(volume, PEL_VOXEL_F32), why);
    assert_false(pel_volume_save(volume, test_temporary_path("fireball.nrrd")));
    expect_refused(NULL, why);
    // One recipe grows on a volume, but not on another recipe.
    const struct pel_bake_options on_it = {.object = volume};
    expect_refused(pel_volume_hypertexture("{\"value\": \"object\"}", &on_it, false),
                   "the recipe grows on 'fireball', which is a hypertexture");
    pel_volume_destroy(volume);
}

static void test_in_a_scene(void **state) {
    (void)state;
    struct pel_volume *volume = create();
    struct pel_scene *scene = pel_scene_create();
    assert_int_equal(pel_scene_add_volume(scene, volume, NULL), 0);
    pel_volume_destroy(volume);
    assert_true(scene->statistics[0].max == 1);
    struct pel_brick_report reports[PEL_BRICK_SIZES];
    assert_false(pel_scene_measure_bricks(scene, 0, reports));
    expect_refused(NULL, "volume 'fireball' is a hypertexture, of whose bricks nobody knows");
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),
        cmocka_unit_test(test_no_voxels),
        cmocka_unit_test(test_in_a_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
