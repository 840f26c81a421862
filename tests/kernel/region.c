// region.c - a part of a picture is cut out of the whole: the same pixels, to the last bit on the
// same device, whatever they take from their neighbours or from their place in the picture.
#include <string.h>

#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

enum { WIDTH = 24, HEIGHT = 18 };

// Corners, edges and the middle, at odd places.
static const int regions[][4] = {{0, 0, 7, 5}, {5, 3, 11, 9}, {17, 13, 7, 5}, {0, 7, 24, 1}};

static struct pel_image *cut(const struct pel_image *whole, const int region[4]) {
    struct pel_image *part = pel_image_create(region[2], region[3]);
    for (int y = 0; y < region[3]; y++)
        memcpy(part->rgba + 4 * y * region[2],
               whole->rgba + 4 * ((region[1] + y) * whole->width + region[0]),
               4 * (size_t)region[2] * sizeof(float));
    return part;
}

static void check_regions(struct pel_renderer *renderer, struct pel_scene *scene,
                          const char *title) {
    struct pel_image *whole = render_picture(renderer, scene, NULL);
    for (size_t i = 0; i < sizeof regions / sizeof *regions; i++) {
        memcpy(scene->render.region, regions[i], sizeof scene->render.region);
        struct pel_image *part = render_picture(renderer, scene, NULL),
                         *expected = cut(whole, regions[i]);
        assert_pictures_within(part, expected, 0, 0, title);
        pel_image_destroy(part);
        pel_image_destroy(expected);
    }
    memset(scene->render.region, 0, sizeof scene->render.region);
    pel_image_destroy(whole);
}

static void test_plain(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    check_regions(renderer, scene, "plain");
    scene->instances[0].hidden = true;
    check_regions(renderer, scene, "background");
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Rows, columns and squares of both eyes lie where they lie in the whole.
static void test_interlaced(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    scene->stereo.separation_mm = 2;
    for (int kind = PEL_STEREO_ROW_INTERLACED; kind <= PEL_STEREO_CHECKERBOARD; kind++) {
        scene->stereo.kind = (enum pel_stereo_kind)kind;
        check_regions(renderer, scene, pel_stereo_names()[kind]);
    }
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Random patterns, rays where there is contrast, and light from the pixels around.
static void test_supersampled(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    scene->render.jitter = true;
    scene->render.supersampling = (struct pel_supersampling){.n = 2,
                                                             .pattern = PEL_PATTERN_MULTI_JITTERED,
                                                             .filter = PEL_RECONSTRUCTION_GAUSSIAN,
                                                             .seed = 7,
                                                             .adaptive = 0.05};
    check_regions(renderer, scene, "supersampled");
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void render_eyes(struct pel_renderer *renderer, const struct pel_scene *scene,
                        struct pel_image *eyes[2]) {
    if (!pel_renderer_render_eyes(renderer, scene, NULL, NULL, eyes))
        fail_msg("%s", pel_error_message());
}

static void destroy_eyes(struct pel_image *eyes[2]) {
    pel_image_destroy(eyes[0]);
    pel_image_destroy(eyes[1]);
}

// In a debug view each eye has a frame of its own, of the region's size. Without stereo both see
// the same.
static void test_eyes_in_debug_views(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    struct pel_image *eyes[2];
    scene->render.debug = PEL_DEBUG_SAMPLES;
    memcpy(scene->render.region, regions[1], sizeof scene->render.region);
    struct pel_image *one = render_picture(renderer, scene, NULL);
    render_eyes(renderer, scene, eyes);
    for (int i = 0; i < 2; i++)
        assert_pictures_equal(eyes[i], one, "an eye of a debug view");
    destroy_eyes(eyes);
    pel_image_destroy(one);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// One ray through a pixel's centre looks at no neighbours, whatever is said of contrast.
static void test_reprojected(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    struct pel_image *eyes[2], *others[2];
    scene->stereo =
        (struct pel_stereo){.kind = PEL_STEREO_TWO_FILES, .separation_mm = 2, .reproject = true};
    memcpy(scene->render.region, regions[1], sizeof scene->render.region);
    render_eyes(renderer, scene, eyes);
    scene->render.supersampling.adaptive = 0.05;
    render_eyes(renderer, scene, others);
    for (int i = 0; i < 2; i++)
        assert_pictures_equal(others[i], eyes[i], "a reprojected eye");
    destroy_eyes(eyes);
    destroy_eyes(others);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void test_refused(void **state) {
    (void)state;
    static const int bad[][4] = {{0, 0, 25, 1}, {24, 0, 1, 1}, {-1, 0, 2, 2}, {0, 0, 0, 4}, {3}};
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_waves(WIDTH, HEIGHT);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        memcpy(scene->render.region, bad[i], sizeof scene->render.region);
        assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
        assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
        assert_non_null(strstr(pel_error_message(), "is not inside the picture of 24 x 18"));
    }
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plain),        cmocka_unit_test(test_interlaced),
        cmocka_unit_test(test_supersampled), cmocka_unit_test(test_eyes_in_debug_views),
        cmocka_unit_test(test_reprojected),  cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
