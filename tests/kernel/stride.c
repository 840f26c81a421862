// stride.c - adaptive steps on the device, against the reference and the analytic truth, the same
// whatever is skipped and however many rays share a packet.
#include <math.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/near.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

// Two volumes of waves across each other, of which much is thin.
static struct pel_scene *scene_of_two(void) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 10 : 24, small ? 6 : 16);
    const int dims[3] = {30, 26, 28};
    const double range[2] = {100, 255}, spacing[3] = {0.8, 0.9, 0.8};
    struct pel_volume *first = scene_volume_waves(dims, PEL_VOXEL_U8, 5, 25);
    struct pel_volume *second = scene_volume_waves(dims, PEL_VOXEL_U8, 6, 30);
    scene_place(first, spacing, (double[]){0.1, 0.3, -0.2, 0.92}, (double[]){-3, 1, 0}, false);
    scene_place(second, spacing, (double[]){0.5, -0.2, 0.1, 0.8}, (double[]){4, 0, 2}, false);
    scene_add(scene, first, scene_transfer_gentle(range, 0.2, 11));
    scene_add(scene, second, scene_transfer_gentle(range, 0.3, 12));
    scene->render.adaptive_step = 0.1;
    return scene;
}

// However it lies and whatever the runs of its samples, a box of one colour hides what its length
// says: no length is lost or counted twice where runs are cut off.
static void test_lengths(void **state) {
    (void)state;
    const double colour[4] = {1, 0.5, 0.2, 0.05};
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_create(12, 8);
    scene_view_parallel(scene, 9);
    scene_add(scene, scene_volume_constant((int[]){31, 29, 33}, PEL_VOXEL_U8, 200),
              scene_transfer_constant(colour));
    scene->render.step_mm = 0.5;
    for (int n = 0; n < 8; n += scene_is_small() ? 3 : 1) {
        struct pel_render_statistics even, strided;
        // A plane ends the box a step earlier each time.
        scene->clips[0] = (struct pel_clip){.point = {0, 0, -10 + 0.5 * n}, .normal = {0, 0, 1}};
        scene->clip_count = 1;
        scene->render.adaptive_step = 0;
        pel_image_destroy(render_picture(renderer, scene, &even));
        scene->render.adaptive_step = 1e-3;
        struct pel_image *picture = judge_render(renderer, scene, &strided, "box");
        for (int i = 0; i < 12 * 8; i++)
            assert_near(picture->rgba[4 * i + 3], 1 - pow(1 - colour[3], 26.5 - 0.5 * n), 2e-6);
        pel_image_destroy(picture);
        assert_true(strided.samples < even.samples / 3);
        assert_int_equal(strided.samples + strided.samples_spared, even.samples);
    }
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Every way to skip, every number of lanes and both readers have one picture.
static void test_ways(void **state) {
    (void)state;
    static const enum pel_skip skips[] = {PEL_SKIP_NONE, PEL_SKIP_OCTREE, PEL_SKIP_DISTANCE,
                                          PEL_SKIP_BLOCKS};
    struct pel_scene *scene = scene_of_two();
    struct pel_renderer *rays = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_renderer *packets = judge_renderer(PEL_READER_BUFFER, judge_packet_lanes());
    struct pel_renderer *images = judge_renderer(PEL_READER_IMAGE, 1);
    struct pel_render_statistics even, statistics;
    struct pel_image *first = NULL;
    scene->render.adaptive_step = 0;
    scene->render.skip = PEL_SKIP_NONE;
    pel_image_destroy(render_picture(packets, scene, &even));
    scene->render.adaptive_step = 0.1;
    for (int n = 0; n < 4; n += scene_is_small() ? 2 : 1) {
        scene->render.skip = skips[n];
        struct pel_image *picture =
            judge_render(n % 2 ? rays : packets, scene, &statistics, "ways");
        uint64_t all = statistics.samples + statistics.samples_skipped + statistics.samples_spared;
        assert_int_equal(all, even.samples);
        if (n == 0) {
            assert_true(statistics.samples_spared > even.samples / 20);
            first = picture;
            continue;
        }
        assert_pictures_within(picture, first, 0.02, 0, "skipped");
        pel_image_destroy(picture);
    }
    if (judge_has_images(images, scene))
        pel_image_destroy(judge_render(images, scene, NULL, "images"));
    pel_image_destroy(first);
    pel_scene_destroy(scene);
    pel_renderer_destroy(rays);
    pel_renderer_destroy(packets);
    pel_renderer_destroy(images);
}

// With other features in one picture: mixing, clips, masks, shading, models beside absorption.
static void test_company(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    scene->render.mixing = PEL_MIX_OVER;
    scene->instances[0].material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    scene->instances[1].filter = PEL_FILTER_CATMULL_ROM;
    scene->clips[0] = (struct pel_clip){.point = {-3.03, 0, 0}, .normal = {1, 0.4, -0.2}};
    scene->clip_count = 1;
    pel_image_destroy(judge_render(renderer, scene, NULL, "over, shaded, clipped"));
    scene->render.mixing = PEL_MIX_INTERSECTION;
    scene->instances[0].material.shading = PEL_SHADING_NONE;
    scene->instances[1].filter = PEL_FILTER_LINEAR;
    scene->instances[1].mask =
        (struct pel_mask){.instance = 0, .range_count = 1, .ranges = {{90, 255}}};
    pel_image_destroy(judge_render(renderer, scene, NULL, "intersection, masked"));
    scene->render.mixing = PEL_MIX_SUM;
    scene->clip_count = 0;
    scene->instances[1].mask.range_count = 0;
    scene->instances[1].model = PEL_MODEL_ISO;
    scene->instances[1].surface_count = 1;
    scene->instances[1].surfaces[0] = (struct pel_surface){.value = 130, .opacity = 0.4};
    // Oclgrind has no word for what its compiler makes of this.
    if (!scene_is_small())
        pel_image_destroy(judge_render(renderer, scene, NULL, "beside a surface"));
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// The finer the depth, the nearer is the picture to that of even steps.
static void test_convergence(void **state) {
    (void)state;
    if (scene_is_small())
        skip();
    struct pel_scene *scene = scene_of_two();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, judge_packet_lanes());
    struct pel_image *pictures[4];
    double errors[4] = {0};
    for (int n = 0; n < 4; n++) {
        scene->render.adaptive_step = n == 0 ? 0 : 0.5 * pow(0.2, n);
        pictures[n] = render_picture(renderer, scene, NULL);
        for (int i = 0; i < 4 * pictures[n]->width * pictures[n]->height; i++)
            errors[n] =
                fmax(errors[n], fabs((double)pictures[n]->rgba[i] - (double)pictures[0]->rgba[i]));
    }
    assert_true(errors[1] > 0 && errors[1] < 0.02);
    assert_true(errors[2] < errors[1] && errors[3] < 0.5 * errors[2]);
    for (int n = 0; n < 4; n++)
        pel_image_destroy(pictures[n]);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void test_refusals(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    scene->render.adaptive_step = -0.5;
    render_refused(renderer, scene, "adaptive steps for a depth of -0.5, must be at least 0");
    scene->render.adaptive_step = 0.5;
    scene->render.mixing = PEL_MIX_ORDERED;
    render_refused(renderer, scene,
                   "adaptive steps are those of all volumes together, and with mixing ordered each "
                   "has its own");
    scene->render.mixing = PEL_MIX_SUM;
    scene->render.order = PEL_ORDER_BACK_TO_FRONT;
    render_refused(renderer, scene, "adaptive steps go from front to back only");
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lengths),  cmocka_unit_test(test_ways),
        cmocka_unit_test(test_company),  cmocka_unit_test(test_convergence),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
