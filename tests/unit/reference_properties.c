// reference_properties.c - what must not change the reference's picture, and what must.
#include <math.h>

#include "base/math.h"
#include "reference/reference.h"
#include "support/picture.h"
#include "support/scenes.h"
#include "support/test.h"

// Rounding in double precision, of 255; a picture of floats has 2^-24 of its own.
static const double EXACT = 1e-4;

static void destroy_all(struct pel_image *a, struct pel_image *b, struct pel_scene *scene) {
    pel_image_destroy(a);
    pel_image_destroy(b);
    pel_scene_destroy(scene);
}

// Random scenes with rough edges taken off: what this file asks of them holds exactly.
static struct pel_scene *scene_without_termination(uint64_t seed, enum pel_mixing mixing) {
    struct pel_scene *scene = scene_random(seed, true);
    scene->render.termination = 1;
    scene->render.mixing = mixing;
    return scene;
}

static void test_permutation(void **state) {
    (void)state;
    int differing = 0;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        for (int mixing = PEL_MIX_SUM; mixing <= PEL_MIX_OVER; mixing++) {
            struct pel_scene *scene = scene_without_termination(seed, (enum pel_mixing)mixing);
            struct pel_image *before = reference_render(scene);
            int reversed[PEL_VOLUME_MAX];
            for (int k = 0; k < scene->instance_count; k++)
                reversed[k] = scene->instance_count - 1 - k;
            scene_permute(scene, reversed);
            struct pel_image *after = reference_render(scene);
            if (mixing == PEL_MIX_SUM)
                assert_pictures_within(after, before, EXACT, 0, "permuted");
            else
                differing += picture_compare(after, before, 0.01).beyond_count > 0;
            destroy_all(before, after, scene);
        }
    }
    // `over` is an order: somewhere it shows.
    assert_true(differing > 2);
}

static void test_back_to_front(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        for (int mixing = PEL_MIX_SUM; mixing <= PEL_MIX_OVER; mixing++) {
            struct pel_scene *scene = scene_without_termination(seed, (enum pel_mixing)mixing);
            struct pel_image *forwards = reference_render(scene);
            struct pel_image *backwards = reference_render_back_to_front(scene);
            assert_pictures_within(backwards, forwards, EXACT, 0, "back to front");
            destroy_all(forwards, backwards, scene);
        }
    }
}

static void test_termination_saves_and_hardly_shows(void **state) {
    (void)state;
    uint64_t taken[2] = {0, 0};
    for (uint64_t seed = 1; seed <= 12; seed++) {
        struct pel_scene *scene = scene_random(seed, true);
        for (int k = 0; k < scene->instance_count; k++)
            scene->instances[k].density *= 20;
        for (int end = 0; end < 2; end++) {
            scene->render.termination = end ? 0.99 : 1;
            struct reference *reference = reference_create(scene);
            for (int x = 0; x < 16; x++) {
                double rgba[4];
                reference_cast(reference, x, 6, rgba, &taken[end]);
            }
            reference_destroy(reference);
        }
        struct pel_image *ended = reference_render(scene);
        struct pel_image *whole = reference_render_back_to_front(scene);
        assert_pictures_within(ended, whole, 0.01 * 255, 0, "ended early");
        destroy_all(ended, whole, scene);
    }
    assert_true(taken[1] < taken[0]);
}

static void test_moving_everything(void **state) {
    (void)state;
    struct pel_matrix transform =
        pel_matrix_from_quaternion((double[]){0.4, 0.2, -0.7, 0.5}, (double[]){300, -50, 20});
    struct reference_errors errors = {.rounding = 1e-10};
    for (uint64_t seed = 1; seed <= 12; seed++) {
        struct pel_scene *scene = scene_random(seed, true);
        // Bounds along the world's axes do not turn with the scene.
        scene->render.origin = PEL_ORIGIN_VOLUMES;
        struct pel_image *before = reference_render(scene);
        // Leave out rays that rounding decides about.
        struct reference *reference = reference_create(scene);
        double worst = 0;
        for (int y = 0; y < before->height; y++)
            for (int x = 0; x < before->width; x++)
                worst = fmax(worst, reference_cast_bound(reference, x, y, &errors));
        reference_destroy(reference);
        scene_move(scene, &transform);
        struct pel_image *after = reference_render(scene);
        assert_true(worst < 1e-4);
        assert_pictures_within(after, before, EXACT + 255 * worst, 0, "moved");
        destroy_all(before, after, scene);
    }
}

// A scene of one oblique volume of waves, seen in perspective.
static struct pel_scene *one_volume(struct pel_volume *volume, struct pel_transfer *transfer) {
    struct pel_scene *scene = scene_create(24, 18);
    struct pel_instance *instance = scene_add(scene, volume, transfer);
    instance->transform =
        pel_matrix_from_quaternion((double[]){0.3, 0.6, 0.2, 0.7}, (double[]){1, -2, 0});
    return scene;
}

static struct pel_transfer *byte_transfer(int entries) {
    struct pel_transfer *transfer = scene_transfer(
        (const double[][5]){{0, 1, 0, 0, 0}, {100, 0, 1, 0.5, 0.1}, {255, 0.2, 0, 1, 0.02}}, 3);
    transfer->table_entries = entries;
    return transfer;
}

static double byte_of(const double p[3], const void *user) {
    const struct pel_volume *bytes = user;
    return ((const uint8_t *)bytes
                ->voxels)[((int)p[2] * bytes->dims[1] + (int)p[1]) * bytes->dims[0] + (int)p[0]];
}

// The same values, stored in other types and scaled, make the same picture with the same table.
static void test_voxel_type(void **state) {
    (void)state;
    const int dims[3] = {18, 20, 22};
    struct pel_volume *bytes = scene_volume_waves(dims, PEL_VOXEL_U8, 5, 10);
    struct pel_scene *scene = one_volume(bytes, byte_transfer(0));
    struct pel_image *expected = reference_render(scene);
    for (int type = PEL_VOXEL_U16; type <= PEL_VOXEL_F32; type++) {
        struct pel_volume *other = scene_volume(dims, (enum pel_voxel_type)type, byte_of, bytes);
        struct pel_scene *twin = one_volume(other, byte_transfer(256));
        struct pel_image *actual = reference_render(twin);
        assert_pictures_within(actual, expected, EXACT, 0, pel_voxel_type_name(other->type));
        destroy_all(actual, NULL, twin);
    }
    // Raw value r stands for 255 - r: the table over the same range is the same table.
    struct pel_volume *turned = scene_volume(dims, PEL_VOXEL_U8, byte_of, bytes);
    for (size_t i = 0; i < pel_volume_voxel_count(turned); i++)
        ((uint8_t *)turned->voxels)[i] = (uint8_t)(255 - ((uint8_t *)turned->voxels)[i]);
    turned->slope = -1;
    turned->intercept = 255;
    struct pel_scene *twin = one_volume(turned, byte_transfer(0));
    struct pel_image *actual = reference_render(twin);
    assert_pictures_within(actual, expected, EXACT, 0, "turned around");
    destroy_all(actual, NULL, twin);
    destroy_all(expected, NULL, scene);
}

// A trilinear field, sampled coarsely or finely: the same field, and the same picture where samples
// lie in the same places.
static double field_at_mm(const double p[3], const void *user) {
    double spacing = *(const double *)user, x = p[0] * spacing, y = p[1] * spacing,
           z = p[2] * spacing;
    return x * y + 3 * z + 40 - x * z;
}

static void test_resampling(void **state) {
    (void)state;
    struct pel_image *pictures[2];
    for (int n = 0; n < 2; n++) {
        double spacing = n ? 1 : 2;
        int count = n ? 17 : 9;
        struct pel_volume *volume =
            scene_volume((int[]){count, count, count}, PEL_VOXEL_F32, field_at_mm, &spacing);
        scene_place(volume, (double[]){spacing, spacing, spacing}, (double[]){0.2, 0.5, 0, 1},
                    (double[]){0, 0, 0}, false);
        struct pel_scene *scene = one_volume(volume, byte_transfer(0));
        scene->instances[0].extent = PEL_EXTENT_POINT;
        scene->render.step = 0.25 / spacing;
        pictures[n] = reference_render(scene);
        pel_scene_destroy(scene);
    }
    assert_pictures_within(pictures[1], pictures[0], EXACT, 0, "resampled");
    destroy_all(pictures[0], pictures[1], scene_create(1, 1));
}

// A step in millimetres, or of one volume, is the same grid of samples said otherwise.
static void test_steps_said_otherwise(void **state) {
    (void)state;
    struct pel_scene *scene = scene_random(3, true);
    double least = INFINITY;
    for (int k = 0; k < scene->instance_count; k++) {
        double spacing[3];
        pel_volume_spacing(scene->volumes[scene->instances[k].volume], spacing);
        least = fmin(least, fmin(spacing[0], fmin(spacing[1], spacing[2])));
    }
    scene->render.step = 0.75;
    struct pel_image *expected = reference_render(scene);
    scene->render.step = 5; // millimetres come before voxels
    scene->render.step_mm = 0.75 * least;
    struct pel_image *picture = reference_render(scene);
    assert_pictures_within(picture, expected, 1e-6, 0, "millimetres");
    pel_image_destroy(picture);
    scene->render.step_mm = 100; // and the finest volume decides
    scene->instances[0].step_mm = 0.75 * least;
    picture = reference_render(scene);
    assert_pictures_within(picture, expected, 1e-6, 0, "of one volume");
    pel_image_destroy(picture);
    pel_image_destroy(expected);
    pel_scene_destroy(scene);
}

// Halving the step brings the picture nearer to the truth: the error of one ray is up to a sample
// at each end, so the whole picture's converges with the step.
static void test_step_converges(void **state) {
    (void)state;
    struct pel_scene *scene =
        one_volume(scene_volume_waves((int[]){20, 20, 20}, PEL_VOXEL_U16, 7, 12),
                   scene_transfer_gentle((double[]){0, 40000}, 0.1, 3));
    struct pel_image *pictures[4];
    for (int n = 0; n < 4; n++) {
        scene->render.step = n == 3 ? 1.0 / 64 : 1 / exp2(n);
        pictures[n] = reference_render(scene);
    }
    double before = picture_compare(pictures[0], pictures[3], 0).psnr_db;
    for (int n = 1; n < 3; n++) {
        double now = picture_compare(pictures[n], pictures[3], 0).psnr_db;
        assert_true(now > before + 4);
        before = now;
    }
    for (int n = 0; n < 4; n++)
        pel_image_destroy(pictures[n]);
    pel_scene_destroy(scene);
}

// A scene in metres instead of millimetres: everything a thousand times as large, opacity too.
static void test_scale(void **state) {
    (void)state;
    struct pel_image *pictures[2];
    for (int n = 0; n < 2; n++) {
        double scale = n ? 1000 : 1;
        struct pel_volume *volume = scene_volume_waves((int[]){15, 9, 12}, PEL_VOXEL_F32, 8, 9);
        scene_place(volume, (double[]){scale, 2 * scale, scale}, (double[]){0.2, 0.5, 0, 1},
                    (double[]){0, 0, 0}, true);
        struct pel_scene *scene = scene_create(24, 18);
        struct pel_transfer *transfer = scene_transfer_gentle((double[]){-1, 2}, 0.1, 4);
        transfer->opacity_unit_mm = scale;
        scene_add(scene, volume, transfer);
        scene->camera.eye[2] *= scale;
        pictures[n] = reference_render(scene);
        pel_scene_destroy(scene);
    }
    assert_pictures_within(pictures[1], pictures[0], EXACT, 0, "scaled");
    destroy_all(pictures[0], pictures[1], scene_create(1, 1));
}

// A volume cut into two that share a layer of voxels, as boxes end at voxel centres.
static void test_cut_in_two(void **state) {
    (void)state;
    const int whole[3] = {21, 20, 19};
    for (int mixing = PEL_MIX_SUM; mixing <= PEL_MIX_OVER; mixing++) {
        struct pel_volume *volume = scene_volume_waves(whole, PEL_VOXEL_U8, 9, 12);
        scene_place(volume, (double[]){1, 1.2, 0.9}, (double[]){0.1, 0.4, 0.3, 0.8},
                    (double[]){0, 0, 0}, false);
        struct pel_scene *one = one_volume(volume, byte_transfer(0));
        one->instances[0].extent = PEL_EXTENT_POINT;

        struct pel_scene *two = scene_create(24, 18);
        for (int half = 0; half < 2; half++) {
            int first = half ? 8 : 0, last = half ? 20 : 8;
            struct pel_volume *part =
                pel_volume_create("part", (int[]){last - first + 1, 20, 19}, PEL_VOXEL_U8);
            for (int row = 0; row < 20 * 19; row++)
                memcpy((uint8_t *)part->voxels + row * part->dims[0],
                       (uint8_t *)volume->voxels + row * 21 + first, (size_t)part->dims[0]);
            struct pel_matrix shift = pel_matrix_translation((double[]){first, 0, 0});
            part->world_from_voxel = pel_matrix_multiply(&volume->world_from_voxel, &shift);
            struct pel_instance *instance = scene_add(two, part, byte_transfer(0));
            instance->transform = one->instances[0].transform;
            instance->extent = PEL_EXTENT_POINT;
        }
        one->render.mixing = two->render.mixing = (enum pel_mixing)mixing;
        struct pel_image *expected = reference_render(one), *actual = reference_render(two);
        assert_pictures_within(actual, expected, EXACT, 0, "cut in two");
        destroy_all(expected, actual, one);
        pel_scene_destroy(two);
    }
}

// Twice the density lets the square of the light through; and so do two of one volume in one place.
static void test_density(void **state) {
    (void)state;
    struct pel_scene *scene =
        one_volume(scene_volume_waves((int[]){12, 12, 12}, PEL_VOXEL_I8, 6, 12),
                   scene_transfer_gentle((double[]){-100, 100}, 0.1, 5));
    struct pel_image *once = reference_render(scene);
    scene->instances[0].density = 2;
    struct pel_image *dense = reference_render(scene);
    scene->instances[0].density = 1;
    scene_add_again(scene, 0, scene_transfer_gentle((double[]){-100, 100}, 0.1, 5))->transform =
        scene->instances[0].transform;
    struct pel_image *twice = reference_render(scene);
    assert_pictures_within(twice, dense, EXACT, 0, "two in one place");
    for (int i = 0; i < once->width * once->height; i++) {
        double through = 1 - once->rgba[4 * i + 3];
        assert_true(fabs(dense->rgba[4 * i + 3] - (1 - through * through)) < 1e-6);
    }
    pel_image_destroy(once);
    destroy_all(dense, twice, scene);
}

static void test_absent_and_hidden(void **state) {
    (void)state;
    struct pel_scene *scene =
        one_volume(scene_volume_waves((int[]){12, 12, 12}, PEL_VOXEL_I8, 6, 12),
                   scene_transfer_gentle((double[]){-100, 100}, 0.1, 5));
    struct pel_image *alone = reference_render(scene);
    // A volume of nothing, as fine and lying within the other, so that samples stay where they are.
    struct pel_volume *nothing = scene_volume_constant((int[]){4, 4, 4}, PEL_VOXEL_F32, NAN);
    ((float *)nothing->voxels)[0] = INFINITY;
    scene_add(scene, nothing, scene_transfer_constant((double[]){1, 1, 1, 1}));
    scene->instances[1].transform = scene->instances[0].transform;
    struct pel_image *with_nothing = reference_render(scene);
    assert_pictures_equal(with_nothing, alone, "absent");
    // A hidden one, however fine.
    struct pel_volume *hidden = scene_volume_constant((int[]){40, 40, 40}, PEL_VOXEL_U8, 255);
    scene_place(hidden, (double[]){0.1, 0.1, 3}, (double[]){0, 0, 0, 1}, (double[]){0, 0, 30},
                false);
    scene_add(scene, hidden, byte_transfer(0))->hidden = true;
    struct pel_image *with_hidden = reference_render(scene);
    assert_pictures_equal(with_hidden, alone, "hidden");
    pel_image_destroy(with_hidden);
    destroy_all(alone, with_nothing, scene);
}

// An upright box alone in the scene is its own bounds.
static void test_sample_origin(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(24, 18);
    scene_add(scene, scene_volume_waves((int[]){12, 14, 16}, PEL_VOXEL_U8, 6, 12),
              byte_transfer(0));
    struct pel_image *volumes = reference_render(scene);
    scene->render.origin = PEL_ORIGIN_BOUNDS;
    struct pel_image *bounds = reference_render(scene);
    assert_pictures_within(bounds, volumes, EXACT, 0, "origin");
    destroy_all(volumes, bounds, scene);
}

// The bound holds for a volume that is off by one everywhere, and is not much too wide.
static void test_bound(void **state) {
    (void)state;
    const int dims[3] = {16, 16, 16};
    struct pel_volume *volume = scene_volume_waves(dims, PEL_VOXEL_U8, 5, 10);
    struct pel_scene *scene = one_volume(volume, byte_transfer(0));
    struct pel_image *before = reference_render(scene);
    struct reference *reference = reference_create(scene);
    struct reference_errors errors = {.rounding = 1e-9, .value = 1};
    double bounds[18][24], tightest = INFINITY;
    for (int y = 0; y < 18; y++)
        for (int x = 0; x < 24; x++)
            bounds[y][x] = reference_cast_bound(reference, x, y, &errors);
    reference_destroy(reference);

    for (size_t i = 0; i < pel_volume_voxel_count(volume); i++) {
        uint8_t *voxel = (uint8_t *)volume->voxels + i;
        *voxel = (uint8_t)(*voxel < 255 ? *voxel + 1 : 255);
    }
    struct pel_image *after = reference_render(scene);
    for (int i = 0; i < 18 * 24; i++) {
        double bound = bounds[i / 24][i % 24], off = 0;
        for (int c = 0; c < 4; c++)
            off = fmax(off, fabs((double)after->rgba[4 * i + c] - before->rgba[4 * i + c]));
        assert_true(off <= 1.1 * bound + 1e-6);
        if (off > 0.002)
            tightest = fmin(tightest, bound / off);
    }
    assert_true(tightest < 4);
    destroy_all(before, after, scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_permutation),
        cmocka_unit_test(test_back_to_front),
        cmocka_unit_test(test_termination_saves_and_hardly_shows),
        cmocka_unit_test(test_moving_everything),
        cmocka_unit_test(test_voxel_type),
        cmocka_unit_test(test_resampling),
        cmocka_unit_test(test_step_converges),
        cmocka_unit_test(test_steps_said_otherwise),
        cmocka_unit_test(test_scale),
        cmocka_unit_test(test_cut_in_two),
        cmocka_unit_test(test_density),
        cmocka_unit_test(test_absent_and_hidden),
        cmocka_unit_test(test_sample_origin),
        cmocka_unit_test(test_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
