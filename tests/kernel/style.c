// style.c - gradients of all kinds, and opacity that follows them, on the device: against the
// reference through buffers and images, and that what is wrong is refused.
#include <math.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

enum { GRADIENTS = PEL_GRADIENT_ANALYTIC + 1 };

// Two instances of one anisotropic, oblique and mirrored volume.
static struct pel_scene *scene_of(int n, enum pel_voxel_type type) {
    static const enum pel_filter filters[] = {PEL_FILTER_LINEAR, PEL_FILTER_CATMULL_ROM,
                                              PEL_FILTER_CUBIC_B_SPLINE};
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 9 : 24, small ? 6 : 16);
    scene->render.step = small ? 2 : 1;
    const int dims[3] = {17, 22, 13};
    struct pel_volume *volume = scene_volume_waves(dims, type, 11, 9);
    scene_place(volume, (double[]){1.4, 1.2, 1.9}, (double[]){0.31, -0.42, 0.17, 0.83},
                (double[]){-1.3, 2.1, 0.7}, true);
    for (size_t i = 0; type == PEL_VOXEL_F32 && i < pel_volume_voxel_count(volume); i += 977)
        ((float *)volume->voxels)[i] = NAN;
    double raw[2];
    scene_raw_range(type, raw);
    double steepest = (raw[1] - raw[0]) / 5; // per millimetre
    for (int k = 0; k < 2; k++) {
        struct pel_transfer *transfer = scene_transfer_gentle(raw, 0.12, 21 + (uint64_t)k);
        struct pel_instance *instance =
            k == 0 ? scene_add(scene, volume, transfer) : scene_add_again(scene, 0, transfer);
        instance->filter = filters[n];
        instance->gradient = (enum pel_gradient)((n + 1 + k) % GRADIENTS);
        if ((n + k) % 2)
            instance->material.shading = PEL_SHADING_BLINN_PHONG;
        if ((n + k) % 3 != 1)
            instance->silhouette = (struct pel_silhouette){0.3, 1.5, 2};
        if ((n + k) % 3 != 2) {
            instance->gradient_opacity_count = 3;
            instance->gradient_opacity[0] = (struct pel_gradient_point){0.1 * steepest, 0.1};
            instance->gradient_opacity[1] = (struct pel_gradient_point){0.5 * steepest, 1.2};
            instance->gradient_opacity[2] = (struct pel_gradient_point){steepest, 0.4};
        }
        if (k == 1)
            instance->transform =
                pel_matrix_from_quaternion((double[]){0.7, 0.2, -0.3, 0.6}, (double[]){3, -2, 1});
    }
    scene->render.mixing = n % 2 ? PEL_MIX_OVER : PEL_MIX_SUM;
    return scene;
}

static void check(enum pel_reader reader, int lanes, int n, enum pel_voxel_type type) {
    struct pel_renderer *renderer = judge_renderer(reader, lanes);
    struct pel_scene *scene = scene_of(n, type);
    char title[64];
    snprintf(title, sizeof title, "%s x %d: scene %d",
             reader == PEL_READER_IMAGE ? "image" : "buffer", lanes, n);
    if (reader == PEL_READER_BUFFER || judge_has_images(renderer, scene))
        pel_image_destroy(judge_render(renderer, scene, NULL, title));
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void test_ways(void **state) {
    (void)state;
    check(PEL_READER_BUFFER, 1, 0, PEL_VOXEL_U8);
    check(PEL_READER_BUFFER, judge_lanes(4), 1, PEL_VOXEL_F32);
    check(PEL_READER_IMAGE, 1, 2, PEL_VOXEL_RGBA8);
}

static void test_refusals(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(0, PEL_VOXEL_U8);
    struct pel_instance *instance = &scene->instances[0];
    instance->gradient_opacity[1].gradient = 0;
    render_refused(renderer, scene, "must be in ascending order");
    instance->gradient_opacity[0].factor = -1;
    render_refused(renderer, scene, "gradient opacity of -1, outside 0..1000");
    instance->gradient_opacity_count = 5;
    render_refused(renderer, scene, "gradient opacity with 5 points, outside 0..4");
    instance->gradient_opacity_count = 0;
    instance->silhouette.exponent = 0;
    render_refused(renderer, scene, "a silhouette of exponent 0, outside 0.25..1000");
    instance->silhouette.strength = NAN;
    render_refused(renderer, scene, "strength nan");
    instance->gradient = (enum pel_gradient)GRADIENTS;
    render_refused(renderer, scene, "gradient 3");
    instance->filter = (enum pel_filter)9;
    render_refused(renderer, scene, "filter 9");
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ways),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
