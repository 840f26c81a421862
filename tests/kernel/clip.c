// clip.c - clipped volumes against the reference and the analytic truth, by rays and by packets,
// from buffers and from images.
#include "base/math.h"
#include "support/judge.h"
#include "support/near.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

static const double red[4] = {1, 0.2, 0, 0.1};

// A box of one colour, 16 mm wide, seen along z.
static struct pel_scene *scene_of_box(void) {
    struct pel_scene *scene = scene_create(8, 8);
    scene_view_parallel(scene, 12);
    struct pel_volume *volume = scene_volume_constant((int[]){16, 16, 16}, PEL_VOXEL_U8, 100);
    scene_add(scene, volume, scene_transfer_constant(red));
    scene->render.step = 0.25;
    return scene;
}

static double opacity_of(double length_mm) {
    return 1 - exp(length_mm * log(1 - red[3]));
}

// The opacity in the middle of the picture.
static double middle(struct pel_renderer *renderer, const struct pel_scene *scene,
                     struct pel_render_statistics *statistics) {
    struct pel_image *picture = judge_render(renderer, scene, statistics, "box");
    double opacity = (double)picture->rgba[4 * (4 * 8 + 4) + 3];
    pel_image_destroy(picture);
    return opacity;
}

static void test_chords(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of_box();
    struct pel_render_statistics whole, half, moved;
    assert_near(middle(renderer, scene, &whole), opacity_of(16), 1e-5);
    // The clip's first frame sends more room for it; then moving it sends the world alone.
    scene->clip_count = 1;
    scene->clips[0] = (struct pel_clip){.normal = {0, 0, 3}, .point = {0, 0, -4.1}};
    assert_near(middle(renderer, scene, &half), opacity_of(12), 1e-5);
    assert_true(half.samples < whole.samples * 4 / 5);
    scene->clips[0].point[2] = 3.9;
    assert_near(middle(renderer, scene, &moved), opacity_of(4), 1e-5);
    assert_true(moved.uploaded_bytes <= 8192);
    // Behind the plane is what it left before.
    scene->clips[0].outside = true;
    assert_near(middle(renderer, scene, NULL), opacity_of(12), 1e-5);
    // A box keeps a length, or cuts it out.
    scene->clips[0] = (struct pel_clip){
        .kind = PEL_CLIP_BOX, .size = {30, 30, 5}, .point = {0, 0, 1.1}, .xyzw = {0, 0, 0.6, 0.8}};
    assert_near(middle(renderer, scene, NULL), opacity_of(5), 1e-5);
    scene->clips[0].outside = true;
    assert_near(middle(renderer, scene, NULL), opacity_of(11), 1e-5);
    // With the volume a clip moves, unless it is to stay.
    scene->instances[0].clips[0] = scene->clips[0];
    scene->instances[0].clip_count = 1;
    scene->clip_count = 0;
    scene->instances[0].transform.m[2][3] = 8;
    assert_near(middle(renderer, scene, NULL), opacity_of(11), 1e-5);
    scene->instances[0].clips[0].in_world = true;
    scene->instances[0].transform.m[2][3] = 9.1;
    assert_near(middle(renderer, scene, NULL), opacity_of(16 - 2.5), 1e-5);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Two waves across each other, clipped every way there is.
static struct pel_scene *scene_of_waves(void) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 12 : 32, small ? 8 : 24);
    scene_add_crossing(scene);
    for (int k = 0; k < 2; k++) {
        struct pel_instance *instance = &scene->instances[k];
        instance->clips[0] = (struct pel_clip){.kind = PEL_CLIP_BOX,
                                               .outside = true,
                                               .in_world = k == 1,
                                               .point = {2, 3, 5},
                                               .size = {9, 8, 10},
                                               .xyzw = {0.3, 0.1, -0.2, 0.9}};
        instance->clips[1] =
            (struct pel_clip){.point = {-3.03, 0, 0}, .normal = {1, 0.4, -0.2}, .outside = k};
        instance->clip_count = 2;
    }
    scene->clips[0] = (struct pel_clip){
        .kind = PEL_CLIP_BOX, .size = {15.3, 14.1, 16.7}, .xyzw = {0, 0.2, 0.1, 1}};
    scene->clip_count = 1;
    scene->render.step = small ? 1 : 0.6;
    return scene;
}

static void test_against_reference(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_waves();
    struct pel_renderer *rays = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_renderer *packets = judge_renderer(PEL_READER_BUFFER, judge_packet_lanes());
    struct pel_renderer *images = judge_renderer(PEL_READER_IMAGE, 1);
    scene->render.mixing = PEL_MIX_ORDERED;
    pel_image_destroy(judge_render(rays, scene, NULL, "rays, ordered"));
    scene->render.mixing = PEL_MIX_UNION;
    if (judge_has_images(images, scene))
        pel_image_destroy(judge_render(images, scene, NULL, "images, union"));
    scene->render.mixing = PEL_MIX_SUM;
    scene->instances[1].material.shading = PEL_SHADING_BLINN_PHONG;
    struct pel_image *pictures[2];
    static const enum pel_skip skips[2] = {PEL_SKIP_NONE, PEL_SKIP_DISTANCE};
    for (int n = 0; n < 2; n++) {
        scene->render.skip = skips[n];
        pictures[n] = judge_render(packets, scene, NULL, "packets, sum");
    }
    assert_pictures_within(pictures[1], pictures[0], 0.01, 0, "skipped");
    for (int n = 0; n < 2; n++)
        pel_image_destroy(pictures[n]);
    pel_renderer_destroy(rays);
    pel_renderer_destroy(packets);
    pel_renderer_destroy(images);
    pel_scene_destroy(scene);
}

// What a plane keeps and what it does not, as two instances of one volume, are the whole.
static void test_halves(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_waves();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    scene->clip_count = scene->instances[0].clip_count = 0;
    scene->instances[1].hidden = true;
    struct pel_image *whole = judge_render(renderer, scene, NULL, "whole");
    struct pel_instance *half =
        scene_add_again(scene, 0, pel_transfer_copy(scene->instances[0].transfer));
    struct pel_transfer *transfer = half->transfer;
    *half = scene->instances[0];
    half->transfer = transfer;
    const struct pel_clip plane = {.point = {0.3, 1, -0.7}, .normal = {0.3, -0.7, 0.4}};
    for (int k = 0; k <= 2; k += 2) {
        scene->instances[k].clip_count = 1;
        scene->instances[k].clips[0] = plane;
        scene->instances[k].clips[0].outside = k == 2;
    }
    struct pel_image *halves = judge_render(renderer, scene, NULL, "halves");
    assert_pictures_within(halves, whole, 0.5, 0, "two halves");
    pel_image_destroy(whole);
    pel_image_destroy(halves);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

static void test_refusals(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_box();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    scene->clip_count = 1;
    render_refused(renderer, scene, "clip 0: the normal 0 0 0 has no direction");
    scene->clips[0] = (struct pel_clip){.kind = PEL_CLIP_BOX, .size = {1, 0, 1}};
    render_refused(renderer, scene, "clip 0: a box of 1 x 0 x 1 mm");
    scene->clip_count = 9;
    render_refused(renderer, scene, "9 clips, outside 0..8");
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_chords),
        cmocka_unit_test(test_against_reference),
        cmocka_unit_test(test_halves),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
