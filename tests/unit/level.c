// level.c - coarser versions of volumes: that a volume stays where it is and its mean what it is,
// whatever its size; and at which level a picture shows it. Against numbers worked out by hand and
// against the reference.
#include "volume/level.h"

#include <math.h>

#include "base/math.h"
#include "reference/level.h"
#include "support/near.h"
#include "support/scenes.h"
#include "support/test.h"
#include "world/detail.h"

static struct pel_volume *make(const int dims[3], enum pel_voxel_type type, uint64_t seed) {
    return scene_volume_waves(dims, type, seed, 5);
}

static double mean_of(const struct pel_volume *volume) {
    double sum = 0;
    size_t count = pel_volume_voxel_count(volume);
    for (size_t i = 0; i < count; i++)
        sum += (double)((const float *)volume->voxels)[i];
    return sum / (double)count;
}

// Three voxels become two, each of one and a half; the middle one counts for both.
static void test_by_hand(void **state) {
    (void)state;
    struct pel_volume *row = pel_volume_create("row", (int[]){3, 1, 1}, PEL_VOXEL_F32);
    memcpy(row->voxels, (float[]){6, 9, 15}, 3 * sizeof(float));
    struct pel_volume *level = pel_volume_level(row, 1);
    const float *voxels = level->voxels;
    assert_int_equal(level->dims[0], 2);
    assert_int_equal(level->dims[1], 1);
    assert_near((double)voxels[0], (6 + 4.5) / 1.5, 1e-6);
    assert_near((double)voxels[1], (4.5 + 15) / 1.5, 1e-6);
    assert_near(level->world_from_voxel.m[0][0], 1.5, 1e-12);
    assert_near(level->world_from_voxel.m[0][3], 0.25, 1e-12);
    pel_volume_destroy(level);
    // What is absent does not count; where nothing is present, nothing is.
    ((float *)row->voxels)[1] = ((float *)row->voxels)[2] = NAN;
    level = pel_volume_level(row, 1);
    assert_near((double)((float *)level->voxels)[0], 6, 0);
    assert_true(isnan(((float *)level->voxels)[1]));
    pel_volume_destroy(level);
    pel_volume_destroy(row);
    // Integers are rounded, halves up.
    struct pel_volume *pair = pel_volume_create("pair", (int[]){2, 2, 1}, PEL_VOXEL_I8);
    memcpy(pair->voxels, (int8_t[]){-2, -1, -2, -1}, 4);
    level = pel_volume_level(pair, 1);
    assert_int_equal(((int8_t *)level->voxels)[0], -1);
    pel_volume_destroy(level);
    pel_volume_destroy(pair);
}

// Corners of the box, and the mean of all values, are those of the volume itself at every level.
static void test_extent(void **state) {
    (void)state;
    static const int sizes[][3] = {{16, 16, 16}, {17, 23, 5}, {1, 40, 9}, {31, 2, 33}};
    for (size_t n = 0; n < sizeof sizes / sizeof *sizes; n++) {
        struct pel_volume *volume = make(sizes[n], PEL_VOXEL_F32, n);
        scene_place(volume, (double[]){0.7, 0.7, 0.7}, (double[]){0.3, 0.1, -0.5, 0.8},
                    (double[]){3, -2, 7}, n % 2);
        for (int l = 1; l <= 6; l++) {
            struct pel_volume *level = pel_volume_level(volume, l);
            assert_non_null(level);
            assert_near(mean_of(level), mean_of(volume), 1e-4);
            for (int corner = 0; corner < 8; corner++) {
                double was[3], is[3];
                for (int c = 0; c < 3; c++) {
                    was[c] = corner >> c & 1 ? volume->dims[c] - 0.5 : -0.5;
                    is[c] = corner >> c & 1 ? level->dims[c] - 0.5 : -0.5;
                }
                pel_matrix_point(was, &volume->world_from_voxel, was);
                pel_matrix_point(is, &level->world_from_voxel, is);
                for (int c = 0; c < 3; c++)
                    assert_near(is[c], was[c], 1e-9);
            }
            pel_volume_destroy(level);
        }
        pel_volume_destroy(volume);
    }
}

// Every type, voxel by voxel, as the reference has it.
static void test_reference(void **state) {
    (void)state;
    for (int type = PEL_VOXEL_U8; type <= PEL_VOXEL_RGBA8; type++) {
        struct pel_volume *volume = make((int[]){13, 10, 7}, (enum pel_voxel_type)type, 3);
        scene_place(volume, (double[]){1, 0.5, 2.2}, (double[]){0, 0, 0, 1}, (double[]){0, 0, 0},
                    false);
        for (int l = 1; l <= 4; l++) {
            struct pel_volume *level = pel_volume_level(volume, l);
            struct pel_volume *expected = reference_level(volume, l);
            assert_memory_equal(level->dims, expected->dims, sizeof level->dims);
            for (int row = 0; row < 3; row++)
                for (int c = 0; c < 4; c++)
                    assert_near(level->world_from_voxel.m[row][c],
                                expected->world_from_voxel.m[row][c], 1e-9);
            for (int k = 0; k < level->dims[2]; k++)
                for (int j = 0; j < level->dims[1]; j++)
                    for (int i = 0; i < level->dims[0]; i++)
                        // A mean within rounding of a half may go either way.
                        assert_near(pel_volume_value(level, i, j, k),
                                    pel_volume_value(expected, i, j, k),
                                    type == PEL_VOXEL_F32 ? 1e-4 : 1);
            pel_volume_destroy(level);
            pel_volume_destroy(expected);
        }
        pel_volume_destroy(volume);
    }
}

// Finer axes are halved first, until voxels are as good as cubes.
static void test_anisotropic(void **state) {
    (void)state;
    struct pel_volume *volume = pel_volume_create("slices", (int[]){64, 64, 12}, PEL_VOXEL_U8);
    scene_place(volume, (double[]){0.5, 0.6, 3}, (double[]){0, 0, 0, 1}, (double[]){0, 0, 0},
                false);
    static const int expected[][3] = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 2, 0}, {4, 3, 1}};
    for (int l = 0; l < 5; l++) {
        int halvings[3];
        pel_volume_level_halvings(volume, l, halvings);
        assert_memory_equal(halvings, expected[l], sizeof halvings);
    }
    pel_volume_destroy(volume);
}

// ---- Which level -------------------------------------------------------------------------------

static struct pel_transfer *haze(void) {
    return scene_transfer_constant((double[]){1, 1, 1, 0.1});
}

static void expect_levels(const struct pel_scene *scene, int level) {
    assert_int_equal(pel_detail_level(scene, NULL, 0), level);
    assert_int_equal(reference_level_of(scene, 0), level);
}

// The camera stands 100 mm away from the middle and sees 40 mm there; a pixel of ten rows is 4 mm.
static void test_footprint(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(10, 10);
    scene_add(scene, scene_volume_constant((int[]){9, 9, 1}, PEL_VOXEL_U8, 1), haze());
    expect_levels(scene, 0);
    scene->render.lod = PEL_LOD_AUTO;
    expect_levels(scene, 1); // the face is half a voxel nearer
    scene->render.height = 9;
    expect_levels(scene, 2);
    scene->render.supersampling.n = 2;
    expect_levels(scene, 1);
    scene->render.supersampling.n = 1;
    scene->instances[0].transform.m[2][3] = -110; // more than twice as far
    expect_levels(scene, 3);
    scene->instances[0].transform.m[2][3] = 99.8; // around the camera
    expect_levels(scene, 0);
    scene->instances[0].transform.m[2][3] = 120; // behind it
    expect_levels(scene, 0);
    scene_view_parallel(scene, 9 * 8);
    expect_levels(scene, 3);
    scene->render.lod = PEL_LOD_LEVEL;
    scene->render.lod_level = 5;
    expect_levels(scene, 5);
    pel_scene_destroy(scene);
}

// Labels, volumes shown voxel by voxel, and those that decide about others stay as they are.
static void test_exceptions(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(10, 10);
    scene_add(scene, scene_volume_constant((int[]){9, 9, 9}, PEL_VOXEL_U8, 1), haze());
    scene_add_again(scene, 0, haze());
    scene->render.lod = PEL_LOD_LEVEL;
    scene->render.lod_level = 2;
    expect_levels(scene, 2);
    scene->instances[0].filter = PEL_FILTER_NEAREST;
    expect_levels(scene, 0);
    assert_int_equal(pel_detail_level(scene, NULL, 1), 2);
    scene->instances[0].filter = PEL_FILTER_LINEAR;
    scene->instances[1].mask = (struct pel_mask){.range_count = 1, .instance = 0};
    expect_levels(scene, 0);
    scene->instances[1].mask = (struct pel_mask){0};
    scene->volumes[0]->labels = true;
    expect_levels(scene, 0);
    pel_scene_destroy(scene);
}

// Of two eyes the one that needs more decides, whichever is asked first.
static void test_two_eyes(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(10, 10);
    scene_add(scene, scene_volume_constant((int[]){9, 9, 1}, PEL_VOXEL_U8, 1), haze());
    scene->render.lod = PEL_LOD_AUTO;
    scene->render.height = 9;
    const struct pel_camera far = scene->camera;
    expect_levels(scene, 2);
    scene->camera.eye[2] /= 2;
    const struct pel_camera near = scene->camera;
    expect_levels(scene, 1);
    assert_int_equal(pel_detail_level(scene, &far, 0), 1);
    scene->camera = far;
    assert_int_equal(pel_detail_level(scene, &near, 0), 1);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_by_hand),   cmocka_unit_test(test_extent),
        cmocka_unit_test(test_reference), cmocka_unit_test(test_anisotropic),
        cmocka_unit_test(test_footprint), cmocka_unit_test(test_exceptions),
        cmocka_unit_test(test_two_eyes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
