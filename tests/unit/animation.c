// Tests of a scene's animation: what is between keyframes, against values worked out by hand; and
// that a frame is a scene like any other.
#include "support/scene_file.h"

#include <math.h>

#include "camera/path.h"
#include "support/near.h"
#include "transfer/blend.h"
#include "transfer/transfer.h"
#include "world/scene_interpolate.h"

static struct pel_scene *load(const char *quoted) {
    struct pel_scene *scene = pel_scene_load(test_write_scene("animated.json", quoted), NULL, 0);
    if (!scene)
        fail_msg("%s", pel_error_message());
    return scene;
}

static void go_to(struct pel_scene *scene, double frame) {
    if (!pel_scene_set_frame(scene, frame))
        fail_msg("%s", pel_error_message());
    assert_true(scene->timeline.frame == frame);
}

static json_t *parse(const char *quoted) {
    char text[512];
    snprintf(text, sizeof text, "%s", quoted);
    for (char *at = text; *at; at++)
        if (*at == '\'')
            *at = '"';
    json_t *value = json_loads(text, JSON_DECODE_ANY, NULL);
    assert_non_null(value);
    return value;
}

// Numbers of `a` and `b` in the order they are written in must agree.
static void compare(const json_t *a, const json_t *b, const char *title) {
    const char *key;
    json_t *value;
    size_t index;
    assert_int_equal(json_is_number(a), json_is_number(b));
    if (json_is_number(a) && fabs(json_number_value(a) - json_number_value(b)) > 1e-12)
        fail_msg("%s: %.17g, not %.17g", title, json_number_value(a), json_number_value(b));
    if (json_is_string(a))
        assert_string_equal(json_string_value(a), json_string_value(b));
    assert_int_equal(json_array_size(a), json_array_size(b));
    assert_int_equal(json_object_size(a), json_object_size(b));
    json_array_foreach((json_t *)a, index, value) compare(value, json_array_get(b, index), title);
    json_object_foreach((json_t *)a, key, value) compare(value, json_object_get(b, key), title);
}

static void expect_between(const char *from, const char *to, double share, const char *wanted) {
    json_t *a = parse(from), *b = parse(to), *right = parse(wanted);
    json_t *mixed = pel_interpolate(a, b, share);
    assert_non_null(mixed);
    compare(mixed, right, from);
    json_decref(a);
    json_decref(b);
    json_decref(right);
    json_decref(mixed);
}

static void test_values(void **state) {
    (void)state;
    expect_between("1", "3", 0.25, "1.5");
    expect_between("[1, [2, 4]]", "[3, [0, 8]]", 0.5, "[2, [1, 6]]");
    expect_between("{'a': 1, 'b': 'x'}", "{'b': 'x', 'a': 2}", 0.5, "{'a': 1.5, 'b': 'x'}");
    // What cannot be mixed waits for the next keyframe.
    expect_between("'left'", "'right'", 0.99, "'left'");
    expect_between("[1, 2]", "[1, 2, 3]", 0.5, "[1, 2]");
    expect_between("'left'", "'right'", 1, "'right'");
}

// A quarter turn about z, half way, and the like: 45 degrees have the sine and cosine sqrt(1/2).
static void test_poses(void **state) {
    (void)state;
    expect_between("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]",
                   "[[0,-1,0,10],[1,0,0,0],[0,0,1,4],[0,0,0,1]]", 0.5,
                   "{'quaternion': [0, 0, 0.38268343236508978, 0.92387953251128674],"
                   " 'translation': [5, 0, 2]}");
    expect_between("{'quaternion': [0,0,0,1]}", "{'quaternion': [0,0,-1,0]}", 0.5,
                   "{'quaternion': [0, 0, -0.70710678118654752, 0.70710678118654752],"
                   " 'translation': [0, 0, 0]}");
    // About one axis the angle is a number: two turns are two turns.
    expect_between("{'rotate': {'axis': 'z', 'degrees': 0}}",
                   "{'rotate': {'axis': 'z', 'degrees': 720}}", 0.25,
                   "{'rotate': {'axis': 'z', 'degrees': 180}}");
    // Between 90 degrees about x and about y lies (1, 1, 0, 2) / sqrt(6): 2 atan(sqrt(1/2)) about
    // the axis between.
    expect_between("{'rotate': {'axis': 'x', 'degrees': 90, 'about': 'centre'}}",
                   "{'rotate': {'axis': 'y', 'degrees': 90, 'about': 'centre'}}", 0.5,
                   "{'rotate': {'axis': [0.70710678118654752, 0.70710678118654752, 0],"
                   " 'degrees': 70.528779365509308, 'about': 'centre'}, 'translate': [0, 0, 0]}");
    // A rotation about a point becomes one with a translation: 180 degrees about (1, 0, 0).
    expect_between("{'rotate': {'axis': 'z', 'degrees': 180, 'about': [1, 0, 0]}}",
                   "{'quaternion': [0, 0, 1, 0], 'translation': [4, 0, 0]}", 0.5,
                   "{'quaternion': [0, 0, 1, 0], 'translation': [3, 0, 0]}");
}

#define FADE(track)                                                                                \
    "{" TEST_VOLUMES ", 'animation': {'fps': 10, 'frames': 21, 'tracks': [{"                       \
    "'key': 'volumes.0.density', " track "}]}}"

static void expect_density(const char *scene_text, const double frames[][2], int count) {
    struct pel_scene *scene = load(scene_text);
    for (int i = 0; i < count; i++) {
        go_to(scene, frames[i][0]);
        assert_near(scene->instances[0].density, frames[i][1], 1e-12);
    }
    pel_scene_destroy(scene);
}

static void test_interpolations(void **state) {
    (void)state;
    expect_density(FADE("'frames': [5, 15], 'values': [1, 2]"),
                   (double[][2]){{0, 1}, {5, 1}, {7.5, 1.25}, {12, 1.7}, {15, 2}, {20, 2}}, 6);
    expect_density(FADE("'times': [0.5, 1.5], 'values': [1, 2], 'interpolation': 'smooth'"),
                   (double[][2]){{5, 1}, {7.5, 1.15625}, {10, 1.5}, {15, 2}}, 4);
    expect_density(FADE("'frames': [0, 10], 'values': [1, 2], 'interpolation': 'step'"),
                   (double[][2]){{0, 1}, {9.99, 1}, {10, 2}}, 3);
    expect_density(FADE("'frames': [0, 10], 'values': [0, 10], 'interpolation': 'whole'"),
                   (double[][2]){{0, 0}, {2.9, 2}, {3, 3}, {9, 9}, {10, 10}}, 5);
    // Spread evenly from frame 0 to frame 20.
    expect_density(FADE("'values': [0, 1, 4]"), (double[][2]){{5, 0.5}, {10, 1}, {15, 2.5}}, 3);
}

// Volumes by name, one value for all of them, lists inside, and the first frame of a still.
static void test_keys(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{'volumes': [{" TEST_VOLUME "}, {" TEST_VOLUME ", 'name': 'ct'}],"
             " 'background': [0, 0, 0], 'animation': {'frame': 5, 'tracks': ["
             "{'key': 'volumes.ct.density', 'frames': [0, 10], 'values': [0, 1]},"
             "{'key': 'volumes.*.opacity_unit', 'frames': [0, 10], 'values': [1, 3]},"
             "{'key': 'background', 'frames': [0, 10], 'values': [[0, 0, 0], [1, 0.5, 0]]}]}}");
    assert_int_equal(scene->timeline.frame_count, 11);
    assert_near(scene->timeline.fps, 25, 0);
    assert_near(scene->instances[0].density, 1, 0);
    assert_near(scene->instances[1].density, 0.5, 1e-12);
    assert_near(scene->instances[0].transfer->opacity_unit_mm, 2, 1e-12);
    assert_near(scene->instances[1].transfer->opacity_unit_mm, 2, 1e-12);
    assert_near(scene->background[0], 0.5, 1e-12);
    assert_near(scene->background[1], 0.25, 1e-12);
    pel_scene_destroy(scene);
}

static const struct pel_colour_point grey[] = {{0, {0, 0, 0}}, {10, {1, 1, 1}}};
static const struct pel_opacity_point ramp[] = {{0, 0}, {10, 1}};
static const struct pel_opacity_point later[] = {{4, 0.5}, {20, 0}};
static const struct pel_opacity_point jump[] = {{0, 0}, {5, 0}, {5, 0.8}};

static struct pel_transfer make(const struct pel_opacity_point *points, int count, double unit_mm) {
    return (struct pel_transfer){.colours = (struct pel_colour_point *)grey,
                                 .colour_count = 2,
                                 .opacities = (struct pel_opacity_point *)points,
                                 .opacity_count = count,
                                 .opacity_unit_mm = unit_mm};
}

static void test_transfers(void **state) {
    (void)state;
    // As many points: they move.
    struct pel_transfer a = make(ramp, 2, 1), b = make(later, 2, 3), c = make(jump, 3, 1);
    struct pel_transfer *mixed = pel_transfer_blend(&a, &b, 0.25);
    assert_int_equal(mixed->opacity_count, 2);
    assert_near(mixed->opacities[0].value, 1, 1e-12);
    assert_near(mixed->opacities[0].opacity, 0.125, 1e-12);
    assert_near(mixed->opacities[1].value, 12.5, 1e-12);
    assert_near(mixed->opacities[1].opacity, 0.75, 1e-12);
    assert_near(mixed->opacity_unit_mm, 1.5, 1e-12);
    pel_transfer_destroy(mixed);
    // Different numbers: the functions are mixed at every value, steps included.
    for (int swapped = 0; swapped < 2; swapped++) {
        double share = 0.3;
        mixed = swapped ? pel_transfer_blend(&c, &a, 1 - share) : pel_transfer_blend(&a, &c, share);
        assert_true(pel_transfer_check(mixed));
        for (double value = -1; value < 12; value += 0.25) {
            double of_a[4], of_c[4], of_mixed[4];
            pel_transfer_evaluate(&a, value, of_a);
            pel_transfer_evaluate(&c, value, of_c);
            pel_transfer_evaluate(mixed, value, of_mixed);
            assert_near(of_mixed[3], 0.7 * of_a[3] + 0.3 * of_c[3], 1e-12);
            assert_near(of_mixed[0], of_a[0], 1e-12);
        }
        // 0 and 5 and 10, the step twice.
        assert_int_equal(mixed->opacity_count, 4);
        pel_transfer_destroy(mixed);
    }
}

static void test_transfer_track(void **state) {
    (void)state;
    struct pel_scene *scene =
        load("{" TEST_VOLUMES ", 'animation': {'tracks': [{'key': 'volumes.0.transfer',"
             " 'frames': [0, 4], 'values': ["
             "{'colours': [[0, 0, 0, 0]], 'opacities': [[0, 0.2], [10, 0.4]]},"
             "{'colours': [[0, 1, 1, 1]], 'opacities': [[4, 0.6], [20, 0.8]]}]}]}}");
    assert_near(scene->instances[0].transfer->opacities[1].opacity, 0.4, 1e-12);
    go_to(scene, 1);
    assert_near(scene->instances[0].transfer->opacities[0].value, 1, 1e-12);
    assert_near(scene->instances[0].transfer->opacities[1].opacity, 0.5, 1e-12);
    assert_near(scene->instances[0].transfer->colours[0].rgb[2], 0.25, 1e-12);
    go_to(scene, 4);
    assert_near(scene->instances[0].transfer->opacities[0].value, 4, 1e-12);
    pel_scene_destroy(scene);
}

// The camera keeps its distance and goes about its target: from in front of the eyes to the left
// side, half way is at 45 degrees.
static void test_cameras(void **state) {
    (void)state;
    const struct pel_camera a = {.eye = {0, 10, 0}, .up = {0, 0, 1}, .fov_deg = 30};
    const struct pel_camera b = {
        .eye = {-20 + 4, 0, 0}, .target = {4, 0, 0}, .up = {0, 0, 1}, .fov_deg = 50};
    struct pel_camera camera;
    assert_true(pel_camera_between(&camera, &a, &b, 0.5));
    double side = 15 * sqrt(0.5);
    assert_near(camera.eye[0], 2 - side, 1e-9);
    assert_near(camera.eye[1], side, 1e-9);
    assert_near(camera.eye[2], 0, 1e-9);
    assert_near(camera.target[0], 2, 1e-12);
    assert_near(camera.up[2], 1, 1e-12);
    assert_near(camera.fov_deg, 40, 1e-12);

    struct pel_scene *scene =
        load("{" TEST_VOLUMES ", 'camera': {'eye': [0, 100, 0], 'target': [0, 0, 10], 'fov': 20},"
             " 'animation': {'frames': 8, 'tracks': [{'orbit': {}}]}}");
    go_to(scene, 2);
    assert_near(scene->camera.eye[0], -100, 1e-9);
    assert_near(scene->camera.eye[1], 0, 1e-9);
    assert_near(scene->camera.eye[2], 0, 1e-9);
    go_to(scene, 8); // where the film begins again
    assert_near(scene->camera.eye[1], 100, 1e-9);
    pel_scene_destroy(scene);

    scene = load("{" TEST_VOLUMES ", 'camera': {'fov': 20}, 'animation': {'frames': 3, 'tracks': ["
                 "{'key': 'camera.view', 'values': ['anterior', 'left']},"
                 "{'orbit': {'axis': [0, 0, 2], 'turns': -0.25}, 'frames': [1, 2]}]}}");
    assert_true(fabs(scene->camera.eye[0] - scene->camera.target[0]) < 1e-9);
    go_to(scene, 1);
    double dx = scene->camera.eye[0] - scene->camera.target[0];
    double dy = scene->camera.eye[1] - scene->camera.target[1];
    assert_true(dx < -1);
    assert_near(dx, -dy, 1e-9);
    go_to(scene, 2); // a quarter back: in front again
    assert_near(scene->camera.eye[0] - scene->camera.target[0], 0, 1e-9);
    assert_near(scene->camera.fov_deg, 20, 1e-12);
    pel_scene_destroy(scene);
}

// Volumes stay where they are, and a value that cannot be leaves the scene as it was.
static void test_frames(void **state) {
    (void)state;
    struct pel_scene *scene = load("{" TEST_VOLUMES ", 'animation': {'frames': 11, 'tracks': ["
                                   "{'key': 'camera.fov', 'values': [30, 230]}]}}");
    const struct pel_volume *volume = scene->volumes[0];
    go_to(scene, 5);
    assert_ptr_equal(scene->volumes[0], volume);
    assert_near(scene->camera.fov_deg, 130, 1e-9);
    assert_non_null(strstr(scene->text, "\"frame\":5.0"));
    assert_false(pel_scene_set_frame(scene, 9));
    assert_non_null(strstr(pel_error_message(), "frame 9: "));
    assert_non_null(strstr(pel_error_message(), "camera.fov: must be above 0 and below 180"));
    assert_near(scene->camera.fov_deg, 130, 1e-9);
    assert_near(scene->timeline.frame, 5, 0);
    assert_false(pel_scene_set_frame(scene, 11.5));
    assert_string_equal(pel_error_message(), "frame 11.5, outside 0..11");
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    go_to(scene, 0);
    assert_ptr_equal(scene->volumes[0], volume);
    pel_scene_destroy(scene);

    // Other voxels are other volumes.
    scene = load("{'volumes': [{'file': 'a.raw', 'raw': {'dims': [2, 3, 4], 'offset': 0}}],"
                 " 'animation': {'tracks': [{'key': 'volumes.0.raw.dims', 'frames': [0, 2],"
                 " 'values': [[2, 3, 4], [2, 3, 2]], 'interpolation': 'step'}]}}");
    go_to(scene, 2);
    assert_int_equal(scene->volumes[0]->dims[2], 2);
    assert_int_equal(scene->volume_count, 1);
    pel_scene_destroy(scene);
}

static void expect_error(const char *animation, const char *message) {
    char text[1024];
    snprintf(text, sizeof text, "{" TEST_VOLUMES ",\n'animation': %s}", animation);
    assert_null(pel_scene_load(test_write_scene("bad.json", text), NULL, 0));
    const char *colon = strstr(pel_error_message(), "bad.json:");
    if (!colon || !strstr(colon, message))
        fail_msg("'%s', not '%s'", pel_error_message(), message);
}

static void test_errors(void **state) {
    (void)state;
    expect_error("{}", "animation: needs 'frames' or 'duration'");
    expect_error("{'frames': 5, 'duration': 2}", "there are 'frames' already");
    expect_error("{'duration': 0.01}", "makes 0 frames, outside 1..1000000");
    expect_error("{'frames': 5, 'frame': 6}", "animation.frame: must be at least 0 and at most 5");
    expect_error("{'frames': 5, 'trakcs': []}", "did you mean 'tracks'");
    expect_error("{'frames': 5, 'tracks': [{}]}", "animation.tracks.0: needs 'key' or 'orbit'");
    expect_error("{'frames': 5, 'tracks': [{'key': 'camera.fov'}]}", "needs 'values'");
    expect_error("{'frames': 5, 'tracks': [{'key': 'animation.fps', 'values': [1]}]}",
                 "'animation.fps' cannot be animated");
    expect_error("{'frames': 5, 'tracks': [{'key': 'volumes.ct.density', 'values': [1]}]}",
                 "animation.tracks.0.key: no volume is named 'ct'");
    expect_error("{'frames': 5, 'tracks': [{'key': 'volumes.7.density', 'values': [1]}]}",
                 "no element 7 in a list of 1");
    expect_error("{'tracks': [{'key': 'camera.fov', 'frames': [3, 3], 'values': [1, 2]}]}",
                 "frames: must ascend, but 3 comes after 3");
    expect_error("{'tracks': [{'key': 'camera.fov', 'times': [1], 'values': [1, 2]}]}",
                 "times: must have 2 elements, not 1");
    expect_error("{'frames': 5, 'tracks': [{'orbit': {'axis': 'z'}}]}",
                 "orbit.axis: must be superior");
    expect_error("{'frames': 5, 'tracks': [{'key': 'volumes.0.transfer', 'values': ['no-such']}]}",
                 "no-such");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),         cmocka_unit_test(test_poses),
        cmocka_unit_test(test_interpolations), cmocka_unit_test(test_keys),
        cmocka_unit_test(test_transfers),      cmocka_unit_test(test_transfer_track),
        cmocka_unit_test(test_cameras),        cmocka_unit_test(test_frames),
        cmocka_unit_test(test_errors),
    };
    return cmocka_run_group_tests(tests, test_write_volumes, NULL);
}
