// skip.c - however empty space is skipped, the picture is the same, from fewer samples.
#include "base/math.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/scenes.h"
#include "support/test.h"

// Waves of which only the crests can be seen, turned, so that rays cross cells every way.
static struct pel_scene *scene_of_crests(void) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 16 : 48, small ? 12 : 36);
    int dims[3] = {small ? 22 : 30, small ? 26 : 34, small ? 18 : 27};
    struct pel_volume *volume = scene_volume_waves(dims, PEL_VOXEL_U8, 5, 13);
    scene_add(scene, volume,
              scene_transfer((const double[][5]){{0, 1, 0.5, 0, 0},
                                                 {180, 1, 0.5, 0, 0},
                                                 {200, 0, 0.5, 1, 0.5},
                                                 {255, 1, 1, 1, 0.8}},
                             4))
        ->transform =
        pel_matrix_from_quaternion((double[]){0.3, -0.2, 0.5, 0.7}, (double[]){1, 2, 3});
    scene->render.step = 0.4;
    return scene;
}

static void test_same_picture(void **state) {
    (void)state;
    static const enum pel_skip skips[] = {PEL_SKIP_NONE, PEL_SKIP_GRID, PEL_SKIP_DISTANCE};
    for (int lanes = 1; lanes <= 4; lanes += 3) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes);
        struct pel_scene *scene = scene_of_crests();
        struct pel_image *pictures[3];
        uint64_t samples[3];
        for (int n = 0; n < 3; n++) {
            struct pel_render_statistics statistics;
            scene->render.skip = skips[n];
            pictures[n] = judge_render(renderer, scene, &statistics,
                                       (const char *[]){"none", "grid", "distance"}[n]);
            samples[n] = statistics.samples;
        }
        assert_pictures_within(pictures[1], pictures[0], 0.01, 0, "cell by cell");
        assert_pictures_within(pictures[2], pictures[0], 0.01, 0, "by distance");
        assert_true(samples[1] < samples[0] * 3 / 4);
        assert_true(samples[2] <= samples[1]);
        for (int n = 0; n < 3; n++)
            pel_image_destroy(pictures[n]);
        pel_scene_destroy(scene);
        pel_renderer_destroy(renderer);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_picture)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
