// Tests of handles: what the pointer takes hold of, and how far it leads it, in millimetres and
// degrees that were worked out by hand.
#include "support/test.h"

#include <math.h>

#include "viewer/handles.h"
#include "viewer/vector.h"

static const int size[2] = {400, 400};

static struct pel_scene *make_scene(void) {
    const int dims[3] = {11, 11, 11};
    struct pel_volume *volume = pel_volume_create("cube", dims, PEL_VOXEL_U8);
    memset(volume->voxels, 0, pel_volume_bytes(volume));
    struct pel_scene *scene = pel_scene_create();
    assert_int_equal(pel_scene_add_volume(scene, volume, NULL), 0);
    pel_volume_destroy(volume);
    scene->instances[0].transform.m[0][3] = 20;
    return scene;
}

// From anterior, half a millimetre a pixel; the volume's centre (25, 5, 5) is in the middle.
static struct pel_view front_view(bool orthographic) {
    struct pel_camera camera = {.eye = {25, 5 + 500, 5},
                                .target = {25, 5, 5},
                                .up = {0, 0, 1},
                                .orthographic = orthographic,
                                .height_mm = 200,
                                .fov_deg = 2 * atan(0.2) * 180 / VECTOR_PI};
    struct pel_view view;
    assert_true(pel_view_make(&view, &camera, size[0], size[1]));
    return view;
}

static struct pel_gizmo make_gizmo(const struct pel_scene *scene, const struct pel_view *view) {
    struct pel_gizmo gizmo;
    assert_true(pel_gizmo_make(&gizmo, scene, 0, view, 80, false));
    assert_float_equal(gizmo.centre[0], 25, 1e-9);
    assert_float_equal(gizmo.centre[1], 5, 1e-9);
    assert_float_equal(gizmo.size_mm, 40, 1e-9);
    return gizmo;
}

static void test_hit(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene();
    struct pel_view view = front_view(true);
    struct pel_gizmo gizmo = make_gizmo(scene, &view);
    // The patient's right, +x, is at the picture's left.
    assert_int_equal(pel_gizmo_hit(&gizmo, (double[]){130, 203}, 6), PEL_HANDLE_MOVE_X);
    assert_int_equal(pel_gizmo_hit(&gizmo, (double[]){197, 170}, 6), PEL_HANDLE_MOVE_Z);
    // The plane of x and z is the one y is perpendicular to; 0.3 to 0.5 arrows are 24 to 40 pixels.
    assert_int_equal(pel_gizmo_hit(&gizmo, (double[]){168, 168}, 6), PEL_HANDLE_PLANE_Y);
    assert_int_equal(pel_gizmo_hit(&gizmo, (double[]){200, 200}, 6), PEL_HANDLE_MOVE_VIEW);
    double at = 0.8 * 80 * sqrt(0.5), outer = 1.15 * 80 * sqrt(0.5);
    assert_int_equal(pel_gizmo_hit(&gizmo, (double[]){200 + at, 200 + at}, 6), PEL_HANDLE_TURN_Y);
    assert_int_equal(pel_gizmo_hit(&gizmo, (double[]){200 + outer, 200 + outer}, 6),
                     PEL_HANDLE_TURN_VIEW);
    assert_int_equal(pel_gizmo_hit(&gizmo, (double[]){310, 200}, 6), PEL_HANDLE_NONE);
    // The arrow that points at the eye is not there.
    double pixels[PEL_HANDLE_POINTS][2];
    assert_int_equal(pel_gizmo_outline(&gizmo, PEL_HANDLE_MOVE_Y, pixels), 0);
    assert_int_equal(pel_gizmo_outline(&gizmo, PEL_HANDLE_MOVE_X, pixels), 2);
    assert_float_equal(pixels[1][0], 120, 1e-9);
    assert_float_equal(pixels[1][1], 200, 1e-9);
    pel_scene_destroy(scene);
}

static struct pel_matrix drag(const struct pel_gizmo *gizmo, const struct pel_scene *scene,
                              enum pel_handle handle, const double from[2], const double to[2],
                              double snap, double amount) {
    struct pel_handle_drag state;
    struct pel_matrix transform;
    assert_true(pel_handle_begin(&state, gizmo, handle, from, &scene->instances[0].transform));
    // On its way the pointer goes anywhere: only where it is counts.
    pel_handle_drag(&state, (double[]){77, 311}, 0, &transform);
    assert_true(pel_handle_drag(&state, to, snap, &transform));
    assert_float_equal(state.amount, amount, 1e-6);
    return transform;
}

static void assert_offset(const struct pel_matrix *transform, double x, double y, double z) {
    assert_float_equal(transform->m[0][3], x, 1e-6);
    assert_float_equal(transform->m[1][3], y, 1e-6);
    assert_float_equal(transform->m[2][3], z, 1e-6);
}

// n pixels along the projected axis are n / 2 millimetres, whatever the pointer does across it.
static void test_move(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene();
    const double from[2] = {140, 200};
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct pel_view view = front_view(orthographic);
        struct pel_gizmo gizmo = make_gizmo(scene, &view);
        struct pel_matrix moved =
            drag(&gizmo, scene, PEL_HANDLE_MOVE_X, from, (double[]){110, 200}, 0, 15);
        assert_offset(&moved, 35, 0, 0);
        moved = drag(&gizmo, scene, PEL_HANDLE_MOVE_Z, (double[]){200, 150}, (double[]){200, 137},
                     0, 6.5);
        assert_offset(&moved, 20, 0, 6.5);
        moved = drag(&gizmo, scene, PEL_HANDLE_MOVE_Z, (double[]){200, 150}, (double[]){200, 137},
                     5, 5);
        assert_offset(&moved, 20, 0, 5);
        moved = drag(&gizmo, scene, PEL_HANDLE_PLANE_Y, (double[]){168, 168}, (double[]){174, 160},
                     0, 5);
        assert_offset(&moved, 17, 0, 4);
        moved = drag(&gizmo, scene, PEL_HANDLE_MOVE_VIEW, (double[]){200, 200},
                     (double[]){206, 208}, 0, 5);
        assert_offset(&moved, 17, 0, -4);
    }
    pel_scene_destroy(scene);
}

// Obliquely seen, the point of the axis that was under the pointer still is.
static void test_move_obliquely(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene();
    struct pel_camera camera = {
        .eye = {325, 355, 205}, .target = {30, 10, 0}, .up = {0, 0, 1}, .fov_deg = 30};
    struct pel_view view;
    assert_true(pel_view_make(&view, &camera, size[0], size[1]));
    struct pel_gizmo gizmo;
    assert_true(pel_gizmo_make(&gizmo, scene, 0, &view, 80, false));
    for (int axis = 0; axis < 3; axis++) {
        double held[3], target[3], from[2], to[2];
        vector_add_scaled(held, gizmo.centre, 20, gizmo.axes[axis]);
        vector_add_scaled(target, held, 7.25, gizmo.axes[axis]);
        assert_true(pel_view_project(&view, held, from));
        assert_true(pel_view_project(&view, target, to));
        struct pel_matrix moved =
            drag(&gizmo, scene, (enum pel_handle)(PEL_HANDLE_MOVE_X + axis), from, to, 0, 7.25);
        double expected[3] = {20, 0, 0};
        expected[axis] += 7.25;
        assert_offset(&moved, expected[0], expected[1], expected[2]);
    }
    pel_scene_destroy(scene);
}

// A quarter turn of a ring turns by 90 degrees, about the volume's centre, which stays.
static void test_turn(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene();
    struct pel_view view = front_view(true);
    struct pel_gizmo gizmo = make_gizmo(scene, &view);
    // y points to the eye, so counter-clockwise in the picture is positive.
    struct pel_matrix turned =
        drag(&gizmo, scene, PEL_HANDLE_TURN_Y, (double[]){264, 200}, (double[]){200, 100}, 0, 90);
    double centre[3] = {5, 5, 5}, edge[3] = {15, 5, 5};
    matrix_point(centre, &turned, centre);
    matrix_point(edge, &turned, edge);
    assert_float_equal(vector_distance(centre, gizmo.centre), 0, 1e-9);
    // +x was at the left; a quarter counter-clockwise is down, -z.
    assert_float_equal(edge[0], 25, 1e-9);
    assert_float_equal(edge[2], -5, 1e-9);
    turned = drag(&gizmo, scene, PEL_HANDLE_TURN_VIEW, (double[]){292, 200}, (double[]){200, 100},
                  0, 90);
    assert_float_equal(turned.m[2][0], -1, 1e-9);
    drag(&gizmo, scene, PEL_HANDLE_TURN_Y, (double[]){264, 200}, (double[]){264, 150}, 15, 45);
    // Seen from its side, the ring about z rolls: its near side goes to the right with the pointer.
    turned = drag(&gizmo, scene, PEL_HANDLE_TURN_Z, (double[]){200, 200}, (double[]){232, 200}, 0,
                  32 / 64.0 * 180 / VECTOR_PI);
    double near[3] = {5, 15, 5};
    matrix_point(near, &turned, near);
    assert_float_equal(near[0], 25 - 10 * sin(0.5), 1e-9);
    pel_scene_destroy(scene);
}

static void test_own_axes(void **state) {
    (void)state;
    struct pel_scene *scene = make_scene();
    struct pel_view view = front_view(true);
    struct pel_gizmo gizmo;
    const double quarter[3][3] = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    for (int row = 0; row < 3; row++)
        vector_set(scene->instances[0].transform.m[row], quarter[row]);
    assert_true(pel_gizmo_make(&gizmo, scene, 0, &view, 80, true));
    assert_float_equal(gizmo.axes[0][1], 1, 1e-12);
    assert_float_equal(gizmo.axes[1][0], -1, 1e-12);
    // What is behind the eye has no handles.
    scene->instances[0].transform.m[1][3] = 900;
    assert_false(pel_gizmo_make(&gizmo, scene, 0, &view, 80, true));
    pel_scene_destroy(scene);
}

static void test_box(void **state) {
    (void)state;
    struct pel_view view = front_view(true);
    // A box in voxels of 2 mm along x.
    struct pel_handle_box box = {
        {{{2, 0, 0, 5}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}, {0, 0, 0}, {20, 10, 10}};
    double point[3], pixel[2];
    pel_box_face(&box, 1, point);
    assert_float_equal(point[0], 45, 1e-12);
    assert_true(pel_view_project(&view, point, pixel));
    assert_float_equal(pixel[0], 160, 1e-9);
    assert_int_equal(pel_box_hit(&box, &view, (double[]){162, 201}, 6), 1);
    assert_int_equal(pel_box_hit(&box, &view, (double[]){238, 201}, 6), 0);
    assert_int_equal(pel_box_hit(&box, &view, (double[]){180, 220}, 6), -1);
    struct pel_handle_box moved;
    // 20 pixels are 10 mm, 5 voxels.
    assert_true(pel_box_drag(&moved, &box, 1, &view, pixel, (double[]){180, 200}));
    assert_float_equal(moved.high[0], 15, 1e-9);
    assert_float_equal(moved.low[0], 0, 0);
    // Not beyond the other face; and never along the line of sight.
    assert_true(pel_box_drag(&moved, &box, 1, &view, pixel, (double[]){399, 200}));
    assert_float_equal(moved.high[0], 0, 0);
    assert_false(pel_box_drag(&moved, &box, 3, &view, pixel, (double[]){180, 200}));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hit),
        cmocka_unit_test(test_move),
        cmocka_unit_test(test_move_obliquely),
        cmocka_unit_test(test_turn),
        cmocka_unit_test(test_own_axes),
        cmocka_unit_test(test_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
