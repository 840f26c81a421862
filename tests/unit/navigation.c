// Tests of the viewer's cameras: where a hand's turns, drags and keys lead, by hand computation.
#include "support/test.h"

#include <math.h>

#include "viewer/navigation.h"
#include "viewer/vector.h"

static const int size[2] = {640, 400};

static struct pel_camera front(void) {
    return (struct pel_camera){
        .eye = {10, 520, 30}, .target = {10, 20, 30}, .up = {0, 0, 1}, .fov_deg = 40};
}

static struct pel_navigation start(enum pel_navigation_mode mode) {
    struct pel_navigation navigation;
    struct pel_camera camera = front();
    pel_navigation_start(&navigation, &camera);
    navigation.mode = mode;
    return navigation;
}

static void assert_vector(const double actual[3], const double expected[3], double within) {
    for (int i = 0; i < 3; i++)
        if (!(fabs(actual[i] - expected[i]) <= within))
            fail_msg("(%.12g, %.12g, %.12g) is not (%g, %g, %g)", actual[0], actual[1], actual[2],
                     expected[0], expected[1], expected[2]);
}

static void assert_camera(const struct pel_camera *actual, const struct pel_camera *expected,
                          double within) {
    assert_vector(actual->eye, expected->eye, within);
    assert_vector(actual->target, expected->target, within);
    assert_vector(actual->up, expected->up, within);
    assert_float_equal(actual->fov_deg, expected->fov_deg, within);
    assert_float_equal(actual->height_mm, expected->height_mm, within);
}

// The angle between two cameras' axes is bounded by those of eye direction and up.
static double angle_between(const struct pel_camera *a, const struct pel_camera *b) {
    double of_a[3], of_b[3];
    vector_subtract(of_a, a->target, a->eye);
    vector_subtract(of_b, b->target, b->eye);
    vector_normalize(of_a);
    vector_normalize(of_b);
    return fmax(vector_distance(of_a, of_b), vector_distance(a->up, b->up));
}

// 360 turns of a degree, each way, in each mode: no step jumps, and the last comes home.
static void test_full_turns(void **state) {
    (void)state;
    static const double ways[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (int mode = 0; mode < 3; mode++) {
        for (int way = 0; way < 4; way++) {
            struct pel_navigation navigation = start((enum pel_navigation_mode)mode);
            const struct pel_camera before = navigation.camera;
            for (int i = 0; i < 360; i++) {
                struct pel_camera last = navigation.camera;
                pel_navigation_turn(&navigation, ways[way][0], ways[way][1]);
                // A chord of one degree is 0.01745.
                assert_true(angle_between(&last, &navigation.camera) < 0.01746);
                assert_float_equal(vector_distance(navigation.camera.eye, navigation.camera.target),
                                   500, 1e-9);
                if (i == 179)
                    assert_true(angle_between(&before, &navigation.camera) > 1.99);
            }
            assert_camera(&navigation.camera, &before, 1e-9);
        }
    }
}

// The same by the mouse: a drag over twice the picture's height, in steps over the poles.
static void test_full_drags(void **state) {
    (void)state;
    for (int mode = 0; mode < 2; mode++) {
        for (int axis = 0; axis < 2; axis++) {
            struct pel_navigation navigation = start((enum pel_navigation_mode)mode);
            const struct pel_camera before = navigation.camera;
            pel_navigation_begin(&navigation);
            for (int i = 0; i < 2 * size[1]; i++) {
                struct pel_camera last = navigation.camera;
                double from[2] = {100, 100}, to[2] = {100, 100};
                to[axis] += 1;
                pel_navigation_rotate(&navigation, size, from, to);
                assert_true(angle_between(&last, &navigation.camera) < 1.001 * VECTOR_PI / size[1]);
            }
            assert_camera(&navigation.camera, &before, 1e-9);
        }
    }
}

// Dragging to the right brings the scene's left side to the front; dragging down its upper side.
static void test_drag_directions(void **state) {
    (void)state;
    const double middle[2] = {320, 200}, right[2] = {330, 200}, below[2] = {320, 210};
    for (int mode = 0; mode < 2; mode++) {
        // The camera stands anterior of its target, so the picture's left is the patient's right.
        struct pel_navigation navigation = start((enum pel_navigation_mode)mode);
        pel_navigation_rotate(&navigation, size, middle, right);
        assert_true(navigation.camera.eye[0] > 10 + 30 && navigation.camera.eye[2] == 30);
        navigation = start((enum pel_navigation_mode)mode);
        pel_navigation_rotate(&navigation, size, middle, below);
        assert_true(navigation.camera.eye[2] > 30 + 30 &&
                    fabs(navigation.camera.eye[0] - 10) < 1e-9);
        // Upside down the hand still leads what it holds.
        navigation = start((enum pel_navigation_mode)mode);
        pel_navigation_turn(&navigation, 0, 180);
        pel_navigation_begin(&navigation);
        struct pel_view before, after;
        double pixel[2], moved[2];
        assert_true(pel_view_make(&before, &navigation.camera, size[0], size[1]));
        double point[3];
        vector_add_scaled(point, navigation.camera.target, -50, before.forward);
        pel_navigation_rotate(&navigation, size, middle, right);
        assert_true(pel_view_make(&after, &navigation.camera, size[0], size[1]));
        assert_true(pel_view_project(&before, point, pixel));
        assert_true(pel_view_project(&after, point, moved));
        assert_true(moved[0] > pixel[0] + 1);
    }
}

// Orbiting never tilts the horizon.
static void test_orbit_stays_upright(void **state) {
    (void)state;
    struct pel_navigation navigation = start(PEL_NAVIGATION_ORBIT);
    uint64_t seed = 3;
    for (int i = 0; i < 500; i++) {
        const double from[2] = {0, 0};
        const double to[2] = {100 * test_random(&seed) - 50, 100 * test_random(&seed) - 50};
        pel_navigation_rotate(&navigation, size, from, to);
        double right[3], forward[3];
        vector_subtract(forward, navigation.camera.target, navigation.camera.eye);
        vector_cross(right, forward, navigation.camera.up);
        assert_float_equal(right[2], 0, 1e-7);
    }
}

// In flight, what is under the pointer stays under it; the eye stays where it is.
static void test_fly_follows_pointer(void **state) {
    (void)state;
    struct pel_navigation navigation = start(PEL_NAVIGATION_FLY);
    const double from[2] = {500, 90}, to[2] = {420, 260};
    struct pel_view view;
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    struct pel_view_ray ray = pel_view_ray(&view, from);
    double point[3], pixel[2], eye[3];
    vector_set(eye, navigation.camera.eye);
    vector_add_scaled(point, ray.origin, 700, ray.direction);
    pel_navigation_rotate(&navigation, size, from, to);
    assert_vector(navigation.camera.eye, eye, 1e-9);
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    assert_true(pel_view_project(&view, point, pixel));
    assert_float_equal(pixel[0], to[0], 1e-6);
    assert_float_equal(pixel[1], to[1], 1e-6);
}

// A pixel at the target is 2 * 500 tan(20 deg) / 400 mm. The camera looks to posterior, so the
// picture's right is the patient's left, -x.
static void test_pan(void **state) {
    (void)state;
    struct pel_navigation navigation = start(PEL_NAVIGATION_ORBIT);
    double mm = 2 * 500 * tan(radians(20)) / 400;
    const double from[2] = {17, 33}, to[2] = {27, 53};
    pel_navigation_pan(&navigation, size, from, to);
    assert_vector(navigation.camera.target, (double[]){10 + 10 * mm, 20, 30 + 20 * mm}, 1e-9);
    assert_vector(navigation.camera.eye, (double[]){10 + 10 * mm, 520, 30 + 20 * mm}, 1e-9);
    // What was under the pointer is under it still.
    struct pel_view view;
    double pixel[2];
    navigation = start(PEL_NAVIGATION_ORBIT);
    pel_navigation_toggle_orthographic(&navigation, NULL);
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    struct pel_view_ray ray = pel_view_ray(&view, from);
    pel_navigation_pan(&navigation, size, from, to);
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    vector_add(ray.origin, ray.origin, ray.direction);
    assert_true(pel_view_project(&view, ray.origin, pixel));
    assert_float_equal(pixel[0], to[0], 1e-9);
    assert_float_equal(pixel[1], to[1], 1e-9);
}

static void check_wheel(bool orthographic) {
    struct pel_navigation navigation = start(PEL_NAVIGATION_ORBIT);
    const double at[2] = {510, 77};
    double fixed[3], pixel[2];
    struct pel_view view;
    if (orthographic)
        pel_navigation_toggle_orthographic(&navigation, NULL);
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    double before = pel_view_target_mm_per_px(&view);
    struct pel_view_ray ray = pel_view_ray(&view, at);
    assert_true(pel_view_meet_plane(fixed, &ray, navigation.camera.target, view.forward));
    pel_navigation_wheel(&navigation, size, at, 3);
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    assert_float_equal(pel_view_target_mm_per_px(&view), before / pow(1.1, 3), 1e-12);
    assert_true(pel_view_project(&view, fixed, pixel));
    assert_float_equal(pixel[0], at[0], 1e-9);
    assert_float_equal(pixel[1], at[1], 1e-9);
    pel_navigation_wheel(&navigation, size, at, -3);
    struct pel_navigation home = start(PEL_NAVIGATION_ORBIT);
    if (orthographic)
        pel_navigation_toggle_orthographic(&home, NULL);
    assert_camera(&navigation.camera, &home.camera, 1e-9);
    // However long it turns, there is a camera.
    pel_navigation_wheel(&navigation, size, at, 1e5);
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    pel_navigation_wheel(&navigation, size, at, -1e5);
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    assert_true(pel_view_target_mm_per_px(&view) <= 1.0001e8 / size[1]);
}

static void test_wheel(void **state) {
    (void)state;
    check_wheel(false);
    check_wheel(true);
}

static void test_zoom_and_roll(void **state) {
    (void)state;
    struct pel_navigation navigation = start(PEL_NAVIGATION_ORBIT);
    const double low[2] = {0, 400}, high[2] = {0, 0};
    pel_navigation_zoom(&navigation, size, low, high);
    assert_vector(navigation.camera.eye, (double[]){10, 20 + 50, 30}, 1e-9);
    assert_vector(navigation.camera.target, (double[]){10, 20, 30}, 1e-9);
    // A quarter turn clockwise brings what was at the right to the bottom.
    const double right[2] = {420, 200}, bottom[2] = {320, 300};
    struct pel_view view;
    double pixel[2];
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    struct pel_view_ray ray = pel_view_ray(&view, right);
    vector_add(ray.origin, ray.origin, ray.direction);
    pel_navigation_roll(&navigation, size, right, bottom);
    assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
    assert_true(pel_view_project(&view, ray.origin, pixel));
    assert_float_equal(pixel[0], bottom[0], 1e-9);
    assert_float_equal(pixel[1], bottom[1], 1e-9);
}

// The thesis's keys move along the camera's axes.
static void test_move(void **state) {
    (void)state;
    struct pel_navigation navigation = start(PEL_NAVIGATION_FLY);
    pel_navigation_move(&navigation, (double[]){0, 0, 0.1});
    assert_vector(navigation.camera.eye, (double[]){10, 470, 30}, 1e-9);
    pel_navigation_move(&navigation, (double[]){0.02, 0, 0});
    assert_vector(navigation.camera.eye, (double[]){0, 470, 30}, 1e-9);
    pel_navigation_move(&navigation, (double[]){0, 0.01, 0});
    assert_vector(navigation.camera.eye, (double[]){0, 470, 35}, 1e-9);
    // Looking up and to the right.
    navigation = start(PEL_NAVIGATION_FLY);
    pel_navigation_turn(&navigation, 0, 30);
    assert_true(navigation.camera.target[2] > 30 + 200);
    navigation = start(PEL_NAVIGATION_FLY);
    pel_navigation_turn(&navigation, 30, 0);
    assert_true(navigation.camera.target[0] < 10 - 200);
}

static void test_views_and_fit(void **state) {
    (void)state;
    const struct pel_bounds bounds = {{-40, -30, -20}, {60, 50, 80}};
    struct pel_navigation navigation = start(PEL_NAVIGATION_ORBIT);
    for (int i = 0; pel_navigation_view_names()[i]; i++) {
        struct pel_camera expected = {.fov_deg = 40};
        assert_true(pel_camera_fit(&expected, pel_navigation_view_names()[i], &bounds, 1.6));
        assert_true(
            pel_navigation_view(&navigation, pel_navigation_view_names()[i], &bounds, 1.6, 0));
        assert_camera(&navigation.camera, &expected, 1e-9);
        // Fitting what is fitted changes nothing.
        assert_true(pel_navigation_fit(&navigation, &bounds, 1.6, 0));
        assert_camera(&navigation.camera, &expected, 1e-9);
    }
    assert_false(pel_navigation_view(&navigation, "behind", &bounds, 1.6, 0));
    // From an odd direction every corner is in the picture, and one nearly at its edge.
    pel_navigation_turn(&navigation, 33, 21);
    for (int parallel = 0; parallel < 2; parallel++) {
        assert_true(pel_navigation_fit(&navigation, &bounds, 1.6, 0));
        struct pel_view view;
        double worst = 0;
        assert_true(pel_view_make(&view, &navigation.camera, size[0], size[1]));
        for (int corner = 0; corner < 8; corner++) {
            double p[3], pixel[2];
            for (int i = 0; i < 3; i++)
                p[i] = corner >> i & 1 ? bounds.high[i] : bounds.low[i];
            assert_true(pel_view_project(&view, p, pixel));
            worst = fmax(worst, fabs(2 * pixel[0] / size[0] - 1));
            worst = fmax(worst, fabs(2 * pixel[1] / size[1] - 1));
        }
        assert_float_equal(worst, 0.95, 1e-9);
        pel_navigation_toggle_orthographic(&navigation, &bounds);
    }
    pel_navigation_reset(&navigation, 0);
    assert_camera(&navigation.camera, &navigation.home, 1e-9);
}

static void test_toggle_keeps_size(void **state) {
    (void)state;
    const struct pel_bounds bounds = {{-1000, -1000, -1000}, {1000, 1000, 1000}};
    struct pel_navigation navigation = start(PEL_NAVIGATION_ORBIT);
    struct pel_view before, after;
    assert_true(pel_view_make(&before, &navigation.camera, size[0], size[1]));
    pel_navigation_toggle_orthographic(&navigation, &bounds);
    assert_true(pel_view_make(&after, &navigation.camera, size[0], size[1]));
    assert_float_equal(pel_view_target_mm_per_px(&after), pel_view_target_mm_per_px(&before),
                       1e-12);
    assert_true(navigation.camera.eye[1] > 1000 * sqrt(3));
    pel_navigation_toggle_orthographic(&navigation, &bounds);
    assert_vector(navigation.camera.eye, before.camera.eye, 1e-9);
    assert_vector(navigation.camera.target, before.camera.target, 1e-9);
    navigation = start(PEL_NAVIGATION_ORBIT);
    pel_navigation_set_fov(&navigation, 10);
    assert_true(pel_view_make(&after, &navigation.camera, size[0], size[1]));
    assert_float_equal(pel_view_target_mm_per_px(&after), pel_view_target_mm_per_px(&before),
                       1e-12);
}

static void test_transitions(void **state) {
    (void)state;
    struct pel_navigation navigation = start(PEL_NAVIGATION_ORBIT);
    assert_false(pel_navigation_recall(&navigation, 3, 0));
    pel_navigation_store(&navigation, 3);
    const struct pel_camera first = navigation.camera;
    pel_navigation_turn(&navigation, 90, 0);
    const double low[2] = {0, 0}, high[2] = {0, 400};
    pel_navigation_zoom(&navigation, size, low, high);
    const struct pel_camera second = navigation.camera;
    // Half way: 45 degrees, and the geometric mean of 500 and 5000 mm.
    struct pel_camera half = pel_navigation_between(&first, &second, 0.5);
    assert_float_equal(vector_distance(half.eye, half.target), 500 * sqrt(10), 1e-6);
    assert_float_equal(half.eye[1] - half.target[1], 500 * sqrt(10) * cos(VECTOR_PI / 4), 1e-6);
    assert_false(pel_navigation_tick(&navigation, 1));
    assert_true(pel_navigation_recall(&navigation, 3, 0.5));
    for (int i = 0; i < 10; i++)
        assert_true(pel_navigation_tick(&navigation, 0.0501));
    assert_false(pel_navigation_tick(&navigation, 0.05));
    assert_camera(&navigation.camera, &first, 0);
    // Half a turn has no shortest way, but it has a way.
    struct pel_camera back = first;
    vector_set(back.eye, (double[]){10, -480, 30});
    half = pel_navigation_between(&first, &back, 0.5);
    assert_float_equal(vector_distance(half.eye, half.target), 500, 1e-6);
    assert_float_equal(half.eye[1], 20, 1e-6);
    // A hand that takes hold ends it.
    assert_true(pel_navigation_recall(&navigation, 3, 0.5));
    pel_navigation_begin(&navigation);
    assert_false(pel_navigation_tick(&navigation, 0.1));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_full_turns),
        cmocka_unit_test(test_full_drags),
        cmocka_unit_test(test_drag_directions),
        cmocka_unit_test(test_orbit_stays_upright),
        cmocka_unit_test(test_fly_follows_pointer),
        cmocka_unit_test(test_pan),
        cmocka_unit_test(test_wheel),
        cmocka_unit_test(test_zoom_and_roll),
        cmocka_unit_test(test_move),
        cmocka_unit_test(test_views_and_fit),
        cmocka_unit_test(test_toggle_keeps_size),
        cmocka_unit_test(test_transitions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
