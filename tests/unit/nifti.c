// nifti.c - NIfTI-1, NIfTI-2 and ANALYZE files, written here field by field at the offsets that the
// standards give.
#include "support/file.h"

#include <math.h>

// What the tests vary. Members that are zero leave zeros in the header.
struct fields {
    int version; // 1, 2, or 0 for ANALYZE
    bool big_endian, pair;
    int dims[8];
    int datatype, bits;
    double pixdim[8], slope, intercept, data_offset;
    int units, qform_code, sform_code, intent;
    double quatern[3], offset[3], rows[3][4];
};

static void put_zeros(struct test_bytes *out, size_t until) {
    static const char zeros[4096];
    while (out->count < until) {
        size_t missing = until - out->count;
        test_put(out, zeros, missing < sizeof zeros ? missing : sizeof zeros);
    }
}

static void put_geometry(struct test_bytes *out, const struct fields *f, int bytes) {
    for (int i = 0; i < 3; i++)
        test_put_float(out, f->quatern[i], bytes, f->big_endian);
    for (int i = 0; i < 3; i++)
        test_put_float(out, f->offset[i], bytes, f->big_endian);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++)
            test_put_float(out, f->rows[r][c], bytes, f->big_endian);
}

static struct test_bytes header1(const struct fields *f) {
    struct test_bytes out = {0};
    bool big = f->big_endian;
    test_put_integer(&out, 348, 4, big);
    put_zeros(&out, 40);
    for (int i = 0; i < 8; i++)
        test_put_integer(&out, f->dims[i], 2, big);
    put_zeros(&out, 68);
    test_put_integer(&out, f->version ? f->intent : 0, 2, big);
    test_put_integer(&out, f->datatype, 2, big);
    test_put_integer(&out, f->bits, 2, big);
    put_zeros(&out, 76);
    for (int i = 0; i < 8; i++)
        test_put_float(&out, f->pixdim[i], 4, big);
    test_put_float(&out, f->data_offset, 4, big);
    test_put_float(&out, f->slope, 4, big);
    test_put_float(&out, f->intercept, 4, big);
    put_zeros(&out, 123);
    test_put_integer(&out, f->units, 1, big);
    put_zeros(&out, 252);
    test_put_integer(&out, f->qform_code, 2, big);
    test_put_integer(&out, f->sform_code, 2, big);
    put_geometry(&out, f, 4);
    put_zeros(&out, 344);
    if (f->version)
        test_put_text(&out, f->pair ? "ni1" : "n+1");
    put_zeros(&out, f->pair || !f->version ? 348 : 352);
    return out;
}

static struct test_bytes header2(const struct fields *f) {
    struct test_bytes out = {0};
    bool big = f->big_endian;
    test_put_integer(&out, 540, 4, big);
    test_put(&out, f->pair ? "ni2\0\r\n\032\n" : "n+2\0\r\n\032\n", 8);
    test_put_integer(&out, f->datatype, 2, big);
    test_put_integer(&out, f->bits, 2, big);
    for (int i = 0; i < 8; i++)
        test_put_integer(&out, f->dims[i], 8, big);
    put_zeros(&out, 104);
    for (int i = 0; i < 8; i++)
        test_put_float(&out, f->pixdim[i], 8, big);
    test_put_integer(&out, (int64_t)f->data_offset, 8, big);
    test_put_float(&out, f->slope, 8, big);
    test_put_float(&out, f->intercept, 8, big);
    put_zeros(&out, 344);
    test_put_integer(&out, f->qform_code, 4, big);
    test_put_integer(&out, f->sform_code, 4, big);
    put_geometry(&out, f, 8);
    put_zeros(&out, 500);
    test_put_integer(&out, f->units, 4, big);
    test_put_integer(&out, f->intent, 4, big);
    put_zeros(&out, 544);
    return out;
}

static struct test_bytes header_of(const struct fields *fields) {
    return fields->version == 2 ? header2(fields) : header1(fields);
}

// A 2 x 3 x 2 image of int16, oblique and left-handed, with values 100 * k + 10 * j + i - 5.
static const struct fields oblique = {
    .version = 1,
    .dims = {3, 2, 3, 2, 1, 1, 1, 1},
    .datatype = 4,
    .bits = 16,
    .pixdim = {1, 1, 1, 1, 0, 0, 0, 0},
    .units = 2,
    .sform_code = 1,
    .data_offset = 352,
    .rows = {{0.75, 0.5, 0.25, -7.5}, {-0.5, 1.25, 0, 11}, {0.125, 0, -3, 0.5}},
};

static void put_values(struct test_bytes *out, const struct fields *fields) {
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < 3; j++)
            for (int i = 0; i < 2; i++)
                test_put_integer(out, 100 * k + 10 * j + i - 5, 2, fields->big_endian);
}

static void assert_values(const struct pel_volume *volume, double slope, double intercept) {
    assert_memory_equal(volume->dims, ((int[]){2, 3, 2}), sizeof volume->dims);
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < 3; j++)
            for (int i = 0; i < 2; i++)
                assert_true(pel_volume_value(volume, i, j, k) ==
                            slope * (100 * k + 10 * j + i - 5) + intercept);
}

static struct pel_volume *load_fields(const struct fields *fields, const char *leaf) {
    struct test_bytes file = header_of(fields);
    put_values(&file, fields);
    const char *path = test_write(leaf, file.bytes, file.count);
    test_release(&file);
    struct pel_volume *volume = pel_volume_load(path, NULL);
    if (!volume)
        fail_msg("%s", pel_error_message());
    return volume;
}

static void test_both_versions_and_byte_orders(void **state) {
    for (int version = 1; version <= 2; version++) {
        for (int big = 0; big < 2; big++) {
            struct fields fields = oblique;
            fields.version = version;
            fields.big_endian = big;
            fields.data_offset = version == 1 ? 352 : 544;
            test_watch_warnings(state);
            struct pel_volume *volume = load_fields(&fields, "oblique.nii");
            assert_int_equal(volume->type, PEL_VOXEL_I16);
            assert_values(volume, 1, 0);
            test_assert_matrix(volume, oblique.rows, 0);
            assert_string_equal(volume->space, "sform (scanner)");
            assert_int_equal(test_warning_count(), 0);
            pel_volume_destroy(volume);
        }
    }
}

static void test_gzip_and_wrong_name(void **state) {
    (void)state;
    struct test_bytes file = header_of(&oblique);
    put_values(&file, &oblique);
    struct test_bytes packed = test_deflate(file.bytes, file.count, 31);
    static const char *const leaves[] = {"a.nii.gz", "a.nii", "a.dat"};
    for (int i = 0; i < 3; i++) {
        struct pel_volume *volume =
            pel_volume_load(test_write(leaves[i], packed.bytes, packed.count), NULL);
        assert_non_null(volume);
        assert_values(volume, 1, 0);
        assert_string_equal(volume->name, leaves[i]);
        pel_volume_destroy(volume);
    }
    // The last bytes of gzip are a checksum, which must be looked at.
    packed.bytes[packed.count - 6] ^= 1;
    test_assert_load_fails(test_write("crc.nii.gz", packed.bytes, packed.count), NULL,
                           PEL_ERROR_FORMAT, "damaged (incorrect data check)");
    test_release(&file);
    test_release(&packed);
}

static void test_pair(void **state) {
    (void)state;
    struct fields fields = oblique;
    fields.pair = true;
    fields.data_offset = 4;
    struct test_bytes header = header_of(&fields), data = {0};
    test_put_text(&data, "skip");
    put_values(&data, &fields);
    test_write("pair.hdr", header.bytes, header.count);
    test_assert_load_fails(test_temporary_path("pair.hdr"), NULL, PEL_ERROR_FILE,
                           "pair.img that belongs to it is missing");
    test_write("pair.img", data.bytes, data.count);
    static const char *const leaves[] = {"pair.hdr", "pair.img"};
    for (int i = 0; i < 2; i++) {
        struct pel_volume *volume = pel_volume_load(test_temporary_path(leaves[i]), NULL);
        assert_non_null(volume);
        assert_values(volume, 1, 0);
        test_assert_matrix(volume, oblique.rows, 0);
        pel_volume_destroy(volume);
    }
    test_release(&header);
    test_release(&data);
}

static void test_analyze_has_no_orientation(void **state) {
    struct fields fields = oblique;
    fields.version = 0;
    fields.pixdim[1] = 2;
    fields.pixdim[2] = 3;
    fields.pixdim[3] = -4;
    fields.slope = 9;
    fields.data_offset = 0;
    struct test_bytes header = header_of(&fields), data = {0};
    put_values(&data, &fields);
    test_write("old.hdr", header.bytes, header.count);
    test_write("old.img", data.bytes, data.count);
    test_watch_warnings(state);
    struct pel_volume *volume = pel_volume_load(test_temporary_path("old.hdr"), NULL);
    assert_non_null(volume);
    assert_values(volume, 1, 0);
    test_assert_matrix(volume, (const double[3][4]){{2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 4, 0}}, 0);
    assert_int_equal(test_warning_count(), 1);
    assert_non_null(strstr(test_warning(), "ANALYZE has no orientation"));
    pel_volume_destroy(volume);
    test_release(&header);
    test_release(&data);
}

static void test_qform(void **state) {
    (void)state;
    // A quarter turn about z: i goes to +y, j to -x; qfac -1 turns k around.
    struct fields fields = oblique;
    fields.sform_code = 0;
    fields.qform_code = 4;
    fields.quatern[2] = sqrt(0.5);
    fields.pixdim[0] = -1;
    fields.pixdim[1] = 2;
    fields.pixdim[2] = 3;
    fields.pixdim[3] = 4;
    fields.offset[0] = 5;
    fields.offset[1] = 6;
    fields.offset[2] = 7;
    struct pel_volume *volume = load_fields(&fields, "qform.nii");
    test_assert_matrix(volume, (const double[3][4]){{0, -3, 0, 5}, {2, 0, 0, 6}, {0, 0, -4, 7}},
                       1e-6);
    assert_string_equal(volume->space, "qform (mni)");
    pel_volume_destroy(volume);
    // The sform goes first, unless it is singular.
    fields.sform_code = 2;
    volume = load_fields(&fields, "both.nii");
    test_assert_matrix(volume, oblique.rows, 0);
    assert_string_equal(volume->space, "sform (aligned)");
    pel_volume_destroy(volume);
    memset(fields.rows, 0, sizeof fields.rows);
    test_watch_warnings(NULL);
    volume = load_fields(&fields, "singular.nii");
    assert_string_equal(volume->space, "qform (mni)");
    assert_non_null(strstr(test_warning(), "sform is singular"));
    pel_volume_destroy(volume);
}

static void test_neither_form_is_said(void **state) {
    struct fields fields = oblique;
    fields.sform_code = 0;
    fields.pixdim[1] = 0.5;
    test_watch_warnings(state);
    struct pel_volume *volume = load_fields(&fields, "plain.nii");
    test_assert_matrix(volume, (const double[3][4]){{0.5, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, 0);
    assert_int_equal(test_warning_count(), 1);
    assert_non_null(strstr(test_warning(), "neither sform nor qform"));
    pel_volume_destroy(volume);
}

static void test_units_of_length(void **state) {
    (void)state;
    const double scales[] = {1, 1000, 1, 0.001};
    for (int unit = 0; unit < 4; unit++) {
        struct fields fields = oblique;
        fields.units = unit | 8; // with seconds
        struct pel_volume *volume = load_fields(&fields, "unit.nii");
        double rows[3][4];
        for (int i = 0; i < 12; i++)
            rows[i / 4][i % 4] = scales[unit] * oblique.rows[i / 4][i % 4];
        test_assert_matrix(volume, rows, 1e-12 * scales[unit]);
        pel_volume_destroy(volume);
    }
}

static void test_slope_and_intercept(void **state) {
    (void)state;
    struct fields fields = oblique;
    fields.slope = 2;
    fields.intercept = -1024;
    fields.intent = 1002;
    struct pel_volume *volume = load_fields(&fields, "scaled.nii");
    assert_values(volume, 2, -1024);
    assert_true(volume->labels);
    pel_volume_destroy(volume);
    // A slope of 0 means none, and so does NaN.
    fields.slope = 0;
    volume = load_fields(&fields, "unscaled.nii");
    assert_values(volume, 1, 0);
    pel_volume_destroy(volume);
    fields.slope = NAN;
    volume = load_fields(&fields, "nan.nii");
    assert_values(volume, 1, 0);
    pel_volume_destroy(volume);
}

static void test_time_and_channels(void **state) {
    struct fields fields = oblique;
    fields.dims[0] = 5;
    fields.dims[4] = 3;
    fields.dims[5] = 2;
    fields.datatype = 2;
    fields.bits = 8;
    struct test_bytes file = header_of(&fields);
    for (int i = 0; i < 12 * 6; i++)
        test_put_integer(&file, i, 1, false);
    const char *path = test_write("five.nii", file.bytes, file.count);
    test_release(&file);
    struct pel_load_options options = {.time = 2, .channel = 1};
    test_watch_warnings(state);
    struct pel_volume *volume = pel_volume_load(path, &options);
    assert_non_null(volume);
    // Time goes faster than channels: volume 2 + 3 * 1 starts at byte 60.
    assert_true(pel_volume_value(volume, 0, 0, 0) == 60 && pel_volume_value(volume, 1, 2, 1) == 71);
    assert_int_equal(test_warning_count(), 0);
    pel_volume_destroy(volume);
    volume = pel_volume_load(path, NULL);
    assert_true(pel_volume_value(volume, 0, 0, 0) == 0);
    assert_int_equal(test_warning_count(), 2);
    pel_volume_destroy(volume);
    options.time = 3;
    test_assert_load_fails(path, &options, PEL_ERROR_ARGUMENT, "no time step 3, the file has 3");
    options = (struct pel_load_options){.channel = 2};
    test_assert_load_fails(path, &options, PEL_ERROR_ARGUMENT, "no channel 2, the file has 2");
}

static void test_colours(void **state) {
    (void)state;
    static const int datatypes[] = {128, 2304};
    for (int i = 0; i < 2; i++) {
        struct fields fields = oblique;
        int components = 3 + i;
        fields.datatype = datatypes[i];
        fields.bits = 8 * components;
        struct test_bytes file = header_of(&fields);
        for (int b = 0; b < 12 * components; b++)
            test_put_integer(&file, b, 1, false);
        struct pel_volume *volume =
            pel_volume_load(test_write("colour.nii", file.bytes, file.count), NULL);
        assert_non_null(volume);
        assert_int_equal(volume->type, i ? PEL_VOXEL_RGBA8 : PEL_VOXEL_RGB8);
        assert_memory_equal(volume->voxels, file.bytes + 352, 12 * (size_t)components);
        pel_volume_destroy(volume);
        test_release(&file);
    }
}

static void test_absent_voxels(void **state) {
    (void)state;
    struct fields fields = oblique;
    fields.datatype = 16;
    fields.bits = 32;
    fields.big_endian = true;
    struct test_bytes file = header_of(&fields);
    for (int i = 0; i < 12; i++)
        test_put_float(&file, i == 1 ? NAN : i == 2 ? INFINITY : i, 4, true);
    struct pel_volume *volume =
        pel_volume_load(test_write("absent.nii", file.bytes, file.count), NULL);
    assert_non_null(volume);
    const float *voxels = volume->voxels;
    assert_true(voxels[0] == 0 && isnan(voxels[1]) && isnan(voxels[2]) && voxels[3] == 3);
    pel_volume_destroy(volume);
    test_release(&file);
}

static void assert_fields_fail(const struct fields *fields, size_t data_bytes, enum pel_error code,
                               const char *fragment) {
    struct test_bytes file = header_of(fields);
    static const char zeros[64];
    test_put(&file, zeros, data_bytes);
    test_assert_load_fails(test_write("bad.nii", file.bytes, file.count), NULL, code, fragment);
    test_release(&file);
}

static void test_errors(void **state) {
    (void)state;
    struct fields fields = oblique;
    assert_fields_fail(&fields, 23, PEL_ERROR_FORMAT,
                       "2 x 3 x 2 voxels of 2 bytes need 24 bytes, the file has 23");
    fields.dims[1] = fields.dims[2] = fields.dims[3] = 2000;
    fields.datatype = 64;
    assert_fields_fail(&fields, 25, PEL_ERROR_FORMAT, "need 64000000000 bytes, the file has 25");
    fields = oblique;
    fields.dims[2] = -3;
    assert_fields_fail(&fields, 24, PEL_ERROR_FORMAT, "-3 elements along dimension 2");
    fields = oblique;
    fields.dims[0] = 9;
    assert_fields_fail(&fields, 24, PEL_ERROR_FORMAT, "9 dimensions");
    fields = oblique;
    fields.datatype = 32;
    assert_fields_fail(&fields, 24, PEL_ERROR_UNSUPPORTED, "type 32");
    fields = oblique;
    fields.data_offset = 1e9;
    assert_fields_fail(&fields, 24, PEL_ERROR_FORMAT, "data starts at byte 1000000000");
    fields.data_offset = NAN;
    assert_fields_fail(&fields, 24, PEL_ERROR_FORMAT, "which cannot be");
    fields = oblique;
    fields.version = 2;
    fields.data_offset = 544;
    fields.dims[3] = 70000;
    assert_fields_fail(&fields, 24, PEL_ERROR_FORMAT, "70000 voxels along axis 2");
    test_assert_load_fails(test_write("short.nii", "\x5c\x01\0\0abc", 7), NULL, PEL_ERROR_FORMAT,
                           "ends after 7 bytes where 348 are needed");
    test_assert_load_fails(test_temporary_path("none.nii"), NULL, PEL_ERROR_FILE, "No such file");
}

static void test_bomb_is_refused(void **state) {
    (void)state;
    // 4 KB that inflate to 4 MB are fine, but the header claims 54 GB.
    struct fields fields = oblique;
    fields.dims[1] = fields.dims[2] = fields.dims[3] = 3000;
    struct test_bytes file = header_of(&fields);
    put_zeros(&file, 4000000);
    struct test_bytes packed = test_deflate(file.bytes, file.count, 31);
    test_assert_load_fails(test_write("bomb.nii.gz", packed.bytes, packed.count), NULL,
                           PEL_ERROR_FORMAT, "need 54000000000 bytes");
    test_release(&file);
    test_release(&packed);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_both_versions_and_byte_orders),
        cmocka_unit_test(test_gzip_and_wrong_name),
        cmocka_unit_test(test_pair),
        cmocka_unit_test(test_analyze_has_no_orientation),
        cmocka_unit_test(test_qform),
        cmocka_unit_test(test_neither_form_is_said),
        cmocka_unit_test(test_units_of_length),
        cmocka_unit_test(test_slope_and_intercept),
        cmocka_unit_test(test_time_and_channels),
        cmocka_unit_test(test_colours),
        cmocka_unit_test(test_absent_voxels),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_bomb_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
