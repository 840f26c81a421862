// generate.c - synthetic volumes against what their formulae and their physics say.
#include "support/test.h"

#include <math.h>

#include "base/math.h"
#include "support/near.h"
#include "volume/generate.h"

static struct pel_volume *generate(const char *kind, int size, enum pel_voxel_type type) {
    struct pel_volume *volume =
        pel_volume_generate(kind, &(struct pel_generate_options){.size = size, .type = type});
    if (!volume)
        fail_msg("%s: %s", kind, pel_error_message());
    return volume;
}

static void voxel_place(double p[3], const struct pel_volume *volume, int i, int j, int k) {
    pel_matrix_point(p, &volume->world_from_voxel, (double[]){i, j, k});
}

// The value of the voxel whose cell holds the world point; NaN outside.
static double value_at(const struct pel_volume *volume, const double p_world[3]) {
    struct pel_matrix voxel_from_world;
    assert_true(pel_matrix_invert(&voxel_from_world, &volume->world_from_voxel));
    double p[3];
    pel_matrix_point(p, &voxel_from_world, p_world);
    int index[3];
    for (int axis = 0; axis < 3; axis++) {
        index[axis] = (int)floor(p[axis] + 0.5);
        if (index[axis] < 0 || index[axis] >= volume->dims[axis])
            return NAN;
    }
    return pel_volume_value(volume, index[0], index[1], index[2]);
}

// Sum over all voxels times the volume of a cell, in cubic millimetres.
static double integral(const struct pel_volume *volume) {
    double sum = 0, spacing[3];
    for (int k = 0; k < volume->dims[2]; k++)
        for (int j = 0; j < volume->dims[1]; j++)
            for (int i = 0; i < volume->dims[0]; i++)
                sum += pel_volume_value(volume, i, j, k);
    pel_volume_spacing(volume, spacing);
    return sum * spacing[0] * spacing[1] * spacing[2];
}

static void test_every_kind_is_centred_and_deterministic(void **state) {
    (void)state;
    for (const char *const *name = pel_generator_names(); *name; name++) {
        struct pel_volume *volume = generate(*name, 24, PEL_VOXEL_U8);
        struct pel_volume *again = generate(*name, 24, PEL_VOXEL_U8);
        assert_memory_equal(volume->voxels, again->voxels, pel_volume_bytes(volume));
        double low[3], high[3];
        voxel_place(low, volume, 0, 0, 0);
        voxel_place(high, volume, volume->dims[0] - 1, volume->dims[1] - 1, volume->dims[2] - 1);
        int longest = 0;
        for (int axis = 0; axis < 3; axis++) {
            assert_near(low[axis] + high[axis], 0, 1e-9);
            longest = volume->dims[axis] > longest ? volume->dims[axis] : longest;
        }
        assert_int_equal(longest, 24);
        pel_volume_destroy(volume);
        pel_volume_destroy(again);
    }
}

static void test_defaults(void **state) {
    (void)state;
    struct pel_volume *volume = pel_volume_generate("sphere", NULL);
    assert_non_null(volume);
    assert_int_equal(volume->type, PEL_VOXEL_U8);
    assert_int_equal(volume->dims[0], 64);
    assert_int_equal(volume->dims[2], 64);
    assert_near(volume->world_from_voxel.m[0][0], 1, 0);
    assert_near(volume->world_from_voxel.m[2][3], -31.5, 0);
    assert_string_equal(volume->unit, "mm");
    assert_string_equal(volume->name, "sphere");
    pel_volume_destroy(volume);
}

// The integer types hold the float field to half a step, over its whole range.
static void test_types_agree(void **state) {
    (void)state;
    static const enum pel_voxel_type types[] = {PEL_VOXEL_U8, PEL_VOXEL_U16};
    for (const char *const *name = pel_generator_names(); *name; name++) {
        struct pel_volume *exact = generate(*name, 20, PEL_VOXEL_F32);
        for (int t = 0; t < 2; t++) {
            struct pel_volume *volume = generate(*name, 20, types[t]);
            for (int k = 0; k < volume->dims[2]; k++)
                for (int j = 0; j < volume->dims[1]; j++)
                    for (int i = 0; i < volume->dims[0]; i++)
                        assert_near(pel_volume_value(volume, i, j, k),
                                    pel_volume_value(exact, i, j, k), volume->slope * 0.501);
            pel_volume_destroy(volume);
        }
        pel_volume_destroy(exact);
    }
}

static void test_sphere_is_a_distance(void **state) {
    (void)state;
    struct pel_volume *volume = pel_volume_generate(
        "sphere",
        &(struct pel_generate_options){.size = 32, .spacing_mm = 4, .type = PEL_VOXEL_F32});
    assert_non_null(volume);
    // Twice the natural spacing of 2 mm: the radius is 48 mm. (3, 4, 12) has length 13.
    assert_near(value_at(volume, (double[]){2, 2, 2}), 48 - 2 * sqrt(3), 1e-5);
    assert_near(value_at(volume, (double[]){6, -6, 46}), 48 - sqrt(36 + 36 + 46 * 46), 1e-5);
    assert_near(value_at(volume, (double[]){62, 62, 62}), 48 - 62 * sqrt(3), 1e-5);
    pel_volume_destroy(volume);
}

static void test_box_has_its_volume_at_any_resolution(void **state) {
    (void)state;
    static const int sizes[] = {7, 32, 50, 64};
    for (int i = 0; i < 4; i++) {
        struct pel_volume *volume = generate("box", sizes[i], PEL_VOXEL_F32);
        assert_near(integral(volume), 40 * 28 * 20, 0.05);
        pel_volume_destroy(volume);
    }
}

static void test_shells_lie_at_their_radii(void **state) {
    (void)state;
    // 129 voxels put one at the origin; 64 / 129 mm apart.
    struct pel_volume *volume = generate("shells", 129, PEL_VOXEL_F32);
    for (int shell = 1; shell <= 5; shell++) {
        double best = 0, best_x = 0;
        for (int i = 64; i < 129; i++) {
            double p[3];
            voxel_place(p, volume, i, 64, 64);
            double value = pel_volume_value(volume, i, 64, 64);
            if (fabs(p[0] - 6 * shell) < 3 && value > best)
                best = value, best_x = p[0];
        }
        assert_near(best_x, 6 * shell, 0.25);
        assert_near(best, shell / 5.0, 0.06 * shell / 5.0);
    }
    assert_true(pel_volume_value(volume, 64, 64, 64) < 1e-12);
    pel_volume_destroy(volume);
}

static double distance(const double a[3], const double b[3]) {
    return pel_length((double[]){a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

static void test_c60_is_a_buckyball(void **state) {
    (void)state;
    double atoms[PEL_C60_ATOMS][3];
    pel_generate_c60_atoms(atoms);
    const double bond = 14;
    int bonds = 0;
    for (int i = 0; i < PEL_C60_ATOMS; i++) {
        // Circumradius of a truncated icosahedron of edge 1: sqrt(58 + 18 sqrt(5)) / 4.
        assert_near(pel_length(atoms[i]), bond * sqrt(58 + 18 * sqrt(5)) / 4, 1e-9);
        int neighbours = 0;
        for (int j = 0; j < PEL_C60_ATOMS; j++) {
            if (i == j)
                continue;
            double d = distance(atoms[i], atoms[j]);
            assert_true(d > bond - 1e-9);
            neighbours += d < bond + 1e-9;
        }
        assert_int_equal(neighbours, 3);
        bonds += neighbours;
    }
    assert_int_equal(bonds / 2, 90);
}

static void test_c60_holds_360_electrons(void **state) {
    (void)state;
    struct pel_volume *volume = generate("c60", 64, PEL_VOXEL_F32);
    assert_near(integral(volume) / 1000, 360, 0.05);
    // The density is greatest at the atoms and nothing at the centre.
    double atoms[PEL_C60_ATOMS][3];
    pel_generate_c60_atoms(atoms);
    for (int i = 0; i < PEL_C60_ATOMS; i++)
        assert_true(value_at(volume, atoms[i]) > 2.7);
    assert_true(value_at(volume, (double[]){0, 0, 0}) < 1e-3);
    pel_volume_destroy(volume);

    // A row longer than the generator's buffer is the same field.
    struct pel_volume *fine = generate("c60", 300, PEL_VOXEL_U8);
    assert_true(value_at(fine, atoms[7]) > 3);
    assert_near(pel_volume_value(fine, 40, 150, 150), pel_volume_value(fine, 259, 150, 150),
                fine->slope * 1.01);
    pel_volume_destroy(fine);
}

static void test_hydrogen_holds_one_electron(void **state) {
    (void)state;
    struct pel_volume *volume = generate("hydrogen", 96, PEL_VOXEL_F32);
    assert_near(integral(volume) / 8, 1, 0.01);
    // On the axis |psi|^2 = 4 r^4 exp(-2r/3) / (81^2 6 pi), greatest at r = 6: 12 mm.
    double peak = 4 * 1296 * exp(-4) / (6561 * 6 * PEL_PI);
    assert_near(value_at(volume, (double[]){0.4, 0.4, 12.4}), peak, 0.03 * peak);
    // The nodal cone: 3 z^2 = r^2, z = x / sqrt(2) in the plane y = 0.
    assert_true(value_at(volume, (double[]){14.4, 0.5, 10.4}) < 0.01 * peak);
    pel_volume_destroy(volume);
}

static void test_marschner_lobb(void **state) {
    (void)state;
    // One voxel is the origin: (1 - 0 + (1 + cos(12 pi)) / 4) / 2.5 = 0.6.
    struct pel_volume *one = generate("marschner-lobb", 1, PEL_VOXEL_F32);
    assert_near(pel_volume_value(one, 0, 0, 0), 0.6, 1e-6);
    pel_volume_destroy(one);
    // Three voxels are at -2/3, 0, 2/3. At (0, 0, 2/3): (1 - sin 60 deg + 1/2) / 2.5. At
    // (2/3, 0, 0): cos 60 deg = 1/2, cos(6 pi) = 1, again 0.6. At (2/3, 2/3, 0):
    // cos(pi sqrt(2) / 3) = 0.0897145, cos(12 pi 0.0897145) = -0.9712.
    struct pel_volume *three = generate("marschner-lobb", 3, PEL_VOXEL_F32);
    assert_near(pel_volume_value(three, 1, 1, 2), (1.5 - 0.8660254) / 2.5, 1e-6);
    assert_near(pel_volume_value(three, 1, 1, 0), (1.5 + 0.8660254) / 2.5, 1e-6);
    assert_near(pel_volume_value(three, 2, 1, 1), 0.6, 1e-6);
    assert_near(pel_volume_value(three, 2, 2, 1), (1 + 0.25 * (1 - 0.9712)) / 2.5, 1e-4);
    pel_volume_destroy(three);
}

static void test_shepp_logan(void **state) {
    (void)state;
    struct pel_volume *volume = generate("shepp-logan", 200, PEL_VOXEL_F32);
    static const struct {
        double place[3], value;
    } truths[] = {
        {{0, 0.9, 0}, 1},              // skull, in front
        {{0.68, 0.01, 0}, 1},          // and at the side
        {{0.01, -0.5, 0}, 0.2},        // brain
        {{-0.22, 0, -0.25}, 0},        // large ventricle
        {{0.22, 0, -0.25}, 0},         // small ventricle
        {{-0.11, -0.33, -0.25}, 0},    // the large one's long axis is at 108 degrees
        {{-0.33, -0.33, -0.25}, 0.2},  // and not at 72
        {{0, 0.35, -0.25}, 0.4},       // tumour
        {{0, 0.08, -0.25}, 0.4},       //
        {{-0.08, -0.65, -0.25}, 0.3},  // small ones
        {{-0.045, -0.65, -0.25}, 0.3}, // long along x,
        {{0.06, -0.615, -0.25}, 0.3},  // long along y
        {{0.095, -0.65, -0.25}, 0.2},
        {{0.06, -0.105, 0.625}, 0.4},
        {{0, 0.1, 0.625}, 0},
        {{0, 0.1, 0.74}, 0.2},
        {{0.98, 0.98, 0}, 0},
    };
    for (size_t i = 0; i < sizeof truths / sizeof *truths; i++) {
        double p[3];
        for (int axis = 0; axis < 3; axis++)
            p[axis] = 100 * truths[i].place[axis];
        assert_near(value_at(volume, p), truths[i].value, 1e-6);
    }
    // The mass of ten ellipsoids, 4/3 pi a b c each; one is 1e6 mm^3.
    double mass = 0.69 * 0.92 * 0.9 - 0.8 * 0.6624 * 0.874 * 0.88 - 0.2 * 0.41 * 0.16 * 0.21 -
                  0.2 * 0.31 * 0.11 * 0.22 + 0.2 * 0.21 * 0.25 * 0.5 + 0.2 * 0.046 * 0.046 * 0.046 +
                  0.2 * 0.046 * 0.023 * 0.02 + 0.2 * 0.056 * 0.04 * 0.1 - 0.2 * 0.056 * 0.056 * 0.1;
    assert_near(integral(volume) / 1e6, 4 * PEL_PI / 3 * mass, 2e-3);
    pel_volume_destroy(volume);
}

static void test_head_tissues(void **state) {
    (void)state;
    struct pel_volume *ct = generate("head-ct", 240, PEL_VOXEL_U16);
    assert_near(ct->slope, 1, 0);
    assert_near(ct->intercept, -1024, 0);
    assert_string_equal(ct->unit, "HU");
    assert_near(value_at(ct, (double[]){0.5, -110, 60}), -1000, 0); // behind the head
    assert_near(value_at(ct, (double[]){32, 64, -18}), 12, 0);      // right eye
    assert_near(value_at(ct, (double[]){-32, 64, -18}), 12, 0);     // left eye
    assert_near(value_at(ct, (double[]){11, 2, 31}), 8, 0);         // ventricle
    assert_near(value_at(ct, (double[]){0.5, -3, 99.5}), 500, 120); // marrow of the skull
    assert_near(value_at(ct, (double[]){0.5, 14, -85}), -1000, 0);  // throat
    pel_volume_destroy(ct);
}

// What the MRI shows at a place of the head, the CT shows there once `transform` moved the MRI.
// Returns the share of MRI voxels inside both that agree on being air or not.
static double agreement(const struct pel_volume *ct, const struct pel_volume *mri,
                        const struct pel_matrix *transform) {
    size_t same = 0, all = 0;
    for (int k = 0; k < mri->dims[2]; k++) {
        for (int j = 0; j < mri->dims[1]; j++) {
            for (int i = 0; i < mri->dims[0]; i++) {
                double p[3];
                voxel_place(p, mri, i, j, k);
                pel_matrix_point(p, transform, p);
                double hounsfield = value_at(ct, p);
                if (isnan(hounsfield))
                    continue;
                all++;
                same += (hounsfield < -500) == (pel_volume_value(mri, i, j, k) < 20);
            }
        }
    }
    return (double)same / (double)all;
}

static void test_head_pair_truth(void **state) {
    (void)state;
    struct pel_generate_options options = {.size = 128, .type = PEL_VOXEL_U16};
    struct pel_volume *ct = pel_volume_generate("head-pair", &options);
    options.second = true;
    struct pel_volume *mri = pel_volume_generate("head-pair", &options);
    assert_non_null(ct);
    assert_non_null(mri);
    assert_string_equal(ct->name, "head-ct");
    assert_string_equal(mri->name, "head-mri");
    struct pel_matrix truth = pel_generate_head_pair_truth(), mri_from_ct;
    assert_true(pel_matrix_is_rigid(&truth, 1e-12));
    double trace = truth.m[0][0] + truth.m[1][1] + truth.m[2][2];
    assert_near(acos((trace - 1) / 2) * 180 / PEL_PI, 12.3, 0.05);

    // The eye and the ventricle of the CT, looked up in the MRI: 150 and 120 only there.
    assert_true(pel_matrix_invert(&mri_from_ct, &truth));
    double p[3];
    pel_matrix_point(p, &mri_from_ct, (double[]){-32, 64, -18});
    assert_near(value_at(mri, p), 150, 0);
    pel_matrix_point(p, &mri_from_ct, (double[]){11, 2, 31});
    assert_near(value_at(mri, p), 120, 0);

    struct pel_matrix identity = pel_matrix_identity();
    assert_true(agreement(ct, mri, &truth) > 0.98);
    assert_true(agreement(ct, mri, &identity) < 0.96);
    assert_true(agreement(ct, mri, &mri_from_ct) < agreement(ct, mri, &identity));
    pel_volume_destroy(ct);
    pel_volume_destroy(mri);
}

// A head keeps its size: half the spacing shows its middle, at the same places.
static void test_head_keeps_its_size(void **state) {
    (void)state;
    struct pel_volume *close_up = pel_volume_generate(
        "head-ct", &(struct pel_generate_options){.size = 120, .spacing_mm = 0.5});
    assert_non_null(close_up);
    double spacing[3];
    pel_volume_spacing(close_up, spacing);
    assert_near(spacing[1], 0.5, 1e-12);
    assert_near(value_at(close_up, (double[]){11, 2, 29}), 8, 8.1);
    assert_true(isnan(value_at(close_up, (double[]){0, 40, 0})));
    pel_volume_destroy(close_up);
}

static void test_refusals(void **state) {
    (void)state;
    static const struct {
        const char *kind;
        struct pel_generate_options options;
        const char *message;
    } cases[] = {
        {"spere", {0}, "no generator 'spere'; did you mean 'sphere'"},
        {"teapot",
         {0},
         "no generator 'teapot'; there are sphere, box, shells, c60, hydrogen, marschner-lobb, "
         "shepp-logan, head-ct, head-mri, head-labels and head-pair"},
        {"sphere", {.size = -1}, "size -1 is outside 1..65536"},
        {"sphere", {.spacing_mm = -2}, "spacing -2 mm is not a positive number"},
        {"sphere", {.spacing_mm = NAN}, "spacing nan mm is not a positive number"},
        {"sphere", {.type = PEL_VOXEL_RGB8}, "generators make uint8, uint16 or float32 only"},
        {"head-ct", {.second = true}, "generator 'head-ct' makes no second volume"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_null(pel_volume_generate(cases[i].kind, &cases[i].options));
        assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
        assert_string_equal(pel_error_message(), cases[i].message);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_kind_is_centred_and_deterministic),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_types_agree),
        cmocka_unit_test(test_sphere_is_a_distance),
        cmocka_unit_test(test_box_has_its_volume_at_any_resolution),
        cmocka_unit_test(test_shells_lie_at_their_radii),
        cmocka_unit_test(test_c60_is_a_buckyball),
        cmocka_unit_test(test_c60_holds_360_electrons),
        cmocka_unit_test(test_hydrogen_holds_one_electron),
        cmocka_unit_test(test_marschner_lobb),
        cmocka_unit_test(test_shepp_logan),
        cmocka_unit_test(test_head_tissues),
        cmocka_unit_test(test_head_pair_truth),
        cmocka_unit_test(test_head_keeps_its_size),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
