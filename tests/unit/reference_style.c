// reference_style.c - the reference's gradients and the opacity that follows them, against analytic
// truth.
#include <math.h>

#include "base/math.h"
#include "reference/gradient.h"
#include "reference/reference.h"
#include "reference/style.h"
#include "support/near.h"
#include "support/scenes.h"
#include "support/test.h"

static const int dims[3] = {12, 11, 13};

static double ramp(const double p[3], const void *user) {
    (void)user;
    return 10 + 2 * p[0] - 3 * p[1] + 0.5 * p[2];
}

static double bowl(const double p[3], const void *user) {
    (void)user;
    return p[0] * p[0] + 0.5 * p[1] * p[1] + 2 * p[2] + 0.25 * p[0] * p[2];
}

static double distance(const double p[3], const void *user) {
    (void)user;
    return 2 * pel_length((double[]){p[0] - 5.5, p[1] - 5, p[2] - 6});
}

static struct pel_scene *scene_of(scene_field field, enum pel_gradient gradient,
                                  enum pel_filter filter) {
    struct pel_scene *scene = scene_create(4, 4);
    struct pel_volume *volume = scene_volume(dims, PEL_VOXEL_F32, field, NULL);
    struct pel_instance *instance =
        scene_add(scene, volume,
                  scene_transfer((const double[][5]){{0, 1, 1, 1, 0.2}, {20, 1, 1, 1, 0.2}}, 2));
    instance->gradient = gradient;
    instance->filter = filter;
    return scene;
}

static void gradient_at(double along[3], scene_field field, enum pel_gradient gradient,
                        enum pel_filter filter, const double p[3]) {
    struct pel_scene *scene = scene_of(field, gradient, filter);
    struct reference *reference = reference_create(scene);
    const struct reference_body *body = &reference->bodies[0];
    struct reference_sample sample;
    double spread;
    assert_true(reference_sample_volume(&sample, body->volume, filter, p));
    reference_gradient(along, body, p, sample.value, &spread);
    reference_destroy(reference);
    pel_scene_destroy(scene);
}

// Every way finds the slopes of a ramp, through every filter that reproduces it.
static void test_ramp(void **state) {
    (void)state;
    static const enum pel_filter filters[] = {PEL_FILTER_LINEAR, PEL_FILTER_CUBIC_B_SPLINE,
                                              PEL_FILTER_CATMULL_ROM};
    for (int gradient = 0; gradient <= PEL_GRADIENT_ANALYTIC; gradient++)
        for (int f = 0; f < 3; f++) {
            double along[3];
            gradient_at(along, ramp, (enum pel_gradient)gradient, filters[f],
                        (double[]){4.3, 5.6, 6.2});
            assert_near(along[0], 2, 1e-5);
            assert_near(along[1], -3, 1e-5);
            assert_near(along[2], 0.5, 1e-5);
        }
}

// The derivative of a quadratic field: the cubic filters' own is exact, that of a cell is its
// secant, and Sobel's is central differences smoothed across.
static void test_bowl(void **state) {
    (void)state;
    const double p[3] = {4.25, 5.5, 6};
    double along[3];
    gradient_at(along, bowl, PEL_GRADIENT_ANALYTIC, PEL_FILTER_CATMULL_ROM, p);
    assert_near(along[0], 2 * 4.25 + 0.25 * 6, 1e-4);
    assert_near(along[1], 5.5, 1e-4);
    assert_near(along[2], 2 + 0.25 * 4.25, 1e-4);
    gradient_at(along, bowl, PEL_GRADIENT_ANALYTIC, PEL_FILTER_CUBIC_B_SPLINE, p);
    assert_near(along[0], 2 * 4.25 + 0.25 * 6, 1e-4);
    gradient_at(along, bowl, PEL_GRADIENT_ANALYTIC, PEL_FILTER_LINEAR, p);
    assert_near(along[0], 9 + 0.25 * 6, 1e-4);
    gradient_at(along, bowl, PEL_GRADIENT_ANALYTIC, PEL_FILTER_NEAREST, p);
    assert_near(along[0], 9 + 0.25 * 6, 1e-4);
    gradient_at(along, bowl, PEL_GRADIENT_SOBEL, PEL_FILTER_CATMULL_ROM, p);
    assert_near(along[0], 2 * 4.25 + 0.25 * 6, 1e-4);
}

// On a sphere the angle of a ray is known: a silhouette is nothing in its middle and everything at
// its rim. The length of the gradient is 2 everywhere.
static void test_sphere(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of(distance, PEL_GRADIENT_ANALYTIC, PEL_FILTER_CATMULL_ROM);
    struct pel_instance *instance = &scene->instances[0];
    struct reference *reference = reference_create(scene);
    const struct reference_body *body = &reference->bodies[0];
    const struct reference_ray ray = {.direction = {0, 0, 1}};
    const double front[3] = {5.5, 5, 2}, rim[3] = {9.5, 5, 6}, between[3] = {5.5, 7.4, 2.8};
    assert_near(reference_style_factor(body, &ray, front, 8, 0, NULL), 1, 0);
    instance->silhouette = (struct pel_silhouette){0.25, 3, 2};
    assert_near(reference_style_factor(body, &ray, front, 8, 0, NULL), 0.25, 1e-3);
    assert_near(reference_style_factor(body, &ray, rim, 8, 0, NULL), 3.25, 0.01);
    assert_near(reference_style_factor(body, &ray, between, 8, 0, NULL), 0.25 + 3 * 0.04, 0.02);
    instance->silhouette = (struct pel_silhouette){0};
    instance->gradient_opacity_count = 2;
    instance->gradient_opacity[0] = (struct pel_gradient_point){1, 0.5};
    instance->gradient_opacity[1] = (struct pel_gradient_point){5, 2.5};
    assert_near(reference_style_factor(body, &ray, front, 8, 0, NULL), 1, 0.02);
    reference_destroy(reference);
    pel_scene_destroy(scene);
}

// Extinction is scaled, so half of it over the whole way is the square root of the transmittance,
// whatever the step.
static void test_step(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of(ramp, PEL_GRADIENT_CENTRAL, PEL_FILTER_LINEAR);
    double plain[4], scaled[4];
    reference_ray(scene, 1.5, 1.5, plain, NULL);
    scene->instances[0].gradient_opacity_count = 1;
    scene->instances[0].gradient_opacity[0] = (struct pel_gradient_point){0, 0.5};
    for (int n = 1; n < 4; n++) {
        scene->render.step = 1.0 / n;
        reference_ray(scene, 1.5, 1.5, scaled, NULL);
        assert_near(1 - scaled[3], sqrt(1 - plain[3]), 0.03);
    }
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ramp),
        cmocka_unit_test(test_bowl),
        cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
