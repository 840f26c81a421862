// Tests of host/camera/stereo.c: where two eyes see points, projected by hand.
#include "support/test.h"

#include <math.h>

#include "base/math.h"
#include "support/near.h"
#include "support/scenes.h"

// 40 x 30 pixels, seen from (0, 0, 100) towards the origin with y up: the view's forward is -z and
// its right is x. A cube of 40 mm at the origin has depths from 80 to 120.
static struct pel_scene *create(void) {
    struct pel_scene *scene = scene_create(40, 30);
    scene_add(scene, scene_volume_constant((int[]){40, 40, 40}, PEL_VOXEL_U8, 1),
              scene_transfer_constant((double[]){1, 1, 1, 0.1}));
    scene->camera.fov_deg = 2 * atan(0.25) * 180 / PEL_PI; // tan(fov / 2) = 1/4
    scene->stereo.kind = PEL_STEREO_SIDE_BY_SIDE;
    return scene;
}

static void make_cameras(const struct pel_scene *scene, struct pel_camera cameras[2],
                         struct pel_stereo *used) {
    if (!pel_stereo_cameras(scene, cameras, used))
        fail_msg("%s", pel_error_message());
}

// Where in the picture a point is, in widths from its left edge and heights from its top.
static void project(double place[2], const struct pel_camera *camera, double aspect,
                    const double point[3]) {
    double forward[3], right[3], up[3], to_point[3];
    for (int i = 0; i < 3; i++) {
        forward[i] = camera->target[i] - camera->eye[i];
        to_point[i] = point[i] - camera->eye[i];
    }
    pel_normalize(forward);
    pel_cross(right, forward, camera->up);
    pel_normalize(right);
    pel_cross(up, right, forward);
    double half = camera->orthographic
                      ? camera->height_mm / 2
                      : tan(camera->fov_deg * PEL_PI / 360) * pel_dot(to_point, forward);
    double u = pel_dot(to_point, right) / half - 2 * camera->shift[0];
    double v = pel_dot(to_point, up) / half - 2 * camera->shift[1];
    place[0] = (u / aspect + 1) / 2;
    place[1] = (1 - v) / 2;
}

// How much further right the left eye sees a point than the right eye, in widths; the difference of
// the heights in *vertical.
static double disparity(const struct pel_camera cameras[2], const double point[3],
                        double *vertical) {
    double left[2], right[2], unwanted;
    project(left, &cameras[0], 40 / 30.0, point);
    project(right, &cameras[1], 40 / 30.0, point);
    *(vertical ? vertical : &unwanted) = left[1] - right[1];
    return left[0] - right[0];
}

static void test_parallel(void **state) {
    (void)state;
    struct pel_scene *scene = create();
    scene->stereo.separation_mm = 4;
    scene->stereo.convergence_mm = 100;
    struct pel_camera cameras[2];
    struct pel_stereo used;
    make_cameras(scene, cameras, &used);
    assert_near(used.separation_mm, 4, 0);
    assert_near(used.convergence_mm, 100, 0);
    // The left eye stands at x = -2, and looks the same way.
    assert_near(cameras[0].eye[0], -2, 1e-12);
    assert_near(cameras[0].target[0], -2, 1e-12);
    assert_near(cameras[1].eye[0], 2, 1e-12);
    // 2 mm of a picture that is 50 mm high at 100 mm.
    assert_near(cameras[0].shift[0], 0.04, 1e-12);
    assert_near(cameras[1].shift[0], -0.04, 1e-12);

    // All of the plane at 100 mm agrees, at its edges too.
    double vertical;
    assert_near(disparity(cameras, (double[]){0, 0, 0}, NULL), 0, 1e-12);
    assert_near(disparity(cameras, (double[]){30, -20, 0}, &vertical), 0, 1e-12);
    assert_near(vertical, 0, 1e-12);
    // At 80 mm the picture is 40 high and 53.3 wide. A point on the axis is 2 mm right of the left
    // eye, whose window is shifted by 0.04 of 40 mm: 0.4 mm, and 0.8 mm between the eyes.
    assert_near(disparity(cameras, (double[]){0, 0, 20}, &vertical), 0.8 * 0.75 / 40, 1e-12);
    assert_near(vertical, 0, 1e-12);
    assert_true(disparity(cameras, (double[]){10, 5, 20}, NULL) > 0);
    assert_true(disparity(cameras, (double[]){10, 5, -20}, NULL) < 0);
    pel_scene_destroy(scene);
}

// The camera's own shift stays between those of both eyes.
static void test_shifted(void **state) {
    (void)state;
    struct pel_scene *scene = create();
    scene->camera.shift[0] = 0.1;
    scene->camera.shift[1] = -0.2;
    scene->stereo.separation_mm = 4;
    scene->stereo.convergence_mm = 50;
    struct pel_camera cameras[2];
    make_cameras(scene, cameras, NULL);
    assert_near(cameras[0].shift[0], 0.18, 1e-12);
    assert_near(cameras[1].shift[0], 0.02, 1e-12);
    assert_near(cameras[1].shift[1], -0.2, 0);
    assert_near(disparity(cameras, (double[]){7, 3, 50}, NULL), 0, 1e-12);
    pel_scene_destroy(scene);
}

static void test_toe_in(void **state) {
    (void)state;
    struct pel_scene *scene = create();
    scene->stereo.separation_mm = 4;
    scene->stereo.convergence_mm = 80;
    scene->stereo.toe_in = true;
    struct pel_camera cameras[2];
    make_cameras(scene, cameras, NULL);
    assert_near(cameras[0].shift[0], 0, 0);
    // Both look at (0, 0, 20).
    for (int i = 0; i < 2; i++) {
        assert_near(cameras[i].target[0], 0, 1e-12);
        assert_near(cameras[i].target[2], 20, 1e-12);
    }
    double vertical;
    assert_near(disparity(cameras, (double[]){0, 0, 20}, NULL), 0, 1e-12);
    assert_true(disparity(cameras, (double[]){0, 0, 40}, NULL) > 0);
    assert_true(disparity(cameras, (double[]){0, 0, 0}, NULL) < 0);
    // The price: keystones, so corners do not lie at one height.
    disparity(cameras, (double[]){20, 15, 20}, &vertical);
    assert_true(fabs(vertical) > 1e-4);
    pel_scene_destroy(scene);
}

static void test_orthographic(void **state) {
    (void)state;
    struct pel_scene *scene = create();
    scene_view_parallel(scene, 40);
    struct pel_camera cameras[2];
    struct pel_stereo used;
    make_cameras(scene, cameras, &used);
    assert_near(used.convergence_mm, 100, 1e-9);
    assert_near(disparity(cameras, (double[]){0, 0, 0}, NULL), 0, 1e-12);
    // Turning is no shearing: the bound holds up to the angle's square.
    assert_near(disparity(cameras, (double[]){0, 0, 20}, NULL), 1.0 / 60, 2e-4);
    assert_near(disparity(cameras, (double[]){0, 0, -20}, NULL), -1.0 / 60, 2e-4);
    pel_scene_destroy(scene);
}

// Flat, swapped, and none at all.
static void test_eyes(void **state) {
    (void)state;
    struct pel_scene *scene = create();
    struct pel_camera cameras[2], swapped[2];
    scene->camera.shift[0] = 0.3;
    scene->stereo.flat = true;
    make_cameras(scene, cameras, NULL);
    assert_memory_equal(&cameras[0], &scene->camera, sizeof *cameras);
    assert_memory_equal(&cameras[1], &scene->camera, sizeof *cameras);
    scene->stereo.toe_in = true;
    make_cameras(scene, cameras, NULL);
    assert_memory_equal(&cameras[0], &cameras[1], sizeof *cameras);

    scene->stereo = (struct pel_stereo){.kind = PEL_STEREO_CHECKERBOARD};
    make_cameras(scene, cameras, NULL);
    assert_true(cameras[0].eye[0] < 0 && cameras[1].eye[0] > 0);
    scene->stereo.swap = true;
    make_cameras(scene, swapped, NULL);
    assert_memory_equal(&swapped[0], &cameras[1], sizeof *cameras);
    assert_memory_equal(&swapped[1], &cameras[0], sizeof *cameras);

    scene->stereo = (struct pel_stereo){0};
    make_cameras(scene, cameras, NULL);
    assert_memory_equal(&cameras[0], &scene->camera, sizeof *cameras);
    assert_memory_equal(&cameras[1], &scene->camera, sizeof *cameras);
    pel_scene_destroy(scene);
}

static void test_automatic(void **state) {
    (void)state;
    struct pel_scene *scene = create();
    struct pel_camera cameras[2];
    struct pel_stereo used;
    make_cameras(scene, cameras, &used);
    // 2 / (1/80 + 1/120), and a separation that makes both disparities 1/60 of the width:
    // separation / (2/4 * 4/3) * (1/80 - 1/96) = 1/60.
    assert_near(used.convergence_mm, 96, 1e-9);
    assert_near(used.separation_mm, 2 / 3.0 / 60 * 480, 1e-9);
    assert_near(disparity(cameras, (double[]){0, 0, 20}, NULL), 1 / 60.0, 1e-9);
    assert_near(disparity(cameras, (double[]){0, 0, -20}, NULL), -1 / 60.0, 1e-9);

    // A given convergence: the farther side decides, as 1/50 - 1/120 is the greater.
    scene->stereo.convergence_mm = 50;
    make_cameras(scene, cameras, &used);
    assert_near(disparity(cameras, (double[]){0, 0, -20}, NULL), -1 / 60.0, 1e-9);
    // A given separation is left alone.
    scene->stereo = (struct pel_stereo){.kind = PEL_STEREO_RED_BLUE, .separation_mm = 65};
    make_cameras(scene, cameras, &used);
    assert_near(used.separation_mm, 65, 0);
    assert_near(used.convergence_mm, 96, 1e-9);
    pel_scene_destroy(scene);
}

// Scenes without a depth to speak of, or with an eye in the middle of them.
static void test_odd_places(void **state) {
    (void)state;
    struct pel_scene *scene = create();
    struct pel_camera cameras[2];
    struct pel_stereo used;
    // Inside: depths reach from -20 to 20, and count from a twentieth of 20.
    memcpy(scene->camera.eye, (double[]){0, 0, 0}, sizeof scene->camera.eye);
    memcpy(scene->camera.target, (double[]){0, 0, -1}, sizeof scene->camera.target);
    make_cameras(scene, cameras, &used);
    assert_near(used.convergence_mm, 2 / (1 / 1.0 + 1 / 20.0), 1e-9);
    assert_true(used.separation_mm > 0);
    // Nothing before the camera, nothing visible: the target counts, and the separation is bounded.
    memcpy(scene->camera.eye, (double[]){0, 0, -50}, sizeof scene->camera.eye);
    memcpy(scene->camera.target, (double[]){0, 0, -80}, sizeof scene->camera.target);
    make_cameras(scene, cameras, &used);
    assert_near(used.convergence_mm, 30, 1e-9);
    assert_near(used.separation_mm, 3, 1e-9);
    scene->instances[0].hidden = true;
    make_cameras(scene, cameras, &used);
    assert_near(used.separation_mm, 3, 1e-9);
    pel_scene_destroy(scene);
}

static void refuse(struct pel_scene *scene, const char *sentence) {
    struct pel_camera cameras[2];
    assert_false(pel_stereo_cameras(scene, cameras, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_non_null(strstr(pel_error_message(), sentence));
}

static void test_refused(void **state) {
    (void)state;
    struct pel_scene *scene = create();
    scene->stereo.separation_mm = -1;
    refuse(scene, "separation of -1 mm");
    scene->stereo.separation_mm = INFINITY;
    refuse(scene, "separation of inf mm");
    scene->stereo.separation_mm = 0;
    scene->stereo.convergence_mm = NAN;
    refuse(scene, "convergence of");
    scene->stereo.convergence_mm = 0;
    scene->camera.fov_deg = 0;
    refuse(scene, "field of view of 0");
    scene->camera.orthographic = true;
    scene->camera.height_mm = 0;
    refuse(scene, "0 mm high");
    memcpy(scene->camera.target, scene->camera.eye, sizeof scene->camera.eye);
    refuse(scene, "one point");
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parallel),   cmocka_unit_test(test_shifted),
        cmocka_unit_test(test_toe_in),     cmocka_unit_test(test_orthographic),
        cmocka_unit_test(test_eyes),       cmocka_unit_test(test_automatic),
        cmocka_unit_test(test_odd_places), cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
