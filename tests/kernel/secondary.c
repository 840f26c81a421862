// secondary.c - shadows and ambient occlusion on the device: against the reference, against
// analytic truth, whatever way empty space is skipped, and that what is wrong is refused.
#include <math.h>

#include "base/math.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"
#include "support/ways.h"

// A table of haze, and above it what casts shadows on it.
static struct pel_scene *scene_of(bool shadows, bool occlusion) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 6 : 24, small ? 4 : 16);
    scene->render.step = small ? 3 : 1;
    scene->render.shadows = (struct pel_shadows){.on = shadows, .step = 1, .strength = 0.8};
    scene->render.ambient_occlusion =
        (struct pel_ambient_occlusion){.on = occlusion, .directions = 5, .radius_mm = 7, .step = 1};
    scene->render.supersampling.seed = 3;
    scene->light_count = 3;
    scene->lights[0] = (struct pel_light){.kind = PEL_LIGHT_DIRECTIONAL,
                                          .direction = {1, -2, -2},
                                          .colour = {1, 0.5, 0.25},
                                          .intensity = 0.6};
    scene->lights[1] = (struct pel_light){
        .kind = PEL_LIGHT_POINT, .position = {8, 3, 14}, .colour = {0.3, 0.5, 1}, .intensity = 0.5};
    scene->lights[2] =
        (struct pel_light){.kind = PEL_LIGHT_HEADLIGHT, .colour = {1, 1, 1}, .intensity = 0.3};
    return scene;
}

static struct pel_instance *add(struct pel_scene *scene, enum pel_voxel_type type, int n) {
    const int dims[3] = {17, 22, 13};
    struct pel_volume *volume = scene_volume_waves(dims, type, 11 + (uint64_t)n, 9);
    scene_place(volume, (double[]){1.4, 1.2, 1.9}, (double[]){0.31, -0.42, 0.17, 0.83},
                (double[]){-1.3 + 4 * n, 2.1, 0.7 - 3 * n}, true);
    double raw[2];
    scene_raw_range(type, raw);
    struct pel_instance *instance =
        scene_add(scene, volume, scene_transfer_gentle(raw, 0.25, 21 + (uint64_t)n));
    instance->material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    instance->material.ambient = 0.4;
    return instance;
}

static void check(struct pel_scene *scene, enum pel_reader reader, int lanes, const char *title) {
    struct pel_renderer *renderer = judge_renderer(reader, lanes);
    if (reader == PEL_READER_BUFFER || judge_has_images(renderer, scene))
        pel_image_destroy(judge_render(renderer, scene, NULL, title));
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// Two volumes, one with an opacity that follows the gradient, the other clipped and with absent
// voxels, with jitter; then one that only takes away from the other, through images.
static void test_media(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of(true, true);
    add(scene, PEL_VOXEL_U8, 0)->silhouette = (struct pel_silhouette){0.5, 1.5, 2};
    struct pel_instance *second = add(scene, PEL_VOXEL_F32, 1);
    for (size_t i = 0; i < pel_volume_voxel_count(scene->volumes[1]); i += 977)
        ((float *)scene->volumes[1]->voxels)[i] = NAN;
    second->clip_count = 2;
    second->clips[0] = (struct pel_clip){
        .kind = PEL_CLIP_BOX, .outside = true, .point = {4, 2, 0}, .size = {8, 9, 10}};
    second->clips[1] =
        (struct pel_clip){.kind = PEL_CLIP_PLANE, .point = {9, 0, 0}, .normal = {-3, 1, 0}};
    scene->render.jitter = true;
    // llvmpipe leaves all loops of a ray after 65536 rounds of them, together.
    scene->render.shadows.length_mm = 8;
    check(scene, PEL_READER_BUFFER, judge_lanes(8), "two clipped");

    scene = scene_of(false, true);
    add(scene, PEL_VOXEL_U8, 0);
    add(scene, PEL_VOXEL_U8, 1);
    scene->render.mixing = PEL_MIX_DIFFERENCE;
    check(scene, PEL_READER_IMAGE, 1, "difference");
}

// Surfaces and pre-integrated media darken each other, blended in order.
static void test_models(void **state) {
    (void)state;
    if (scene_is_small()) // Oclgrind has no word for what its compiler makes of so many models
        skip();
    struct pel_scene *scene = scene_of(true, true);
    struct pel_instance *surface = add(scene, PEL_VOXEL_U8, 0);
    surface->model = PEL_MODEL_ISO;
    surface->surface_count = 2;
    surface->surfaces[0] = (struct pel_surface){.value = 160, .opacity = 0.6};
    surface->surfaces[1] = (struct pel_surface){.value = 90, .opacity = 0.3};
    add(scene, PEL_VOXEL_U8, 1)->preintegration = true;
    scene->instances[1].transfer->opacities[0].opacity = 0;
    scene->render.mixing = PEL_MIX_OVER;
    check(scene, PEL_READER_BUFFER, judge_lanes(4), "models");
}

// Ways to skip give the same picture: none at all, by cells, and with the most to remember.
static void test_ways(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(true, true);
    const double points[3][5] = {{0, 1, 1, 1, 0}, {150, 1, 1, 1, 0}, {220, 0.5, 0.7, 1, 0.5}};
    struct pel_instance *instance = add(scene, PEL_VOXEL_U8, 0);
    pel_transfer_destroy(instance->transfer);
    instance->transfer = scene_transfer(points, 3);
    struct pel_image *expected = NULL;
    for (int n = 0; n < WAYS; n++) {
        bool cells = ways[n].skip == PEL_SKIP_DISTANCE;
        if (n > 0 && ways[n].skip != PEL_SKIP_BLOCKS && (!cells || scene_is_small()))
            continue;
        scene->render.skip = ways[n].skip;
        struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, NULL);
        if (!picture)
            fail_msg("%s: %s", ways[n].name, pel_error_message());
        if (expected)
            assert_pictures_within(picture, expected, 1e-3, 0, ways[n].name);
        else
            expected = picture;
        if (picture != expected)
            pel_image_destroy(picture);
    }
    pel_image_destroy(expected);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// ---- Analytic truth ----------------------------------------------------------------------------

static double below_middle(const double p_voxel[3], const void *user) {
    (void)user;
    return 200 - 10 * p_voxel[2];
}

// A share of shadows so small that there are none, in the same kernel.
static const double next_to_none = 1e-9;

// A slab of haze between a lamp and a plane leaves exp(-depth) of the plane's light. Seen from the
// front the slab lies beside the line of sight.
static void test_slab(void **state) {
    (void)state;
    const double points[3][5] = {{0, 1, 1, 1, 0}, {100, 1, 1, 1, 0}, {100.5, 1, 1, 1, 0.999}};
    struct pel_scene *scene = scene_create(2, 2);
    scene_view_parallel(scene, 4);
    // The plane faces the viewer at z = -1/2 and does not shine.
    struct pel_instance *plane =
        scene_add(scene, scene_volume((int[]){24, 24, 20}, PEL_VOXEL_U8, below_middle, NULL),
                  scene_transfer(points, 3));
    plane->material =
        (struct pel_material){.shading = PEL_SHADING_PHONG, .diffuse = 1, .shininess = 1};
    scene->light_count = 1;
    scene->lights[0] = (struct pel_light){.kind = PEL_LIGHT_DIRECTIONAL,
                                          .direction = {0, -4, -3},
                                          .colour = {1, 1, 1},
                                          .intensity = 1};
    // 4 mm thick across y, and thus 5 mm along the light.
    struct pel_volume *slab = scene_volume_constant((int[]){40, 4, 40}, PEL_VOXEL_U8, 9);
    scene_place(slab, (double[]){1, 1, 1}, (double[]){0, 0, 0, 1}, (double[]){0, 16, 12}, false);
    scene_add(scene, slab, scene_transfer_constant((double[]){1, 1, 1, 0.15}));
    scene->render.step_mm = 0.5;

    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    scene->render.shadows =
        (struct pel_shadows){.on = true, .step = 0.25, .strength = next_to_none};
    struct pel_image *lit = pel_renderer_render(renderer, scene, NULL, NULL);
    scene->render.shadows.strength = 1;
    struct pel_image *shadowed = pel_renderer_render(renderer, scene, NULL, NULL);
    scene->render.shadows.length_mm = 10;
    struct pel_image *near = pel_renderer_render(renderer, scene, NULL, NULL);
    assert_true(lit && shadowed && near);
    for (int i = 0; i < 4; i++) {
        assert_float_equal(lit->rgba[4 * i], 0.6, 0.01); // the cosine
        assert_float_equal(shadowed->rgba[4 * i] / lit->rgba[4 * i], pow(0.85, 5), 0.02);
        assert_float_equal(near->rgba[4 * i], lit->rgba[4 * i], 0.01);
        assert_float_equal(shadowed->rgba[4 * i + 3], lit->rgba[4 * i + 3], 1e-6);
    }
    pel_image_destroy(lit);
    pel_image_destroy(shadowed);
    pel_image_destroy(near);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

static double in_ball(const double p_voxel[3], const void *user) {
    (void)user;
    double away[3] = {p_voxel[0] - 15.5, p_voxel[1] - 15.5, p_voxel[2] - 15.5};
    return 100 + 10 * (12 - pel_length(away));
}

// An opaque ball hides nothing from its own outside, and its light side gets all of the lamp.
static void test_convex(void **state) {
    (void)state;
    const double points[3][5] = {{0, 1, 1, 1, 0}, {100, 1, 1, 1, 0}, {101, 1, 1, 1, 0.999}};
    struct pel_scene *scene = scene_create(5, 5);
    scene->render.step = scene_is_small() ? 1 : 0.5;
    struct pel_instance *ball =
        scene_add(scene, scene_volume((int[]){32, 32, 32}, PEL_VOXEL_F32, in_ball, NULL),
                  scene_transfer(points, 3));
    ball->material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    scene->render.shadows = (struct pel_shadows){.on = true, .strength = next_to_none};
    scene->render.ambient_occlusion =
        (struct pel_ambient_occlusion){.on = true, .strength = next_to_none};
    struct pel_image *plain = pel_renderer_render(renderer, scene, NULL, NULL);
    scene->render.shadows.strength = scene->render.ambient_occlusion.strength = 1;
    struct pel_image *darkened = pel_renderer_render(renderer, scene, NULL, NULL);
    assert_true(plain && darkened);
    assert_pictures_within(darkened, plain, 2, 0, "convex");
    pel_image_destroy(plain);
    pel_image_destroy(darkened);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

// ---- What is refused ---------------------------------------------------------------------------

static void test_refusals(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of(true, true);
    add(scene, PEL_VOXEL_U8, 0);
    struct pel_ambient_occlusion *occlusion = &scene->render.ambient_occlusion;
    occlusion->directions = 65;
    render_refused(renderer, scene, "ambient occlusion in 65 directions, outside 1..64");
    occlusion->step = 0.1;
    render_refused(renderer, scene, "ambient occlusion in steps of 0.1, outside 0.25..64");
    occlusion->radius_mm = NAN;
    render_refused(renderer, scene, "ambient occlusion over nan mm");
    scene->render.shadows.strength = 2;
    render_refused(renderer, scene, "shadows of strength 2, outside 0..1");
    scene->render.shadows.length_mm = -1;
    render_refused(renderer, scene, "shadows over -1 mm");
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_media),  cmocka_unit_test(test_models),
        cmocka_unit_test(test_ways),   cmocka_unit_test(test_slab),
        cmocka_unit_test(test_convex), cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
