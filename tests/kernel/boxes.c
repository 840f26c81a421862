// boxes.c - rays come to the boxes that they cross and to no others, and to none behind something
// opaque. Counts tell, so nothing here depends on time.
#include <math.h>

#include "base/math.h"
#include "reference/ray.h"
#include "support/judge.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

enum { SMALL = 10, WIDTH = 24, HEIGHT = 16 };

// A block of constant value, turned and moved.
static struct pel_instance *add_block(struct pel_scene *scene, double side, const double middle[3],
                                      double degrees, double opacity) {
    struct pel_volume *volume = scene_volume_constant((int[]){4, 4, 4}, PEL_VOXEL_U8, 100);
    double half = degrees * 3.14159265358979323846 / 360;
    scene_place(volume, (double[]){side / 4, side / 4, side / 4},
                (double[]){0.6 * sin(half), 0.8 * sin(half), 0, cos(half)}, middle, false);
    return scene_add(scene, volume, scene_transfer_constant((double[]){1, 0.5, 0.2, opacity}));
}

// Small blocks here and there, some in each other.
static struct pel_scene *scatter(uint64_t seed) {
    struct pel_scene *scene = scene_create(WIDTH, HEIGHT);
    for (int k = 0; k < SMALL; k++) {
        double middle[3];
        for (int i = 0; i < 3; i++)
            middle[i] = (i == 0 ? 40 : 24) * (test_random(&seed) - 0.5);
        add_block(scene, 4 + 6 * test_random(&seed), middle, 360 * test_random(&seed), 0.02);
    }
    return scene;
}

static uint64_t count_entered(struct pel_renderer *renderer, const struct pel_scene *scene) {
    struct pel_render_statistics statistics;
    pel_image_destroy(render_picture(renderer, scene, &statistics));
    return statistics.boxes_entered;
}

// How many boxes, made larger by `slack_mm` on either side, the ray through a pixel has a sample
// in.
static uint64_t boxes_of_ray(const struct pel_scene *scene, int x, int y, double step_mm,
                             double slack_mm) {
    struct reference_span spans[SMALL];
    double first = INFINITY;
    const struct reference_ray ray = reference_camera_ray(&scene->camera, WIDTH, HEIGHT, x, y);
    for (int k = 0; k < SMALL; k++) {
        struct pel_matrix voxel_from_world;
        assert_true(pel_matrix_invert(&voxel_from_world, &scene->volumes[k]->world_from_voxel));
        const struct reference_ray mapped = reference_map_ray(&voxel_from_world, &ray);
        spans[k] = reference_clip(&mapped, (double[]){-0.5, -0.5, -0.5}, (double[]){3.5, 3.5, 3.5});
        if (spans[k].t_in < spans[k].t_out)
            first = fmin(first, spans[k].t_in);
    }
    uint64_t count = 0;
    for (int k = 0; k < SMALL; k++) {
        double near = spans[k].t_in - slack_mm, far = spans[k].t_out + slack_mm;
        double sample = first + (fmax(ceil((near - first) / step_mm - 0.5), 0) + 0.5) * step_mm;
        count += near < far && sample < far;
    }
    return count;
}

// One ray after the other comes to as many boxes as geometry demands, but for those that it has a
// sample in by a hair's breadth.
static void test_exact(void **state) {
    (void)state;
    static const double slack_mm = 1e-3;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    for (int n = 0; n < 4; n++) {
        struct pel_scene *scene = scatter(70 + (uint64_t)n);
        if (n % 2 == 1)
            scene_view_parallel(scene, 40);
        double step_mm = INFINITY;
        for (int k = 0; k < SMALL; k++)
            step_mm = fmin(step_mm,
                           scene->render.step *
                               pel_length((double[]){scene->volumes[k]->world_from_voxel.m[0][0],
                                                     scene->volumes[k]->world_from_voxel.m[1][0],
                                                     scene->volumes[k]->world_from_voxel.m[2][0]}));
        uint64_t least = 0, most = 0;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                least += boxes_of_ray(scene, x, y, step_mm, -slack_mm);
                most += boxes_of_ray(scene, x, y, step_mm, slack_mm);
            }
        assert_in_range(most - least, 0, least / 50);
        struct pel_render_statistics statistics;
        pel_image_destroy(judge_render(renderer, scene, &statistics, "scattered blocks"));
        assert_in_range(statistics.boxes_entered, least, most);
        pel_scene_destroy(scene);
    }
    pel_renderer_destroy(renderer);
}

// Behind an opaque block, and in it, the others do not even cost their boxes, and change nothing.
static void test_behind(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, judge_packet_lanes());
    struct pel_scene *scene = scatter(80);
    scene->render.termination = 0.99;
    // The first two of the list: one would be a kernel of its own.
    add_block(scene, 60, (double[]){0, 0, 0}, 0, 1);
    add_block(scene, 60, (double[]){0, 0, 0}, 0, 1);
    uint64_t all = count_entered(renderer, scene);
    for (int k = 0; k < SMALL; k++)
        scene->instances[k].hidden = true;
    uint64_t blocks = count_entered(renderer, scene);
    assert_true(blocks > 0);
    assert_int_equal(all, blocks);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact),
        cmocka_unit_test(test_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
