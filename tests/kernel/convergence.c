// convergence.c - how fast the device's picture comes nearer to the analytic truth as the step
// shrinks: a medium that changes smoothly is integrated by the midpoint rule, of second order;
// where it ends between two samples, what is missed or too much is of first order.
#include <math.h>

#include "reference/reference.h"
#include "support/judge.h"
#include "support/picture.h"
#include "support/scenes.h"
#include "support/test.h"

enum { SIDE = 4, STEPS = 3 };

// Values 0 to 1 over 16 mm along the rays, in a box that ends at its outer voxels.
static struct pel_scene *scene_of_ramp(struct pel_transfer *transfer) {
    struct pel_scene *scene = scene_create(SIDE, SIDE);
    scene_view_parallel(scene, 8);
    // Seen from z = 100 the last voxels come first.
    struct pel_volume *volume =
        scene_volume_ramp((int[]){17, 17, 17}, PEL_VOXEL_F32, (double[]){1, 0});
    scene_add(scene, volume, transfer)->extent = PEL_EXTENT_POINT;
    return scene;
}

// The errors of one channel of a pixel at steps of 4, 2 and 1 mm.
static void find_errors(struct pel_renderer *renderer, struct pel_scene *scene, int channel,
                        double truth, double errors[STEPS]) {
    for (int n = 0; n < STEPS; n++) {
        scene->render.step_mm = 4 / exp2(n);
        struct pel_image *picture = judge_render(renderer, scene, NULL, "ramp");
        errors[n] = fabs((double)picture->rgba[4 * (SIDE + 1) + channel] - truth);
        pel_image_destroy(picture);
    }
}

static void expect_second_order(const double errors[STEPS], const char *what) {
    print_message("%s: %.2e %.2e %.2e\n", what, errors[0], errors[1], errors[2]);
    for (int n = 1; n < STEPS; n++)
        assert_true(errors[n - 1] / errors[n] > 3.4 && errors[n - 1] / errors[n] < 4.6);
}

// Opacity o(t) rises linearly from 0 to 0.9 per mm, so with the density k and a = 0.9 / 16 the
// optical depth is the integral of -k ln(1 - a t) over 0..16, k / a ((1 - a t) ln(1 - a t) + a t).
static void test_opacity(void **state) {
    (void)state;
    const double greatest = 0.9, density = 0.1;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of_ramp(
        scene_transfer((const double[][5]){{0, 1, 1, 1, 0}, {1, 1, 1, 1, greatest}}, 2));
    scene->instances[0].density = density;
    double clear = 1 - greatest, errors[STEPS];
    double depth = density * 16 / greatest * (clear * log(clear) + greatest);
    find_errors(renderer, scene, 3, 1 - exp(-depth), errors);
    expect_second_order(errors, "opacity");
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Of one extinction e everywhere, and a colour c(t) = t / L: the light is the integral of
// e exp(-e t) t / L over 0..L.
static void test_colour(void **state) {
    (void)state;
    const double opacity = 0.25, e = -log(1 - opacity), length = 16;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_of_ramp(
        scene_transfer((const double[][5]){{0, 0, 0, 0, opacity}, {1, 1, 1, 1, opacity}}, 2));
    double truth = (1 - (1 + e * length) * exp(-e * length)) / (e * length), errors[STEPS];
    find_errors(renderer, scene, 0, truth, errors);
    expect_second_order(errors, "colour");
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// A medium of one extinction whose length is anything: the mean error over many lengths.
static void test_ends(void **state) {
    (void)state;
    enum { LENGTHS = 24 };
    const double grey[4] = {1, 1, 1, 0.05}, e = -log(1 - grey[3]);
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    double errors[STEPS] = {0};
    uint64_t seed = 5;
    for (int k = 0; k < LENGTHS; k++) {
        double length = 14 + 4 * test_random(&seed);
        struct pel_scene *scene = scene_of_ramp(scene_transfer_constant(grey));
        scene_place(scene->volumes[0], (double[]){1, 1, length / 16}, (double[]){0, 0, 0, 1},
                    (double[]){0, 0, 0}, false);
        for (int n = 0; n < STEPS; n++) {
            scene->render.step_mm = 4 / exp2(n);
            struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, NULL);
            assert_non_null(picture);
            double opacity = (double)picture->rgba[4 * (SIDE + 1) + 3];
            errors[n] += fabs(opacity - (1 - exp(-e * length))) / LENGTHS;
            pel_image_destroy(picture);
        }
        pel_scene_destroy(scene);
    }
    print_message("ends: %.2e %.2e %.2e\n", errors[0], errors[1], errors[2]);
    for (int n = 1; n < STEPS; n++)
        assert_true(errors[n - 1] / errors[n] > 1.5 && errors[n - 1] / errors[n] < 2.7);
    pel_renderer_destroy(renderer);
}

// A better quality is one: the error against a picture of many samples falls from each to the next,
// and samples are what it costs.
static void test_quality(void **state) {
    (void)state;
    enum { QUALITIES = 4 };
    static const double qualities[QUALITIES] = {0, 0.5, 0.75, 1};
    bool small = scene_is_small();
    struct pel_scene *scene = scene_create(small ? 8 : 16, small ? 6 : 12);
    scene_add(scene, scene_volume_waves((int[]){20, 20, 20}, PEL_VOXEL_F32, 7, 12),
              scene_transfer_gentle((double[]){-1.5, 2.5}, 0.4, 3));
    scene->render.step = 1.0 / 32;
    struct pel_image *truth = reference_render(scene);
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    double error = INFINITY;
    uint64_t samples = 0;
    for (int n = 0; n < QUALITIES; n++) {
        scene->instances[0].step = 0;
        pel_scene_set_quality(scene, qualities[n]);
        scene->render.supersampling = (struct pel_supersampling){0}; // the truth has one ray, too
        struct pel_render_statistics statistics;
        struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, &statistics);
        assert_non_null(picture);
        double sum = 0;
        for (int i = 0; i < 4 * picture->width * picture->height; i++)
            sum += pow((double)picture->rgba[i] - (double)truth->rgba[i], 2);
        print_message("quality %.2f: %.2e of %llu samples\n", qualities[n], sqrt(sum),
                      (unsigned long long)statistics.samples);
        assert_true(sqrt(sum) < 0.7 * error && statistics.samples > samples);
        error = sqrt(sum);
        samples = statistics.samples;
        pel_image_destroy(picture);
    }
    pel_image_destroy(truth);
    pel_renderer_destroy(renderer);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_opacity),
        cmocka_unit_test(test_colour),
        cmocka_unit_test(test_ends),
        cmocka_unit_test(test_quality),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
