// animation.c - frames of one renderer: each is the picture of a still scene with the same values,
// and nothing but what changed travels to the device for it.
#include "shared/world.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/scene_file.h"
#include "support/scenes.h"

#define SCENE                                                                                      \
    "{'volumes': [{'generate': {'kind': 'head-ct', 'size': 16}, 'transfer': 'ct-bone'}],"          \
    " 'render': {'size': [24, 16], 'step': 1}, 'camera': {'view': 'left'}"

static struct pel_scene *load(const char *leaf, const char *quoted) {
    struct pel_scene *scene = pel_scene_load(test_write_scene(leaf, quoted), NULL, 0);
    if (!scene)
        fail_msg("%s", pel_error_message());
    return scene;
}

static struct pel_image *render(struct pel_renderer *renderer, struct pel_scene *scene,
                                uint64_t *uploaded_bytes) {
    struct pel_render_statistics statistics;
    struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, &statistics);
    if (!picture)
        fail_msg("%s", pel_error_message());
    *uploaded_bytes = statistics.uploaded_bytes;
    return picture;
}

static void test_stills(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *film =
        load("film.json", SCENE ", 'animation': {'frames': 5, 'tracks': ["
                                "{'key': 'camera.fov', 'values': [20, 40]},"
                                "{'key': 'volumes.0.density', 'values': [0.5, 1.5]},"
                                "{'key': 'volumes.0.transform', 'values': ["
                                "  {'rotate': {'axis': 'z', 'degrees': 0}},"
                                "  {'rotate': {'axis': 'z', 'degrees': 90}}]}]}}");
    static const char *const stills[] = {
        "{'volumes': [{'generate': {'kind': 'head-ct', 'size': 16}, 'transfer': 'ct-bone',"
        "  'density': 0.75, 'transform': {'rotate': {'axis': 'z', 'degrees': 22.5}}}],"
        " 'render': {'size': [24, 16], 'step': 1}, 'camera': {'view': 'left', 'fov': 25}}",
        "{'volumes': [{'generate': {'kind': 'head-ct', 'size': 16}, 'transfer': 'ct-bone',"
        "  'density': 1.25, 'transform': {'rotate': {'axis': 'z', 'degrees': 67.5}}}],"
        " 'render': {'size': [24, 16], 'step': 1}, 'camera': {'view': 'left', 'fov': 35}}"};
    struct pel_image *first = NULL;
    for (int frame = 1; frame < 4; frame += 2) {
        uint64_t uploaded_bytes;
        struct pel_scene *still = load("still.json", stills[frame / 2]);
        assert_true(pel_scene_set_frame(film, frame));
        struct pel_image *moving = render(renderer, film, &uploaded_bytes);
        struct pel_image *standing = render(renderer, still, &uploaded_bytes);
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
    struct pel_scene *film =
        load("film.json", SCENE ", 'animation': {'frames': 8, 'tracks': [{'orbit': {}}]}}");
    for (int frame = 0; frame < 4; frame++) {
        uint64_t uploaded_bytes;
        assert_true(pel_scene_set_frame(film, frame));
        pel_image_destroy(render(renderer, film, &uploaded_bytes));
        if (frame > 0)
            assert_int_equal(uploaded_bytes, sizeof(struct camera));
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
