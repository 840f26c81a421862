// Tests of display walls: the regions of a scene file, and that the rays of a region are those of
// the whole picture.
#include "support/scene_file.h"

#include <math.h>

#include "viewer/vector.h"
#include "viewer/pace.h"
#include "viewer/view.h"
#include "viewer/wall.h"

static struct pel_scene *load_wall(const char *wall) {
    char text[1024];
    snprintf(text, sizeof text, "{" TEST_VOLUMES ", 'wall': %s}", wall);
    return pel_scene_load(test_write_scene("wall.json", text), NULL, 0);
}

static void assert_place(const struct pel_wall_region *region, double left, double top,
                         double width, double height) {
    const double expected[4] = {left, top, width, height};
    for (int i = 0; i < 4; i++)
        assert_float_equal(region->place[i], expected[i], 1e-12);
}

static void test_grid(void **state) {
    (void)state;
    struct pel_scene *scene = load_wall("{'columns': 3, 'rows': 2, 'bezel': [0.5, 0.25]}");
    assert_non_null(scene);
    assert_int_equal(scene->wall.region_count, 6);
    // 3 + 2 x 0.5 widths across, 2 + 0.25 heights down.
    assert_place(&scene->wall.regions[0], 0, 0, 0.25, 1 / 2.25);
    assert_place(&scene->wall.regions[2], 0.75, 0, 0.25, 1 / 2.25);
    assert_place(&scene->wall.regions[4], 0.375, 1.25 / 2.25, 0.25, 1 / 2.25);
    assert_int_equal(scene->wall.regions[5].monitor, -1);
    pel_scene_destroy(scene);
    scene = load_wall("{'regions': [{'place': [0, 0, 0.5, 1], 'monitor': 1, 'device': 'gpu'}]}");
    assert_non_null(scene);
    assert_int_equal(scene->wall.regions[0].monitor, 1);
    assert_string_equal(scene->wall.regions[0].device, "gpu");
    pel_scene_destroy(scene);
}

static void check_refused(const char *wall, const char *sentence) {
    assert_null(load_wall(wall));
    assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
    if (!strstr(pel_error_message(), sentence))
        fail_msg("%s", pel_error_message());
}

static void test_refused(void **state) {
    (void)state;
    check_refused("{'columns': 9, 'rows': 4}", "wall: has 9 x 4 regions, more than 32");
    check_refused("{'rows': 2, 'regions': [{'place': [0, 0, 1, 1]}]}",
                  "wall.rows: there are 'regions' already");
    check_refused("{'regions': [{'place': [0, 0, 1, 0]}]}", "wall.regions.0.place: has no size");
    check_refused("{'regions': [{}]}", "wall.regions.0: needs 'place'");
    check_refused("{'regions': []}", "wall.regions: must have 1 to 32 elements, not 0");
}

// The rays of a part of 160 x 60 pixels, whose corner is pixel (240, 60) of 640 x 240.
static void test_rays(void **state) {
    (void)state;
    const double place[4] = {240 / 640.0, 60 / 240.0, 160 / 640.0, 60 / 240.0};
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct pel_camera camera = {.eye = {100, 300, 50},
                                    .target = {1, 2, 3},
                                    .up = {0, 0, 1},
                                    .fov_deg = 50,
                                    .height_mm = 200,
                                    .orthographic = orthographic,
                                    .shift = {0.125, -0.25}};
        struct pel_camera part = pel_camera_part(&camera, 640 / 240.0, place);
        struct pel_view whole_view, part_view;
        assert_true(pel_view_make(&whole_view, &camera, 640, 240));
        assert_true(pel_view_make(&part_view, &part, 160, 60));
        for (int i = 0; i < 9; i++) {
            const double at[2] = {80.0 * (i % 3), 30.0 * (i / 3)};
            const double there[2] = {240 + at[0], 60 + at[1]};
            struct pel_view_ray a = pel_view_ray(&part_view, at);
            struct pel_view_ray b = pel_view_ray(&whole_view, there);
            assert_true(vector_distance(a.origin, b.origin) < 1e-9);
            assert_true(vector_distance(a.direction, b.direction) < 1e-12);
        }
        // All of it is the camera itself.
        part = pel_camera_part(&camera, 640 / 240.0, (double[]){0, 0, 1, 1});
        assert_float_equal(part.fov_deg, 50, 1e-12);
        assert_float_equal(part.shift[0], 0.125, 1e-12);
        assert_float_equal(part.shift[1], -0.25, 1e-12);
    }
}

// The eyes of a part are the parts of the eyes.
static void test_stereo(void **state) {
    (void)state;
    struct pel_scene *scene = load_wall("{'columns': 2}");
    const double *place = scene->wall.regions[1].place;
    scene->stereo = (struct pel_stereo){
        .kind = PEL_STEREO_SIDE_BY_SIDE, .separation_mm = 3, .convergence_mm = 40};
    struct pel_camera eyes[2], parts[2];
    assert_true(pel_stereo_cameras(scene, eyes, NULL));
    scene->camera = pel_camera_part(&scene->camera, 1.5, place);
    assert_true(pel_stereo_cameras(scene, parts, NULL));
    for (int eye = 0; eye < 2; eye++) {
        struct pel_camera expected = pel_camera_part(&eyes[eye], 1.5, place);
        assert_true(vector_distance(expected.eye, parts[eye].eye) < 1e-9);
        assert_float_equal(expected.shift[0], parts[eye].shift[0], 1e-9);
        assert_float_equal(expected.fov_deg, parts[eye].fov_deg, 1e-9);
    }
    pel_scene_destroy(scene);
}

// Without bezels every pixel of the whole belongs to one window.
static void test_tiling(void **state) {
    (void)state;
    struct pel_scene *scene = load_wall("{'columns': 3, 'rows': 2}");
    const int wall_px[2] = {101, 67};
    int covered[101 * 67] = {0};
    for (int i = 0; i < 6; i++) {
        struct pel_wall_part part = pel_wall_place(&scene->wall, i, wall_px);
        const int *region = part.region;
        for (int y = region[1]; y < region[1] + region[3]; y++)
            for (int x = region[0]; x < region[0] + region[2]; x++)
                covered[y * 101 + x]++;
        struct pel_wall_part fitted = pel_wall_fit(&scene->wall, i, wall_px, &region[2]);
        assert_memory_equal(&fitted, &part, sizeof part);
    }
    for (int i = 0; i < 101 * 67; i++)
        assert_int_equal(covered[i], 1);
    // Monitors of their own size are those of a larger wall.
    struct pel_wall_part part = pel_wall_fit(&scene->wall, 4, wall_px, (int[]){200, 100});
    const struct pel_wall_part expected = {{600, 200}, {200, 100, 200, 100}};
    assert_memory_equal(&part, &expected, sizeof part);
    pel_scene_destroy(scene);
}

// A quick picture has fewer pixels, and the part that is shown of it lies where it did.
static void test_quick_part(void **state) {
    (void)state;
    const struct pel_render_settings asked = {
        .width = 100, .height = 90, .region = {33, 10, 30, 41}, .step = 1};
    const struct pel_quality quality = {3, 1, 1};
    struct pel_render_settings applied = pel_pace_apply(&asked, &quality);
    assert_int_equal(applied.width, 34);
    assert_int_equal(applied.height, 30);
    double part[4];
    pel_pace_part(&asked, &applied, part);
    for (int axis = 0; axis < 2; axis++) {
        const int whole = axis ? asked.height : asked.width;
        const int fewer = axis ? applied.height : applied.width;
        const double low = applied.region[axis] + part[axis] * applied.region[2 + axis];
        const double size = part[2 + axis] * applied.region[2 + axis];
        assert_float_equal(low / fewer, (double)asked.region[axis] / whole, 1e-9);
        assert_float_equal(size / fewer, (double)asked.region[2 + axis] / whole, 1e-9);
        assert_true(applied.region[axis] + applied.region[2 + axis] <= fewer);
    }
    // The scene's own quality shows all of what was asked for.
    applied = pel_pace_apply(&asked, &(struct pel_quality){1, 1, 1});
    pel_pace_part(&asked, &applied, part);
    assert_memory_equal(applied.region, asked.region, sizeof asked.region);
    for (int i = 0; i < 4; i++)
        assert_float_equal(part[i], i < 2 ? 0 : 1, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grid),   cmocka_unit_test(test_refused),
        cmocka_unit_test(test_rays),   cmocka_unit_test(test_stereo),
        cmocka_unit_test(test_tiling), cmocka_unit_test(test_quick_part),
    };
    return cmocka_run_group_tests(tests, test_write_volumes, NULL);
}
