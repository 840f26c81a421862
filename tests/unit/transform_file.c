// Rigid transforms in files: where they send points, worked out by hand.
#include "support/near.h"
#include "support/test.h"

#include "base/math.h"

static const char *write_bytes(const char *leaf, const void *bytes, size_t count) {
    const char *path = test_temporary_path(leaf);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, count, stream), count);
    fclose(stream);
    return path;
}

static const char *write_file(const char *leaf, const char *text) {
    return write_bytes(leaf, text, strlen(text));
}

static void check_map(const struct pel_matrix *matrix, const double from[3], const double to[3]) {
    double p[3];
    pel_matrix_point(p, matrix, from);
    for (int i = 0; i < 3; i++)
        if (!(fabs(p[i] - to[i]) < 1e-9))
            fail_msg("(%g %g %g) goes to (%.12g %.12g %.12g), not (%g %g %g)", from[0], from[1],
                     from[2], p[0], p[1], p[2], to[0], to[1], to[2]);
    assert_true(pel_matrix_is_rigid(matrix, 1e-12));
    assert_near(matrix->m[3][3], 1, 0);
}

// Loads an ITK file of that body. It must map fixed to moving in LPS, so the result maps the same
// points back in RAS.
static void check_itk(const char *body, const double fixed_lps[3], const double moving_lps[3]) {
    char text[1024];
    snprintf(text, sizeof text, "#Insight Transform File V1.0\n#Transform 0\n%s", body);
    struct pel_matrix matrix;
    if (!pel_transform_load(&matrix, write_file("itk.tfm", text), NULL, NULL))
        fail_msg("%s: %s", body, pel_error_message());
    check_map(&matrix, (double[]){-moving_lps[0], -moving_lps[1], moving_lps[2]},
              (double[]){-fixed_lps[0], -fixed_lps[1], fixed_lps[2]});
}

static void test_itk_kinds(void **state) {
    (void)state;
    // A quarter turn about z round (10, 20, 30): (1, 0, 0) from there becomes (0, 1, 0), and then
    // (1, 2, 3) is added.
    const double fixed[3] = {11, 20, 30}, moving[3] = {11, 23, 33};
    check_itk("Transform: Euler3DTransform_double_3_3\n"
              "Parameters: 0 0 1.5707963267948966 1 2 3\nFixedParameters: 10 20 30\n",
              fixed, moving);
    check_itk("Transform: VersorRigid3DTransform_double_3_3\r\n"
              "Parameters: 0 0 0.70710678118654752 1 2 3 \r\nFixedParameters: 10 20 30\r\n",
              fixed, moving);
    check_itk("Transform: QuaternionRigidTransform_double_3_3\n"
              "Parameters: 0 0 0.70710678118654752 0.70710678118654752 1 2 3\n"
              "FixedParameters: 10 20 30\n",
              fixed, moving);
    check_itk("Transform: AffineTransform_float_3_3\n"
              "Parameters: 0 -1 0 1 0 0 0 0 1 1 2 3\nFixedParameters: 10 20 30",
              fixed, moving);
    check_itk("Transform: MatrixOffsetTransformBase_double_3_3\n"
              "Parameters: 0 -1 0 1 0 0 0 0 1 1 2 3\nFixedParameters: 10 20 30\n",
              fixed, moving);
    check_itk("Transform: CenteredEuler3DTransform_double_3_3\n"
              "Parameters: 0 0 1.5707963267948966 10 20 30 1 2 3\nFixedParameters: 0\n",
              fixed, moving);
    check_itk("Transform: TranslationTransform_double_3_3\nParameters: 0 3 3\nFixedParameters:\n",
              fixed, moving);
}

static void test_itk_order_of_angles(void **state) {
    (void)state;
    // Rz Rx Ry: a quarter turn about y takes x to -z, one about x then -z to y.
    check_itk("Transform: Euler3DTransform_double_3_3\n"
              "Parameters: 1.5707963267948966 1.5707963267948966 0 0 0 0\nFixedParameters: 0 0 0\n",
              (double[]){1, 0, 0}, (double[]){0, 1, 0});
    // Rz Ry Rx with the flag set: x stays under Rx and goes to -z.
    check_itk("Transform: Euler3DTransform_double_3_3\n"
              "Parameters: 1.5707963267948966 1.5707963267948966 0 0 0 0\n"
              "FixedParameters: 0 0 0 1\n",
              (double[]){1, 0, 0}, (double[]){0, 0, -1});
}

static void test_itk_composite(void **state) {
    (void)state;
    check_itk("Transform: CompositeTransform_double_3_3\n#Transform 1\n"
              "Transform: Euler3DTransform_double_3_3\n"
              "Parameters: 0 0 1.5707963267948966 1 2 3\nFixedParameters: 10 20 30\n",
              (double[]){11, 20, 30}, (double[]){11, 23, 33});
    // The last part first: move by 5 along x, then a quarter turn about z.
    check_itk("Transform: CompositeTransform_double_3_3\n"
              "Transform: Euler3DTransform_double_3_3\n"
              "Parameters: 0 0 1.5707963267948966 0 0 0\nFixedParameters: 0 0 0\n"
              "Transform: TranslationTransform_double_3_3\nParameters: 5 0 0\nFixedParameters:\n",
              (double[]){1, 0, 0}, (double[]){0, 6, 0});
}

static void refuse(const char *leaf, const char *text, enum pel_error code, const char *sentence) {
    const char *path = write_file(leaf, text);
    struct pel_matrix matrix;
    assert_false(pel_transform_load(&matrix, path, NULL, NULL));
    char expected[512];
    snprintf(expected, sizeof expected, "%s: %s", path, sentence);
    assert_string_equal(pel_error_message(), expected);
    assert_int_equal(pel_error_code(), code);
}

#define ITK "#Insight Transform File V1.0\n"

static void test_itk_refusals(void **state) {
    (void)state;
    const enum pel_error format = PEL_ERROR_FORMAT;
    refuse("a.tfm", ITK, format, "no transform in it");
    refuse("a.tfm", ITK "Transform: CompositeTransform_double_3_3\n", format, "no transform in it");
    refuse("a.tfm", ITK "Transform: BSplineTransform_double_3_3\nParameters: 1\n",
           PEL_ERROR_UNSUPPORTED, "line 2: 'BSplineTransform_double_3_3' is not a rigid transform");
    refuse("a.tfm", ITK "Transform: TranslationTransform_double_2_2\n", PEL_ERROR_UNSUPPORTED,
           "line 2: 'TranslationTransform_double_2_2' is not for three dimensions");
    refuse("a.tfm", ITK "Transform:\n", PEL_ERROR_UNSUPPORTED,
           "line 2: '' is not a rigid transform");
    refuse("a.tfm", ITK "Transform: Euler3DTransform_double_3_3\nParameters: 1 2 3\n", format,
           "Euler3DTransform has 3 parameters, not 6");
    refuse("a.tfm", ITK "Transform: Euler3DTransform_double_3_3\nParameters: 0 0 x 0\n", format,
           "line 3: 'x 0' is not a finite number");
    refuse("a.tfm", ITK "Transform: Euler3DTransform_double_3_3\nParameters: 0 nan 0 0 0 0\n",
           format, "line 3: 'nan 0 0 0 0' is not a finite number");
    refuse("a.tfm", ITK "Transform: IdentityTransform_double_3_3\nBanana: 7\n", format,
           "line 3: unexpected 'Banana: 7'");
    refuse("a.tfm", ITK "Parameters: 7\n", format, "line 2: unexpected 'Parameters: 7'");
    refuse("a.tfm",
           ITK "Transform: IdentityTransform_double_3_3\n"
               "Transform: IdentityTransform_double_3_3\n",
           format, "line 3: a second transform, and no composite");
    refuse("a.tfm", ITK "Transform: VersorRigid3DTransform_double_3_3\nParameters: 1 1 0 0 0 0\n",
           format, "a versor of length 1.41421 exceeds 1");
    refuse("a.tfm",
           ITK "Transform: AffineTransform_double_3_3\nParameters: 0 0 0 0 0 0 0 0 0 0 0 0\n",
           format, "not a rotation and translation: it scales or shears by 1");
    refuse("a.tfm",
           ITK "Transform: AffineTransform_double_3_3\nParameters: 1 0 0 0 1 0 0 0 -1 0 0 0\n",
           format, "not a rotation and translation: it mirrors");
}

// Appends a MATLAB 4 variable.
static size_t add_variable(char *out, const char *name, const double *numbers, int count) {
    int32_t head[5] = {0, count, 1, 0, (int32_t)strlen(name) + 1};
    memcpy(out, head, sizeof head);
    memcpy(out + sizeof head, name, (size_t)head[4]);
    size_t bytes = sizeof head + (size_t)head[4];
    memcpy(out + bytes, numbers, (size_t)count * sizeof *numbers);
    return bytes + (size_t)count * sizeof *numbers;
}

// The same turn as above, as antsRegistration writes it.
static void test_itk_binary(void **state) {
    (void)state;
    const double parameters[12] = {0, -1, 0, 1, 0, 0, 0, 0, 1, 1, 2, 3};
    const double centre[3] = {10, 20, 30};
    char data[512];
    size_t bytes = add_variable(data, "AffineTransform_double_3_3", parameters, 12);
    bytes += add_variable(data + bytes, "fixed", centre, 3);
    struct pel_matrix matrix;
    const char *path = write_bytes("0GenericAffine.mat", data, bytes);
    if (!pel_transform_load(&matrix, path, NULL, NULL))
        fail_msg("%s", pel_error_message());
    check_map(&matrix, (double[]){-11, -23, 33}, (double[]){-11, -20, 30});
    // Every truncation is told, but the one that leaves out the centre altogether.
    size_t whole = bytes - (20 + 6 + 24);
    for (size_t cut = 0; cut < bytes; cut++) {
        path = write_bytes("cut.mat", data, cut);
        assert_int_equal(pel_transform_load(&matrix, path, NULL, NULL), cut == whole);
    }
    assert_string_equal(strstr(pel_error_message(), "variable"), "variable 2: the file ends early");
}

static void test_plain(void **state) {
    (void)state;
    struct pel_matrix matrix;
    assert_true(pel_transform_load(
        &matrix,
        write_file("a.txt", "# comment 7\n[[0, -1, 0, 1],\n [1, 0, 0, 2], [0 0 1 3]; 0 0 0 1]\n"),
        NULL, NULL));
    check_map(&matrix, (double[]){10, 0, 0}, (double[]){1, 12, 3});
    refuse("a.txt", "1 0 0 0 0 1 0 0 0 0 1 0", PEL_ERROR_FORMAT,
           "12 numbers, not the 16 of a 4x4 matrix");
    refuse("a.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1", PEL_ERROR_FORMAT,
           "the last row is 0 0 1 1, not 0 0 0 1");
    refuse("a.txt", "1 0 0 0 0 one 0 0", PEL_ERROR_FORMAT, "'one' is not a number");
    refuse("a.txt", "1 0 0 0 0 inf 0 0 0 0 1 0 0 0 0 1", PEL_ERROR_FORMAT,
           "the matrix is not finite");
    refuse("a.txt", "1.1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", PEL_ERROR_FORMAT,
           "not a rotation and translation: it scales or shears by 0.21");
    refuse("a.txt", "", PEL_ERROR_FORMAT, "0 numbers, not the 16 of a 4x4 matrix");
}

static int warning_count;

static void count_warning(const char *message, void *user) {
    (void)message, (void)user;
    warning_count++;
}

static void test_nearly_rigid_is_mended(void **state) {
    (void)state;
    pel_on_warning(count_warning, NULL);
    warning_count = 0;
    struct pel_matrix matrix;
    assert_true(pel_transform_load(
        &matrix, write_file("a.txt", "1.00002 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n"), NULL, NULL));
    assert_int_equal(warning_count, 1);
    check_map(&matrix, (double[]){100, 0, 0}, (double[]){105, 6, 7});
    pel_on_warning(NULL, NULL);
}

// Moving: 10 x 20 x 30 voxels of 2 x 1 x 3 mm, left-handed. Fixed: 5 x 6 x 7 voxels of 1 x 1 x 2
// mm, right-handed, so that FSL counts its x from the other end.
static void make_pair(struct pel_volume *moving, struct pel_volume *fixed) {
    *moving = (struct pel_volume){.name = "moving", .dims = {10, 20, 30}};
    moving->world_from_voxel = pel_matrix_scaling((double[]){-2, 1, 3});
    *fixed = (struct pel_volume){.name = "fixed", .dims = {5, 6, 7}};
    fixed->world_from_voxel = pel_matrix_scaling((double[]){1, 1, 2});
}

static void test_fsl(void **state) {
    (void)state;
    struct pel_volume moving, fixed;
    make_pair(&moving, &fixed);
    struct pel_matrix matrix;
    // Voxel (1, 2, 3) of moving: world (-2, 2, 9), FSL (2, 2, 9). Moved by (1, 2, 3) it is (3, 4,
    // 12) in fixed's FSL, its voxel (4 - 3, 4, 6), world (1, 4, 12).
    const char *path = write_file("a.mat", "1 0 0 1\n0 1 0 2\n0 0 1 3\n0 0 0 1\n");
    assert_true(pel_transform_load(&matrix, path, &moving, &fixed));
    check_map(&matrix, (double[]){-2, 2, 9}, (double[]){1, 4, 12});
    // A quarter turn: FSL (2, 2, 9) becomes (-2, 2, 9), voxel (4 + 2, 2, 4.5), world (6, 2, 9).
    path = write_file("b.mat", "0 -1 0 0  \n1 0 0 0  \n0 0 1 0  \n0 0 0 1  \n");
    assert_true(pel_transform_load(&matrix, path, &moving, &fixed));
    check_map(&matrix, (double[]){-2, 2, 9}, (double[]){6, 2, 9});
    // The other way round: world (-2, 2, 9) is fixed's voxel (-2, 2, 4.5), FSL (6, 2, 9), after
    // the turn (-2, 6, 9), moving's voxel (-1, 6, 3), world (2, 6, 9).
    assert_true(pel_transform_load(&matrix, path, &fixed, &moving));
    check_map(&matrix, (double[]){-2, 2, 9}, (double[]){2, 6, 9});
}

static void test_fsl_needs_volumes(void **state) {
    (void)state;
    struct pel_volume moving, fixed;
    make_pair(&moving, &fixed);
    struct pel_matrix matrix = pel_matrix_identity();
    const char *path = write_file("a.mat", "1 0 0 1\n0 1 0 2\n0 0 1 3\n0 0 0 1\n");
    assert_false(pel_transform_load(&matrix, path, &moving, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_non_null(strstr(pel_error_message(), "the fixed one is not known"));
    assert_false(pel_transform_load(&matrix, path, NULL, &fixed));
    assert_non_null(strstr(pel_error_message(), "the moving one is not known"));
    assert_false(pel_transform_save(&matrix, path, NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    // With neither it cannot be FSL's, which is worth a warning.
    pel_on_warning(count_warning, NULL);
    warning_count = 0;
    assert_true(pel_transform_load(&matrix, path, NULL, NULL));
    assert_int_equal(warning_count, 1);
    check_map(&matrix, (double[]){0, 0, 0}, (double[]){1, 2, 3});
    pel_on_warning(NULL, NULL);
}

static void test_round_trips(void **state) {
    (void)state;
    static const char *const leaves[] = {"r.tfm", "r.mat", "r.txt"};
    struct pel_volume moving, fixed;
    make_pair(&moving, &fixed);
    moving.world_from_voxel =
        pel_matrix_from_quaternion((double[]){0.1, -0.2, 0.3, 0.9}, (double[]){-80, 40, 7});
    const double quarter = PEL_PI / 2;
    uint64_t random = 11;
    for (int trial = 0; trial < 300; trial++) {
        double q[4], t[3];
        for (int i = 0; i < 4; i++)
            q[i] = test_random(&random) - 0.5;
        for (int i = 0; i < 3; i++)
            t[i] = 400 * (test_random(&random) - 0.5);
        // A third of them near a quarter turn about x, where Euler's angles are ambiguous.
        if (trial % 3 == 0) {
            double near_quarter = quarter + (trial % 2 ? 1 : 0) * pow(10, -(trial % 16));
            q[0] = sin(near_quarter / 2), q[3] = cos(near_quarter / 2);
            q[1] = 0, q[2] = 0;
        }
        struct pel_matrix matrix = pel_matrix_from_quaternion(q, t);
        if (trial % 3 == 0) {
            struct pel_matrix about_z =
                pel_matrix_from_quaternion((double[]){0, 0, 0.3, 0.7}, (double[]){0, 0, 0});
            matrix = pel_matrix_multiply(&matrix, &about_z);
        }
        for (int k = 0; k < 3; k++) {
            const char *path = test_temporary_path(leaves[k]);
            struct pel_matrix back;
            assert_true(pel_transform_save(&matrix, path, &moving, &fixed));
            assert_true(pel_transform_load(&back, path, &moving, &fixed));
            for (int i = 0; i < 16; i++)
                assert_near(back.m[i / 4][i % 4], matrix.m[i / 4][i % 4], 1e-9);
        }
    }
}

static void test_save_refuses(void **state) {
    (void)state;
    struct pel_matrix matrix = pel_matrix_identity();
    assert_false(pel_transform_save(&matrix, test_temporary_path("a.xfm"), NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    matrix.m[0][0] = 2;
    assert_false(pel_transform_save(&matrix, test_temporary_path("a.txt"), NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_false(
        pel_transform_load(&matrix, test_temporary_path("does-not-exist.tfm"), NULL, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_itk_kinds),
        cmocka_unit_test(test_itk_order_of_angles),
        cmocka_unit_test(test_itk_composite),
        cmocka_unit_test(test_itk_refusals),
        cmocka_unit_test(test_itk_binary),
        cmocka_unit_test(test_plain),
        cmocka_unit_test(test_nearly_rigid_is_mended),
        cmocka_unit_test(test_fsl),
        cmocka_unit_test(test_fsl_needs_volumes),
        cmocka_unit_test(test_round_trips),
        cmocka_unit_test(test_save_refuses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
