// Cameras: their axes, and that a fitted box touches the margin and nothing crosses it.
#include "support/near.h"
#include "support/test.h"

#include "base/math.h"
#include "camera/camera.h"

static const struct pel_bounds box = {{-90, -126, -72}, {91, 91, 110}};

static void check_vector(const double v[3], double x, double y, double z) {
    assert_near(v[0], x, 1e-12);
    assert_near(v[1], y, 1e-12);
    assert_near(v[2], z, 1e-12);
}

static void test_basis(void **state) {
    (void)state;
    struct pel_camera camera = {.eye = {0, 500, 0}, .target = {0, 100, 0}, .up = {0, 3, 7}};
    double forward[3], right[3], up[3];
    assert_true(pel_camera_basis(&camera, forward, right, up));
    check_vector(forward, 0, -1, 0);
    // Face to face, the patient's right is on the picture's left.
    check_vector(right, -1, 0, 0);
    check_vector(up, 0, 0, 1);
}

static void refuse_basis(struct pel_camera camera, const char *sentence) {
    double forward[3], right[3], up[3];
    assert_false(pel_camera_basis(&camera, forward, right, up));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_string_equal(pel_error_message(), sentence);
}

static void test_basis_refuses(void **state) {
    (void)state;
    refuse_basis((struct pel_camera){.eye = {1, 2, 3}, .target = {1, 2, 3}, .up = {0, 0, 1}},
                 "the camera's eye and target are one point, or not finite");
    refuse_basis((struct pel_camera){.eye = {1, 2, 3}}, "the camera's up vector is zero");
    refuse_basis((struct pel_camera){.eye = {0, 0, 9}, .up = {0, 0, -2}},
                 "the camera looks along its up vector (0, 0, -2), which leaves its roll open");
    refuse_basis((struct pel_camera){.eye = {NAN, 0, 9}, .up = {0, 1, 0}},
                 "the camera's eye and target are one point, or not finite");
}

// The greatest |u| / aspect and |v| of the box's corners in the picture, both 1 at its border, by
// the formulae of docs/picture.md turned round.
static void extent_of(const struct pel_camera *camera, const struct pel_bounds *bounds,
                      double aspect, double *u_most, double *v_most) {
    double forward[3], right[3], up[3];
    assert_true(pel_camera_basis(camera, forward, right, up));
    *u_most = *v_most = 0;
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = (corner >> i & 1 ? bounds->high[i] : bounds->low[i]) - camera->eye[i];
        double depth = pel_dot(p, forward);
        assert_true(depth > 0);
        double scale = camera->orthographic ? camera->height_mm / 2
                                            : depth * tan(camera->fov_deg / 2 * PEL_PI / 180);
        *u_most = fmax(*u_most, fabs(pel_dot(p, right)) / scale / aspect);
        *v_most = fmax(*v_most, fabs(pel_dot(p, up)) / scale);
    }
}

static void test_fits_every_view(void **state) {
    (void)state;
    const char *const views[] = {"anterior", "posterior", "left",   "right",
                                 "superior", "inferior",  "oblique"};
    const double aspects[] = {0.3, 1, 16 / 9.0}, fovs[] = {1, 30, 60, 150};
    for (int view = 0; view < 7; view++)
        for (int a = 0; a < 3; a++)
            for (int f = 0; f < 8; f++) {
                struct pel_camera camera = {.fov_deg = fovs[f % 4], .orthographic = f >= 4};
                assert_true(pel_camera_fit(&camera, views[view], &box, aspects[a]));
                double u, v;
                extent_of(&camera, &box, aspects[a], &u, &v);
                assert_near(fmax(u, v), 0.95, 1e-9);
                check_vector(camera.target, 0.5, -17.5, 19);
            }
}

// Whether the eye is on that side, and which world axes the picture's right and up are.
static void check_view(const char *view, int axis, int side, const double right[3],
                       const double up[3]) {
    struct pel_camera camera = {0};
    assert_true(pel_camera_fit(&camera, view, &box, 1));
    assert_near(camera.fov_deg, 30, 0);
    double f[3], r[3], u[3];
    assert_true(pel_camera_basis(&camera, f, r, u));
    assert_true(side * camera.eye[axis] > 110);
    check_vector(r, right[0], right[1], right[2]);
    check_vector(u, up[0], up[1], up[2]);
}

static void test_sides_are_the_radiologists(void **state) {
    (void)state;
    const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    const double left[3] = {-1, 0, 0}, posterior[3] = {0, -1, 0};
    check_view("anterior", 1, 1, left, z);
    check_view("posterior", 1, -1, x, z);
    check_view("left", 0, -1, posterior, z);
    check_view("right", 0, 1, y, z);
    check_view("superior", 2, 1, x, y);
    check_view("inferior", 2, -1, left, y);
    struct pel_camera camera = {0};
    assert_true(pel_camera_fit(&camera, "oblique", &box, 1));
    for (int i = 0; i < 3; i++)
        assert_true(camera.eye[i] > box.high[i]);
}

// From the anterior, the near face decides: its half height 91 at 0.95 of tan 15 degrees, and the
// centre 108.5 behind it.
static void test_distance_by_hand(void **state) {
    (void)state;
    struct pel_camera camera = {0};
    assert_true(pel_camera_fit(&camera, "anterior", &box, 2));
    assert_near(camera.eye[1] - camera.target[1], 91 / (0.95 * 0.26794919243112270) + 108.5, 1e-9);
    camera = (struct pel_camera){.orthographic = true};
    assert_true(pel_camera_fit(&camera, "anterior", &box, 0.5));
    assert_near(camera.height_mm, 181 / 0.5 / 0.95, 1e-9);
}

static void test_fits_flat_boxes(void **state) {
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        for (int flat = 0; flat < 8; flat++) {
            struct pel_bounds bounds = {{5, 5, 5}, {5, 5, 5}};
            for (int i = 0; i < 3; i++)
                bounds.high[i] += flat >> i & 1 ? 10 : 0;
            struct pel_camera camera = {.orthographic = orthographic};
            assert_true(pel_camera_fit(&camera, "anterior", &bounds, 1));
            double u, v;
            extent_of(&camera, &bounds, 1, &u, &v);
            assert_true(fmax(u, v) <= 0.95 + 1e-9);
        }
    }
}

static void test_fit_refuses(void **state) {
    (void)state;
    struct pel_camera camera = {0};
    assert_false(pel_camera_fit(&camera, "anterio", &box, 1));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_string_equal(pel_error_message(), "no view 'anterio'; did you mean 'anterior'");
    assert_false(pel_camera_fit(&camera, "moon", &box, 1));
    assert_false(pel_camera_fit(&camera, "left", &box, 0));
    assert_string_equal(pel_error_message(), "aspect ratio 0 is not positive");
    camera.fov_deg = 180;
    assert_false(pel_camera_fit(&camera, "left", &box, 1));
    camera.fov_deg = 0;
    assert_false(pel_camera_fit(&camera, "left", &(struct pel_bounds){{0, 0, 1}, {1, 1, 0}}, 1));
    assert_false(
        pel_camera_fit(&camera, "left", &(struct pel_bounds){{0, 0, 0}, {1, 1, INFINITY}}, 1));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_basis),
        cmocka_unit_test(test_basis_refuses),
        cmocka_unit_test(test_fits_every_view),
        cmocka_unit_test(test_sides_are_the_radiologists),
        cmocka_unit_test(test_distance_by_hand),
        cmocka_unit_test(test_fits_flat_boxes),
        cmocka_unit_test(test_fit_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
