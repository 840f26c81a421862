// eyes.c - one launch of two eyes makes the pictures of two launches, bit for bit.
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
                               const char *what) {
    static const enum pel_stereo_kind kinds[] = {
        PEL_STEREO_TWO_FILES, PEL_STEREO_ROW_INTERLACED, PEL_STEREO_COLUMN_INTERLACED,
        PEL_STEREO_CHECKERBOARD, PEL_STEREO_COLOUR_RED_CYAN};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        scene->stereo.kind = kinds[k];
        struct pel_image *alone[2] = {render_alone(renderer, scene, 0),
                                      render_alone(renderer, scene, 1)};
        struct pel_image *expected = pel_stereo_compose(&scene->stereo, alone[0], alone[1]);
        assert_non_null(expected);
        struct pel_image *picture = render_picture(renderer, scene, NULL);
        assert_pictures_equal(picture, expected, what);
        pel_image_destroy(picture);
        pel_image_destroy(expected);
        destroy_eyes(alone);
    }
}

static void test_one_launch(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_TWO_FILES);
    scene->render.width -= 3; // tiles and packets that reach beyond the edges
    scene->render.height -= 1;
    compare_with_alone(renderer, scene, "one ray");
    scene->render.supersampling = (struct pel_supersampling){
        .n = 2, .pattern = PEL_PATTERN_JITTERED, .filter = PEL_RECONSTRUCTION_GAUSSIAN, .seed = 5};
    compare_with_alone(renderer, scene, "Gaussian");
    scene->render.supersampling.filter = PEL_RECONSTRUCTION_BOX;
    compare_with_alone(renderer, scene, "box");
    scene->render.supersampling.adaptive = 0.05;
    compare_with_alone(renderer, scene, "adaptive");
    scene->render.supersampling = (struct pel_supersampling){0};
    scene->render.debug = PEL_DEBUG_SAMPLES;
    compare_with_alone(renderer, scene, "debug");
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_launch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
