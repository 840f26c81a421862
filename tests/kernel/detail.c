// detail.c - levels of detail on the device: against the reference, cheaper and hardly another
// picture where volumes are far away, made once, and that what is wrong is refused.
#include <math.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

// A smooth volume of odd dimensions twice, the second one `far_mm` behind the first. Its waves are
// that many voxels long.
static struct pel_scene *scene_of(double far_mm, double wavelength) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 12 : 24, small ? 8 : 16);
    const int dims[3] = {33, 29, 21};
    struct pel_volume *volume = scene_volume_waves(dims, PEL_VOXEL_U8, 5, wavelength);
    double raw[2];
    scene_raw_range(PEL_VOXEL_U8, raw);
    scene_place(volume, (double[]){0.6, 0.6, 0.9}, (double[]){0.31, -0.42, 0.17, 0.83},
                (double[]){-5, 2, 0}, true);
    scene_add(scene, volume, scene_transfer_gentle(raw, 0.2, 21));
    struct pel_instance *second = scene_add_again(scene, 0, scene_transfer_gentle(raw, 0.1, 22));
    second->transform.m[0][3] = 9 + far_mm / 15;
    second->transform.m[2][3] = -far_mm;
    return scene;
}

// Given levels, with absent voxels, and such as the camera asks for, which differ.
static void test_levels(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(4, 24);
    struct pel_render_statistics statistics;
    scene->render.lod = PEL_LOD_LEVEL;
    for (int level = 0; level <= 3; level += 1 + scene_is_small()) {
        scene->render.lod_level = level;
        pel_image_destroy(judge_render(renderer, scene, &statistics, "level"));
        assert_int_equal(statistics.lod.levels[0], level);
        assert_int_equal(statistics.lod.levels[1], level);
    }
    pel_scene_destroy(scene);

    scene = scene_of(400, 24);
    scene->render.lod = PEL_LOD_AUTO;
    pel_image_destroy(judge_render(renderer, scene, &statistics, "auto"));
    assert_true(statistics.lod.levels[0] < statistics.lod.levels[1]);
    assert_true(statistics.lod.levels[0] >= 1);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A far volume takes a fraction of the memory and of the samples, and looks the same where its
// field is smooth: the mean over a share w of a wave, interpolated, is off by up to (pi w)^2 (1/6 +
// 1/8) of its height, which here is less than a hundredth.
static void test_far(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(0, 72);
    for (int k = 0; k < 2; k++)
        scene->instances[k].transform.m[2][3] = -500;
    scene->render.width = 24;
    scene->render.height = 16;
    scene->camera.fov_deg = 4;
    scene->render.step = 0.125;
    struct pel_render_statistics full, coarse, again;
    struct pel_image *expected = render_picture(renderer, scene, &full);
    scene->render.lod = PEL_LOD_AUTO;
    struct pel_image *picture = render_picture(renderer, scene, &coarse);
    assert_int_equal(full.lod.bytes, 0);
    assert_true(coarse.lod.levels[0] >= 1);
    assert_true(coarse.samples * 3 < full.samples * 2);
    assert_true(coarse.lod.bytes * 4 < 33 * 29 * 21);
    assert_true(coarse.device_bytes < full.device_bytes);
    assert_pictures_within(picture, expected, 5, 0, "far");
    pel_image_destroy(expected);

    // The second frame has it all.
    expected = render_picture(renderer, scene, &again);
    assert_pictures_equal(picture, expected, "again");
    assert_true(again.uploaded_bytes < coarse.uploaded_bytes / 4);
    pel_image_destroy(expected);
    pel_image_destroy(picture);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Every way to skip, and a pool, know the level and not the volume.
static void test_skip(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(4, 24);
    const double points[4][5] = {
        {0, 1, 1, 1, 0}, {200, 1, 1, 1, 0}, {220, 0.5, 0.7, 1, 0.4}, {255, 1, 0.7, 0.5, 0.5}};
    pel_transfer_destroy(scene->instances[0].transfer);
    scene->instances[0].transfer = scene_transfer(points, 4);
    scene->instances[1].hidden = true;
    scene->render.lod = PEL_LOD_LEVEL;
    scene->render.lod_level = 1;
    struct pel_render_statistics statistics;
    for (int n = 0; n < 2; n++) {
        scene->render.skip = n == 0 ? PEL_SKIP_DISTANCE : PEL_SKIP_BVH;
        scene->render.bricks.pool = n == 0 ? PEL_POOL_OFF : PEL_POOL_ON;
        pel_image_destroy(judge_render(renderer, scene, &statistics, n == 0 ? "grid" : "pool"));
        // Bricks are too large for anything to be empty.
        assert_int_equal(statistics.samples_skipped > 0, n == 0);
    }
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Toed-in eyes beside a volume see it from different depths, and both see the level that the nearer
// one needs: in one launch, and in two.
static void test_two_eyes(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(30, 24);
    scene->instances[0].transform.m[0][3] = 60;
    scene->instances[1].transform.m[0][3] = -70;
    scene->render.lod = PEL_LOD_AUTO;
    scene->stereo = (struct pel_stereo){
        .kind = PEL_STEREO_TWO_FILES, .toe_in = true, .separation_mm = 150, .convergence_mm = 90};
    struct pel_camera cameras[2];
    assert_true(pel_stereo_cameras(scene, cameras, NULL));
    int least[2] = {PEL_LOD_LEVEL_MAX, PEL_LOD_LEVEL_MAX}, most[2] = {0, 0};
    struct pel_render_statistics statistics;
    for (int i = 0; i < 2; i++) {
        struct pel_scene alone = *scene;
        alone.stereo.kind = PEL_STEREO_NONE;
        alone.camera = cameras[i];
        pel_image_destroy(render_picture(renderer, &alone, &statistics));
        for (int k = 0; k < 2; k++) {
            int level = statistics.lod.levels[k];
            least[k] = level < least[k] ? level : least[k];
            most[k] = level > most[k] ? level : most[k];
        }
    }
    assert_true(least[0] < most[0] || least[1] < most[1]);
    for (int swap = 0; swap < 2; swap++)
        for (int apart = 0; apart < 2; apart++) {
            scene->stereo.swap = swap;
            scene->render.debug = apart ? PEL_DEBUG_SAMPLES : PEL_DEBUG_NONE;
            pel_image_destroy(render_picture(renderer, scene, &statistics));
            assert_memory_equal(statistics.lod.levels, least, sizeof least);
        }
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void test_refusals(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(4, 24);
    scene->render.lod = PEL_LOD_LEVEL;
    scene->render.lod_level = 16;
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_string_equal(pel_error_message(), "level of detail 16, outside 0..15");
    scene->render.lod = (enum pel_lod)7;
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_string_equal(pel_error_message(), "level of detail 7");
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_levels),   cmocka_unit_test(test_far),
        cmocka_unit_test(test_skip),     cmocka_unit_test(test_two_eyes),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
