// reproject.c - the second eye's picture from the first one's: exact where that can be, and within
// a bound on surfaces.
#include <math.h>

#include "support/judge.h"
#include "support/scenes.h"
#include "support/test.h"

static struct pel_scene *create(void) {
    bool small = scene_is_small();
    struct pel_scene *scene = small ? scene_create(24, 16) : scene_create(64, 48);
    scene->background[3] = 1;
    scene->stereo = (struct pel_stereo){.kind = PEL_STEREO_TWO_FILES,
                                        .separation_mm = 10,
                                        .convergence_mm = 110,
                                        .reproject = true};
    return scene;
}

// Renders the second eye as it is reprojected, and as it is.
static void render(struct pel_renderer *renderer, struct pel_scene *scene,
                   struct pel_render_statistics *statistics, struct pel_image *seconds[2]) {
    for (int i = 0; i < 2; i++) {
        struct pel_image *eyes[2];
        scene->stereo.reproject = i == 0;
        if (!pel_renderer_render_eyes(renderer, scene, NULL, i == 0 ? statistics : NULL, eyes))
            fail_msg("%s", pel_error_message());
        pel_image_destroy(eyes[0]);
        seconds[i] = eyes[1];
    }
    scene->stereo.reproject = true;
    size_t pixels = (size_t)seconds[0]->width * (size_t)seconds[0]->height;
    size_t cast = statistics->rays - pixels;
    assert_float_equal(statistics->stereo.reprojected, 1 - (double)cast / (double)pixels, 1e-9);
}

static void destroy(struct pel_image *seconds[2]) {
    pel_image_destroy(seconds[0]);
    pel_image_destroy(seconds[1]);
}

// An opaque box of one colour that faces the camera: the same picture, from few rays.
static void test_box(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    for (int place = -1; place <= 1; place++) {
        struct pel_scene *scene = create();
        struct pel_instance *box =
            scene_add(scene, scene_volume_constant((int[]){12, 12, 6}, PEL_VOXEL_U8, 1),
                      scene_transfer_constant((double[]){1, 0.5, 0.25, 1}));
        box->transform.m[2][3] = 20 * place;
        struct pel_render_statistics statistics;
        struct pel_image *seconds[2];
        render(renderer, scene, &statistics, seconds);
        int floats = 4 * seconds[0]->width * seconds[0]->height;
        for (int i = 0; i < floats; i++)
            assert_float_equal(seconds[0]->rgba[i], seconds[1]->rgba[i], 1.0 / 4096);
        assert_true(statistics.stereo.reprojected > 0.4);
        destroy(seconds);
        pel_scene_destroy(scene);
    }
    pel_renderer_destroy(renderer);
}

// How much a channel of the picture changes within so many pixels of one to either side.
static double change_around(const struct pel_image *image, int x, int y, int c, int reach) {
    double low = INFINITY, high = -INFINITY;
    for (int k = x - reach; k <= x + reach; k++) {
        if (k < 0 || k >= image->width)
            continue;
        double value = image->rgba[4 * (y * image->width + k) + c];
        low = fmin(low, value);
        high = fmax(high, value);
    }
    return high - low;
}

// An opaque surface with a pattern: no pixel is further off than the true picture changes within
// two pixels of it.
static void compare_surface(bool orthographic) {
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = create();
    // Towards its silhouette the first eye sees the surface between the rays of the second one.
    int reach = orthographic ? 3 : 2;
    if (orthographic)
        scene_view_parallel(scene, 40);
    static const double points[][5] = {{0, 0, 0.2, 1, 1}, {255, 1, 0.8, 0, 1}};
    struct pel_instance *box =
        scene_add(scene, scene_volume_waves((int[]){16, 16, 8}, PEL_VOXEL_U8, 11, 9),
                  scene_transfer(points, 2));
    // Turned, so that depth changes along rows.
    box->transform.m[0][0] = box->transform.m[2][2] = 0.8;
    box->transform.m[0][2] = 0.6;
    box->transform.m[2][0] = -0.6;
    struct pel_render_statistics statistics;
    struct pel_image *seconds[2];
    render(renderer, scene, &statistics, seconds);
    for (int i = 0; i < 4 * seconds[0]->width * seconds[0]->height; i++) {
        int x = i / 4 % seconds[0]->width, y = i / 4 / seconds[0]->width;
        double bound = change_around(seconds[1], x, y, i % 4, reach) + 1.0 / 255;
        assert_float_equal(seconds[0]->rgba[i], seconds[1]->rgba[i], bound);
    }
    assert_true(statistics.stereo.reprojected > 0.4);
    destroy(seconds);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void test_surface(void **state) {
    (void)state;
    compare_surface(false);
}

static void test_orthographic(void **state) {
    (void)state;
    compare_surface(true);
}

// Both eyes in one place: nothing is cast, and both see the same.
static void test_flat(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = create();
    scene_add(scene, scene_volume_waves((int[]){8, 8, 8}, PEL_VOXEL_U8, 3, 5),
              scene_transfer_constant((double[]){1, 0.5, 0.25, 0.1}));
    scene->stereo.flat = true;
    struct pel_render_statistics statistics;
    struct pel_image *seconds[2];
    render(renderer, scene, &statistics, seconds);
    assert_float_equal(statistics.stereo.reprojected, 1, 0);
    for (int i = 0; i < 4 * seconds[0]->width * seconds[0]->height; i++)
        assert_float_equal(seconds[0]->rgba[i], seconds[1]->rgba[i], 1e-6);
    destroy(seconds);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A projection has no depth, so all of its rays are cast, and nothing is wrong.
static void test_projection(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = create();
    static const double points[][5] = {{0, 0, 0, 0, 0.2}, {255, 1, 0.8, 0, 1}};
    scene_add(scene, scene_volume_waves((int[]){30, 30, 8}, PEL_VOXEL_U8, 3, 5),
              scene_transfer(points, 2));
    scene->render.model = PEL_MODEL_MIP;
    struct pel_render_statistics statistics;
    struct pel_image *seconds[2];
    render(renderer, scene, &statistics, seconds);
    for (int i = 0; i < 4 * seconds[0]->width * seconds[0]->height; i++)
        assert_float_equal(seconds[0]->rgba[i], seconds[1]->rgba[i], 1.0 / 4096);
    destroy(seconds);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

static void refuse(struct pel_renderer *renderer, const struct pel_scene *scene) {
    assert_null(pel_renderer_render(renderer, scene, NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_UNSUPPORTED);
}

static void test_refusals(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_AUTO, 0);
    struct pel_scene *scene = create();
    scene_add(scene, scene_volume_constant((int[]){4, 4, 4}, PEL_VOXEL_U8, 1),
              scene_transfer_constant((double[]){1, 1, 1, 0.5}));
    scene->stereo.toe_in = true;
    refuse(renderer, scene);
    scene->stereo.toe_in = false;
    scene->render.supersampling.n = 2;
    refuse(renderer, scene);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_box),          cmocka_unit_test(test_surface),
        cmocka_unit_test(test_orthographic), cmocka_unit_test(test_flat),
        cmocka_unit_test(test_projection),   cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
