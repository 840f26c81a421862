// Tests of host/render/reproject.c: rows moved to the second eye, against the reference and by
// hand.
#include "render/reproject.h"

#include <math.h>

#include "reference/reproject.h"
#include "support/test.h"

enum { WIDTH = 32, ROWS = 200 };

// The same numbers in each run.
static double draw(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) * 0x1p-24;
}

// Surfaces at random depths and slopes, beside and before each other, and gaps between them.
static void fill_row(float *rgba, float *depth, uint32_t *state) {
    double z = 50, slope = 0;
    bool nothing = false;
    for (int x = 0; x < WIDTH; x++) {
        if (draw(state) < 0.15) {
            nothing = draw(state) < 0.3;
            z = 20 + 200 * draw(state);
            slope = 8 * draw(state) - 4;
        }
        z = fmax(z + slope, 10);
        depth[x] = nothing ? INFINITY : (float)z;
        for (int c = 0; c < 4; c++)
            rgba[4 * x + c] = nothing ? 0 : (float)draw(state);
    }
}

static void test_random_rows(void **state) {
    (void)state;
    struct pel_image *first = pel_image_create(WIDTH, ROWS);
    struct pel_image *second = pel_image_create(WIDTH, ROWS);
    static float depth[WIDTH * ROWS];
    static uint8_t holes[WIDTH * ROWS];
    uint32_t seed = 7;
    for (int y = 0; y < ROWS; y++)
        fill_row(first->rgba + 4 * WIDTH * y, depth + WIDTH * y, &seed);
    for (int n = 0; n < 4; n++) {
        int sign = n % 2 ? 1 : -1;
        struct pel_parallax parallax = {.shift_px = sign * 2.25, .reach_mm_px = sign * 150};
        if (n >= 2)
            parallax = (struct pel_parallax){.shift_px = sign * -4.5,
                                             .orthographic = true,
                                             .scale = 0.99,
                                             .slope_px_mm = sign * 0.04,
                                             .lean_mm_px = sign * 0.3,
                                             .fall = 0.98,
                                             .empty_mm = 100};
        assert_true(pel_reproject(second, holes, first, depth, &parallax));
        int set = 0;
        for (int i = 0; i < WIDTH * ROWS; i++) {
            int y = i / WIDTH;
            const struct reference_row row = {.width = WIDTH,
                                              .rgba =
                                                  (const float(*)[4])(first->rgba + 4 * WIDTH * y),
                                              .depth = depth + WIDTH * y,
                                              .shift = parallax.shift_px,
                                              .reach = parallax.reach_mm_px,
                                              .orthographic = parallax.orthographic,
                                              .scale = parallax.scale,
                                              .slope = parallax.slope_px_mm,
                                              .lean = parallax.lean_mm_px,
                                              .fall = parallax.fall,
                                              .empty = parallax.empty_mm};
            double rgba[4];
            bool known = reference_reproject(rgba, &row, i % WIDTH);
            assert_int_equal(holes[i], !known);
            for (int c = 0; known && c < 4; c++)
                assert_float_equal(second->rgba[4 * i + c], rgba[c], 1e-5);
            set += known;
        }
        assert_in_range(set, WIDTH * ROWS / 4, WIDTH * ROWS * 3 / 4);
    }
    pel_image_destroy(first);
    pel_image_destroy(second);
}

// A plane moves by whole pixels, and what comes into view at its end is cast.
static void test_plane(void **state) {
    (void)state;
    struct pel_image *first = pel_image_create(8, 1), *second = pel_image_create(8, 1);
    float depth[8];
    uint8_t holes[8];
    for (int x = 0; x < 8; x++) {
        depth[x] = 100;
        first->rgba[4 * x] = (float)x;
    }
    const struct pel_parallax parallax = {.shift_px = 1,
                                          .reach_mm_px = 300}; // 2 pixels to the left
    assert_true(pel_reproject(second, holes, first, depth, &parallax));
    for (int x = 0; x < 8; x++) {
        assert_int_equal(holes[x], x >= 6);
        if (x < 6)
            assert_float_equal(second->rgba[4 * x], x + 2, 0);
    }
    depth[3] = 0; // it is not known where one pixel goes
    assert_true(pel_reproject(second, holes, first, depth, &parallax));
    for (int x = 0; x < 8; x++)
        assert_int_equal(holes[x], 1);
    pel_image_destroy(first);
    pel_image_destroy(second);
}

// Cameras 10 mm apart that agree at 100 mm, where a picture of 40 x 30 pixels is 40 mm wide.
static void test_parallax(void **state) {
    (void)state;
    double fov = 2 * atan(0.15) * 180 / 3.14159265358979323846, shift = 5 / 30.0;
    const struct pel_camera cameras[2] = {{.eye = {-5, 0, 100},
                                           .target = {-5, 0, 0},
                                           .up = {0, 1, 0},
                                           .fov_deg = fov,
                                           .shift = {shift, 0}},
                                          {.eye = {5, 0, 100},
                                           .target = {5, 0, 0},
                                           .up = {0, 1, 0},
                                           .fov_deg = fov,
                                           .shift = {-shift, 0}}};
    const struct pel_render_settings whole = {.width = 40, .height = 30};
    struct pel_parallax parallax = pel_parallax_between(cameras, &whole);
    assert_float_equal(parallax.shift_px - parallax.reach_mm_px / 100, 0, 1e-9);
    assert_float_equal(parallax.shift_px - parallax.reach_mm_px / 50, -10, 1e-9);
    // The left camera's middle ray goes to (0, 0, 0) and is as long as from (-5, 0, 100).
    float depth[] = {(float)sqrt(100 * 100 + 5 * 5)};
    const struct pel_render_settings settings = {.width = 1, .height = 1};
    pel_depth_from_distance(depth, &cameras[0], &settings);
    assert_float_equal(depth[0], 100, 1e-4);
}

// A point in space is found where both cameras see it: the second one is turned by an angle whose
// cosine is 0.8 and sine 0.6, and both look at (0, 0, 0).
static void test_orthographic(void **state) {
    (void)state;
    const struct pel_camera cameras[2] = {{.eye = {0, 0, 100},
                                           .up = {0, 1, 0},
                                           .orthographic = true,
                                           .height_mm = 30,
                                           .shift = {0.1, 0}},
                                          {.eye = {60, 0, 80},
                                           .up = {0, 1, 0},
                                           .orthographic = true,
                                           .height_mm = 30,
                                           .shift = {0.1, 0}}};
    // A region of a picture of 40 x 30 pixels of 1 mm, whose middle is 3 mm to the right.
    const struct pel_render_settings part = {.width = 40, .height = 30, .region = {8, 0, 20, 30}};
    struct pel_parallax parallax = pel_parallax_between(cameras, &part);
    const double points[3][3] = {{0, 0, 0}, {5, 2, -7}, {-4, 1, 20}};
    for (int n = 0; n < 3; n++) {
        const double *p = points[n];
        // The second camera's right is (0.8, 0, -0.6), and forward (-0.6, 0, -0.8).
        double x = p[0] - 3 + 20 - 8, second = 0.8 * p[0] - 0.6 * p[2] - 3 + 20 - 8;
        double z = 100 - p[2], second_z = -0.6 * (p[0] - 60) - 0.8 * (p[2] - 80);
        assert_float_equal(parallax.scale * x + parallax.shift_px + parallax.slope_px_mm * z,
                           second, 1e-9);
        double origin = -0.6 * (3 - 60 + 8 - 20) + 0.8 * 80 - 0.8 * 100; // of x = 0, z = 0
        assert_float_equal(parallax.lean_mm_px * x + parallax.fall * z + origin, second_z, 1e-9);
    }
    assert_float_equal(parallax.empty_mm, 100, 1e-9);
    float depth[] = {70};
    pel_depth_from_distance(depth, &cameras[0],
                            &(struct pel_render_settings){.width = 1, .height = 1});
    assert_float_equal(depth[0], 70, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_rows),
        cmocka_unit_test(test_plane),
        cmocka_unit_test(test_parallax),
        cmocka_unit_test(test_orthographic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
