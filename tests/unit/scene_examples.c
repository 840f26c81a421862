// Tests of the scenes in scenes/: each loads, without a warning, and is what its comment says.
#include "support/test.h"

#include <glob.h>

#include "volume/generate.h"

static struct pel_scene *load(const char *leaf) {
    char path[1024];
    snprintf(path, sizeof path, "%s/scenes/%s", TEST_SOURCE, leaf);
    struct pel_scene *scene = pel_scene_load(path, NULL, 0);
    if (!scene)
        fail_msg("%s", pel_error_message());
    return scene;
}

static void fail_on_warning(const char *message, void *user) {
    (void)user;
    fail_msg("warning: %s", message);
}

static void test_all_load(void **state) {
    (void)state;
    glob_t found;
    assert_int_equal(glob(TEST_SOURCE "/scenes/*.json", 0, NULL, &found), 0);
    assert_true(found.gl_pathc >= 8);
    pel_on_warning(fail_on_warning, NULL);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        if (strstr(found.gl_pathv[i], ".schema.json"))
            continue;
        struct pel_scene *scene = pel_scene_load(found.gl_pathv[i], NULL, 0);
        if (!scene)
            fail_msg("%s", pel_error_message());
        // They are image tests, also on an interpreter of kernels.
        assert_true(scene->render.width <= 480 && scene->render.height <= 240);
        for (int volume = 0; volume < scene->volume_count; volume++)
            assert_true(pel_volume_voxel_count(scene->volumes[volume]) <= 64 * 64 * 64);
        pel_scene_destroy(scene);
    }
    pel_on_warning(NULL, NULL);
    globfree(&found);
}

static void test_grid(void **state) {
    (void)state;
    struct pel_scene *scene = load("grid-32.json");
    assert_int_equal(scene->instance_count, PEL_VOLUME_MAX);
    assert_int_equal(scene->volume_count, 1);
    // The last stands at the right of the bottom row.
    assert_float_equal(scene->instances[31].transform.m[0][3], 350, 1e-9);
    assert_float_equal(scene->instances[31].transform.m[2][3], -150, 1e-9);
    pel_scene_destroy(scene);
}

static void test_head_pair(void **state) {
    (void)state;
    struct pel_scene *scene = load("head-pair.json");
    struct pel_matrix truth = pel_generate_head_pair_truth();
    for (int i = 0; i < 16; i++)
        assert_float_equal(scene->instances[1].transform.m[i / 4][i % 4], truth.m[i / 4][i % 4],
                           1e-8);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_load),
        cmocka_unit_test(test_grid),
        cmocka_unit_test(test_head_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
