// reference_mix.c - docs/mixing.md by hand, by analytic truth, and by properties.
#include "reference/reference.h"

#include <math.h>

#include "support/near.h"
#include "support/scenes.h"
#include "support/test.h"

static const double red[4] = {1, 0, 0, 0.1}, blue[4] = {0, 0, 1, 0.3}, green[4] = {0, 1, 0, 0.2};

// Extinction per millimetre of an opacity per millimetre.
static double extinction(const double rgba[4]) {
    return -log(1 - rgba[3]);
}

// Boxes of one colour each, 8 mm wide and as far apart along the ray as `offsets` say, seen through
// the middle.
static struct pel_scene *scene_of_boxes(const double *const colours[], const double *offsets,
                                        int count) {
    struct pel_scene *scene = scene_create(1, 1);
    scene_view_parallel(scene, 4);
    for (int n = 0; n < count; n++) {
        struct pel_volume *volume = scene_volume_constant((int[]){8, 8, 8}, PEL_VOXEL_U8, 100);
        scene_add(scene, volume, scene_transfer_constant(colours[n]))->transform.m[2][3] =
            -offsets[n];
    }
    scene->render.step = 0.25;
    return scene;
}

static void cast(const struct pel_scene *scene, double rgba[4]) {
    reference_ray(scene, 0, 0, rgba, NULL);
}

// Two boxes of which the second begins half way: 4 mm of one, 4 mm of both, 4 mm of the other.
static void test_two_boxes(void **state) {
    (void)state;
    const double a = extinction(red), b = extinction(blue);
    const struct {
        enum pel_mixing mixing;
        double both;       // extinction where both are,
        double first_only; // where the first is alone,
        double last_only;  // and where the second is
        double red;        // the first one's share of the colour where both are
    } cases[] = {
        {PEL_MIX_SUM, a + b, a, b, a / (a + b)},
        {PEL_MIX_MAX, b, a, b, 0},
        {PEL_MIX_PRIORITY, a, a, b, 1},
        {PEL_MIX_UNION, b, a, b, a / (a + b)},
        {PEL_MIX_INTERSECTION, a, 0, 0, a / (a + b)},
        {PEL_MIX_DIFFERENCE, 0, a, 0, 1},
    };
    struct pel_scene *scene = scene_of_boxes((const double *[]){red, blue}, (double[]){0, 4}, 2);
    scene->instances[0].priority = 1;
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        double rgba[4];
        scene->render.mixing = cases[n].mixing;
        cast(scene, rgba);
        double t1 = exp(-4 * cases[n].first_only), t2 = t1 * exp(-4 * cases[n].both);
        double t3 = t2 * exp(-4 * cases[n].last_only);
        assert_near(rgba[3], 1 - t3, 1e-9);
        assert_near(rgba[0], 1 - t1 + cases[n].red * (t1 - t2), 1e-9);
        assert_near(rgba[2], (1 - cases[n].red) * (t1 - t2) + t2 - t3, 1e-9);
    }
    // The weaker one taken away from the stronger one leaves the rest of it.
    scene_permute(scene, (int[]){1, 0});
    scene->render.mixing = PEL_MIX_DIFFERENCE;
    double rgba[4];
    cast(scene, rgba);
    assert_near(rgba[3], 1 - exp(-4 * (b - a) - 4 * b), 1e-9);
    pel_scene_destroy(scene);
}

// In order, each box has its own samples: both are 8 mm long, at steps of 1 and of 2 mm.
static void test_ordered(void **state) {
    (void)state;
    double rgba[4], expected[4] = {0};
    struct pel_scene *scene = scene_of_boxes((const double *[]){red, blue}, (double[]){0, 0.25}, 2);
    scene->render.mixing = PEL_MIX_ORDERED;
    scene->render.step = 1;
    scene->instances[1].step = 2;
    cast(scene, rgba);
    // Red at 0.5, 1.5 ... 7.5, blue at 1.25, 3.25, 5.25, 7.25.
    static const int order[] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    for (size_t n = 0; n < sizeof order / sizeof *order; n++) {
        const double *colour = order[n] ? blue : red;
        double a = 1 - exp(-extinction(colour) * (order[n] ? 2 : 1));
        for (int c = 0; c < 3; c++)
            expected[c] += (1 - expected[3]) * a * colour[c];
        expected[3] += (1 - expected[3]) * a;
    }
    for (int c = 0; c < 4; c++)
        assert_near(rgba[c], expected[c], 1e-9);
    pel_scene_destroy(scene);
}

// A box beside the other changes nothing about it, wherever it lies: in order, samples are counted
// from each one's own entry.
static void test_ordered_keeps_samples(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(1, 1);
    scene_view_parallel(scene, 4);
    struct pel_volume *ramp = scene_volume_ramp((int[]){9, 9, 9}, PEL_VOXEL_U8, (double[]){0, 255});
    scene_add(scene, ramp,
              scene_transfer((const double[][5]){{0, 0, 0, 1, 0}, {255, 1, 0, 0, 0.4}}, 2));
    scene->render.mixing = PEL_MIX_ORDERED;
    scene->render.step = 1.3;
    double alone[4], both[4], far[4];
    cast(scene, alone);
    struct pel_volume *box = scene_volume_constant((int[]){3, 3, 3}, PEL_VOXEL_U8, 1);
    scene_add(scene, box, scene_transfer_constant(green))->transform.m[2][3] = -11.37;
    cast(scene, both);
    double a = 1 - exp(-extinction(green) * 1.3), t = (1 - alone[3]) * (1 - a) * (1 - a);
    assert_near(both[3], 1 - t, 1e-9); // two samples lie in 3 mm at steps of 1.3 mm
    assert_near(both[0], alone[0], 1e-9);
    scene->instances[1].transform.m[0][3] = 50;
    cast(scene, far);
    for (int c = 0; c < 4; c++)
        assert_near(far[c], alone[c], 1e-12);
    pel_scene_destroy(scene);
}

static void assert_permuted_same(struct pel_scene *scene, const int order[]) {
    double before[4], after[4];
    cast(scene, before);
    scene_permute(scene, order);
    cast(scene, after);
    for (int c = 0; c < 4; c++)
        assert_near(after[c], before[c], 1e-12);
}

// Three boxes, two of which overlap twice.
static void test_permuting(void **state) {
    (void)state;
    struct pel_scene *scene =
        scene_of_boxes((const double *[]){red, blue, green}, (double[]){0, 3, 5}, 3);
    for (int k = 0; k < 3; k++)
        scene->instances[k].priority = k;
    static const enum pel_mixing mixings[] = {PEL_MIX_SUM, PEL_MIX_MAX, PEL_MIX_PRIORITY,
                                              PEL_MIX_UNION, PEL_MIX_INTERSECTION};
    for (size_t n = 0; n < sizeof mixings / sizeof *mixings; n++) {
        scene->render.mixing = mixings[n];
        assert_permuted_same(scene, (int[]){2, 0, 1});
        scene_permute(scene, (int[]){1, 2, 0});
    }
    // Of those that are taken away the order does not matter either.
    scene->render.mixing = PEL_MIX_DIFFERENCE;
    assert_permuted_same(scene, (int[]){0, 2, 1});
    pel_scene_destroy(scene);
}

static void assert_same_cast(struct pel_scene *scene, enum pel_mixing one, enum pel_mixing other) {
    double a[4], b[4];
    scene->render.mixing = one;
    cast(scene, a);
    scene->render.mixing = other;
    cast(scene, b);
    for (int c = 0; c < 4; c++)
        assert_near(a[c], b[c], 1e-12);
}

static void test_identities(void **state) {
    (void)state;
    double alone[4], rgba[4];
    // Where nothing overlaps, everything but what is common to all is the sum.
    struct pel_scene *scene =
        scene_of_boxes((const double *[]){red, blue, green}, (double[]){0, 9, 20}, 3);
    assert_same_cast(scene, PEL_MIX_SUM, PEL_MIX_UNION);
    assert_same_cast(scene, PEL_MIX_SUM, PEL_MIX_MAX);
    assert_same_cast(scene, PEL_MIX_SUM, PEL_MIX_PRIORITY);
    assert_same_cast(scene, PEL_MIX_SUM, PEL_MIX_OVER);
    scene->render.mixing = PEL_MIX_INTERSECTION;
    cast(scene, rgba);
    assert_near(rgba[3], 0, 0);
    // The difference to what is elsewhere is the first.
    scene->render.mixing = PEL_MIX_DIFFERENCE;
    cast(scene, rgba);
    scene->instances[1].hidden = scene->instances[2].hidden = true;
    cast(scene, alone);
    for (int c = 0; c < 4; c++)
        assert_near(rgba[c], alone[c], 1e-12);
    pel_scene_destroy(scene);

    // The same twice: union and intersection are it, the difference is nothing.
    scene = scene_of_boxes((const double *[]){green, green}, (double[]){0, 0}, 2);
    assert_same_cast(scene, PEL_MIX_UNION, PEL_MIX_INTERSECTION);
    assert_same_cast(scene, PEL_MIX_UNION, PEL_MIX_MAX);
    cast(scene, rgba);
    assert_near(rgba[3], 1 - exp(-8 * extinction(green)), 1e-9);
    scene->render.mixing = PEL_MIX_DIFFERENCE;
    cast(scene, rgba);
    assert_near(rgba[3], 0, 0);
    // On one grid, in order is over.
    assert_same_cast(scene, PEL_MIX_ORDERED, PEL_MIX_OVER);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_boxes),
        cmocka_unit_test(test_ordered),
        cmocka_unit_test(test_ordered_keeps_samples),
        cmocka_unit_test(test_permuting),
        cmocka_unit_test(test_identities),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
