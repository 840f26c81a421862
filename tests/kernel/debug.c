// debug.c - debug views: their numbers are those that geometry demands.
#include <math.h>
#include <stdlib.h>

#include "support/judge.h"
#include "support/scenes.h"
#include "support/test.h"

enum { WIDTH = 24, HEIGHT = 16, PIXELS = WIDTH * HEIGHT };

// Two boxes of 10 mm that overlap by half along the view and along x, in a parallel view of 16 mm:
// 1 mm is 1 pixel. The left one reaches over x = -7.5 .. 2.5 and z = -7.5 .. 2.5, the right one
// over -2.5 .. 7.5 of both.
static struct pel_scene *two_boxes(void) {
    struct pel_scene *scene = scene_create(WIDTH, HEIGHT);
    scene_view_parallel(scene, HEIGHT);
    const double faint[4] = {1, 1, 1, 0.01};
    int dims[3] = {10, 10, 10};
    scene_add(scene, scene_volume_constant(dims, PEL_VOXEL_U8, 100),
              scene_transfer_constant(faint));
    scene_add_again(scene, 0, scene_transfer_constant(faint));
    for (int k = 0; k < 2; k++)
        for (int axis = 0; axis < 3; axis += 2)
            scene->instances[k].transform.m[axis][3] = k == 0 ? -2.5 : 2.5;
    scene->render.skip = PEL_SKIP_NONE;
    return scene;
}

// The numbers of a view, one a pixel. The caller frees them.
static float *show(struct pel_renderer *renderer, struct pel_scene *scene, enum pel_debug view,
                   struct pel_render_statistics *statistics) {
    float *numbers = calloc(PIXELS, sizeof *numbers);
    assert_non_null(numbers);
    scene->render.debug = view;
    const struct pel_render_options options = {.numbers = numbers};
    struct pel_image *image = pel_renderer_render(renderer, scene, &options, statistics);
    assert_non_null(image);
    double sum = 0, greatest = 0;
    for (int i = 0; i < PIXELS; i++) {
        sum += numbers[i];
        greatest = numbers[i] > greatest ? numbers[i] : greatest;
        // What there is nothing of is black, and everything is opaque.
        const float *rgba = &image->rgba[4 * i];
        assert_true(rgba[3] == 1);
        if (view < PEL_DEBUG_WORK_GROUP)
            assert_true((rgba[0] + rgba[1] + rgba[2] == 0) == (numbers[i] == 0));
    }
    assert_true(statistics->debug.max == greatest);
    assert_float_equal(statistics->debug.mean, sum / PIXELS, 1e-6 * greatest);
    pel_image_destroy(image);
    return numbers;
}

// In the middle row: beside the boxes, in the left one only, in both, in the right one only.
static void check_row(const float *numbers, const double expected[4]) {
    static const int x[4] = {2, 6, 12, 17};
    const float *row = &numbers[HEIGHT / 2 * WIDTH];
    for (int i = 0; i < 4; i++)
        assert_float_equal(row[x[i]], expected[i], 0);
}

static void test_counts(void **state) {
    (void)state;
    const int lanes[2] = {1, judge_packet_lanes()};
    for (int l = 0; l < 2; l++) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes[l]);
        struct pel_scene *scene = two_boxes();
        struct pel_render_statistics statistics;
        float *numbers = show(renderer, scene, PEL_DEBUG_SAMPLES, &statistics);
        // Steps of half a millimetre.
        check_row(numbers, (double[]){0, 20, 40, 20});
        assert_float_equal(statistics.debug.mean * PIXELS, (double)statistics.samples, 1e-3);
        free(numbers);
        // The left box, both, the right one.
        numbers = show(renderer, scene, PEL_DEBUG_SPANS, &statistics);
        check_row(numbers, (double[]){0, 1, 3, 1});
        free(numbers);
        numbers = show(renderer, scene, PEL_DEBUG_VOLUMES, &statistics);
        check_row(numbers, (double[]){0, 1, 2, 1});
        free(numbers);
        // One behind the other, without touching: a gap of nothing is no span.
        scene->instances[0].transform.m[2][3] = -10;
        scene->instances[1].transform.m[2][3] = 10;
        numbers = show(renderer, scene, PEL_DEBUG_SPANS, &statistics);
        check_row(numbers, (double[]){0, 1, 2, 1});
        free(numbers);
        pel_scene_destroy(scene);
        pel_renderer_destroy(renderer);
    }
}

// Each work-item makes one packet of pixels, and each tile is launched on its own to be timed.
static void test_what_made_a_pixel(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 4);
    struct pel_scene *scene = two_boxes();
    struct pel_render_statistics statistics;
    float *groups = show(renderer, scene, PEL_DEBUG_WORK_GROUP, &statistics);
    float *items = show(renderer, scene, PEL_DEBUG_WORK_ITEM, &statistics);
    assert_true(statistics.debug.max < statistics.work_group);
    for (int i = 0; i < PIXELS; i++) {
        int same = 0;
        for (int j = 0; j < PIXELS; j++)
            same += groups[i] == groups[j] && items[i] == items[j];
        assert_int_equal(same, statistics.lanes);
    }
    float *times = show(renderer, scene, PEL_DEBUG_TIME, &statistics);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            assert_true(times[y * WIDTH + x] > 0);
            assert_true(times[y * WIDTH + x] == times[x / 16 * 16]);
        }
    free(groups);
    free(items);
    free(times);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// 200 in a cube of 12 voxels, 0 elsewhere.
static double cube(const double p[3], const void *user) {
    (void)user;
    for (int c = 0; c < 3; c++)
        if (p[c] < 17 || p[c] > 28)
            return 0;
    return 200;
}

// Boxes of a hierarchy: eight bricks of 8^3 voxels make one cluster, or lie in one block. Voxel p
// is stored at p + 1, so the cube lies in the bricks 2 and 3 along each axis.
static void test_clusters(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, judge_packet_lanes());
    struct pel_scene *scene = scene_create(WIDTH, HEIGHT);
    scene_add(scene, scene_volume((int[]){62, 62, 62}, PEL_VOXEL_U8, cube, NULL),
              scene_transfer(
                  (const double[][5]){
                      {0, 1, 1, 1, 0}, {100, 1, 1, 1, 0}, {150, 1, 1, 1, 0.9}, {255, 1, 1, 1, 0.9}},
                  4));
    scene_view_parallel(scene, 64);
    scene->render.bricks.size = 8;
    // A ray through the bricks, 8 mm to the left of the middle and above it; and one beside them.
    const int through = (HEIGHT / 2 + 1) * WIDTH + WIDTH / 2 - 2, beside = 2 * WIDTH + 2;
    struct pel_render_statistics statistics;
    for (int apart = 0; apart < 2; apart++) {
        scene->render.bricks.apart = apart;
        float *clusters = show(renderer, scene, PEL_DEBUG_CLUSTERS, &statistics);
        assert_int_equal(statistics.skip, PEL_SKIP_BVH);
        assert_float_equal(clusters[through], apart ? 2 : 1, 0);
        assert_float_equal(clusters[beside], 0, 0);
        float *nodes = show(renderer, scene, PEL_DEBUG_NODES, &statistics);
        // Of the fifteen nodes over eight bricks, by which axis is divided first.
        assert_true(apart ? nodes[through] >= 5 && nodes[through] <= 7 : nodes[through] == 1);
        free(clusters);
        free(nodes);
    }
    scene->render.skip = PEL_SKIP_BLOCKS;
    float *blocks = show(renderer, scene, PEL_DEBUG_CLUSTERS, &statistics);
    assert_float_equal(blocks[through], 1, 0);
    free(blocks);
    scene->render.skip = PEL_SKIP_DISTANCE;
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_non_null(strstr(pel_error_message(), "only skip bvh and blocks"));
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// What the ray of one pixel meets, against geometry, and what it brings, against the picture.
static void test_probe(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 0);
    struct pel_scene *scene = two_boxes();
    struct pel_probe probe;
    // Its pixel counts in the whole picture, whatever part of it is rendered.
    memcpy(scene->render.region, (int[]){1, 2, 3, 4}, sizeof scene->render.region);
    assert_true(pel_renderer_probe(renderer, scene, 12, 8, &probe));
    memset(scene->render.region, 0, sizeof scene->render.region);
    // The camera is at z = 100 and looks along -z; the first sample lies a quarter of a millimetre
    // in.
    static const double spans[3][2] = {{92.75, 97.75}, {97.75, 102.75}, {102.75, 107.75}};
    static const uint32_t instances[3] = {2, 3, 1};
    assert_int_equal(probe.span_count, 3);
    for (int i = 0; i < 3; i++) {
        assert_float_equal(probe.spans[i].from_mm, spans[i][0], 1e-4);
        assert_float_equal(probe.spans[i].to_mm, spans[i][1], 1e-4);
        assert_int_equal(probe.spans[i].instances, instances[i]);
    }
    assert_int_equal(probe.sample_count, 40);
    assert_false(probe.cut);
    double clear = 1;
    for (int i = 0; i < probe.sample_count; i++) {
        const struct pel_probe_sample *sample = &probe.samples[i];
        assert_float_equal(sample->value, 100, 0);
        assert_float_equal(sample->opacity, 1 - sqrt(1 - 0.01), 1e-6);
        assert_float_equal(sample->distance_mm, 92.75 + 0.5 * sample->number, 1e-4);
        assert_float_equal(sample->position[0], 0.5, 1e-4);
        assert_float_equal(sample->position[1], -0.5, 1e-4);
        assert_float_equal(sample->position[2], 100 - sample->distance_mm, 1e-4);
        // Both volumes of one sample see the same opacity before it.
        bool second = i > 0 && sample->number == probe.samples[i - 1].number;
        assert_float_equal(1 - sample->accumulated, second ? clear / (1 - sample->opacity) : clear,
                           1e-5);
        clear *= 1 - sample->opacity;
    }
    struct pel_image *image = pel_renderer_render(renderer, scene, NULL, NULL);
    assert_non_null(image);
    for (int c = 0; c < 4; c++)
        assert_float_equal(probe.rgba[c], image->rgba[4 * (8 * WIDTH + 12) + c], 1e-6);
    pel_image_destroy(image);
    pel_probe_finish(&probe);
    assert_false(pel_renderer_probe(renderer, scene, WIDTH, 0, &probe));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counts), cmocka_unit_test(test_what_made_a_pixel),
        cmocka_unit_test(test_clusters), cmocka_unit_test(test_probe)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
