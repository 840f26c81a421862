// brick_report.c - how bricks cluster, for volumes whose bricks can be counted by hand.
#include "support/scenes.h"
#include "support/test.h"

// 200 in a box of voxels, 0 elsewhere.
static double box(const double p[3], const void *user) {
    const double *ends = user;
    for (int c = 0; c < 3; c++)
        if (p[c] < ends[c] || p[c] > ends[3 + c])
            return 0;
    return 200;
}

static const double opaque_above[][5] = {
    {0, 1, 1, 1, 0}, {100, 1, 1, 1, 0}, {150, 1, 1, 1, 0.5}, {255, 1, 1, 1, 0.5}};

static struct pel_scene *scene_of_box(const double ends[6]) {
    struct pel_scene *scene = scene_create(16, 16);
    struct pel_volume *volume =
        scene_volume((int[]){62, 62, 62}, PEL_VOXEL_U8, box, (const void *)ends);
    scene_add(scene, volume, scene_transfer(opaque_above, 4));
    scene_view_parallel(scene, 64);
    return scene;
}

// Stored with its border, the volume has 64 voxels a side; voxel p is stored at p + 1. Stored
// voxels 17 to 30 along each axis lie in the bricks 2 and 3 of 8 voxels, and reach into no other.
static void test_by_hand(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_box((const double[]){16, 16, 16, 29, 29, 29});
    struct pel_brick_report reports[PEL_BRICK_SIZES];
    assert_true(pel_scene_measure_bricks(scene, 0, reports));
    static const struct {
        int size;
        uint64_t total, active, clusters;
    } expected[] = {{8, 512, 8, 1}, {16, 64, 1, 1}, {32, 8, 1, 1}, {64, 1, 1, 1}, {128, 1, 1, 1}};
    for (int i = 0; i < PEL_BRICK_SIZES; i++) {
        assert_int_equal(reports[i].bricks.size, expected[i].size);
        assert_int_equal(reports[i].bricks.total, expected[i].total);
        assert_int_equal(reports[i].bricks.active, expected[i].active);
        assert_int_equal(reports[i].bricks.clusters, expected[i].clusters);
        // One cube is crossed once; its 2 x 2 x 2 bricks, by parallel rays along an axis, two at a
        // time.
        assert_true(reports[i].depth == 1);
        assert_true(reports[i].depth_apart == (i == 0 ? 2 : 1));
    }
    pel_scene_destroy(scene);
}

// A column of five bricks is five clusters, because clusters are cubes.
static void test_column(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_box((const double[]){17, 17, 9, 20, 20, 45});
    struct pel_brick_report reports[PEL_BRICK_SIZES];
    assert_true(pel_scene_measure_bricks(scene, 0, reports));
    assert_int_equal(reports[0].bricks.active, 5);
    assert_int_equal(reports[0].bricks.clusters, 5);
    assert_true(reports[0].depth == 5);
    pel_scene_destroy(scene);
}

static void test_nothing(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_box((const double[]){99, 99, 99, 99, 99, 99});
    struct pel_brick_report reports[PEL_BRICK_SIZES];
    assert_true(pel_scene_measure_bricks(scene, 0, reports));
    assert_int_equal(reports[0].bricks.active, 0);
    assert_int_equal(reports[0].bricks.clusters, 0);
    assert_true(reports[0].depth == 0);
    assert_false(pel_scene_measure_bricks(scene, 1, reports));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_by_hand),
        cmocka_unit_test(test_column),
        cmocka_unit_test(test_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
