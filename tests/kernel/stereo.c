// stereo.c - two eyes of one renderer: what they see, what they cost, and what they must not
// change.
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

static void render_eyes(struct pel_renderer *renderer, const struct pel_scene *scene,
                        struct pel_render_statistics *statistics, struct pel_image *eyes[2]) {
    if (!pel_renderer_render_eyes(renderer, scene, NULL, statistics, eyes))
        fail_msg("%s", pel_error_message());
}

static void destroy_eyes(struct pel_image *eyes[2]) {
    pel_image_destroy(eyes[0]);
    pel_image_destroy(eyes[1]);
}

// Every eye against the reference, and the picture against what they compose.
static void test_eyes(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_HALF_COLOUR_RED_CYAN);
    pel_image_destroy(judge_render(renderer, scene, NULL, "parallel"));
    scene->stereo.toe_in = true;
    scene->stereo.kind = PEL_STEREO_TOP_BOTTOM;
    pel_image_destroy(judge_render(renderer, scene, NULL, "toe-in"));
    scene_view_parallel(scene, 40);
    pel_image_destroy(judge_render(renderer, scene, NULL, "orthographic"));
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Without separation both eyes are the single picture, bit for bit.
static void test_flat(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_TWO_FILES);
    struct pel_image *eyes[2];
    scene->stereo.flat = true;
    render_eyes(renderer, scene, NULL, eyes);
    scene->stereo.kind = PEL_STEREO_NONE;
    struct pel_image *single = render_picture(renderer, scene, NULL);
    assert_pictures_equal(eyes[0], single, "left");
    assert_pictures_equal(eyes[1], single, "right");
    destroy_eyes(eyes);
    scene->stereo.kind = PEL_STEREO_CHECKERBOARD;
    struct pel_image *woven = render_picture(renderer, scene, NULL);
    assert_pictures_equal(woven, single, "checkerboard");
    pel_image_destroy(woven);
    pel_image_destroy(single);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void test_swap(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_TWO_FILES);
    struct pel_image *eyes[2], *swapped[2];
    render_eyes(renderer, scene, NULL, eyes);
    scene->stereo.swap = true;
    render_eyes(renderer, scene, NULL, swapped);
    assert_pictures_equal(swapped[0], eyes[1], "left is right");
    assert_pictures_equal(swapped[1], eyes[0], "right is left");
    // They are two pictures.
    assert_memory_not_equal(eyes[0]->rgba, eyes[1]->rgba,
                            sizeof(float) * 4 * (size_t)eyes[0]->width * (size_t)eyes[0]->height);
    destroy_eyes(eyes);
    destroy_eyes(swapped);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// How far the picture's opacity lies from its left edge, in pixels.
static double centre_of_alpha(const struct pel_image *image) {
    double sum = 0, weighted = 0;
    for (int i = 0; i < image->width * image->height; i++) {
        sum += image->rgba[4 * i + 3];
        weighted += image->rgba[4 * i + 3] * (i % image->width + 0.5);
    }
    assert_true(sum > 0);
    return weighted / sum;
}

// The left eye sees a near cube further right, a far one further left, and one at the convergence
// distance in the same place.
static void test_signs(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    int height = scene_is_small() ? 24 : 48;
    for (int place = -1; place <= 1; place++) {
        struct pel_scene *scene = scene_create(height * 4 / 3, height);
        struct pel_instance *cube =
            scene_add(scene, scene_volume_constant((int[]){6, 6, 6}, PEL_VOXEL_U8, 1),
                      scene_transfer_constant((double[]){1, 1, 1, 0.5}));
        cube->transform.m[2][3] = 25 * place;
        scene->stereo = (struct pel_stereo){
            .kind = PEL_STEREO_TWO_FILES, .separation_mm = 10, .convergence_mm = 100};
        struct pel_image *eyes[2];
        render_eyes(renderer, scene, NULL, eyes);
        double disparity_px = centre_of_alpha(eyes[0]) - centre_of_alpha(eyes[1]);
        // The picture is 40 mm high at 100 mm; 10 mm * 100 * (1/z - 1/100) there.
        double expected_px = 10 * 100 * (1 / (100.0 - 25 * place) - 0.01) * height / 40;
        // The cube's edges lie on whole pixels, in both eyes.
        assert_float_equal(disparity_px, expected_px, 1);
        destroy_eyes(eyes);
        pel_scene_destroy(scene);
    }
    pel_renderer_destroy(renderer);
}

// Everything is sent once, a picture again sends nothing, another view both cameras; and both eyes
// are accounted for.
static void test_statistics(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_DUBOIS_RED_CYAN);
    struct pel_render_statistics first, again;
    pel_image_destroy(render_picture(renderer, scene, &first));
    pel_image_destroy(render_picture(renderer, scene, &again));
    assert_true(first.uploaded_bytes > 1024);
    assert_int_equal(again.uploaded_bytes, 0);
    scene->camera.eye[0] += 1;
    pel_image_destroy(render_picture(renderer, scene, &again));
    assert_in_range(again.uploaded_bytes, 1, 1024);
    size_t pixels = (size_t)scene->render.width * (size_t)scene->render.height;
    assert_int_equal(again.rays, 2 * pixels);
    assert_int_equal(again.samples, again.stereo.eye_samples[0] + again.stereo.eye_samples[1]);
    assert_true(again.stereo.eye_samples[0] > 0 && again.stereo.eye_samples[1] > 0);
    assert_true(again.stereo.separation_mm > 0 && again.stereo.convergence_mm > 0);
    scene->stereo.kind = PEL_STEREO_NONE;
    pel_image_destroy(render_picture(renderer, scene, &again));
    assert_int_equal(again.rays, pixels);
    assert_true(again.stereo.separation_mm == 0 && again.stereo.eye_samples[1] == 0);
    // Half the rays of both eyes are half the samples, but for chance.
    scene->stereo.kind = PEL_STEREO_ROW_INTERLACED;
    pel_image_destroy(render_picture(renderer, scene, &again));
    assert_int_equal(again.rays, pixels);
    assert_in_range(again.samples, first.samples * 9 / 20, first.samples * 11 / 20);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

struct watched {
    double last;
    bool stop;
};

static bool watch(double finished, void *user) {
    struct watched *watched = user;
    assert_true(finished >= watched->last && finished <= 1);
    watched->last = finished;
    return !(watched->stop && finished > 0.5);
}

// Progress goes on from one eye to the other, and a frame abandoned in the second eye leaves none.
static void test_progress(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = scene_stereo(PEL_STEREO_TWO_FILES);
    struct watched watched = {0};
    struct pel_render_options options = {.progress = watch, .user = &watched};
    struct pel_image *eyes[2];
    assert_true(pel_renderer_render_eyes(renderer, scene, &options, NULL, eyes));
    assert_float_equal(watched.last, 1, 0);
    destroy_eyes(eyes);
    watched = (struct watched){.stop = true};
    assert_false(pel_renderer_render_eyes(renderer, scene, &options, NULL, eyes));
    assert_true(!eyes[0] && !eyes[1]);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_eyes),       cmocka_unit_test(test_flat),
        cmocka_unit_test(test_swap),       cmocka_unit_test(test_signs),
        cmocka_unit_test(test_statistics), cmocka_unit_test(test_progress),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
