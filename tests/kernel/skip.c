// skip.c - however empty space is skipped, the picture is the same, from fewer samples.
//
// With PELLUCID_TEST_ALL every scene of scenes/ is rendered in every way with every number of
// lanes, which takes minutes, nearly all of them for compiling; otherwise kernel.scenes and
// kernel.random, which compare with the reference, each take one of the ways.
#include <dirent.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/scenes.h"
#include "support/test.h"
#include "support/ways.h"

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
    scene->render.bricks.size = 8;
    return scene;
}

// Renders a scene in every way and expects the picture of the first. Counts the samples of each.
static void compare_ways(struct pel_renderer *renderer, struct pel_scene *scene, const char *title,
                         uint64_t samples[WAYS]) {
    struct pel_image *first = NULL;
    for (int n = 0; n < WAYS; n++) {
        struct pel_render_statistics statistics;
        scene->render.skip = ways[n].skip;
        struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, &statistics);
        if (!picture)
            fail_msg("%s, %s: %s", title, ways[n].name, pel_error_message());
        samples[n] = statistics.samples;
        if (!first) {
            first = picture;
            continue;
        }
        char text[1100];
        snprintf(text, sizeof text, "%s, %s, %d lanes", title, ways[n].name, statistics.lanes);
        assert_pictures_equal(picture, first, text);
        pel_image_destroy(picture);
    }
    pel_image_destroy(first);
}

static int way_index(enum pel_skip skip) {
    int n = 0;
    while (ways[n].skip != skip)
        n++;
    return n;
}

static void test_same_picture(void **state) {
    (void)state;
    for (int lanes = 1; lanes <= 4; lanes += 3) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes);
        struct pel_scene *scene = scene_of_crests();
        uint64_t samples[WAYS];
        compare_ways(renderer, scene, "crests", samples);
        for (int n = 1; n < WAYS; n++) {
            print_message("%s: %.3f of the samples\n", ways[n].name,
                          (double)samples[n] / (double)samples[0]);
            // Bricks are twice as wide as cells, and in this volume few are empty.
            bool bricks = ways[n].skip == PEL_SKIP_BVH || ways[n].skip == PEL_SKIP_BLOCKS;
            assert_true((double)samples[n] < (bricks ? 0.97 : 0.75) * (double)samples[0]);
        }
        // However far a lone ray leaps at once, it takes its samples where a cell is not empty.
        const uint64_t grid = samples[way_index(PEL_SKIP_GRID)];
        assert_true(lanes > 1 || samples[way_index(PEL_SKIP_DISTANCE)] == grid);
        assert_true(lanes > 1 || samples[way_index(PEL_SKIP_OCTREE)] == grid);
        pel_image_destroy(judge_render(renderer, scene, NULL, "crests"));
        pel_scene_destroy(scene);
        pel_renderer_destroy(renderer);
    }
}

// However blocks are found and whatever of them is culled, the picture is the same; and what cannot
// be seen any more, or can now, is so after an edit.
static void test_blocks(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 4);
    struct pel_scene *scene = scene_of_crests();
    struct pel_render_statistics statistics;
    uint64_t samples[4];
    struct pel_image *first = NULL;
    scene->render.skip = PEL_SKIP_BLOCKS;
    for (int n = 0; n < 4; n++) {
        scene->render.bricks.stay = n & 1;
        scene->render.bricks.keep = n & 2;
        struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, &statistics);
        assert_non_null(picture);
        assert_int_equal(statistics.skip, PEL_SKIP_BLOCKS);
        assert_int_equal(statistics.bricks.size, 8);
        samples[n] = statistics.samples;
        if (first)
            assert_pictures_equal(picture, first, "walking and culling");
        pel_image_destroy(first);
        first = picture;
    }
    // Walking finds no more and no less; the values of this volume touch all bins somewhere.
    assert_int_equal(samples[1], samples[0]);
    assert_int_equal(samples[3], samples[2]);
    assert_true(samples[0] < samples[2]);
    pel_image_destroy(first);

    scene->render.bricks.stay = scene->render.bricks.keep = false;
    struct pel_opacity_point *edges = scene->instances[0].transfer->opacities;
    pel_image_destroy(judge_render(renderer, scene, &statistics, "before edits"));
    uint64_t stored = statistics.bricks.active, taken = statistics.samples;
    edges[1].value = 60;
    pel_image_destroy(judge_render(renderer, scene, &statistics, "more to be seen"));
    assert_true(statistics.samples > taken);
    assert_int_equal(statistics.bricks.active, stored);
    // Tables, and less than half of the bricks that the voxels lie in.
    assert_true(statistics.uploaded_bytes < 5 * 9856);
    edges[1].value = edges[2].value = 230;
    pel_image_destroy(judge_render(renderer, scene, &statistics, "less to be seen"));
    assert_true(statistics.samples < taken);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A box in nothing: what its corner is filled with is not stored until it can be seen.
static double box(const double p[3], const void *user) {
    const double *ends = user;
    for (int c = 0; c < 3; c++)
        if (p[c] < ends[0] || p[c] > ends[1])
            return 10;
    return 200;
}

static void test_no_data(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 4);
    struct pel_scene *scene = scene_create(scene_is_small() ? 12 : 32, scene_is_small() ? 9 : 24);
    // Stored with its border, the volume has 64 voxels a side: 8^3 sub-blocks, of which the box is
    // in 2^3, and in the corner that eight blocks of 6^3 meet in only one of them.
    const double ends[2] = {17, 28};
    struct pel_volume *volume = scene_volume((int[]){62, 62, 62}, PEL_VOXEL_U8, box, ends);
    struct pel_instance *instance = scene_add(
        scene, volume,
        scene_transfer(
            (const double[][5]){
                {0, 1, 0.5, 0, 0}, {100, 1, 0.5, 0, 0}, {200, 0, 0.5, 1, 0.5}, {255, 1, 1, 1, 0.8}},
            4));
    scene_view_parallel(scene, 64);
    scene->render.skip = PEL_SKIP_BLOCKS;
    struct pel_render_statistics statistics;
    pel_image_destroy(judge_render(renderer, scene, &statistics, "a box"));
    assert_int_equal(statistics.bricks.total, 512);
    assert_int_equal(statistics.bricks.active, 8);
    assert_int_equal(statistics.bricks.clusters, 1);
    instance->transfer->opacities[0].opacity = 0.01;
    pel_image_destroy(judge_render(renderer, scene, &statistics, "a box in fog"));
    assert_int_equal(statistics.bricks.active, 512);
    assert_int_equal(statistics.bricks.clusters, 8);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static int is_scene(const struct dirent *entry) {
    const char *dot = strrchr(entry->d_name, '.');
    return dot && strcmp(dot, ".json") == 0 && !strstr(entry->d_name, ".schema.");
}

// Every scene of scenes/ with every number of lanes.
static void test_all_scenes(void **state) {
    (void)state;
    if (!getenv("PELLUCID_TEST_ALL"))
        skip();
    struct dirent **entries;
    int count = scandir(TEST_SOURCE "/scenes", &entries, is_scene, alphasort);
    assert_true(count > 0);
    for (int lanes = 1; lanes <= 16; lanes = lanes == 1 ? 4 : 2 * lanes) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes);
        for (int i = 0; i < count; i++) {
            char path[1024];
            uint64_t samples[WAYS];
            const char *sizes[] = {"render.size=[64,48]"};
            snprintf(path, sizeof path, "%s/scenes/%s", TEST_SOURCE, entries[i]->d_name);
            struct pel_scene *scene = pel_scene_load(path, sizes, 1);
            if (!scene)
                fail_msg("%s", pel_error_message());
            compare_ways(renderer, scene, entries[i]->d_name, samples);
            pel_scene_destroy(scene);
        }
        pel_renderer_destroy(renderer);
    }
    for (int i = 0; i < count; i++)
        free(entries[i]);
    free(entries);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_picture),
        cmocka_unit_test(test_blocks),
        cmocka_unit_test(test_no_data),
        cmocka_unit_test(test_all_scenes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
