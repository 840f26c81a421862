// Tests of the handles of planes and boxes that cut, against places worked out by hand.
#include "support/test.h"

#include <math.h>

#include "viewer/clip_handles.h"
#include "viewer/vector.h"

// From anterior, with parallel rays and half a millimetre a pixel: the patient's right (x) is at
// the picture's left, superior (z) at its top, and the world's middle in the picture's.
static struct pel_view front_view(void) {
    const struct pel_camera camera = {
        .eye = {0, 500, 0}, .up = {0, 0, 1}, .orthographic = true, .height_mm = 200};
    struct pel_view view;
    assert_true(pel_view_make(&view, &camera, 400, 400));
    return view;
}

static void assert_vector(const double actual[3], double x, double y, double z) {
    const double expected[3] = {x, y, z};
    for (int i = 0; i < 3; i++)
        assert_float_equal(actual[i], expected[i], 1e-6);
}

static const struct pel_matrix nowhere = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

// Leads a handle from one pixel to another.
static struct pel_clip dragged(const struct pel_clip *clip, enum pel_handle handle,
                               const double from_px[2], const double to_px[2]) {
    struct pel_view view = front_view();
    struct pel_gizmo gizmo;
    struct pel_handle_drag drag;
    struct pel_matrix transform;
    struct pel_clip moved;
    assert_true(pel_clip_gizmo(&gizmo, clip, &view, 80));
    assert_true(pel_handle_begin(&drag, &gizmo, handle, from_px, &nowhere));
    assert_true(pel_handle_drag(&drag, to_px, 0, &transform));
    pel_clip_move(&moved, clip, &transform);
    return moved;
}

static void test_plane(void **state) {
    (void)state;
    const struct pel_clip plane = {
        .kind = PEL_CLIP_PLANE, .point = {10, 0, 0}, .normal = {0, 0, 3}};
    // Along its normal, upwards by 20 pixels, wherever to the side the pointer goes.
    struct pel_clip moved =
        dragged(&plane, PEL_HANDLE_MOVE_Z, (double[]){180, 150}, (double[]){190, 130});
    assert_vector(moved.point, 10, 0, 10);
    assert_vector(moved.normal, 0, 0, 3);
    // About the line of sight by a quarter, from above the middle to the right of it.
    moved = dragged(&plane, PEL_HANDLE_TURN_VIEW, (double[]){180, 100}, (double[]){280, 200});
    assert_vector(moved.point, 10, 0, 0);
    assert_vector(moved.normal, -3, 0, 0);
    // It has an arrow along its normal alone.
    struct pel_view view = front_view();
    struct pel_gizmo gizmo;
    double pixels[PEL_HANDLE_POINTS][2];
    assert_true(pel_clip_gizmo(&gizmo, &plane, &view, 80));
    assert_int_equal(pel_gizmo_outline(&gizmo, PEL_HANDLE_MOVE_X, pixels), 0);
    assert_int_equal(pel_gizmo_outline(&gizmo, PEL_HANDLE_MOVE_Z, pixels), 2);
}

// A plane that faces the viewer goes away from it upwards, however its normal points.
static void test_push(void **state) {
    (void)state;
    struct pel_view view = front_view();
    for (int sign = -1; sign <= 1; sign += 2) {
        const struct pel_clip plane = {.kind = PEL_CLIP_PLANE, .normal = {0, 2.0 * sign, 0}};
        struct pel_clip moved;
        pel_clip_push(&moved, &plane, &view, (double[]){200, 200}, (double[]){200, 160});
        assert_vector(moved.point, 0, -20, 0);
    }
}

static void test_box(void **state) {
    (void)state;
    const struct pel_clip box = {.kind = PEL_CLIP_BOX, .point = {0, 0, 20}, .size = {40, 60, 80}};
    struct pel_clip moved =
        dragged(&box, PEL_HANDLE_TURN_VIEW, (double[]){200, 60}, (double[]){300, 160});
    // A quarter clockwise about the line of sight, -y: what was x is z now.
    double q[4] = {0}, x[3] = {1, 0, 0};
    memcpy(q, moved.xyzw, sizeof q);
    quaternion_rotate(x, q, x);
    assert_vector(x, 0, 0, 1);
    assert_vector(moved.point, 0, 0, 20);
    assert_vector(moved.size, 40, 60, 80);
    // And a quarter again: turns add up.
    moved = dragged(&moved, PEL_HANDLE_TURN_VIEW, (double[]){200, 60}, (double[]){300, 160});
    memcpy(q, moved.xyzw, sizeof q);
    quaternion_rotate(x, q, (double[]){1, 0, 0});
    assert_vector(x, -1, 0, 0);
}

// The upper face is led up by 40 pixels: the box grows by 20 mm, and its middle follows by half.
static void test_face(void **state) {
    (void)state;
    struct pel_view view = front_view();
    struct pel_clip clip = {.kind = PEL_CLIP_BOX, .point = {0, 0, 20}, .size = {40, 60, 80}};
    struct pel_handle_box before = pel_clip_box(&clip), box;
    const double top[2] = {200, 80}, higher[2] = {200, 40}, below[2] = {200, 399};
    int face = pel_box_hit(&before, &view, top, 5);
    assert_int_equal(face, 5);
    assert_true(pel_box_drag(&box, &before, face, &view, top, higher));
    pel_clip_set_box(&clip, &box);
    assert_vector(clip.point, 0, 0, 30);
    assert_vector(clip.size, 40, 60, 100);
    // It does not go through the opposite one.
    assert_true(pel_box_drag(&box, &before, face, &view, top, below));
    pel_clip_set_box(&clip, &box);
    assert_true(clip.size[2] > 0 && clip.size[2] < 0.01);
}

// Edges of a box are as long as its sides; a plane is a square.
static void test_outline(void **state) {
    (void)state;
    double lines[PEL_CLIP_LINES][2][3], sum = 0;
    struct pel_clip clip = {.kind = PEL_CLIP_BOX, .size = {1, 2, 3}, .xyzw = {0, 0, 1, 1}};
    assert_int_equal(pel_clip_outline(&clip, 9, lines), 12);
    for (int i = 0; i < 12; i++)
        sum += vector_distance(lines[i][0], lines[i][1]);
    assert_float_equal(sum, 4 * (1 + 2 + 3), 1e-9);
    clip = (struct pel_clip){.kind = PEL_CLIP_PLANE, .point = {1, 2, 3}, .normal = {1, 1, 1}};
    assert_int_equal(pel_clip_outline(&clip, 9, lines), 4);
    for (int i = 0; i < 4; i++) {
        assert_float_equal(vector_distance(lines[i][0], lines[i][1]), 18, 1e-9);
        for (int end = 0; end < 2; end++)
            assert_float_equal(vector_dot(lines[i][end], clip.normal), 6, 1e-9);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plane), cmocka_unit_test(test_push),    cmocka_unit_test(test_box),
        cmocka_unit_test(test_face),  cmocka_unit_test(test_outline),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
