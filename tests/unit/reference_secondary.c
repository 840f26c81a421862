// reference_secondary.c - the reference's shadows and ambient occlusion against analytic truth:
// everything expected here is a closed formula.
#include <math.h>

#include "base/math.h"
#include "reference/secondary.h"
#include "support/near.h"
#include "support/scenes.h"
#include "support/test.h"

static struct pel_transfer *haze(double opacity) {
    return scene_transfer_constant((double[]){1, 1, 1, opacity});
}

static double extinction(double opacity) {
    return -log(1 - opacity);
}

// What comes through along a ray of the scene, from a place on.
static double through(const struct pel_scene *scene, const double from[3], const double along[3],
                      double end, double step_mm) {
    struct reference *reference = reference_create(scene);
    struct reference_ray ray = {{from[0], from[1], from[2]}, {along[0], along[1], along[2]}};
    assert_true(pel_normalize(ray.direction));
    double light = reference_light_through(reference, &ray, end, step_mm, NULL, 0);
    reference_destroy(reference);
    return light;
}

// Two crossed slabs of haze: depths add where both are, whatever they are made of, up to the ray's
// end.
static void test_slabs(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(1, 1);
    scene_add(scene, scene_volume_constant((int[]){20, 20, 8}, PEL_VOXEL_U8, 7), haze(0.2));
    scene_add(scene, scene_volume_constant((int[]){20, 6, 20}, PEL_VOXEL_F32, 7), haze(0.1));
    scene->instances[1].density = 3;
    const double first = extinction(0.2), second = 3 * extinction(0.1);
    const double from[3] = {1, 0.5, -30}, up[3] = {0, 0, 1};
    for (int halvings = 0; halvings <= 2; halvings++) {
        double step_mm = ldexp(1, -halvings);
        assert_near(through(scene, from, up, INFINITY, step_mm), exp(-8 * first - 20 * second),
                    1e-12);
        assert_near(through(scene, from, up, 30, step_mm), exp(-4 * first - 10 * second), 1e-12);
        assert_near(through(scene, from, up, 8, step_mm), 1, 0);
    }
    assert_near(through(scene, from, up, INFINITY, 4), exp(-8 * first - 20 * second), 1e-12);
    // Slanted, 3:4:5.
    const double slanted[3] = {0, 3, 4}, below[3] = {0.3, -22.5, -30};
    assert_near(through(scene, below, slanted, INFINITY, 1. / 64), exp(-10 * first - 10 * second),
                0.01 * exp(-10 * first - 10 * second));
    // From within, and away from everything.
    assert_near(through(scene, (double[]){0, 5, 0}, up, INFINITY, 0.5), exp(-4 * first), 1e-12);
    assert_near(through(scene, (double[]){0, 5, 0}, (double[]){0, 1, 0}, INFINITY, 0.5),
                exp(-5 * first), 1e-12);
    pel_scene_destroy(scene);
}

// Media are mixed as in the picture, and what is clipped away casts no shadow.
static void test_mixing(void **state) {
    (void)state;
    static const struct {
        enum pel_mixing mixing;
        double depth; // in millimetres of haze 0.2, whose double is the other
    } cases[] = {{PEL_MIX_SUM, 30},       {PEL_MIX_OVER, 30},        {PEL_MIX_ORDERED, 30},
                 {PEL_MIX_MAX, 20},       {PEL_MIX_PRIORITY, 10},    {PEL_MIX_UNION, 20},
                 {PEL_MIX_DIFFERENCE, 0}, {PEL_MIX_INTERSECTION, 10}};
    const double from[3] = {0.5, 0.5, -20}, up[3] = {0, 0, 1};
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        struct pel_scene *scene = scene_create(1, 1);
        const int dims[3] = {10, 10, 10};
        scene_add(scene, scene_volume_constant(dims, PEL_VOXEL_U8, 7), haze(0.2));
        scene_add_again(scene, 0, haze(0.2))->density = 2;
        scene->render.mixing = cases[n].mixing;
        assert_near(through(scene, from, up, INFINITY, 0.5), exp(-cases[n].depth * extinction(0.2)),
                    1e-9);
        pel_scene_destroy(scene);
    }
    struct pel_scene *scene = scene_create(1, 1);
    scene_add(scene, scene_volume_constant((int[]){10, 10, 10}, PEL_VOXEL_U8, 7), haze(0.2));
    scene->clip_count = 1;
    scene->clips[0] = (struct pel_clip){
        .kind = PEL_CLIP_BOX, .outside = true, .point = {0, 0, 1}, .size = {4, 4, 4}};
    assert_near(through(scene, from, up, INFINITY, 0.5), exp(-6 * extinction(0.2)), 1e-12);
    pel_scene_destroy(scene);
}

static double height_above(const double p_voxel[3], const void *user) {
    (void)user;
    return 100 - p_voxel[2];
}

// A surface lets through what it does not hide, however long the step is; there is none behind.
static void test_surface(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(1, 1);
    scene_add(scene, scene_volume((int[]){10, 10, 20}, PEL_VOXEL_F32, height_above, NULL),
              haze(0.9));
    scene->instances[0].model = PEL_MODEL_ISO;
    scene->instances[0].surface_count = 2;
    scene->instances[0].surfaces[0] = (struct pel_surface){.value = 95, .opacity = 0.25};
    scene->instances[0].surfaces[1] = (struct pel_surface){.value = 90.25, .opacity = 0.5};
    const double up[3] = {0, 0, 1}, slanted[3] = {1, 0, 3};
    for (int doublings = -1; doublings <= 1; doublings++) {
        double step_mm = ldexp(1, doublings);
        assert_near(through(scene, (double[]){0, 0, -30}, up, INFINITY, step_mm), 0.375, 1e-12);
        assert_near(through(scene, (double[]){0, 0, -2}, up, INFINITY, step_mm), 0.5, 1e-12);
        assert_near(through(scene, (double[]){-3, 0, -2}, slanted, INFINITY, step_mm), 0.5, 1e-12);
        assert_near(through(scene, (double[]){0, 0, 2}, up, INFINITY, step_mm), 1, 0);
    }
    pel_scene_destroy(scene);
}

// Directions are of length 1, lie on one side, evenly: half a sphere's mean cosine is 1/2, and its
// mean direction half as long. Another seed gives others.
static void test_directions(void **state) {
    (void)state;
    enum { COUNT = PEL_OCCLUSION_DIRECTION_MAX };
    double first[3];
    for (uint32_t seed = 0; seed < 8; seed++) {
        double sum[3] = {0}, along = 0;
        const double axis[3] = {0.36, -0.48, 0.8};
        for (int k = 0; k < COUNT; k++) {
            double d[3];
            reference_direction(d, seed, k, COUNT);
            assert_near(pel_length(d), 1, 1e-12);
            along += fabs(pel_dot(d, axis)) / COUNT;
            for (int c = 0; c < 3; c++)
                sum[c] += d[c] / COUNT;
            if (k == 0 && seed == 0)
                memcpy(first, d, sizeof first);
            else if (k == 0)
                assert_true(pel_dot(d, first) < 0.999);
        }
        assert_near(pel_length(sum), 0.5, 0.01);
        assert_near(along, 0.5, 0.01);
    }
}

// ---- Walls -------------------------------------------------------------------------------------

// Opaque where at least one of the first `walls` coordinates is below the middle.
static double walls_at(const double p_voxel[3], const void *user) {
    const int *walls = user;
    for (int c = 0; c < *walls; c++)
        if (p_voxel[2 - c] < 20)
            return 200;
    return 0;
}

static double ball_at(const double p_voxel[3], const void *user) {
    (void)user;
    double away[3] = {p_voxel[0] - 20, p_voxel[1] - 20, p_voxel[2] - 20};
    return pel_length(away) <= 12 ? 200 : 0;
}

// A scene of hard voxels, 1 mm each, opaque or not there.
static struct pel_scene *hard_scene(scene_field field, const void *user) {
    const double points[3][5] = {{0, 1, 1, 1, 0}, {100, 1, 1, 1, 0}, {101, 1, 1, 1, 1}};
    struct pel_scene *scene = scene_create(1, 1);
    scene_add(scene, scene_volume((int[]){41, 41, 41}, PEL_VOXEL_U8, field, user),
              scene_transfer(points, 3));
    scene->instances[0].filter = PEL_FILTER_NEAREST;
    scene->instances[0].material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    scene->render.ambient_occlusion = (struct pel_ambient_occlusion){
        .on = true, .directions = PEL_OCCLUSION_DIRECTION_MAX, .radius_mm = 16, .step = 0.5};
    return scene;
}

// What ambient occlusion leaves at a place with a normal, seen from the front; the mean over seeds.
static double around(struct pel_scene *scene, const double p[3], const double normal[3]) {
    enum { SEEDS = 8 };
    double sum = 0;
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        scene->render.supersampling.seed = seed;
        struct reference *reference = reference_create(scene);
        const struct reference_ray ray = {{p[0], p[1], p[2]}, {-normal[0], -normal[1], -normal[2]}};
        const double towards[1][3] = {{0, 0, 1}};
        sum +=
            reference_dimming(reference, &reference->bodies[0], &ray, 0, normal, towards, NULL, 0)
                .around;
        reference_destroy(reference);
    }
    return sum / SEEDS;
}

// A plane by itself hides nothing, one wall beside a floor half of what the floor sees, and two in
// a corner three quarters. Behind the radius nothing counts.
static void test_walls(void **state) {
    (void)state;
    static const double left[] = {1, 0.5, 0.25};
    const double up[3] = {0, 0, 1};
    for (int walls = 1; walls <= 3; walls++) {
        struct pel_scene *scene = hard_scene(walls_at, &walls);
        // The walls end half a voxel before the middle. The rays begin a voxel above the floor.
        const double corner[3] = {-0.49, -0.49, -1.45}, far[3] = {17, 17, -1.45};
        assert_near(around(scene, corner, up), left[walls - 1], 0.02);
        assert_near(around(scene, far, up), 1, 1e-12);
        scene->render.ambient_occlusion.strength = 0.5;
        assert_near(around(scene, corner, up), (1 + left[walls - 1]) / 2, 0.01);
        pel_scene_destroy(scene);
    }
}

// Outside a convex body nothing is hidden, whichever way its surface is seen.
static void test_convex(void **state) {
    (void)state;
    struct pel_scene *scene = hard_scene(ball_at, NULL);
    for (int n = 0; n < 20; n++) {
        double z = 1 - (2 * n + 1) / 20.0, angle = n * 2.399963, r = sqrt(1 - z * z);
        double out[3] = {r * cos(angle), r * sin(angle), z}, in[3], p[3];
        for (int c = 0; c < 3; c++) {
            p[c] = 11.8 * out[c];
            in[c] = -out[c];
        }
        struct reference *reference = reference_create(scene);
        const struct reference_ray ray = {{p[0], p[1], p[2]}, {in[0], in[1], in[2]}};
        const double towards[1][3] = {{0, 0, 1}};
        for (int turned = 0; turned < 2; turned++) {
            struct reference_dimming dimming = reference_dimming(
                reference, &reference->bodies[0], &ray, 0, turned ? in : out, towards, NULL, 0);
            // Voxels have edges, which rays near the surface may meet.
            assert_near(dimming.around, 1, 0.05);
        }
        reference_destroy(reference);
    }
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slabs),   cmocka_unit_test(test_mixing),
        cmocka_unit_test(test_surface), cmocka_unit_test(test_directions),
        cmocka_unit_test(test_walls),   cmocka_unit_test(test_convex),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
