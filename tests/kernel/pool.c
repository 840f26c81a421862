// pool.c - bricks from a pool make the same picture, in the memory that those need which can be
// seen.
#include <math.h>

#include "support/judge.h"
#include "support/picture.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

// A few small balls in much nothing.
static double balls(const double p[3], const void *user) {
    const double *size = user;
    double value = 0;
    for (int n = 0; n < 3; n++) {
        double square = 0;
        for (int c = 0; c < 3; c++) {
            double middle = (0.2 + 0.3 * ((n + c * n) % 3)) * *size;
            square += (p[c] - middle) * (p[c] - middle);
        }
        value = fmax(value, 200 - 25 * sqrt(square));
    }
    return value;
}

static struct pel_scene *scene_of_balls(enum pel_voxel_type type, bool shaded) {
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 12 : 32, small ? 9 : 24);
    double size = small ? 50 : 100;
    struct pel_volume *volume =
        scene_volume((int[]){(int)size, (int)size, (int)size}, type, balls, &size);
    struct pel_instance *instance = scene_add(
        scene, volume,
        scene_transfer(
            (const double[][5]){
                {0, 1, 0.5, 0, 0}, {40, 1, 0.5, 0, 0}, {110, 0, 0.5, 1, 0.2}, {200, 1, 1, 1, 0.8}},
            4));
    if (shaded)
        instance->material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    scene_view_parallel(scene, size);
    scene->camera.eye[0] = 60;
    scene->camera.eye[1] = 45;
    return scene;
}

static void test_same_picture(void **state) {
    (void)state;
    static const struct {
        enum pel_voxel_type type;
        enum pel_skip skip;
        bool shaded, styled;
        int lanes;
    } cases[] = {{PEL_VOXEL_U8, PEL_SKIP_BLOCKS, false, false, 4},
                 {PEL_VOXEL_U8, PEL_SKIP_BVH, false, true, 4},
                 {PEL_VOXEL_F32, PEL_SKIP_NONE, true, false, 1}};
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, cases[n].lanes);
        struct pel_scene *scene = scene_of_balls(cases[n].type, cases[n].shaded);
        // What can be seen ends just behind the face of a brick: gradients reach into one of which
        // nothing can.
        if (cases[n].styled) {
            struct pel_instance *instance = &scene->instances[0];
            instance->transfer->opacities[1].value = 80;
            instance->gradient = PEL_GRADIENT_SOBEL;
            instance->gradient_opacity_count = 2;
            instance->gradient_opacity[1] = (struct pel_gradient_point){30, 1};
        }
        struct pel_render_statistics whole, pooled;
        // A hole without values: the brick that stands in for those that are not there has none.
        if (cases[n].type == PEL_VOXEL_F32)
            for (int i = 0; i < 3000; i++)
                ((float *)scene->volumes[0]->voxels)[i] = NAN;
        scene->render.skip = cases[n].skip;
        scene->render.bricks.pool = PEL_POOL_OFF;
        struct pel_image *expected = render_picture(renderer, scene, &whole);
        assert_int_equal(whole.bricks.resident, 0);
        scene->render.bricks.pool = PEL_POOL_ON;
        struct pel_image *actual = render_picture(renderer, scene, &pooled);
        assert_pictures_equal(actual, expected, "from the pool");
        assert_true(pooled.bricks.resident > 0);
        assert_int_equal(pooled.bricks.size, 16);
        if (!scene_is_small())
            assert_true(pooled.device_bytes < whole.device_bytes / 2);
        pel_image_destroy(actual);
        pel_image_destroy(expected);
        pel_scene_destroy(scene);
        pel_renderer_destroy(renderer);
    }
}

// Editing a transfer function brings what is missing and keeps what is there.
static void test_edit(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 4);
    struct pel_scene *scene = scene_of_balls(PEL_VOXEL_U8, false);
    scene->render.skip = PEL_SKIP_BVH;
    scene->render.bricks.pool = PEL_POOL_ON;
    struct pel_render_statistics statistics;
    struct pel_opacity_point *edge = &scene->instances[0].transfer->opacities[1];
    edge->value = 100;
    pel_image_destroy(render_picture(renderer, scene, &statistics));
    uint64_t few = statistics.bricks.active;
    pel_image_destroy(render_picture(renderer, scene, &statistics));
    assert_true(statistics.uploaded_bytes < 9856);

    edge->value = 10;
    pel_image_destroy(judge_render(renderer, scene, &statistics, "more to be seen"));
    uint64_t many = statistics.bricks.active;
    assert_true(many > few);
    assert_int_equal(statistics.bricks.resident, many);
    assert_true(statistics.uploaded_bytes >= (many - few) * 9856);

    edge->value = 100;
    pel_image_destroy(judge_render(renderer, scene, &statistics, "less to be seen"));
    assert_int_equal(statistics.bricks.active, few);
    // Nothing but tables and pages.
    assert_true(scene_is_small() || statistics.uploaded_bytes < few * 9856);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A volume larger than the device takes otherwise comes from a pool by itself; where not even that
// is enough, a sentence says so, and the next frame is as if nothing had been.
static void test_too_large(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_balls(PEL_VOXEL_U8, false);
    scene->render.skip = PEL_SKIP_BVH;
    struct pel_renderer *free_renderer = judge_renderer(PEL_READER_BUFFER, 4);
    struct pel_render_statistics statistics;
    struct pel_image *expected = render_picture(free_renderer, scene, &statistics);
    scene->render.bricks.pool = PEL_POOL_ON;
    pel_image_destroy(render_picture(free_renderer, scene, &statistics));
    uint64_t needed = (statistics.bricks.active + 1) * 9856;
    pel_renderer_destroy(free_renderer);

    scene->render.bricks.pool = PEL_POOL_AUTO;
    struct pel_renderer_options options = {
        .reader = PEL_READER_BUFFER, .lanes = 4, .max_allocation_bytes = needed};
    struct pel_renderer *tight = pel_renderer_create(&options);
    assert_non_null(tight);
    struct pel_image *actual = render_picture(tight, scene, &statistics);
    if (!scene_is_small()) {
        assert_true(statistics.bricks.resident > 0);
        assert_pictures_equal(actual, expected, "in little memory");
        scene->instances[0].transfer->opacities[1].value = 1;
        scene->instances[0].transfer->opacities[0].opacity = 0.01;
        assert_null(pel_renderer_render(tight, scene, NULL, NULL));
        assert_int_equal(pel_error_code(), PEL_ERROR_DEVICE);
        assert_non_null(strstr(pel_error_message(), "largest allocation"));
        scene->instances[0].transfer->opacities[0].opacity = 0;
        scene->instances[0].transfer->opacities[1].value = 40;
        pel_image_destroy(actual);
        actual = render_picture(tight, scene, &statistics);
        assert_pictures_equal(actual, expected, "after a failure");
    }
    pel_image_destroy(actual);
    pel_image_destroy(expected);
    pel_renderer_destroy(tight);
    pel_scene_destroy(scene);
}

static void test_refusals(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_balls(PEL_VOXEL_U8, false);
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 4);
    scene->render.bricks.pool = PEL_POOL_ON;
    scene->instances[0].model = PEL_MODEL_ISO;
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_UNSUPPORTED);
    scene->instances[0].model = PEL_MODEL_DEFAULT;
    scene->render.bricks.size = 24;
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_picture),
        cmocka_unit_test(test_edit),
        cmocka_unit_test(test_too_large),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
