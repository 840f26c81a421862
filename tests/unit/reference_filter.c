// reference_filter.c - the reference's cubic filters against analytic truth: which polynomials they
// reproduce, and what they do to a single bright voxel.
#include <math.h>

#include "reference/sample.h"
#include "support/near.h"
#include "support/scenes.h"
#include "support/test.h"

static const int dims[3] = {9, 8, 10};

// Coefficients of a polynomial in x, y and z: the sum of c[n][d] times coordinate n to the power d,
// and a product of all three.
struct polynomial {
    double c[3][4], product;
};

static double polynomial_value(const double p[3], const void *user) {
    const struct polynomial *polynomial = user;
    double sum = polynomial->product * p[0] * p[1] * p[2];
    for (int n = 0; n < 3; n++)
        for (int d = 3; d >= 0; d--)
            sum += polynomial->c[n][d] * pow(p[n], d);
    return sum;
}

static double value_at(const struct pel_volume *volume, enum pel_filter filter, const double p[3]) {
    struct reference_sample sample;
    assert_true(reference_sample_volume(&sample, volume, filter, p));
    return sample.value;
}

// The greatest difference from the polynomial in the middle of its volume, where nothing is
// clamped.
static double greatest_error(const struct polynomial *polynomial, enum pel_filter filter) {
    struct pel_volume *volume = scene_volume(dims, PEL_VOXEL_F32, polynomial_value, polynomial);
    uint64_t seed = 7;
    double greatest = 0;
    for (int n = 0; n < 200; n++) {
        double p[3];
        for (int c = 0; c < 3; c++)
            p[c] = 1 + (dims[c] - 3) * test_random(&seed);
        greatest =
            fmax(greatest, fabs(value_at(volume, filter, p) - polynomial_value(p, polynomial)));
    }
    pel_volume_destroy(volume);
    return greatest;
}

static void test_polynomials(void **state) {
    (void)state;
    const struct polynomial linear = {{{3, 0.5}, {0, -2}, {0, 1.25}}, 0.125};
    const struct polynomial quadratic = {{{3, 0.5, 0.25}, {0, -2, 0.5}, {0, 1.25, -0.125}}, 0.125};
    const struct polynomial cubic = {{{0, 0, 0, 0.25}}, 0};
    assert_true(greatest_error(&linear, PEL_FILTER_LINEAR) < 1e-5);
    assert_true(greatest_error(&linear, PEL_FILTER_CUBIC_B_SPLINE) < 1e-5);
    assert_true(greatest_error(&linear, PEL_FILTER_CATMULL_ROM) < 1e-5);
    assert_true(greatest_error(&quadratic, PEL_FILTER_LINEAR) > 0.05);
    assert_true(greatest_error(&quadratic, PEL_FILTER_CATMULL_ROM) < 1e-5);
    // The B-spline adds a third of each second derivative's half: x^2 becomes x^2 + 1/3.
    assert_near(greatest_error(&quadratic, PEL_FILTER_CUBIC_B_SPLINE), (0.25 + 0.5 - 0.125) / 3,
                1e-5);
    // Catmull & Rom's spline misses x^3 by f (1 - f) (2 f - 1) / 2 at most 0.0481 of its
    // coefficient.
    assert_near(greatest_error(&cubic, PEL_FILTER_CATMULL_ROM), 0.25 * sqrt(3) / 18, 1e-4);
}

// One bright voxel shows the kernel itself.
static void test_impulse(void **state) {
    (void)state;
    struct pel_volume *volume = scene_volume_constant(dims, PEL_VOXEL_U8, 0);
    ((uint8_t *)volume->voxels)[(4 * dims[1] + 4) * dims[0] + 4] = 216;
    const struct {
        double p[3], b_spline, catmull_rom;
    } truths[] = {
        {{4, 4, 4}, 216 * 8 / 27.0, 216},
        {{5, 4, 4}, 216 * 4 / 54.0, 0},
        {{4.5, 4, 4}, 216 * (23 / 48.0) * 4 / 9, 216 * 9 / 16.0},
        {{2.5, 4, 4}, 216 / 48.0 * 4 / 9, -216 / 16.0},
        {{5.5, 5.5, 4}, 216 / 48.0 / 48 * 2 / 3, 216 / 256.0},
        {{6.5, 4, 4}, 0, 0},
    };
    for (size_t n = 0; n < sizeof truths / sizeof *truths; n++) {
        assert_near(value_at(volume, PEL_FILTER_CUBIC_B_SPLINE, truths[n].p), truths[n].b_spline,
                    1e-12);
        assert_near(value_at(volume, PEL_FILTER_CATMULL_ROM, truths[n].p), truths[n].catmull_rom,
                    1e-12);
    }
    pel_volume_destroy(volume);
}

// Beyond the outer voxels a field goes on as at its edge, and an absent voxel reaches as far as the
// filter does.
static void test_edges(void **state) {
    (void)state;
    struct pel_volume *volume = scene_volume_constant(dims, PEL_VOXEL_F32, 5);
    assert_near(value_at(volume, PEL_FILTER_CATMULL_ROM, (double[]){-0.5, 7.5, 0.2}), 5, 1e-12);
    assert_near(value_at(volume, PEL_FILTER_CUBIC_B_SPLINE, (double[]){-0.5, 7.5, 0.2}), 5, 1e-12);
    ((float *)volume->voxels)[0] = NAN;
    struct reference_sample sample;
    const double near[3] = {1.5, 1.2, 1.9}, far[3] = {2.01, 1, 1};
    assert_true(reference_sample_volume(&sample, volume, PEL_FILTER_LINEAR, near));
    assert_false(reference_sample_volume(&sample, volume, PEL_FILTER_CATMULL_ROM, near));
    assert_false(reference_sample_volume(&sample, volume, PEL_FILTER_CUBIC_B_SPLINE, near));
    assert_true(reference_sample_volume(&sample, volume, PEL_FILTER_CATMULL_ROM, far));
    pel_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_polynomials),
        cmocka_unit_test(test_impulse),
        cmocka_unit_test(test_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
