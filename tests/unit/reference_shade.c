// reference_shade.c - the reference's shading against analytic truth: everything expected here is a
// closed formula or was worked out by hand.
#include <math.h>

#include "base/math.h"
#include "reference/reference.h"
#include "reference/shade.h"
#include "support/near.h"
#include "support/scenes.h"
#include "support/test.h"

static const double turn[4] = {0.31, -0.42, 0.17, 0.83}, middle[3] = {-1.3, 2.1, 0.7};
static const double spacing[3] = {0.7, 1.3, 2.1};

static struct pel_transfer *grey(double low, double high) {
    const double points[2][5] = {{low, 0.5, 0.25, 0.125, 0.2}, {high, 0.5, 0.25, 0.125, 0.2}};
    return scene_transfer(points, 2);
}

// A field that is a function of the place in the world.
struct world_field {
    struct pel_matrix world_from_voxel;
    double direction[3]; // of the ramp; zero: the distance from `middle`
};

static double field_value(const double p_voxel[3], const void *user) {
    const struct world_field *field = user;
    double p[3], away[3];
    pel_matrix_point(p, &field->world_from_voxel, p_voxel);
    for (int c = 0; c < 3; c++)
        away[c] = p[c] - middle[c];
    bool ramp = pel_length(field->direction) > 0;
    return ramp ? 100 + pel_dot(away, field->direction) : pel_length(away);
}

// A scene of one anisotropic, oblique and mirrored volume that holds the field.
static struct pel_scene *field_scene(const double direction[3], int width) {
    const int dims[3] = {40, 28, 20};
    struct pel_volume *volume = pel_volume_create("field", dims, PEL_VOXEL_F32);
    assert_non_null(volume);
    scene_place(volume, spacing, turn, middle, true);
    struct world_field field = {volume->world_from_voxel,
                                {direction[0], direction[1], direction[2]}};
    float *voxels = volume->voxels;
    for (int k = 0; k < dims[2]; k++)
        for (int j = 0; j < dims[1]; j++)
            for (int i = 0; i < dims[0]; i++)
                *voxels++ = (float)field_value((double[]){i, j, k}, &field);
    struct pel_scene *scene = scene_create(width, width);
    struct pel_instance *instance = scene_add(scene, volume, grey(0, 200));
    instance->material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    return scene;
}

// The normals of a distance field point to the middle, however the voxels lie; N points to lesser
// values.
static void test_sphere(void **state) {
    (void)state;
    struct pel_scene *scene = field_scene((double[]){0, 0, 0}, 1);
    struct reference *reference = reference_create(scene);
    const struct reference_body *body = &reference->bodies[0];
    for (int n = 0; n < 50; n++) {
        // Spread over a sphere of 10 mm by the golden angle.
        double z = 1 - (2 * n + 1) / 50.0, angle = n * 2.399963, r = sqrt(1 - z * z);
        double out[3] = {r * cos(angle), r * sin(angle), z}, p[3], normal[3];
        for (int c = 0; c < 3; c++)
            p[c] = middle[c] + 10 * out[c];
        pel_matrix_point(p, &body->voxel_from_world, p);
        struct reference_sample sample;
        assert_true(reference_sample_volume(&sample, body->volume, PEL_FILTER_LINEAR, p));
        reference_normal(normal, body, p, sample.value, NULL);
        // Central differences over up to 4 mm of a sphere of 10 mm: the error is about h^2 / 2 r^2.
        assert_near(pel_dot(normal, out), -1, 0.004);
    }
    reference_destroy(reference);
    pel_scene_destroy(scene);
}

// The gradient of a ramp is exact but for the rounding of its voxels to floats, so that its shade
// is a constant: here n.l = 0.8 by a light along -x on a plane that is tilted 3:4.
static void test_plane(void **state) {
    (void)state;
    struct pel_scene *scene = field_scene((double[]){1.6, 1.2, 0}, 1);
    scene->light_count = 1;
    scene->lights[0] = (struct pel_light){.kind = PEL_LIGHT_DIRECTIONAL,
                                          .direction = {3, 0, 0},
                                          .colour = {1, 1, 0.5},
                                          .intensity = 2};
    struct reference *reference = reference_create(scene);
    const struct reference_body *body = &reference->bodies[0];
    double p[3] = {20.3, 13.1, 9.9}, normal[3];
    struct reference_sample sample;
    assert_true(reference_sample_volume(&sample, body->volume, PEL_FILTER_LINEAR, p));
    reference_normal(normal, body, p, sample.value, NULL);
    assert_near(normal[0], -0.8, 1e-5);
    assert_near(normal[1], -0.6, 1e-5);
    assert_near(normal[2], 0, 1e-5);

    // The viewer looks along y. L = (-1, 0, 0), V = (0, -1, 0), H = (-1, -1, 0) / sqrt 2:
    // n.l = 0.8, n.h = 1.4 / sqrt 2.
    const struct reference_ray ray = {{0, -50, 0}, {0, 1, 0}};
    double shine = pow(1.4 / sqrt(2), 10);
    struct reference_shade shade = reference_shade(reference, body, &ray, 40, normal);
    assert_near(shade.matt[0], 0.1 + 2 * 0.7 * 0.8, 1e-5);
    assert_near(shade.matt[2], 0.1 + 0.7 * 0.8, 1e-5);
    assert_near(shade.gloss[1], 2 * 0.2 * shine, 1e-4);
    assert_near(shade.gloss[2], 0.2 * shine, 1e-4);

    // Phong: L mirrored is 2 * 0.8 n - L = (-0.28, -0.96, 0), so that s = 0.96.
    scene->instances[0].material.shading = PEL_SHADING_PHONG;
    shade = reference_shade(reference, body, &ray, 40, normal);
    assert_near(shade.gloss[1], 2 * 0.2 * pow(0.96, 10), 1e-4);

    // From the other side: as bright when two-sided, and ambient alone when not.
    scene->lights[0].direction[0] = -3;
    shade = reference_shade(reference, body, &ray, 40, normal);
    assert_near(shade.matt[0], 0.1 + 2 * 0.7 * 0.8, 1e-5);
    scene->instances[0].material.one_sided = true;
    shade = reference_shade(reference, body, &ray, 40, normal);
    assert_near(shade.matt[0], 0.1, 0);
    assert_near(shade.gloss[0], 0, 0);
    reference_destroy(reference);
    pel_scene_destroy(scene);
}

// Where the four kinds of light come from, on a wall that faces -z and is seen along z.
static void test_lights(void **state) {
    (void)state;
    struct pel_scene *scene = field_scene((double[]){0, 0, 2}, 1);
    struct pel_camera *camera = &scene->camera;
    for (int c = 0; c < 3; c++)
        camera->eye[c] = c == 1 ? 4 : 0, camera->target[c] = c == 2 ? 3 : 0;
    struct reference *reference = reference_create(scene);
    const double normal[3] = {0, 0, -1};
    const struct reference_ray ray = {{0, 0, -30}, {0, 0, 1}};
    const struct {
        struct pel_light light;
        double facing;
    } cases[] = {
        {{.kind = PEL_LIGHT_HEADLIGHT}, 1},
        {{.kind = PEL_LIGHT_CAMERA}, 0.6}, // forward is (0, -4, 3) / 5
        {{.kind = PEL_LIGHT_DIRECTIONAL, .direction = {5, 0, 12}}, 12 / 13.0},
        {{.kind = PEL_LIGHT_POINT, .position = {0, 24, -20}}, 10 / 26.0},
    };
    // At t = 20 the sample is at (0, 0, -10).
    for (int n = 0; n < 4; n++) {
        scene->light_count = 1;
        scene->lights[0] = cases[n].light;
        scene->lights[0].intensity = 1;
        scene->lights[0].colour[0] = 1;
        struct reference_shade shade =
            reference_shade(reference, &reference->bodies[0], &ray, 20, normal);
        assert_near(shade.matt[0], 0.1 + 0.7 * cases[n].facing, 1e-12);
    }
    // Light opposite the viewer has no half-way vector.
    scene->lights[0] = (struct pel_light){.kind = PEL_LIGHT_DIRECTIONAL,
                                          .direction = {0, 0, -1},
                                          .colour = {1, 1, 1},
                                          .intensity = 1};
    struct reference_shade shade =
        reference_shade(reference, &reference->bodies[0], &ray, 20, normal);
    assert_near(shade.gloss[0], 0, 0);
    reference_destroy(reference);
    pel_scene_destroy(scene);
}

// No gradient, no light: what is left is the ambient part.
static void test_no_gradient(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(1, 1);
    scene_view_parallel(scene, 1);
    scene->render.step = 1;
    const int dims[3] = {4, 4, 4};
    struct pel_volume *volume = scene_volume_constant(dims, PEL_VOXEL_U8, 77);
    struct pel_instance *instance = scene_add(scene, volume, grey(0, 255));
    double bare[4], shaded[4];
    reference_ray(scene, 0, 0, bare, NULL);
    instance->material = (struct pel_material){.shading = PEL_SHADING_PHONG, .ambient = 0.25};
    instance->material.diffuse = instance->material.specular = instance->material.shininess = 1;
    reference_ray(scene, 0, 0, shaded, NULL);
    for (int c = 0; c < 3; c++)
        assert_near(shaded[c], 0.25 * bare[c], 1e-12);
    assert_near(shaded[3], bare[3], 0); // opacity stays
    pel_scene_destroy(scene);
}

// Turning everything, lights and camera included, changes nothing.
static void test_rigid_motion(void **state) {
    (void)state;
    struct pel_scene *scene = field_scene((double[]){0, 0, 0}, 12);
    scene->light_count = 4;
    scene->lights[0] = (struct pel_light){.colour = {0.2, 0.1, 0}, .intensity = 1};
    scene->lights[1] =
        (struct pel_light){.kind = PEL_LIGHT_CAMERA, .colour = {0, 0.2, 0.1}, .intensity = 2};
    scene->lights[2] = (struct pel_light){.kind = PEL_LIGHT_DIRECTIONAL,
                                          .direction = {1, 2, -3},
                                          .colour = {0.3, 0, 0.4},
                                          .intensity = 1};
    scene->lights[3] = (struct pel_light){.kind = PEL_LIGHT_POINT,
                                          .position = {20, -30, 40},
                                          .colour = {0.5, 0.3, 0.1},
                                          .intensity = 1};
    struct pel_image *before = reference_render(scene);
    struct pel_matrix motion =
        pel_matrix_from_quaternion((double[]){0.2, 0.5, -0.1, 0.6}, (double[]){11, -7, 5});
    scene_move(scene, &motion);
    struct pel_image *after = reference_render(scene);
    double greatest = 0;
    for (int i = 0; i < 4 * 12 * 12; i++) {
        greatest = fmax(greatest, (double)before->rgba[i]);
        assert_near(after->rgba[i], before->rgba[i], 1e-6);
    }
    assert_true(greatest > 0.1);
    pel_image_destroy(before);
    pel_image_destroy(after);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere),       cmocka_unit_test(test_plane),
        cmocka_unit_test(test_lights),       cmocka_unit_test(test_no_gradient),
        cmocka_unit_test(test_rigid_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
