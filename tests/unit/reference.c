// reference.c - the reference against analytic truth: everything expected here is a closed formula
// or was worked out by hand.
#include <math.h>

#include "base/math.h"
#include "reference/classify.h"
#include "reference/ray.h"
#include "reference/reference.h"
#include "reference/sample.h"
#include "support/scenes.h"
#include "support/test.h"

#define CHECK_NEAR(actual, expected, tolerance)                                                    \
    check_near(actual, expected, tolerance, #actual, __FILE__, __LINE__)

static void check_near(double actual, double expected, double tolerance, const char *text,
                       const char *file, int line) {
    if (fabs(actual - expected) <= tolerance)
        return;
    print_error("%s is %.12g, not %.12g within %g\n", text, actual, expected, tolerance);
    _fail(file, line);
}

// A scene of one pixel whose ray comes down the z axis.
static struct pel_scene *one_ray(double step) {
    struct pel_scene *scene = scene_create(1, 1);
    scene_view_parallel(scene, 1);
    scene->render.step = step;
    return scene;
}

static void cast(const struct pel_scene *scene, double rgba[4]) {
    reference_ray(scene, 0, 0, rgba, NULL);
}

// ---- Rays --------------------------------------------------------------------------------------

static void test_rays(void **state) {
    (void)state;
    struct pel_camera camera = {
        .eye = {1, 2, 3}, .target = {1, 2, 0}, .up = {0, 5, 1}, .fov_deg = 90, .height_mm = 10};
    // Down -z with y up, x is to the right. The upper left corner of a 4x2 picture has u = -2 and
    // v = 1, and tan 45 degrees is 1.
    struct reference_ray ray = reference_camera_ray(&camera, 4, 2, -0.5, -0.5);
    double length = sqrt(6);
    CHECK_NEAR(ray.direction[0], -2 / length, 1e-12);
    CHECK_NEAR(ray.direction[1], 1 / length, 1e-12);
    CHECK_NEAR(ray.direction[2], -1 / length, 1e-12);
    CHECK_NEAR(ray.origin[2], 3, 0);

    // A shift of a quarter moves the window by half of v's unit, up.
    camera.shift[1] = 0.25;
    ray = reference_camera_ray(&camera, 4, 2, 1.5, 0.5);
    CHECK_NEAR(ray.direction[1] / -ray.direction[2], 0.5, 1e-12);

    // Pixel (3, 1) of 4x2, parallel: u = 3/2, v = -1/2 + 1/2, times 5 mm.
    camera.orthographic = true;
    ray = reference_camera_ray(&camera, 4, 2, 3, 1);
    CHECK_NEAR(ray.origin[0], 1 + 7.5, 1e-12);
    CHECK_NEAR(ray.origin[1], 2, 1e-12);
    CHECK_NEAR(ray.direction[2], -1, 1e-12);
}

static void test_spans(void **state) {
    (void)state;
    const double low[3] = {-1, -2, -3}, high[3] = {1, 2, 3};
    struct reference_ray ray = {{0, 0, 10}, {0, 0, -2}};
    struct reference_span span = reference_clip(&ray, low, high);
    CHECK_NEAR(span.t_in, 3.5, 0);
    CHECK_NEAR(span.t_out, 6.5, 0);
    ray.origin[2] = 1; // inside: the span begins at the origin
    span = reference_clip(&ray, low, high);
    CHECK_NEAR(span.t_in, 0, 0);
    CHECK_NEAR(span.t_out, 2, 0);
    ray.origin[2] = -4; // behind
    span = reference_clip(&ray, low, high);
    assert_true(span.t_in >= span.t_out);
    ray = (struct reference_ray){{1, 0, 10}, {0, 0, -1}}; // along the upper face: outside
    span = reference_clip(&ray, low, high);
    assert_true(span.t_in >= span.t_out);
    ray.origin[0] = -1; // along the lower one: inside
    span = reference_clip(&ray, low, high);
    CHECK_NEAR(span.t_out - span.t_in, 6, 0);
}

// ---- Values ------------------------------------------------------------------------------------

static double product_field(const double p[3], const void *user) {
    (void)user;
    return 10 * (p[0] + 1) * (p[1] + 1) * (p[2] + 1);
}

static void test_interpolation(void **state) {
    (void)state;
    struct pel_volume *volume = scene_volume((int[]){3, 3, 2}, PEL_VOXEL_I16, product_field, NULL);
    volume->slope = 0.5;
    volume->intercept = -7;
    struct reference_sample sample;
    // The field is trilinear, so that trilinear interpolation is exact.
    assert_true(
        reference_sample_volume(&sample, volume, PEL_FILTER_LINEAR, (double[]){1.25, 0.5, 0.75}));
    CHECK_NEAR(sample.value, 0.5 * 10 * 2.25 * 1.5 * 1.75 - 7, 1e-12);
    assert_true(
        reference_sample_volume(&sample, volume, PEL_FILTER_LINEAR, (double[]){-0.5, 2, 1.5}));
    CHECK_NEAR(sample.value, 0.5 * 10 * 1 * 3 * 2 - 7, 1e-12);
    assert_true(
        reference_sample_volume(&sample, volume, PEL_FILTER_NEAREST, (double[]){0.5, 1.49, -0.4}));
    CHECK_NEAR(sample.value, 0.5 * 10 * 2 * 2 * 1 - 7, 1e-12);
    pel_volume_destroy(volume);
}

static void test_absent_corner(void **state) {
    (void)state;
    struct pel_volume *volume = scene_volume_constant((int[]){4, 1, 1}, PEL_VOXEL_F32, 5);
    ((float *)volume->voxels)[2] = NAN;
    struct reference_sample sample;
    const double at_1[3] = {1, 0, 0}, at_09[3] = {0.9, 0, 0};
    // At 1 exactly the cell is the one from 1 to 2, whose upper corner is absent at weight 0.
    assert_false(reference_sample_volume(&sample, volume, PEL_FILTER_LINEAR, at_1));
    assert_true(reference_sample_volume(&sample, volume, PEL_FILTER_LINEAR, at_09));
    assert_true(reference_sample_volume(&sample, volume, PEL_FILTER_NEAREST, at_1));
    CHECK_NEAR(sample.value, 5, 0);
    // Beyond the last voxel's centre it is the only one.
    const double at_31[3] = {3.1, -0.5, 0.5};
    assert_true(reference_sample_volume(&sample, volume, PEL_FILTER_LINEAR, at_31));
    CHECK_NEAR(sample.value, 5, 1e-12);
    pel_volume_destroy(volume);
}

static void test_colours(void **state) {
    (void)state;
    struct pel_volume *volume = pel_volume_create("rgb", (int[]){2, 1, 1}, PEL_VOXEL_RGB8);
    memcpy(volume->voxels, (uint8_t[]){255, 0, 0, 10, 20, 30}, 6);
    struct reference_sample sample;
    assert_true(reference_sample_volume(&sample, volume, PEL_FILTER_LINEAR, (double[]){0.5, 0, 0}));
    // Luminances 54.213 -> 54 and 18.596 -> 19.
    CHECK_NEAR(sample.value, 36.5, 1e-12);
    CHECK_NEAR(sample.rgb[0], 132.5 / 255, 1e-12);
    assert_true(sample.coloured);
    pel_volume_destroy(volume);

    volume = pel_volume_create("rgba", (int[]){1, 1, 2}, PEL_VOXEL_RGBA8);
    memcpy(volume->voxels, (uint8_t[]){1, 2, 3, 100, 5, 6, 7, 200}, 8);
    assert_true(
        reference_sample_volume(&sample, volume, PEL_FILTER_LINEAR, (double[]){0, 0, 0.25}));
    CHECK_NEAR(sample.value, 125, 1e-12);
    CHECK_NEAR(sample.rgb[2], 4.0 / 255, 1e-12);
    pel_volume_destroy(volume);
}

// ---- Classification ----------------------------------------------------------------------------

static void test_table_of_bytes(void **state) {
    (void)state;
    // Signed bytes in half units from -74 to 53.5, and a step at -10.
    struct pel_volume *volume = scene_volume_constant((int[]){1, 1, 1}, PEL_VOXEL_I8, 0);
    volume->slope = 0.5;
    volume->intercept = -10;
    struct pel_transfer *transfer = scene_transfer(
        (const double[][5]){{-20, 0, 0, 0, 0}, {-10, 1, 0, 0, 0.5}, {-10, 0, 1, 0, 1}}, 3);
    struct reference_table table;
    reference_table_init(&table, transfer, volume);
    assert_int_equal(table.count, 256);
    CHECK_NEAR(table.low, -74, 0);
    CHECK_NEAR(table.high, 53.5, 0);

    double rgba[4];
    reference_table_look_up(rgba, &table, -10); // the later point
    CHECK_NEAR(rgba[3], 1, 1e-12);
    reference_table_look_up(rgba, &table, -10.5); // a twentieth before it
    CHECK_NEAR(rgba[3], 0.475, 1e-12);
    CHECK_NEAR(rgba[0], 0.95, 1e-12);
    reference_table_look_up(rgba, &table, -10.25); // half way up the step, as the table has it
    CHECK_NEAR(rgba[3], (0.475 + 1) / 2, 1e-12);
    table.nearest = true;
    reference_table_look_up(rgba, &table, -10.26);
    CHECK_NEAR(rgba[3], 0.475, 1e-12);
    reference_table_finish(&table);

    // Turned around, it is the same table: over the same range, the lower end first.
    volume->slope = -0.5;
    volume->intercept = -10.5;
    reference_table_init(&table, transfer, volume);
    CHECK_NEAR(table.low, -74, 0);
    reference_table_look_up(rgba, &table, -10.25);
    CHECK_NEAR(rgba[3], (0.475 + 1) / 2, 1e-12);
    reference_table_finish(&table);

    pel_volume_destroy(volume);
    struct pel_scene *owner = one_ray(1);
    scene_add(owner, scene_volume_constant((int[]){1, 1, 1}, PEL_VOXEL_U8, 0), transfer);
    pel_scene_destroy(owner);
}

static void test_table_of_wide_values(void **state) {
    (void)state;
    struct pel_scene *scene = one_ray(1);
    struct pel_transfer *transfer = scene_transfer(
        (const double[][5]){{-1000, 0, 0, 0, 0}, {500, 0.6, 0, 0, 0.3}, {1000, 1, 0, 0, 0.2}}, 3);
    scene_add(scene, scene_volume_constant((int[]){1, 1, 1}, PEL_VOXEL_I16, 0), transfer);
    struct reference_table table;
    reference_table_init(&table, transfer, scene->volumes[0]);
    assert_int_equal(table.count, 4096);
    CHECK_NEAR(table.low, -1000, 0);
    CHECK_NEAR(table.high, 1000, 0);
    double rgba[4];
    reference_table_look_up(rgba, &table, 5000);
    CHECK_NEAR(rgba[3], 0.2, 0);
    reference_table_look_up(rgba, &table, -250);
    CHECK_NEAR(rgba[3], 0.15, 1e-12);
    reference_table_finish(&table);

    // Five entries lie at -1000, -500, 0, 500 and 1000; 250 is in the middle of two.
    transfer->table_entries = 5;
    reference_table_init(&table, transfer, scene->volumes[0]);
    reference_table_look_up(rgba, &table, 250);
    CHECK_NEAR(rgba[0], (0.4 + 0.6) / 2, 1e-12);
    table.nearest = true; // a tie goes up
    reference_table_look_up(rgba, &table, 250);
    CHECK_NEAR(rgba[0], 0.6, 1e-12);
    reference_table_finish(&table);
    pel_scene_destroy(scene);
}

// ---- Light -------------------------------------------------------------------------------------

// How long a ray is inside a turned box around the origin: the box's own frame has the rows of
// `turn`'s transpose.
static double chord_of_box(const struct reference_ray *ray, const struct pel_matrix *turn,
                           const double half[3]) {
    double near = -INFINITY, far = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double normal[3] = {turn->m[0][axis], turn->m[1][axis], turn->m[2][axis]};
        double height = pel_dot(normal, ray->origin), speed = pel_dot(normal, ray->direction);
        double t0 = (-half[axis] - height) / speed, t1 = (half[axis] - height) / speed;
        near = fmax(near, fmin(t0, t1));
        far = fmin(far, fmax(t0, t1));
    }
    return fmax(0, far - near);
}

static void test_homogeneous_box(void **state) {
    (void)state;
    const int width = 24, height = 18;
    struct pel_scene *scene = scene_create(width, height);
    struct pel_volume *volume = scene_volume_constant((int[]){20, 10, 6}, PEL_VOXEL_U16, 3);
    const double turn_xyzw[4] = {0.3, -0.5, 0.1, 0.8};
    scene_place(volume, (double[]){1, 1.5, 2}, turn_xyzw, (double[]){0, 0, 0}, true);
    scene_add(scene, volume, scene_transfer_constant((double[]){0.25, 0.5, 1, 0.05}));
    struct pel_matrix turn = pel_matrix_from_quaternion(turn_xyzw, (double[]){0, 0, 0});

    int met = 0;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            struct reference_ray ray = reference_camera_ray(&scene->camera, width, height, x, y);
            double chord = chord_of_box(&ray, &turn, (double[]){10, 7.5, 6}), rgba[4];
            reference_ray(scene, x, y, rgba, NULL);
            // Samples in the middle of steps stand for a length right to half a step.
            double length = log(1 - rgba[3]) / log(1 - 0.05);
            CHECK_NEAR(length, chord, 0.25 + 1e-9);
            CHECK_NEAR(rgba[0], 0.25 * rgba[3], 1e-12);
            CHECK_NEAR(rgba[2], rgba[3], 1e-12);
            met += chord > 1;
        }
    }
    assert_in_range(met, 60, width * height - 60);
    pel_scene_destroy(scene);
}

static double distance_field(const double p[3], const void *user) {
    double middle = *(const double *)user;
    return 15 - pel_length((double[]){p[0] - middle, p[1] - middle, p[2] - middle});
}

static void test_homogeneous_sphere(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(16, 12);
    double middle = 20;
    struct pel_volume *volume =
        scene_volume((int[]){41, 41, 41}, PEL_VOXEL_F32, distance_field, &middle);
    struct pel_transfer *transfer = scene_transfer(
        (const double[][5]){
            {-15, 1, 1, 1, 0}, {0, 1, 1, 1, 0}, {0, 1, 1, 1, 0.04}, {15, 1, 1, 1, 0.04}},
        4);
    scene_add(scene, volume, transfer);
    scene->render.step = 0.05;
    int met = 0;
    for (int y = 0; y < 12; y++) {
        for (int x = 0; x < 16; x++) {
            struct reference_ray ray = reference_camera_ray(&scene->camera, 16, 12, x, y);
            double along = pel_dot(ray.origin, ray.direction);
            double apart = sqrt(pel_dot(ray.origin, ray.origin) - along * along), rgba[4];
            if (apart > 14)
                continue;
            // Between voxels the field lies below the distance by up to 3/8 h^2 / radius.
            double chord = 2 * sqrt(15 * 15 - apart * apart);
            reference_ray(scene, x, y, rgba, NULL);
            CHECK_NEAR(log(1 - rgba[3]) / log(1 - 0.04), chord,
                       0.05 + 2 * (0.375 / 15 + 0.008) * 15 / (chord / 2));
            met++;
        }
    }
    assert_true(met > 40);
    pel_scene_destroy(scene);
}

// Opacity k z / L over the length L: the integral of -ln(1 - k z / L) is L / k ((1-k) ln(1-k) + k).
static void test_ramp_of_opacity(void **state) {
    (void)state;
    const double k = 0.5, length = 16;
    double depth = length / k * ((1 - k) * log(1 - k) + k), errors[3];
    for (int n = 0; n < 3; n++) {
        struct pel_scene *scene = one_ray(2 / exp2(n));
        struct pel_transfer *transfer =
            scene_transfer((const double[][5]){{0, 1, 1, 1, 0}, {1, 1, 1, 1, k}}, 2);
        scene_add(scene, scene_volume_ramp((int[]){2, 2, 17}, PEL_VOXEL_F32, (double[]){1, 0}),
                  transfer)
            ->extent = PEL_EXTENT_POINT;
        double rgba[4];
        cast(scene, rgba);
        errors[n] = -log(1 - rgba[3]) - depth;
        pel_scene_destroy(scene);
    }
    // The midpoint rule: of second order, and below the truth as the extinction is convex, by
    // step^2 / 24 times the difference of the slopes at the ends.
    double slopes = k / length * (1 / (1 - k) - 1);
    CHECK_NEAR(errors[2], -0.25 / 24 * slopes, 0.02 * 0.25 / 24 * slopes);
    CHECK_NEAR(errors[0] / errors[1], 4, 0.1);
    CHECK_NEAR(errors[1] / errors[2], 4, 0.03);
}

// Colour 1 - s / L in a constant extinction e: 1/L ((1 - exp(-e L)) / e - L exp(-e L)) is what
// s / L gives.
static void test_ramp_of_colour(void **state) {
    (void)state;
    const double length = 16, extinction = -log(1 - 0.2);
    double past = exp(-extinction * length);
    double truth = 1 - past - ((1 - past) / extinction - length * past) / length, errors[3];
    for (int n = 0; n < 3; n++) {
        struct pel_scene *scene = one_ray(1 / exp2(n));
        struct pel_transfer *transfer =
            scene_transfer((const double[][5]){{0, 0, 0, 0, 0.2}, {1, 1, 1, 1, 0.2}}, 2);
        scene_add(scene, scene_volume_ramp((int[]){2, 2, 17}, PEL_VOXEL_F32, (double[]){0, 1}),
                  transfer)
            ->extent = PEL_EXTENT_POINT;
        double rgba[4];
        cast(scene, rgba);
        CHECK_NEAR(rgba[3], 1 - past, 1e-12);
        errors[n] = rgba[0] - truth;
        pel_scene_destroy(scene);
    }
    assert_true(fabs(errors[2]) > 1e-8);
    CHECK_NEAR(errors[0] / errors[1], 4, 0.1);
    CHECK_NEAR(errors[1] / errors[2], 4, 0.05);
}

// Two boxes of 8 mm, 4 mm of which they share; every stretch is a whole number of steps.
static void two_boxes(enum pel_mixing mixing, double rgba[4]) {
    struct pel_scene *scene = one_ray(1);
    scene->render.mixing = mixing;
    for (int k = 0; k < 2; k++) {
        struct pel_volume *volume = scene_volume_constant((int[]){8, 8, 8}, PEL_VOXEL_U8, 9);
        scene_place(volume, (double[]){1, 1, 1}, (double[]){0, 0, 0, 1},
                    (double[]){0, 0, k == 0 ? 2 : -2}, false);
        scene_add(scene, volume, scene_transfer_constant((double[]){k == 0, k == 1, 0, 0.1}))
            ->density = k == 0 ? 1 : 2;
    }
    cast(scene, rgba);
    pel_scene_destroy(scene);
}

static void test_two_boxes(void **state) {
    (void)state;
    // Transmittances multiply: 0.9 per millimetre of the first, 0.81 of the second.
    double first = pow(0.9, 4), second = pow(0.81, 4), rgba[4];
    two_boxes(PEL_MIX_SUM, rgba);
    CHECK_NEAR(rgba[3], 1 - first * first * second * second, 1e-12);
    // In the shared stretch the colour is a third of the first's and two thirds of the second's.
    double shared = first * (1 - first * second);
    CHECK_NEAR(rgba[0], 1 - first + shared / 3, 1e-12);
    CHECK_NEAR(rgba[1], shared * 2 / 3 + first * first * second * (1 - second), 1e-12);

    // Over: at each shared sample the first one lies in front: 0.1 of red, then 0.9 * 0.19 of
    // green.
    two_boxes(PEL_MIX_OVER, rgba);
    CHECK_NEAR(rgba[3], 1 - first * first * second * second, 1e-12);
    double red_share = 0.1 / (1 - 0.9 * 0.81);
    CHECK_NEAR(rgba[0], 1 - first + shared * red_share, 1e-12);
}

static void test_background_and_units(void **state) {
    (void)state;
    struct pel_scene *scene = one_ray(1);
    // 0.19 per two millimetres is 0.1 per millimetre: 1 - 0.9^6 over the six of the box.
    struct pel_transfer *transfer = scene_transfer_constant((double[]){0.5, 0.5, 0, 0.19});
    transfer->opacity_unit_mm = 2;
    scene_add(scene, scene_volume_constant((int[]){6, 6, 6}, PEL_VOXEL_U8, 9), transfer);
    memcpy(scene->background, (double[]){1, 0.5, 0.25, 0.5}, sizeof scene->background);
    double rgba[4], through = pow(0.9, 6);
    cast(scene, rgba);
    CHECK_NEAR(rgba[0], 0.5 * (1 - through) + through * 0.5, 1e-12);
    CHECK_NEAR(rgba[2], through * 0.5 * 0.25, 1e-12);
    CHECK_NEAR(rgba[3], 1 - through + through * 0.5, 1e-12);

    // Nothing visible: the background alone, premultiplied.
    scene->instances[0].hidden = true;
    cast(scene, rgba);
    CHECK_NEAR(rgba[1], 0.25, 0);
    CHECK_NEAR(rgba[3], 0.5, 0);

    // An opacity of one is as opaque as a float can say: 24 halvings a unit.
    scene->instances[0].hidden = false;
    transfer->opacities[0].opacity = 1;
    transfer->opacity_unit_mm = 24 * 6;
    scene->background[3] = 0;
    cast(scene, rgba);
    CHECK_NEAR(rgba[3], 0.5, 1e-12);
    pel_scene_destroy(scene);
}

static void test_termination(void **state) {
    (void)state;
    struct pel_scene *scene = one_ray(1);
    scene_add(scene, scene_volume_constant((int[]){8, 8, 20}, PEL_VOXEL_U8, 9),
              scene_transfer_constant((double[]){1, 1, 1, 0.5}));
    // 1/2, 3/4, 7/8: the third sample is the first to exceed 3/4.
    scene->render.termination = 0.75 + 1e-9;
    double rgba[4];
    uint64_t samples = 0;
    reference_ray(scene, 0, 0, rgba, &samples);
    CHECK_NEAR(rgba[3], 0.875, 1e-12);
    assert_int_equal(samples, 3);
    scene->render.termination = 1;
    samples = 0;
    reference_ray(scene, 0, 0, rgba, &samples);
    assert_int_equal(samples, 20);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays),
        cmocka_unit_test(test_spans),
        cmocka_unit_test(test_interpolation),
        cmocka_unit_test(test_absent_corner),
        cmocka_unit_test(test_colours),
        cmocka_unit_test(test_table_of_bytes),
        cmocka_unit_test(test_table_of_wide_values),
        cmocka_unit_test(test_homogeneous_box),
        cmocka_unit_test(test_homogeneous_sphere),
        cmocka_unit_test(test_ramp_of_opacity),
        cmocka_unit_test(test_ramp_of_colour),
        cmocka_unit_test(test_two_boxes),
        cmocka_unit_test(test_background_and_units),
        cmocka_unit_test(test_termination),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
