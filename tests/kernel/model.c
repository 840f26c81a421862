// model.c - optical models on the device, against the reference and against each other.
#include <math.h>

#include "base/math.h"
#include "reference/ray.h"
#include "support/near.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/scenes.h"
#include "support/test.h"

// Packets of few rays, whose kernels are quickly compiled; scenes/models.json has wide ones.
static int lanes(void) {
    return judge_lanes(4);
}

// Two overlapping volumes of smooth waves, turned against each other.
static struct pel_scene *scene_of_two(void) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 9 : 24, small ? 6 : 16);
    const int dims[3] = {18, 16, 14};
    const double range[2] = {0, 255}, spacing[3] = {1.5, 1.25, 1.5};
    struct pel_volume *first = scene_volume_waves(dims, PEL_VOXEL_U8, 5, 9);
    struct pel_volume *second = scene_volume_waves(dims, PEL_VOXEL_U8, 6, 7);
    scene_place(first, spacing, (double[]){0.1, 0.3, -0.2, 0.92}, (double[]){-3, 1, 0}, false);
    scene_place(second, spacing, (double[]){0.5, -0.2, 0.1, 0.8}, (double[]){4, 0, 2}, false);
    scene_add(scene, first, scene_transfer_gentle(range, 0.2, 11));
    scene_add(scene, second, scene_transfer_gentle(range, 0.3, 12));
    return scene;
}

static const char *const names[] = {"default", "absorption", "emission", "mip",
                                    "minip",   "average",    "iso",      "thesis"};

// Every model beside absorption, with and without skipping.
static void test_models(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_two();
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes());
    scene->instances[0].material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    scene->instances[0].surface_count = 2;
    scene->instances[0].surfaces[0] = (struct pel_surface){.value = 150, .opacity = 0.5};
    scene->instances[0].surfaces[1] =
        (struct pel_surface){.value = 100, .opacity = 0.7, .coloured = true, .rgb = {1, 0.5, 0}};
    for (enum pel_model model = PEL_MODEL_MIP; model <= PEL_MODEL_THESIS; model++) {
        scene->instances[0].model = model;
        for (int skip = model != PEL_MODEL_ISO; skip < 2; skip++) {
            scene->render.skip = skip ? PEL_SKIP_DISTANCE : PEL_SKIP_NONE;
            pel_image_destroy(judge_render(renderer, scene, NULL, names[model]));
        }
    }
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A shell of a millimetre in a ramp is all there at steps of two voxels, as long as what
// lies between samples counts.
static void test_thin_shell(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes());
    struct pel_scene *scene = scene_create(24, 16);
    const int dims[3] = {9, 9, 17};
    const double range[2] = {0, 160}; // ten values a millimetre
    // Depth 0.5 over a millimetre of the ramp, from value 71 to value 81: opaque to 1 - exp(-0.5).
    const double opacity = 1 - exp(-0.5);
    struct pel_transfer *transfer = scene_transfer(
        (const double[][5]){
            {71, 1, 1, 1, 0}, {71, 1, 1, 1, opacity}, {81, 1, 1, 1, opacity}, {81, 1, 1, 1, 0}},
        4);
    scene_add(scene, scene_volume_ramp(dims, PEL_VOXEL_F32, range), transfer);
    scene_view_parallel(scene, 6);
    scene->render.step = 2;
    double errors[2];
    for (int n = 0; n < 2; n++) {
        scene->render.preintegration = n == 1;
        errors[n] = 0;
        for (int phase = 0; phase < 8; phase++) {
            scene->render.phase = phase / 8.0;
            struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, NULL);
            assert_non_null(picture);
            errors[n] = fmax(errors[n], fabs(picture->rgba[4 * (8 * 24 + 12) + 3] - opacity));
            pel_image_destroy(picture);
        }
    }
    assert_true(errors[0] > 0.3);
    assert_true(errors[1] < 0.01);
    pel_scene_destroy(scene);

    // And it is what the reference integrates numerically, with another volume in the same place.
    scene = scene_of_two();
    scene->instances[0].preintegration = true;
    scene->render.step = 1.5;
    scene->render.skip = PEL_SKIP_DISTANCE;
    pel_image_destroy(judge_render(renderer, scene, NULL, "preintegration"));
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// From whichever end its samples are put together, a picture is the same.
static void test_order(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes());
    struct pel_scene *scene = scene_of_two();
    scene->instances[1].model = PEL_MODEL_ISO;
    scene->instances[1].surface_count = 1;
    scene->instances[1].surfaces[0] = (struct pel_surface){.value = 130, .opacity = 0.5};
    struct pel_image *pictures[2];
    for (int order = 0; order < 2; order++) {
        scene->render.order = (enum pel_order)order;
        pictures[order] = judge_render(renderer, scene, NULL, order ? "backwards" : "forwards");
    }
    assert_pictures_within(pictures[1], pictures[0], 0.01, 0, "both orders");
    pel_image_destroy(pictures[0]);
    pel_image_destroy(pictures[1]);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Every sample of every ray is taken, skipped, or behind the end of its ray.
static void test_counts(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes());
    struct pel_scene *scene = scene_of_two();
    struct pel_render_statistics all, some;
    scene->render.skip = PEL_SKIP_NONE;
    pel_image_destroy(pel_renderer_render(renderer, scene, NULL, &all));
    assert_int_equal(all.samples_skipped, 0);
    assert_int_equal(all.samples_terminated, 0);
    scene->render.termination = 0.4;
    pel_image_destroy(pel_renderer_render(renderer, scene, NULL, &some));
    assert_int_equal(some.samples_skipped, 0);
    assert_true(some.samples_terminated > all.samples / 10);
    assert_int_equal(some.samples + some.samples_terminated, all.samples);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A box of constant colour, however it lies, shines by the length of the ray in it; and without
// steps there is no error but rounding's.
static void test_emission(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes());
    struct pel_scene *scene = scene_of_two();
    scene->render.model = PEL_MODEL_EMISSION;
    pel_image_destroy(judge_render(renderer, scene, NULL, "emission"));
    pel_scene_destroy(scene);

    scene = scene_create(24, 16);
    const int dims[3] = {7, 9, 5};
    struct pel_volume *volume = scene_volume_constant(dims, PEL_VOXEL_U8, 200);
    scene_place(volume, (double[]){1.5, 2, 3}, (double[]){0.3, -0.2, 0.5, 0.7}, (double[]){1, 2, 3},
                false);
    scene_add(scene, volume, scene_transfer_constant((double[]){1, 0.5, 0.25, 0}));
    scene->render.model = PEL_MODEL_EMISSION;
    scene->render.emission_scale = 0.03;
    struct pel_render_statistics statistics;
    struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, &statistics);
    assert_non_null(picture);
    assert_int_equal(statistics.skip, PEL_SKIP_NONE);
    struct pel_matrix inverse;
    const double low[3] = {-0.5, -0.5, -0.5}, high[3] = {6.5, 8.5, 4.5};
    assert_true(pel_matrix_invert(&inverse, &volume->world_from_voxel));
    double most = 0;
    for (int i = 0; i < 24 * 16; i++) {
        struct reference_ray ray = reference_camera_ray(&scene->camera, 24, 16, i % 24, i / 24);
        struct reference_ray own = reference_map_ray(&inverse, &ray);
        struct reference_span span = reference_clip(&own, low, high);
        double chord = fmax(span.t_out - span.t_in, 0);
        most = fmax(most, chord);
        const float *rgba = &picture->rgba[4 * i];
        assert_near(rgba[0], 0.03 * chord, 1e-4);
        assert_near(rgba[1], 0.015 * chord, 6e-4); // colours have ten bits
        assert_near(rgba[3], 0, 0);
    }
    assert_true(most > 15);
    pel_image_destroy(picture);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A box that shines by the length that planes, boxes and masks leave of each ray.
static void test_emission_left(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, lanes());
    struct pel_scene *scene = scene_create(8, 8);
    scene_view_parallel(scene, 12);
    scene->render.model = PEL_MODEL_EMISSION;
    scene->render.emission_scale = 0.05;
    const double white[4] = {1, 1, 1, 0};
    scene_add(scene, scene_volume_constant((int[]){16, 16, 16}, PEL_VOXEL_U8, 100),
              scene_transfer_constant(white));
    // A cut-away box of 3.3 mm that overlaps another, 5 mm of both, and a plane 1.7 mm above the
    // ground.
    struct pel_clip *clips = scene->clips;
    clips[0] =
        (struct pel_clip){PEL_CLIP_BOX, .outside = true, .point = {0, 0, 3}, .size = {50, 50, 3.3}};
    clips[1] = clips[0];
    clips[1].point[2] += 1.7;
    clips[2] = (struct pel_clip){PEL_CLIP_PLANE, .point = {0, 0, -6.3}, .normal = {0, 0, 1}};
    scene->clip_count = 3;
    // Layers of 4 mm.
    double labels[2] = {1, 2};
    struct pel_volume *layers = scene_volume_ramp((int[]){2, 2, 2}, PEL_VOXEL_U8, labels);
    scene_place(layers, (double[]){50, 50, 4}, (double[]){0, 0, 0, 1}, (double[]){0, 0, -4}, false);
    scene_add(scene, layers, scene_transfer_constant(white))->hidden = true;
    // Without a mask, label 1, all but label 1, and a label that there is not.
    static const double lengths[4] = {14.3 - 5, 2.3, 14.3 - 5 - 2.3, 0};
    for (int n = 0; n < 4; n++) {
        double label = n == 3 ? 3 : 1;
        scene->instances[0].mask = (struct pel_mask){
            .instance = 1, .range_count = n > 0, .ranges = {{label, label}}, .inverted = n == 2};
        struct pel_image *picture = judge_render(renderer, scene, NULL, "what is left");
        assert_near(picture->rgba[4 * (4 * 8 + 4)], 0.05 * lengths[n], 1e-5);
        pel_image_destroy(picture);
    }
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// The same in all poses, from buffers and from images.
static void test_emission_waves(void **state) {
    (void)state;
    struct pel_renderer *buffers = judge_renderer(PEL_READER_BUFFER, lanes());
    struct pel_renderer *images = judge_renderer(PEL_READER_IMAGE, 1);
    struct pel_scene *scene = scene_of_two();
    scene->render.model = PEL_MODEL_EMISSION;
    scene->instances[0].mask =
        (struct pel_mask){.instance = 1, .range_count = 1, .ranges = {{60, 190}}, .inverted = true};
    scene->instances[1].clips[0] =
        (struct pel_clip){PEL_CLIP_BOX, .outside = true, .point = {2, 3, 1}, .size = {9, 8, 10},
                          .xyzw = {0.3, 0.1, -0.2, 0.9}};
    scene->instances[1].clip_count = 1;
    scene->clips[0] =
        (struct pel_clip){PEL_CLIP_BOX, .size = {15.3, 14.1, 16.7}, .xyzw = {0, 0.2, 0.1, 1}};
    scene->clip_count = 1;
    pel_image_destroy(judge_render(buffers, scene, NULL, "buffers"));
    if (judge_has_images(images, scene))
        pel_image_destroy(judge_render(images, scene, NULL, "images"));
    pel_scene_destroy(scene);
    pel_renderer_destroy(buffers);
    pel_renderer_destroy(images);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_models),         cmocka_unit_test(test_emission),
        cmocka_unit_test(test_thin_shell),     cmocka_unit_test(test_counts),
        cmocka_unit_test(test_order),          cmocka_unit_test(test_emission_left),
        cmocka_unit_test(test_emission_waves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
