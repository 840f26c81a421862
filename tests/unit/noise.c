// Tests of the noises' tables and of their reference, against published values and first
// principles.
#include "support/test.h"

#include "reference/noise.h"
#include "support/near.h"
#include "world/recipe.h"

static struct recipe tables_of(uint32_t seed) {
    struct recipe tables = {.length = 0};
    pel_recipe_seed(&tables, seed);
    return tables;
}

static void random_point(uint64_t *state, double scale, double p[3]) {
    for (int axis = 0; axis < 3; axis++)
        p[axis] = scale * (2 * test_random(state) - 1);
}

// The table printed with Perlin's implementation begins and ends so, and his noise has this value
// at (3.14, 42, 7), as implementations in some forty languages agree.
static void test_published(void **state) {
    (void)state;
    struct recipe tables = tables_of(0);
    assert_int_equal(tables.permutation[0], 151);
    assert_int_equal(tables.permutation[1], 160);
    assert_int_equal(tables.permutation[255], 180);
    assert_near(reference_noise_2002(&tables, (double[]){3.14, 42, 7}), 0.13691995878400012, 1e-15);
}

// In the middle of the cell at (0,0,0) every corner weighs 1/8. Worked out by hand from the printed
// table p: p[0] = 151 and p[1] = 160, so the corners' numbers p[p[p[x] + y] + z], with z fastest,
// are 36 103 108 110 for x = 0 and 86 164 128 195 for x = 1. Their low four bits choose the
// gradients (1,0,1) (-1,0,-1) (1,1,0) (-1,1,0) and (1,0,-1) (1,0,1) (1,1,0) (-1,-1,0), which times
// the way from the corner are 1, 0, 0, -1 and -1, -1, -1, 1.
static void test_middle(void **state) {
    (void)state;
    struct recipe tables = tables_of(0);
    assert_near(reference_noise_2002(&tables, (double[]){0.5, 0.5, 0.5}), -2.0 / 8, 1e-15);
}

static void test_tables(void **state) {
    (void)state;
    for (uint32_t seed = 0; seed < 20; seed++) {
        struct recipe tables = tables_of(seed);
        int seen[RECIPE_LATTICE] = {0};
        for (int i = 0; i < RECIPE_LATTICE; i++) {
            float4 g = tables.gradients[i];
            assert_true(tables.permutation[i] < RECIPE_LATTICE);
            seen[tables.permutation[i]]++;
            assert_near(sqrt((double)g.x * g.x + (double)g.y * g.y + (double)g.z * g.z), 1, 1e-6);
        }
        for (int i = 0; i < RECIPE_LATTICE; i++)
            assert_int_equal(seen[i], 1);
        struct recipe again = tables_of(seed), other = tables_of(seed + 1);
        assert_memory_equal(&tables, &again, sizeof tables);
        assert_memory_not_equal(tables.permutation, other.permutation, sizeof other.permutation);
        assert_memory_not_equal(tables.gradients, other.gradients, sizeof other.gradients);
    }
}

// Gradient noise is 0 at the lattice's points, and its slope there is the gradient.
static void test_lattice(void **state) {
    (void)state;
    struct recipe tables = tables_of(3);
    uint64_t random = 1;
    for (int i = 0; i < 200; i++) {
        double p[3], beside[3];
        random_point(&random, 300, p);
        double slope_2002 = 0, slope_1985 = 0;
        for (int axis = 0; axis < 3; axis++)
            p[axis] = floor(p[axis]);
        assert_near(reference_noise_2002(&tables, p), 0, 1e-15);
        assert_near(reference_noise_1985(&tables, p), 0, 1e-15);
        for (int axis = 0; axis < 3; axis++) {
            memcpy(beside, p, sizeof p);
            beside[axis] += 1e-4;
            slope_2002 += pow(reference_noise_2002(&tables, beside) / 1e-4, 2);
            slope_1985 += pow(reference_noise_1985(&tables, beside) / 1e-4, 2);
        }
        assert_near(slope_2002, 2, 1e-3);
        assert_near(slope_1985, 1, 1e-3);
    }
}

static void test_range(void **state) {
    (void)state;
    struct recipe tables = tables_of(0);
    uint64_t random = 2;
    double low = 0, high = 0, sum = 0;
    enum { COUNT = 50000 };
    for (int i = 0; i < COUNT; i++) {
        double p[3];
        random_point(&random, 100, p);
        double noise = reference_noise_2002(&tables, p);
        low = fmin(low, noise);
        high = fmax(high, noise);
        sum += noise;
        assert_true(fabs(noise) <= 1.04);
        assert_true(fabs(reference_noise_1985(&tables, p)) <= 1);
        double ridged = reference_ridged(&tables, p, 3);
        assert_true(ridged >= 0 && ridged <= 1);
        assert_true(reference_turbulence(&tables, p, 3) >= fabs(reference_fbm(&tables, p, 3)));
    }
    assert_true(low < -0.7 && high > 0.7);
    assert_near(sum / COUNT, 0, 0.02);
}

// The n-th distance grows with n, and changes no faster than the point moves. Of points as thick as
// four to a unit cube the nearest is 0.554 / 4^(1/3) = 0.349 away on average (Hertz 1909).
static void test_worley(void **state) {
    (void)state;
    struct recipe tables = tables_of(0);
    uint64_t random = 3;
    double sum = 0;
    enum { COUNT = 4000 };
    for (int i = 0; i < COUNT; i++) {
        double p[3];
        random_point(&random, 100, p);
        double before = 0;
        for (int nth = 1; nth <= 4; nth++) {
            double distance = reference_worley(&tables, p, nth);
            assert_true(distance >= before);
            before = distance;
        }
        double beside[3] = {p[0] + 0.01, p[1], p[2]};
        double distance = reference_worley(&tables, p, 1);
        assert_true(fabs(reference_worley(&tables, beside, 1) - distance) <= 0.01 + 1e-12);
        sum += distance;
    }
    assert_near(sum / COUNT, 0.349, 0.01);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published), cmocka_unit_test(test_middle),
        cmocka_unit_test(test_tables),    cmocka_unit_test(test_lattice),
        cmocka_unit_test(test_range),     cmocka_unit_test(test_worley),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
