// eyes.c - one launch of two eyes makes the pictures of two launches, bit for bit, and the colours
// that glasses make of them.
#include <math.h>

#include "reference/stereo.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

static void destroy_eyes(struct pel_image *eyes[2]) {
    pel_image_destroy(eyes[0]);
    pel_image_destroy(eyes[1]);
}

// What one camera sees, by itself.
static struct pel_image *render_alone(struct pel_renderer *renderer, const struct pel_scene *scene,
                                      int eye) {
    struct pel_camera cameras[2];
    assert_true(pel_stereo_cameras(scene, cameras, NULL));
    struct pel_scene alone = *scene;
    alone.stereo.kind = PEL_STEREO_NONE;
    alone.camera = cameras[eye];
    return render_picture(renderer, &alone, NULL);
}

// One launch of both eyes makes the pictures that each camera makes by itself, and an interlaced
// picture, of which only the rays that are shown are followed, is what they compose.
static void compare_with_alone(struct pel_renderer *renderer, struct pel_scene *scene,
                               size_t kind_count, const char *what) {
    static const enum pel_stereo_kind kinds[] = {
        PEL_STEREO_TWO_FILES,    PEL_STEREO_ROW_INTERLACED, PEL_STEREO_COLOUR_RED_CYAN,
        PEL_STEREO_CHECKERBOARD, PEL_STEREO_SIDE_BY_SIDE,   PEL_STEREO_COLUMN_INTERLACED,
        PEL_STEREO_TOP_BOTTOM};
    struct pel_image *alone[2] = {render_alone(renderer, scene, 0),
                                  render_alone(renderer, scene, 1)};
    for (size_t k = 0; k < kind_count; k++) {
        scene->stereo.kind = kinds[k];
        struct pel_image *expected = pel_stereo_compose(&scene->stereo, alone[0], alone[1]);
        assert_non_null(expected);
        struct pel_image *picture = render_picture(renderer, scene, NULL);
        judge_composed(picture, expected, kinds[k], what);
        pel_image_destroy(picture);
        pel_image_destroy(expected);
    }
    destroy_eyes(alone);
}

static void test_one_launch(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_TWO_FILES);
    scene->render.width -= 3; // tiles and packets that reach beyond the edges
    scene->render.height -= 1;
    compare_with_alone(renderer, scene, 7, "one ray");
    // What else a frame can be asked for, with two pictures, a woven and a merged one.
    size_t kind_count = scene_is_small() ? 2 : 3;
    scene->render.supersampling = (struct pel_supersampling){
        .n = 2, .pattern = PEL_PATTERN_JITTERED, .filter = PEL_RECONSTRUCTION_GAUSSIAN, .seed = 5};
    compare_with_alone(renderer, scene, kind_count, "Gaussian");
    scene->render.supersampling.filter = PEL_RECONSTRUCTION_BOX;
    compare_with_alone(renderer, scene, kind_count, "box");
    scene->render.supersampling.adaptive = 0.05;
    compare_with_alone(renderer, scene, kind_count, "adaptive");
    scene->render.supersampling = (struct pel_supersampling){0};
    scene->render.debug = PEL_DEBUG_SAMPLES;
    compare_with_alone(renderer, scene, kind_count, "debug");
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Every pixel of every anaglyph against the formula, over a background that lets through.
static void test_glasses(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_TWO_FILES);
    memcpy(scene->background, (double[]){0.02, 0.3, 0.9, 0.25}, sizeof scene->background);
    struct pel_image *eyes[2];
    assert_true(pel_renderer_render_eyes(renderer, scene, NULL, NULL, eyes));
    for (int row = 0; row < 3;
         row++) // too bright in red and below nothing in green, here and there
        for (int column = 0; column < 6; column++)
            scene->stereo.matrix[row][column] = row == 0 ? 0.5 : row == 1 ? column - 2.5 : 1.0 / 6;
    for (int kind = PEL_STEREO_MATRIX; kind >= PEL_STEREO_TRUE_RED_CYAN;
         kind -= scene_is_small() ? 4 : 1) {
        scene->stereo.kind = (enum pel_stereo_kind)kind;
        struct pel_image *picture = render_picture(renderer, scene, NULL);
        for (int i = 0; i < picture->width * picture->height; i++) {
            double seen[2][4], expected[4];
            for (int n = 0; n < 8; n++)
                seen[n / 4][n % 4] = eyes[n / 4]->rgba[4 * i + n % 4];
            reference_anaglyph(expected, &scene->stereo, seen[0], seen[1]);
            for (int c = 0; c < 4; c++)
                if (!(fabs(picture->rgba[4 * i + c] - expected[c]) < 1e-5))
                    fail_msg("%s: channel %d of pixel %d is %g, not %g", pel_stereo_names()[kind],
                             c, i, picture->rgba[4 * i + c], expected[c]);
        }
        pel_image_destroy(picture);
    }
    destroy_eyes(eyes);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Two eyes that see nothing.
static void test_nothing(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_GREY_RED_CYAN);
    memcpy(scene->background, (double[]){1, 0, 0, 1}, sizeof scene->background);
    for (int k = 0; k < scene->instance_count; k++)
        scene->instances[k].hidden = true;
    struct pel_image *picture = render_picture(renderer, scene, NULL);
    for (int c = 0; c < 3; c++) // light 0.299 of red
        assert_float_equal(picture->rgba[c], 0.582943, 1e-5);
    pel_image_destroy(picture);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_launch),
        cmocka_unit_test(test_glasses),
        cmocka_unit_test(test_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
