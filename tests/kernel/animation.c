// animation.c - frames of one renderer: each is the picture of a still scene with the same values,
// and nothing but what changed travels to the device for it.
#include "shared/world.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scene_file.h"
#include "support/scenes.h"

#define SCENE                                                                                      \
    "{'volumes': [{'generate': {'kind': 'head-ct', 'size': 16}, 'transfer': 'ct-bone'}],"          \
    " 'render': {'size': [24, 16], 'step': 1}, 'camera': {'view': 'left'}"

static void test_stills(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *film =
        test_load_scene("film.json",
                        SCENE ", 'animation': {'frames': 5, 'tracks': ["
                              "{'key': 'camera.fov', 'values': [20, 40]},"
                              "{'key': 'clip', 'values': ["
                              "  [{'plane': {'normal': [1, 0, 0], 'point': [-60, 0, 0]}}],"
                              "  [{'plane': {'normal': [1, 0, 0], 'point': [20, 0, 0]}}]]},"
                              "{'key': 'volumes.0.density', 'values': [0.5, 1.5]},"
                              "{'key': 'volumes.0.transform', 'values': ["
                              "  {'rotate': {'axis': 'z', 'degrees': 0}},"
                              "  {'rotate': {'axis': 'z', 'degrees': 90}}]}]}}",
                        NULL);
    static const char *const stills[] = {
        "{'volumes': [{'generate': {'kind': 'head-ct', 'size': 16}, 'transfer': 'ct-bone',"
        "  'density': 0.75, 'transform': {'rotate': {'axis': 'z', 'degrees': 22.5}}}],"
        " 'render': {'size': [24, 16], 'step': 1}, 'camera': {'view': 'left', 'fov': 25},"
        " 'clip': [{'plane': {'normal': [1, 0, 0], 'point': [-40, 0, 0]}}]}",
        "{'volumes': [{'generate': {'kind': 'head-ct', 'size': 16}, 'transfer': 'ct-bone',"
        "  'density': 1.25, 'transform': {'rotate': {'axis': 'z', 'degrees': 67.5}}}],"
        " 'render': {'size': [24, 16], 'step': 1}, 'camera': {'view': 'left', 'fov': 35},"
        " 'clip': [{'plane': {'normal': [1, 0, 0], 'point': [0, 0, 0]}}]}"};
    struct pel_image *first = NULL;
    for (int frame = 1; frame < 4; frame += 2) {
        struct pel_scene *still = test_load_scene("still.json", stills[frame / 2], NULL);
        assert_true(pel_scene_set_frame(film, frame));
        struct pel_image *moving = render_picture(renderer, film, NULL);
        struct pel_image *standing = render_picture(renderer, still, NULL);
        assert_pictures_equal(moving, standing, "a frame and a still");
        // And the frames do differ.
        if (first)
            assert_true(picture_compare(first, moving, 8).beyond_count > 8);
        pel_image_destroy(standing);
        pel_image_destroy(first);
        first = moving;
        pel_scene_destroy(still);
    }
    pel_image_destroy(first);
    pel_scene_destroy(film);
    pel_renderer_destroy(renderer);
}

// An orbit sends a camera per frame.
static void test_uploads(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *film = test_load_scene(
        "film.json", SCENE ", 'animation': {'frames': 8, 'tracks': [{'orbit': {}}]}}", NULL);
    for (int frame = 0; frame < 4; frame++) {
        struct pel_render_statistics statistics;
        assert_true(pel_scene_set_frame(film, frame));
        pel_image_destroy(render_picture(renderer, film, &statistics));
        if (frame > 0)
            assert_int_equal(statistics.uploaded_bytes, sizeof(struct camera));
    }
    pel_scene_destroy(film);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stills),
        cmocka_unit_test(test_uploads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
