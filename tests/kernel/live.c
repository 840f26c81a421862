// live.c - hypertextures in scenes: worked out at every sample against the reference, baked against
// the same voxels from a file, and one against the other.
#include "support/judge.h"
#include "support/near.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scene_file.h"
#include "support/scenes.h"

#define RECIPE "{'value': ['*', ['sphere', 0.5, 0.8], ['+', 0.7, ['*', 0.3, ['noise', 2]]]]}"
#define LOOK                                                                                       \
    "'transfer': {'colours': [[0, 1, 0.4, 0.1], [1, 0.6, 0.8, 1]],"                                \
    " 'opacities': [[0.1, 0], [1, 0.5]], 'opacity_unit': 20}"
#define VIEW "'camera': {'view': 'oblique'}, 'render': {'size': [20, 16], 'step_mm': 4}"

// With one ray and, where that compiles fast, four at a time: on a scan, beside voxels, shaded,
// turned and animated.
static void test_reference(void **state) {
    (void)state;
    static const char scene_text[] =
        "{'volumes': [{'name': 'head', 'generate': {'kind': 'head-ct', 'size': 10},"
        "   'transfer': 'ct-bone', 'density': 0.3},"
        " {'hypertexture': {'live': true, 'size': 10, 'object': 'head', 'time': 0.25, 'recipe':"
        "   {'value': ['+', 'object', ['*', 0.2, ['fbm', 3, 2]], 'time']}},"
        "   'transform': {'rotate': {'axis': 'z', 'degrees': 20}}, 'shading': true," LOOK "},"
        " {'hypertexture': {'live': true, 'size': 6, 'seed': 5, 'recipe': " RECIPE "}," LOOK "}],"
        " 'camera': {'view': 'left'}, 'render': {'size': [16, 12], 'step_mm': 16}}";
    for (int lanes = 1; lanes <= judge_lanes(4); lanes += 3) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes);
        struct pel_scene *scene =
            test_load_scene("live.json", scene_text, scene_is_small() ? "render.size=[8,6]" : NULL);
        struct pel_render_statistics statistics;
        pel_image_destroy(judge_render(renderer, scene, &statistics, "live"));
        assert_true(statistics.samples > 0);
        pel_scene_destroy(scene);
        pel_renderer_destroy(renderer);
    }
}

// Baked in the scene, it is the volume that pel_renderer_bake makes; and the finer its grid, the
// closer it comes to the live one.
static void test_baked(void **state) {
    (void)state;
    static const char scene_text[] = "{'volumes': [{'hypertexture': {'recipe': " RECIPE
                                     ", 'size': 8, 'type': 'float32'}," LOOK "}]," VIEW "}";
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 0);
    struct pel_scene *scene = test_load_scene("live.json", scene_text, NULL);
    struct pel_image *baked = render_picture(renderer, scene, NULL);
    const struct pel_bake_options options = {.size = 8, .type = PEL_VOXEL_F32};
    struct pel_volume *volume =
        pel_renderer_bake(renderer,
                          "{\"value\": [\"*\", [\"sphere\", 0.5, 0.8], [\"+\", 0.7, [\"*\", 0.3, "
                          "[\"noise\", 2]]]]}",
                          &options);
    assert_non_null(volume);
    const char *path = test_temporary_path("baked.nrrd");
    assert_true(pel_volume_save(volume, path));
    struct pel_scene *file = test_load_scene(
        "live.json", "{'volumes': [{'file': 'baked.nrrd'," LOOK "}]," VIEW "}", NULL);
    struct pel_image *read = render_picture(renderer, file, NULL);
    assert_pictures_equal(baked, read, "baked in a scene, and from a file");
    pel_volume_destroy(volume);
    pel_scene_destroy(file);
    pel_image_destroy(read);

    struct pel_scene *live =
        test_load_scene("live.json", scene_text, "volumes.0.hypertexture.live=true");
    assert_null(live->volumes[0]->voxels);
    struct pel_image *truth = render_picture(renderer, live, NULL);
    double before = picture_compare(baked, truth, 0).greatest;
    assert_true(before > 1);
    static const char *const sizes[] = {"volumes.0.hypertexture.size=16",
                                        "volumes.0.hypertexture.size=32"};
    for (int i = 0; i < (scene_is_small() ? 1 : 2); i++) {
        struct pel_scene *finer = test_load_scene("live.json", scene_text, sizes[i]);
        struct pel_image *picture = render_picture(renderer, finer, NULL);
        double now = picture_compare(picture, truth, 0).greatest;
        if (!(now < 0.6 * before))
            fail_msg("%s: off by %g of 255, after %g", sizes[i], now, before);
        before = now;
        pel_image_destroy(picture);
        pel_scene_destroy(finer);
    }
    pel_image_destroy(baked);
    pel_image_destroy(truth);
    pel_scene_destroy(scene);
    pel_scene_destroy(live);
    pel_renderer_destroy(renderer);
}

// Time is a number in a recipe: nothing else is sent.
static void test_time(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 0);
    struct pel_scene *scene = test_load_scene(
        "live.json",
        "{'volumes': [{'generate': {'kind': 'box', 'size': 40}, 'density': 0.1},"
        " {'hypertexture': {'recipe': {'value': ['+', 'radius', 'time']}, 'live': true,"
        "  'size': 8}," LOOK "}]," VIEW ", 'animation': {'frames': 3, 'tracks': ["
        " {'key': 'volumes.1.hypertexture.time', 'values': [0, -1]}]}}",
        NULL);
    struct pel_render_statistics statistics;
    struct pel_image *first = render_picture(renderer, scene, &statistics);
    assert_true(statistics.uploaded_bytes > 40 * 40 * 40);
    assert_true(pel_scene_set_frame(scene, 2));
    struct pel_image *last = render_picture(renderer, scene, &statistics);
    assert_true(statistics.uploaded_bytes <= 4096);
    assert_true(picture_compare(first, last, 8).beyond_count > 8);
    pel_image_destroy(first);
    pel_image_destroy(last);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reference),
        cmocka_unit_test(test_baked),
        cmocka_unit_test(test_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
