// Tests of what is under the pointer, and of the scale bar and the orientation cube.
#include "support/scenes.h"
#include "support/test.h"

#include <math.h>

#include "viewer/gauge.h"
#include "viewer/pick.h"
#include "viewer/vector.h"

static const int size[2] = {200, 100};

// A volume whose value is 10 i + j, 10 mm off along x, opaque from a value on.
static struct pel_scene *ramp_scene(enum pel_voxel_type type, double threshold) {
    const int dims[3] = {11, 9, 7};
    struct pel_volume *volume = pel_volume_create("ramp", dims, type);
    assert_non_null(volume);
    for (int i = 0; i < dims[0] * dims[1] * dims[2]; i++) {
        int value = 10 * (i % dims[0]) + i / dims[0] % dims[1];
        if (type == PEL_VOXEL_F32)
            ((float *)volume->voxels)[i] = (float)value;
        else
            ((uint8_t *)volume->voxels)[i] = (uint8_t)value;
    }
    volume->world_from_voxel.m[0][3] = 10;
    struct pel_scene *scene = pel_scene_create();
    assert_int_equal(pel_scene_add_volume(scene, volume, NULL), 0);
    pel_volume_destroy(volume);
    struct pel_transfer *transfer = scene->instances[0].transfer;
    transfer->opacity_count = 2;
    transfer->opacities[0] = (struct pel_opacity_point){threshold, 0};
    transfer->opacities[1] = (struct pel_opacity_point){threshold, 0.9};
    scene->camera = (struct pel_camera){.eye = {-500, 4, 3},
                                        .target = {15, 4, 3},
                                        .up = {0, 0, 1},
                                        .orthographic = true,
                                        .height_mm = 50};
    return scene;
}

static struct pel_pick pick_at(const struct pel_scene *scene, double x, double y) {
    struct pel_view view;
    struct pel_pick pick;
    const double pixel[2] = {x, y};
    assert_true(pel_view_make(&view, &scene->camera, size[0], size[1]));
    pel_pick(&pick, scene, &view, pixel);
    return pick;
}

// The ray runs along x through y = 4: the value 55 is reached at i = 5.1, that is at x = 15.1.
static void test_first_visible(void **state) {
    (void)state;
    struct pel_scene *scene = ramp_scene(PEL_VOXEL_U8, 55);
    struct pel_pick pick = pick_at(scene, 100, 50);
    assert_true(pick.hit);
    assert_int_equal(pick.instance, 0);
    assert_true(pick.position[0] >= 15.1 && pick.position[0] < 15.1 + 0.5);
    assert_float_equal(pick.position[1], 4, 1e-9);
    assert_float_equal(pick.position[2], 3, 1e-9);
    assert_float_equal(pick.distance_mm, pick.position[0] + 500, 1e-9);
    assert_int_equal(pick.count, 1);
    assert_float_equal(pick.values[0].value, 10 * (pick.position[0] - 10) + 4, 1e-9);
    assert_float_equal(pick.values[0].opacity, 0.9, 1e-9);
    // 50 mm over 100 pixels: 20 pixels from the middle are beyond the volume.
    assert_false(pick_at(scene, 100, 5).hit);
    assert_false(pick_at(scene, 20, 50).hit);
    scene->instances[0].hidden = true;
    assert_false(pick_at(scene, 100, 50).hit);
    // Nothing in it is opaque.
    scene->instances[0].hidden = false;
    scene->instances[0].density = 0;
    assert_false(pick_at(scene, 100, 50).hit);
    pel_scene_destroy(scene);
}

static void test_models(void **state) {
    (void)state;
    struct pel_scene *scene = ramp_scene(PEL_VOXEL_F32, 0);
    struct pel_instance *instance = &scene->instances[0];
    instance->model = PEL_MODEL_ISO;
    instance->surface_count = 1;
    instance->surfaces[0] = (struct pel_surface){.value = 72, .opacity = 1};
    struct pel_pick pick = pick_at(scene, 100, 50);
    assert_true(pick.hit && fabs(pick.position[0] - 16.8) < 0.5);
    // Without a surface of its own, the middle of 0 and 108.
    instance->surface_count = 0;
    pick = pick_at(scene, 100, 50);
    assert_true(pick.hit && fabs(pick.position[0] - 15) < 0.5);
    instance->model = PEL_MODEL_MIP;
    pick = pick_at(scene, 100, 50);
    assert_true(pick.hit && pick.position[0] > 19.5);
    instance->model = PEL_MODEL_MINIP;
    pick = pick_at(scene, 100, 50);
    assert_true(pick.hit && pick.position[0] < 10.5);
    pel_scene_destroy(scene);
}

// The nearer of two volumes is found, and both values are told.
static void test_two_volumes(void **state) {
    (void)state;
    struct pel_scene *scene = ramp_scene(PEL_VOXEL_F32, 55);
    assert_int_equal(pel_scene_add_copy(scene, 0), 1);
    scene->instances[1].transform.m[0][3] = -3;
    struct pel_pick pick = pick_at(scene, 100, 50);
    assert_true(pick.hit);
    assert_int_equal(pick.instance, 1);
    assert_true(pick.position[0] >= 12.1 && pick.position[0] < 12.6);
    assert_int_equal(pick.count, 2);
    assert_float_equal(pick.values[1].value - pick.values[0].value, 30, 1e-6);
    pel_pick_values(&pick, scene, (double[]){19, 4, 3});
    assert_true(pick.values[0].inside && !pick.values[1].inside);
    pel_scene_destroy(scene);
}

static void test_absent_and_nearest(void **state) {
    (void)state;
    struct pel_scene *scene = ramp_scene(PEL_VOXEL_F32, 0);
    ((float *)scene->volumes[0]->voxels)[5] = NAN;
    struct pel_sampler sampler;
    assert_true(pel_sampler_make(&sampler, scene, 0));
    struct pel_sample sample = pel_sampler_take(&sampler, (double[]){14.5, 0.5, 0.5});
    assert_true(sample.inside && sample.absent && isnan(sample.value) && sample.opacity == 0);
    scene->instances[0].filter = PEL_FILTER_NEAREST;
    sample = pel_sampler_take(&sampler, (double[]){14.4, 0.4, 0.4});
    assert_true(!sample.absent && sample.value == 40);
    // Cells reach half a voxel beyond the outer centres, where the outer voxel's value goes on.
    scene->instances[0].filter = PEL_FILTER_LINEAR;
    sample = pel_sampler_take(&sampler, (double[]){9.6, 3, 3});
    assert_true(sample.inside);
    assert_float_equal(sample.value, 3, 1e-9);
    assert_false(pel_sampler_take(&sampler, (double[]){9.4, 3, 3}).inside);
    pel_scene_destroy(scene);
}

// ---- The scale bar and the cube ----------------------------------------------------------------

static struct pel_view parallel_view(double height_mm) {
    struct pel_camera camera = {
        .eye = {0, 500, 0}, .up = {0, 0, 1}, .orthographic = true, .height_mm = height_mm};
    struct pel_view view;
    assert_true(pel_view_make(&view, &camera, size[0], size[1]));
    return view;
}

static void check_bar(double height_mm, double length_mm, double length_px, const char *text) {
    struct pel_view view = parallel_view(height_mm);
    struct pel_scale_bar bar;
    assert_true(pel_scale_bar_make(&bar, &view, 60));
    assert_float_equal(bar.length_mm, length_mm, 1e-9 * length_mm);
    assert_float_equal(bar.length_px, length_px, 1e-6);
    assert_string_equal(bar.text, text);
}

static void test_scale_bar(void **state) {
    (void)state;
    check_bar(100, 50, 50, "50 mm");
    check_bar(200, 100, 50, "10 cm");
    check_bar(1000 / 60.0 * 10, 100, 60, "10 cm");
    check_bar(40, 20, 50, "20 mm");
    check_bar(1, 0.5, 50, "500 um");
    check_bar(0.003, 0.001, 100 / 3.0, "1 um");
    check_bar(5000, 2000, 40, "2 m");
    check_bar(0.0005, 0.0002, 40, "200 nm");
}

// From anterior the patient's right is at the picture's left, and an anterior face is all there is.
static void test_cube(void **state) {
    (void)state;
    struct pel_cube_face faces[3];
    const double centre[2] = {50, 50};
    struct pel_view view = parallel_view(100);
    assert_int_equal(pel_orientation_cube(faces, &view, centre, 20), 1);
    assert_int_equal(faces[0].letter, 'A');
    assert_float_equal(faces[0].corners[0][0], 40, 1e-9);
    assert_float_equal(faces[0].corners[0][1], 40, 1e-9);
    assert_float_equal(faces[0].corners[2][0], 60, 1e-9);
    assert_float_equal(faces[0].corners[2][1], 60, 1e-9);
    assert_int_equal(pel_orientation_cube_hit(faces, 1, (double[]){58, 42}), 0);
    assert_int_equal(pel_orientation_cube_hit(faces, 1, (double[]){61, 42}), -1);
    // Each named view looks at the face of its name, with its letter upright.
    const struct pel_bounds bounds = {{-1, -1, -1}, {1, 1, 1}};
    static const char *const names[] = {"anterior", "posterior", "left",
                                        "right",    "superior",  "inferior"};
    for (int i = 0; i < 6; i++) {
        struct pel_camera camera = {.fov_deg = 30};
        assert_true(pel_camera_fit(&camera, names[i], &bounds, 2));
        assert_true(pel_view_make(&view, &camera, size[0], size[1]));
        assert_int_equal(pel_orientation_cube(faces, &view, centre, 20), 1);
        assert_string_equal(faces[0].view, names[i]);
        assert_float_equal(faces[0].right[0], 10, 1e-9);
        assert_float_equal(faces[0].down[1], 10, 1e-9);
    }
    struct pel_camera camera = {.fov_deg = 30};
    assert_true(pel_camera_fit(&camera, "oblique", &bounds, 2));
    assert_true(pel_view_make(&view, &camera, size[0], size[1]));
    assert_int_equal(pel_orientation_cube(faces, &view, centre, 20), 3);
    assert_int_equal(faces[2].letter, 'A');
    for (int i = 0; i < 3; i++)
        assert_int_equal(pel_orientation_cube_hit(faces, 3, faces[i].centre), i);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_first_visible), cmocka_unit_test(test_models),
        cmocka_unit_test(test_two_volumes),   cmocka_unit_test(test_absent_and_nearest),
        cmocka_unit_test(test_scale_bar),     cmocka_unit_test(test_cube),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
