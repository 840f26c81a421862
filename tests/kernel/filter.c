// filter.c - cubic filters on the device where they reach beyond a cell or a slab. Every way to
// read them is among the kernels of variants.c.
#include <math.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

// A thin shell of values that linear interpolation never reaches, between voxels of 60 and 200:
// cells must not be skipped for the voxels they own alone.
static void test_skip(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    const int dims[3] = {40, 20, 20};
    const int width = scene_is_small() ? 12 : 24, height = scene_is_small() ? 8 : 16;
    struct pel_scene *scene = scene_create(width, height);
    struct pel_volume *volume = scene_volume_constant(dims, PEL_VOXEL_U8, 60);
    for (size_t i = 0; i < pel_volume_voxel_count(volume); i++)
        if (i % 40 > 15 && i % 40 < 24)
            ((uint8_t *)volume->voxels)[i] = 200;
    struct pel_instance *instance = scene_add(
        scene, volume,
        scene_transfer(
            (const double[][5]){
                {0, 1, 0, 0, 0}, {201, 1, 0, 0, 0}, {206, 0, 1, 0, 0.5}, {255, 0, 0, 1, 0.5}},
            4));
    instance->filter = PEL_FILTER_CATMULL_ROM;
    struct pel_render_statistics statistics[2];
    struct pel_image *pictures[2];
    for (int n = 0; n < 2; n++) {
        scene->render.skip = n == 0 ? PEL_SKIP_NONE : PEL_SKIP_DISTANCE;
        pictures[n] = judge_render(renderer, scene, &statistics[n], n == 0 ? "none" : "skipped");
    }
    assert_pictures_within(pictures[1], pictures[0], 0, 0, "skipped");
    assert_true(statistics[1].samples < statistics[0].samples * 3 / 4);
    double greatest = 0;
    for (int i = 0; i < width * height; i++)
        greatest = fmax(greatest, (double)pictures[1]->rgba[4 * i + 3]);
    assert_true(greatest > 0.1); // the overshoot is seen at all
    pel_image_destroy(pictures[0]);
    pel_image_destroy(pictures[1]);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A volume in slabs is filtered and shaded like a whole one, also where it is cut.
static void test_slabs(void **state) {
    (void)state;
    struct pel_scene *scene = scene_tall(12, 20);
    scene->instances[0].material.shading = PEL_SHADING_BLINN_PHONG;
    scene->instances[0].filter = PEL_FILTER_CUBIC_B_SPLINE;
    struct pel_renderer *renderer = render_in_slabs(0);
    pel_image_destroy(judge_render(renderer, scene, NULL, "slabs"));
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// Absent voxels around a nearest one do not matter, also where others are interpolated and a
// device's images are read by one filter for all.
static void test_absent_neighbours(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_IMAGE, 1);
    struct pel_scene *scene = scene_create(16, 12);
    for (int k = 0; k < 2; k++) {
        struct pel_volume *volume =
            scene_volume_waves((int[]){12, 10, 8}, PEL_VOXEL_F32, (uint64_t)k, 7);
        for (size_t i = 0; k == 0 && i < pel_volume_voxel_count(volume); i += 7)
            ((float *)volume->voxels)[i] = NAN;
        struct pel_instance *instance = scene_add(
            scene, volume, scene_transfer_gentle((double[]){-1.5, 2.5}, 0.2, (uint64_t)(3 + k)));
        instance->transform = pel_matrix_from_quaternion((double[]){0.3 - 0.4 * k, 0.2, 0.1, 1},
                                                         (double[]){3 * k, 0, 0});
        instance->filter = k == 0 ? PEL_FILTER_NEAREST : PEL_FILTER_LINEAR;
    }
    if (judge_has_images(renderer, scene))
        pel_image_destroy(judge_render(renderer, scene, NULL, "absent neighbours"));
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_skip),
        cmocka_unit_test(test_slabs),
        cmocka_unit_test(test_absent_neighbours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
