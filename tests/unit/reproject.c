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
    for (int sign = -1; sign <= 1; sign += 2) {
        const struct pel_parallax parallax = {sign * 2.25, sign * 150};
        assert_true(pel_reproject(second, holes, first, depth, &parallax));
        int set = 0;
        for (int i = 0; i < WIDTH * ROWS; i++) {
            int y = i / WIDTH;
            const struct reference_row row = {.width = WIDTH,
                                              .rgba =
                                                  (const float(*)[4])(first->rgba + 4 * WIDTH * y),
                                              .depth = depth + WIDTH * y,
                                              .shift = parallax.shift_px,
                                              .reach = parallax.reach_mm_px};
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
    const struct pel_parallax parallax = {1, 300}; // 2 pixels to the left
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
    struct pel_parallax parallax = pel_parallax_between(cameras, 40, 30);
    assert_float_equal(parallax.shift_px - parallax.reach_mm_px / 100, 0, 1e-9);
    assert_float_equal(parallax.shift_px - parallax.reach_mm_px / 50, -10, 1e-9);
    // The left camera's middle ray goes to (0, 0, 0) and is as long as from (-5, 0, 100).
    float depth[] = {(float)sqrt(100 * 100 + 5 * 5)};
    const struct pel_render_settings settings = {.width = 1, .height = 1};
    pel_depth_from_distance(depth, &cameras[0], &settings);
    assert_float_equal(depth[0], 100, 1e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_rows),
        cmocka_unit_test(test_plane),
        cmocka_unit_test(test_parallax),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
