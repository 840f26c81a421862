// formats.c - real volumes open with the dimensions, type and place that their origin states.
//
// Placements are what another reader found in the headers (sform), or what the acquisition
// protocol says; see SOURCE.txt beside each file.
#include "support/file.h"

#include <math.h>

#include "base/math.h"

#define AXES(x, y, z, tx, ty, tz)                                                                  \
    {                                                                                              \
        {x, 0, 0, tx}, {0, y, 0, ty}, {                                                            \
            0, 0, z, tz                                                                            \
        }                                                                                          \
    }

#define MNI AXES(-2, 2, 2, 90, -126, -72)

// One anatomy, tilted against the scanner.
#define OBLIQUE                                                                                    \
    {                                                                                              \
        {0.993592024, 0.016005039, 0.111887276, -64.898239136},                                    \
            {-0.049704909, 0.950936675, 0.305366874, -110.431144714}, {                            \
            -0.101510286, -0.308971405, 0.945638597, -27.925539017                                 \
        }                                                                                          \
    }

static const struct {
    const char *path;
    int dims[3];
    enum pel_voxel_type type;
    double rows[3][4];
    double slope;
} volumes[] = {
    {"pair_ct_mr_mni/scct.nii", {91, 109, 91}, PEL_VOXEL_U8, MNI, 14.880134582519531},
    {"pair_ct_mr_mni/avg152T1.nii", {91, 109, 91}, PEL_VOXEL_U8, MNI, 0.003921568859368563},
    {"pair_ct_mr_mni/avg152T2.nii", {91, 109, 91}, PEL_VOXEL_U8, MNI, 0.003921568859368563},
    {"pair_stroke_t1_t2_flair/T1.nii.gz", {124, 160, 140}, PEL_VOXEL_U8, OBLIQUE, 1},
    {"pair_stroke_t1_t2_flair/T2.nii.gz",
     {124, 160, 140},
     PEL_VOXEL_U8,
     OBLIQUE,
     2.007843255996704},
    {"pair_stroke_t1_t2_flair/FLAIR.nii.gz", {124, 160, 140}, PEL_VOXEL_U8, OBLIQUE, 1},
    // The same scan as NRRD, in LPS.
    {"torture_nrrd/FLAIR.nrrd", {124, 160, 140}, PEL_VOXEL_U8, OBLIQUE, 1},
    {"colin27_ch2/ch2.nii.gz", {181, 217, 181}, PEL_VOXEL_U8, AXES(1, 1, 1, -90, -125, -71), 1},
    {"colin27_ch2/ch2bet.nii.gz", {181, 217, 181}, PEL_VOXEL_U8, AXES(1, 1, 1, -90, -125, -71), 1},
    {"macaque_inia19/inia19-t1-brain.nii.gz",
     {168, 206, 128},
     PEL_VOXEL_F32,
     AXES(0.5, 0.5, 0.5, -42, -57.5, -30),
     1},
    {"macaque_inia19/inia19-NeuroMaps.nii.gz",
     {168, 206, 128},
     PEL_VOXEL_I16,
     AXES(0.5, 0.5, 0.5, -42, -57.5, -30),
     1},
    {"engine/engine.nii.gz", {256, 256, 128}, PEL_VOXEL_U8, AXES(1, 1, 1, -127, -127, -64), 1},
    {"fuel64/fuel_cropped_64x33x32.nii.gz",
     {64, 33, 32},
     PEL_VOXEL_U8,
     AXES(1, 1, 1, -31, -16, -16),
     1},
    {"heptane302/heptane.nii.gz",
     {302, 302, 302},
     PEL_VOXEL_U8,
     AXES(1, 1, 1, -150, -150, -151),
     1},
    {"pair_phantom_known_rigid/phantom01_fixed.nii.gz",
     {128, 128, 128},
     PEL_VOXEL_U8,
     AXES(-1, -1, 1, 0, 0, 0),
     1},
    {"pair_phantom_known_rigid/phantom01_moving.nii.gz",
     {128, 128, 128},
     PEL_VOXEL_U8,
     AXES(-1, -1, 1, 0, 0, 0),
     1},
    {"pair_phantom_known_rigid/phantom02_fixed.nii.gz",
     {128, 128, 128},
     PEL_VOXEL_U8,
     AXES(-1, -1, 1, 0, 0, 0),
     1},
    {"pair_phantom_known_rigid/phantom03_fixed.nii.gz",
     {128, 128, 128},
     PEL_VOXEL_F32,
     AXES(-1, -1, 1, 0, 0, 0),
     1},
    {"bucky32/Bucky.pvm", {32, 32, 32}, PEL_VOXEL_U8, AXES(1, 1, 1, 0, 0, 0), 1},
    {"nucleon41/nucleon.mhd", {41, 41, 41}, PEL_VOXEL_U8, AXES(-1, -1, 1, 0, 0, 0), 1},
    {"nucleon41/nucleon.nhdr_as_nrrd.nrrd", {41, 41, 41}, PEL_VOXEL_U8, AXES(1, 1, 1, 0, 0, 0), 1},
    {"teddybear/Teddybear.mhd", {128, 128, 62}, PEL_VOXEL_U8, AXES(-2.8, -2.8, 5, 0, 0, 0), 1},
    {"tooth/tooth.nrrd", {103, 94, 161}, PEL_VOXEL_U8, AXES(-1, -1, 1, 0, 0, 0), 1},
    {"walnut_heart_mhd/walnut.mhd", {128, 96, 114}, PEL_VOXEL_U16, AXES(-1, -1, 1, 0, 0, 0), 1},
    {"walnut_heart_mhd/walnut-transformed.mhd",
     {130, 73, 128},
     PEL_VOXEL_U16,
     AXES(-1.32308, -1.31507, 1.32813, 0, 0, 0),
     1},
    {"walnut_heart_mhd/heart.mhd",
     {125, 154, 145},
     PEL_VOXEL_U8,
     AXES(-0.0127651, -0.0127389, 0.0128079, 0, 0, 0),
     1},
    {"torture_nrrd/template_T2.nrrd",
     {117, 159, 126},
     PEL_VOXEL_F32,
     AXES(-0.859375, -0.859375, 0.859375, 49.84375, -67.890625, -53.7109375),
     1},
};

static struct pel_volume *load(const char *relative, const struct pel_load_options *options) {
    char path[256];
    snprintf(path, sizeof path, "data/%s", relative);
    struct pel_volume *volume = pel_volume_load(test_data_path(path), options);
    if (!volume)
        fail_msg("%s", pel_error_message());
    return volume;
}

static void test_volumes(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof volumes / sizeof *volumes; i++) {
        struct pel_volume *volume = load(volumes[i].path, NULL);
        assert_memory_equal(volume->dims, volumes[i].dims, sizeof volume->dims);
        if (volume->type != volumes[i].type)
            fail_msg("%s: %s", volumes[i].path, pel_voxel_type_name(volume->type));
        test_assert_matrix(volume, volumes[i].rows, 1e-6);
        assert_true(volume->slope == volumes[i].slope && volume->intercept == 0);
        size_t varied = 0;
        for (size_t v = 1; v < pel_volume_bytes(volume); v++)
            varied += ((unsigned char *)volume->voxels)[v] != ((unsigned char *)volume->voxels)[0];
        assert_true(varied > 0);
        pel_volume_destroy(volume);
    }
}

static void test_headerless(void **state) {
    (void)state;
    static const struct {
        const char *path;
        int dims[3];
        enum pel_voxel_type type;
    } raws[] = {
        {"bucky32/Bucky.raw", {32, 32, 32}, PEL_VOXEL_U8},
        {"fuel64/fuel_64x64x64_uint8.raw", {64, 64, 64}, PEL_VOXEL_U8},
        {"hydrogen128/hydrogen_atom_128x128x128_uint8.raw", {128, 128, 128}, PEL_VOXEL_U8},
        {"rgba64_vltest/VLTest.raw", {64, 64, 64}, PEL_VOXEL_RGBA8},
        {"tooth/tooth_103x94x161_uint8.raw", {103, 94, 161}, PEL_VOXEL_U8},
    };
    for (size_t i = 0; i < sizeof raws / sizeof *raws; i++) {
        struct pel_load_options options = {.raw.type = raws[i].type};
        memcpy(options.raw.dims, raws[i].dims, sizeof options.raw.dims);
        test_watch_warnings(NULL);
        struct pel_volume *volume = load(raws[i].path, &options);
        assert_int_equal(test_warning_count(), 0);
        assert_memory_equal(volume->dims, raws[i].dims, sizeof volume->dims);
        pel_volume_destroy(volume);
        char path[256];
        snprintf(path, sizeof path, "data/%s", raws[i].path);
        test_assert_load_fails(test_data_path(path), NULL, PEL_ERROR_FORMAT, "headerless");
    }
}

// Files that are known to hold the same voxels, read through different readers.
static void test_same_voxels(void **state) {
    (void)state;
    static const char *const pairs[][2] = {
        {"torture_nrrd/BallBinary30x30x30.nrrd", "torture_nrrd/BallBinary30x30x30.nhdr"},
        {"torture_nrrd/BallBinary30x30x30.nrrd", "torture_nrrd/BallBinary30x30x30_gz.nrrd"},
        {"torture_nrrd/BallBinary30x30x30.nrrd", "torture_nrrd/BallBinary30x30x30_bz2.nrrd"},
        {"torture_nrrd/BallBinary30x30x30.nrrd",
         "torture_nrrd/BallBinary30x30x30_gz_lineskip.nrrd"},
        {"torture_nrrd/BallBinary30x30x30.nrrd",
         "torture_nrrd/BallBinary30x30x30_byteskip_minus_one.nhdr"},
        {"torture_nrrd/BallBinary30x30x30.nrrd",
         "torture_nrrd/BallBinary30x30x30_byteskip_minus_one_nifti.nhdr"},
        {"torture_nrrd/BallBinary30x30x30.nrrd", "torture_nrrd/BallBinary30x30x30.nii.gz"},
        {"torture_nrrd/FLAIR.nrrd", "pair_stroke_t1_t2_flair/FLAIR.nii.gz"},
        {"torture_nifti/nifti-reader-js/avg152T1_LR_nifti.nii",
         "torture_nifti/nifti-reader-js/avg152T1_LR_nifti.nii.gz"},
        {"torture_nifti/nifti-rs/minimal.nii", "torture_nifti/nifti-rs/minimal.hdr"},
        {"torture_nifti/nifti-rs/minimal.nii", "torture_nifti/nifti-rs/minimal.img.gz"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        struct pel_volume *a = load(pairs[i][0], NULL), *b = load(pairs[i][1], NULL);
        test_assert_same_volume(a, b, 1e-5);
        pel_volume_destroy(a);
        pel_volume_destroy(b);
    }
}

static void test_pvm_is_the_raw_file(void **state) {
    (void)state;
    struct pel_volume *volume = load("bucky32/Bucky.pvm", NULL);
    struct test_bytes raw = test_read(test_data_path("data/bucky32/Bucky.raw"));
    assert_int_equal(raw.count, pel_volume_bytes(volume));
    assert_memory_equal(volume->voxels, raw.bytes, raw.count);
    test_release(&raw);
    pel_volume_destroy(volume);
}

static void test_teddybear_has_one_channel(void **state) {
    test_watch_warnings(state);
    struct pel_volume *volume = load("teddybear/Teddybear.mhd", NULL);
    assert_int_equal(test_warning_count(), 1);
    assert_non_null(strstr(test_warning(), "4 channels are claimed"));
    pel_volume_destroy(volume);
}

// All number types of one 3 x 3 x 3 image hold the same values.
static void test_number_types(void **state) {
    (void)state;
    static const char *const types[] = {"uint8", "int8",   "uint16", "int16",   "uint32",
                                        "int32", "uint64", "int64",  "float32", "float64"};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        char path[128];
        snprintf(path, sizeof path, "torture_nifti/nifti-rs/27/%s.nii", types[i]);
        struct pel_volume *volume = load(path, NULL);
        struct pel_volume *first = load("torture_nifti/nifti-rs/27/uint8.nii", NULL);
        for (int v = 0; v < 27; v++)
            assert_true(pel_volume_value(volume, v % 3, v / 3 % 3, v / 9) ==
                        pel_volume_value(first, v % 3, v / 3 % 3, v / 9));
        assert_true(pel_volume_value(volume, 2, 2, 2) > pel_volume_value(volume, 0, 0, 0));
        pel_volume_destroy(volume);
        pel_volume_destroy(first);
    }
}

// The protocol of these acquisitions states where the middle of the stack was: off centre by
// (ap, fh, rl) = (-18.805, 22.157, -17.977) mm towards posterior, head and left, and how far the
// first and last slice are apart.
static void check_phantom(const struct pel_volume *volume, double slice_mm) {
    const double middle[] = {40, 40, 4.5};
    double centre[3], spacing[3];
    pel_matrix_point(centre, &volume->world_from_voxel, middle);
    assert_true(fabs(centre[0] - 17.977) < 2e-3);
    assert_true(fabs(centre[1] - 18.805) < 2e-3);
    assert_true(fabs(centre[2] - 22.157) < 2e-3);
    pel_volume_spacing(volume, spacing);
    assert_true(fabs(spacing[0] - 1.91176) < 1e-4 && fabs(spacing[1] - 1.91176) < 1e-4);
    assert_true(fabs(spacing[2] - slice_mm) < 1e-3);
}

static void test_phantom_lies_where_the_protocol_says(void **state) {
    (void)state;
    struct pel_volume *volume = load("torture_formats_equiv/NIFTI/T1.nii.gz", NULL);
    check_phantom(volume, 10);
    pel_volume_destroy(volume);
    volume = load("torture_formats_equiv/NIFTI/T2.nii.gz", NULL);
    check_phantom(volume, 12.33);
    pel_volume_destroy(volume);
}

static bool has_dcm2niix(void) {
    return system("command -v dcm2niix >/dev/null 2>&1") == 0;
}

static void test_dicom(void **state) {
    (void)state;
    const char *path = test_data_path("data/torture_formats_equiv/DICOM/T1.dcm");
    if (!has_dcm2niix()) {
        test_assert_load_fails(path, NULL, PEL_ERROR_UNSUPPORTED, "package dcm2niix");
        return;
    }
    struct pel_volume *dicom = load("torture_formats_equiv/DICOM/T1.dcm", NULL);
    struct pel_volume *nifti = load("torture_formats_equiv/NIFTI/T1.nii.gz", NULL);
    // The two may count rows in opposite directions: the same points must have the same values.
    struct pel_matrix from_world;
    assert_true(pel_matrix_invert(&from_world, &dicom->world_from_voxel));
    double worst = 0;
    for (int k = 0; k < nifti->dims[2]; k++) {
        for (int j = 0; j < nifti->dims[1]; j++) {
            for (int i = 0; i < nifti->dims[0]; i++) {
                double point[3] = {i, j, k};
                pel_matrix_point(point, &nifti->world_from_voxel, point);
                pel_matrix_point(point, &from_world, point);
                int at[3] = {(int)lround(point[0]), (int)lround(point[1]), (int)lround(point[2])};
                for (int c = 0; c < 3; c++)
                    assert_true(at[c] >= 0 && at[c] < dicom->dims[c]);
                double difference = fabs(pel_volume_value(nifti, i, j, k) -
                                         pel_volume_value(dicom, at[0], at[1], at[2]));
                worst = difference > worst ? difference : worst;
            }
        }
    }
    assert_true(worst < 2);
    pel_volume_destroy(dicom);
    pel_volume_destroy(nifti);
}

static void test_par_rec_gets_advice(void **state) {
    (void)state;
    test_assert_load_fails(test_data_path("data/torture_formats_equiv/PARREC/T1.PAR"), NULL,
                           PEL_ERROR_UNSUPPORTED, "dcm2niix turns it into NIfTI");
}

int main(void) {
    test_need_data("data/bucky32");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volumes),
        cmocka_unit_test(test_headerless),
        cmocka_unit_test(test_same_voxels),
        cmocka_unit_test(test_pvm_is_the_raw_file),
        cmocka_unit_test(test_teddybear_has_one_channel),
        cmocka_unit_test(test_number_types),
        cmocka_unit_test(test_phantom_lies_where_the_protocol_says),
        cmocka_unit_test(test_dicom),
        cmocka_unit_test(test_par_rec_gets_advice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
