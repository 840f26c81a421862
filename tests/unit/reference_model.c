// reference_model.c - optical models of the reference against what is known in closed form.
#include <math.h>

#include "reference/reference.h"
#include "support/near.h"
#include "support/picture.h"
#include "support/scenes.h"
#include "support/test.h"

static const double grey[2][5] = {{0, 0, 0, 0, 0}, {200, 1, 1, 1, 1}};

// The pixel in the middle of a picture of one ray.
static void cast(const struct pel_scene *scene, double rgba[4]) {
    reference_ray(scene, 0, 0, rgba, NULL);
}

static struct pel_scene *one_ray(struct pel_volume *volume, enum pel_model model) {
    struct pel_scene *scene = scene_create(1, 1);
    scene_view_parallel(scene, 1);
    scene_add(scene, volume, scene_transfer(grey, 2));
    scene->render.model = model;
    return scene;
}

static double bell(const double p_voxel[3], const void *user) {
    (void)user;
    double x = p_voxel[0] - 4, y = p_voxel[1] - 4, z = p_voxel[2] - 8;
    return 180 * exp(-(x * x + y * y + z * z) / 18);
}

// The greatest value of a bell is at its top, wherever the density and the step.
static void test_mip_of_a_bell(void **state) {
    (void)state;
    const int dims[3] = {9, 9, 17};
    struct pel_scene *scene = one_ray(scene_volume(dims, PEL_VOXEL_F32, bell, NULL), PEL_MODEL_MIP);
    scene->render.step = 0.125;
    scene->render.phase = 0;
    double rgba[4];
    cast(scene, rgba);
    assert_near(rgba[3], 0.9, 1e-3);
    assert_near(rgba[0], 0.81, 2e-3);
    scene->instances[0].density = 7;
    cast(scene, rgba);
    assert_near(rgba[3], 0.9, 1e-3);
    pel_scene_destroy(scene);
}

// The mean of a ramp is its middle, and its least value the first.
static void test_average_of_a_ramp(void **state) {
    (void)state;
    const int dims[3] = {5, 5, 21};
    const double ends[2] = {40, 160};
    struct pel_scene *scene =
        one_ray(scene_volume_ramp(dims, PEL_VOXEL_F32, ends), PEL_MODEL_AVERAGE);
    scene->instances[0].extent = PEL_EXTENT_POINT;
    scene->render.step = 0.25;
    double rgba[4];
    cast(scene, rgba);
    assert_near(rgba[3], 0.5, 1e-6);
    scene->render.model = PEL_MODEL_MINIP;
    cast(scene, rgba);
    assert_near(rgba[3], (40 + 0.125 * 6) / 200, 1e-6);
    pel_scene_destroy(scene);
}

static double distance_field(const double p_voxel[3], const void *user) {
    (void)user;
    double x = p_voxel[0] - 10, y = p_voxel[1] - 10, z = p_voxel[2] - 10;
    return 100 - 10 * sqrt(x * x + y * y + z * z);
}

// Where a ray meets a sphere of distances tells the light from a point: behind the sphere's rim
// nothing is met.
static void test_iso_of_a_sphere(void **state) {
    (void)state;
    const int dims[3] = {21, 21, 21};
    struct pel_scene *scene = scene_create(41, 1);
    scene_view_parallel(scene, 20.5 / 41);
    scene_add(scene, scene_volume(dims, PEL_VOXEL_F32, distance_field, NULL),
              scene_transfer(grey, 2));
    scene->render.model = PEL_MODEL_ISO;
    scene->instances[0].surface_count = 1;
    scene->instances[0].surfaces[0] = (struct pel_surface){.value = 40, .opacity = 1};
    struct pel_image *picture = reference_render(scene);
    for (int x = 0; x < 41; x++) {
        double away = fabs(20.5 * ((x + 0.5) / 41 - 0.5));
        if (fabs(away - 6) < 0.3)
            continue;
        assert_near(picture->rgba[4 * x + 3], away < 6 ? 1 : 0, 0);
        assert_near(picture->rgba[4 * x], away < 6 ? 0.2 : 0, 1e-6);
    }
    pel_image_destroy(picture);
    pel_scene_destroy(scene);
}

// The thesis's picture changes with the step, and its two orders differ where opacity is below 1.
static void test_thesis_is_wrong(void **state) {
    (void)state;
    const int dims[3] = {5, 5, 8};
    struct pel_scene *scene = scene_create(1, 1);
    scene_view_parallel(scene, 1);
    scene_add(scene, scene_volume_constant(dims, PEL_VOXEL_U8, 100),
              scene_transfer_constant((double[]){0.5, 0.5, 0.5, 0.25}));
    scene->render.model = PEL_MODEL_THESIS;
    scene->instances[0].density = 0.2;
    scene->render.step = 1; // eight samples
    double rgba[4], clear = pow(1 - 0.05, 8);
    cast(scene, rgba);
    assert_near(rgba[3], 1 - clear, 1e-9);
    assert_near(rgba[0], 0.2 * 0.5 * (1 - clear) / 0.05, 1e-9);
    scene->render.order = PEL_ORDER_BACK_TO_FRONT;
    cast(scene, rgba);
    assert_near(rgba[0], 0.5 * (1 - clear), 1e-9);
    scene->render.step = 0.5;
    cast(scene, rgba);
    assert_near(rgba[0], 0.5 * (1 - clear * clear), 1e-9);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mip_of_a_bell),
        cmocka_unit_test(test_average_of_a_ramp),
        cmocka_unit_test(test_iso_of_a_sphere),
        cmocka_unit_test(test_thesis_is_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
