// nrrd.c - NRRD files in every encoding and space, and what must not reach teem.
#include "support/file.h"

#include <math.h>
#include <sys/stat.h>

static struct pel_volume *load_text(const char *leaf, const char *header, const void *data,
                                    size_t count, const struct pel_load_options *options) {
    struct test_bytes file = {0};
    test_put_text(&file, header);
    test_put(&file, data, count);
    const char *path = test_write(leaf, file.bytes, file.count);
    test_release(&file);
    struct pel_volume *volume = pel_volume_load(path, options);
    if (!volume)
        fail_msg("%s", pel_error_message());
    return volume;
}

static void assert_text_fails(const char *header, const void *data, size_t count,
                              enum pel_error code, const char *fragment) {
    struct test_bytes file = {0};
    test_put_text(&file, header);
    test_put(&file, data, count);
    test_assert_load_fails(test_write("bad.nrrd", file.bytes, file.count), NULL, code, fragment);
    test_release(&file);
}

static const unsigned char bytes24[24] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11,
                                          12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23};

static void test_spaces_become_ras(void **state) {
    static const struct {
        const char *name;
        double signs[3];
        const char *space;
    } spaces[] = {
        {"right-anterior-superior", {1, 1, 1}, "space directions (RAS)"},
        {"RAS", {1, 1, 1}, "space directions (RAS)"},
        {"left-anterior-superior", {-1, 1, 1}, "space directions (LAS)"},
        {"left-posterior-superior", {-1, -1, 1}, "space directions (LPS)"},
        {"scanner-xyz", {1, 1, 1}, "space directions (unknown space)"},
    };
    for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++) {
        char header[512];
        snprintf(header, sizeof header,
                 "NRRD0004\ntype: uint8\ndimension: 3\nspace: %s\nsizes: 4 3 2\n"
                 "space directions: (0.75,-0.5,0.125) (0.5,1.25,0) (0.25,0,-3)\n"
                 "space origin: (-7.5,11,0.5)\nencoding: raw\n\n",
                 spaces[i].name);
        test_watch_warnings(state);
        struct pel_volume *volume = load_text("space.nrrd", header, bytes24, 24, NULL);
        // The file has one direction per axis: a column of the matrix.
        double rows[3][4] = {{0.75, 0.5, 0.25, -7.5}, {-0.5, 1.25, 0, 11}, {0.125, 0, -3, 0.5}};
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++)
                rows[r][c] *= spaces[i].signs[r];
        test_assert_matrix(volume, rows, 0);
        assert_string_equal(volume->space, spaces[i].space);
        assert_int_equal(test_warning_count(), i == 4);
        assert_memory_equal(volume->voxels, bytes24, 24);
        pel_volume_destroy(volume);
    }
}

static void test_spacings_without_space(void **state) {
    (void)state;
    struct pel_volume *volume =
        load_text("spacings.nrrd",
                  "NRRD0001\ntype: uchar\ndimension: 3\nsizes: 4 3 2\nspacings: 0.5 nan 3\n"
                  "axis mins: 10 1 nan\naxis maxs: nan 7 nan\ncenters: node cell cell\n"
                  "units: \"mm\" \"mm\" \"um\"\nencoding: raw\n\n",
                  bytes24, 24, NULL);
    // Axis 1: three cells from 1 to 7 are 2 wide, the first centre at 2. Axis 2 is in micrometres.
    const double rows[3][4] = {{0.5, 0, 0, 10}, {0, 2, 0, 2}, {0, 0, 0.003, 0}};
    test_assert_matrix(volume, rows, 1e-12);
    pel_volume_destroy(volume);
}

static void test_space_units(void **state) {
    (void)state;
    struct pel_volume *volume =
        load_text("um.nrrd",
                  "NRRD0004\ntype: uint8\ndimension: 3\nspace: RAS\nsizes: 4 3 2\n"
                  "space directions: (500,0,0) (0,250,0) (0,0,1000)\n"
                  "space units: \"um\" \"um\" \"um\"\nspace origin: (1000,0,-2000)\n"
                  "sample units: \"HU\"\nencoding: raw\n\n",
                  bytes24, 24, NULL);
    test_assert_matrix(volume, (const double[3][4]){{0.5, 0, 0, 1}, {0, 0.25, 0, 0}, {0, 0, 1, -2}},
                       1e-12);
    assert_string_equal(volume->unit, "HU");
    pel_volume_destroy(volume);
}

// 12 values of uint16, 256 * i + 1, in all encodings and byte orders.
static void test_encodings(void **state) {
    (void)state;
    for (int big = 0; big < 2; big++) {
        struct test_bytes raw = {0}, hex = {0}, text = {0};
        for (int i = 0; i < 12; i++) {
            char number[16];
            test_put_integer(&raw, 256 * i + 1, 2, big);
            snprintf(number, sizeof number, "%02x%02x%s", big ? i : 1, big ? 1 : i,
                     i % 5 ? "" : "\n");
            test_put_text(&hex, number);
            snprintf(number, sizeof number, "%d%s", 256 * i + 1, i % 3 == 2 ? "\n" : " ");
            test_put_text(&text, number);
        }
        struct test_bytes gzip = test_deflate(raw.bytes, raw.count, 31);
        const struct {
            const char *encoding;
            const struct test_bytes *data;
        } encodings[] = {{"raw", &raw}, {"gzip", &gzip},  {"gz", &gzip},
                         {"hex", &hex}, {"ascii", &text}, {"txt", &text}};
        for (size_t e = 0; e < sizeof encodings / sizeof *encodings; e++) {
            char header[256];
            snprintf(header, sizeof header,
                     "NRRD0004\ntype: unsigned short\ndimension: 3\nsizes: 3 2 2\nendian: %s\n"
                     "encoding: %s\n\n",
                     big ? "big" : "little", encodings[e].encoding);
            struct pel_volume *volume = load_text("coded.nrrd", header, encodings[e].data->bytes,
                                                  encodings[e].data->count, NULL);
            assert_int_equal(volume->type, PEL_VOXEL_U16);
            for (int i = 0; i < 12; i++)
                assert_int_equal(((uint16_t *)volume->voxels)[i], 256 * i + 1);
            pel_volume_destroy(volume);
        }
        test_release(&raw);
        test_release(&hex);
        test_release(&text);
        test_release(&gzip);
    }
}

static void test_skips(void **state) {
    (void)state;
    struct test_bytes data = {0};
    test_put_text(&data, "one line\nanother\nxyz");
    test_put(&data, bytes24, 24);
    test_write("skip.dat", data.bytes, data.count);
    struct pel_volume *volume =
        load_text("skip.nhdr",
                  "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nline skip: 2\nbyte skip: 3\n"
                  "encoding: raw\ndata file: skip.dat\n",
                  "", 0, NULL);
    assert_memory_equal(volume->voxels, bytes24, 24);
    pel_volume_destroy(volume);
    volume = load_text("end.nhdr",
                       "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nbyte skip: -1\n"
                       "encoding: raw\ndata file: skip.dat\n",
                       "", 0, NULL);
    assert_memory_equal(volume->voxels, bytes24, 24);
    pel_volume_destroy(volume);
    test_release(&data);
}

static void test_several_data_files(void **state) {
    (void)state;
    test_write("z07.raw", bytes24, 12);
    test_write("z09.raw", bytes24 + 12, 12);
    static const char *const fields[] = {"data file: z%02d.raw 7 9 2\n",
                                         "data file: LIST\nz07.raw\nz09.raw\n"};
    for (int i = 0; i < 2; i++) {
        char header[256];
        snprintf(header, sizeof header,
                 "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n%s", fields[i]);
        struct pel_volume *volume = load_text("several.nhdr", header, "", 0, NULL);
        assert_memory_equal(volume->voxels, bytes24, 24);
        pel_volume_destroy(volume);
    }
}

static void test_colours_and_channels(void **state) {
    static const char header[] =
        "NRRD0004\ntype: uint8\ndimension: 4\nspace: RAS\nsizes: 3 2 2 2\nkinds: %s domain domain "
        "domain\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\n\n";
    static const char *const kinds[] = {"RGB-color", "3-color", "vector", "???"};
    for (int i = 0; i < 4; i++) {
        char text[256];
        snprintf(text, sizeof text, header, kinds[i]);
        struct pel_volume *volume = load_text("rgb.nrrd", text, bytes24, 24, NULL);
        assert_int_equal(volume->type, PEL_VOXEL_RGB8);
        assert_memory_equal(volume->voxels, bytes24, 24);
        pel_volume_destroy(volume);
    }
    // The same bytes as three channels, of which the last is asked for.
    char text[256];
    snprintf(text, sizeof text, header, "vector");
    struct pel_load_options options = {.channel = 2, .split_channels = true};
    test_watch_warnings(state);
    struct pel_volume *volume = load_text("channel.nrrd", text, bytes24, 24, &options);
    const unsigned char expected[] = {2, 5, 8, 11, 14, 17, 20, 23};
    assert_int_equal(volume->type, PEL_VOXEL_U8);
    assert_memory_equal(volume->voxels, expected, 8);
    assert_int_equal(test_warning_count(), 0);
    pel_volume_destroy(volume);
    // Colours as the last axis are planes.
    volume = load_text("planar.nrrd",
                       "NRRD0004\ntype: uint8\ndimension: 4\nspace: RAS\nsizes: 2 2 2 3\n"
                       "kinds: domain domain domain RGB-color\n"
                       "space directions: (1,0,0) (0,1,0) (0,0,1) none\nencoding: raw\n\n",
                       bytes24, 24, NULL);
    const unsigned char first[] = {0, 8, 16, 1, 9, 17};
    assert_int_equal(volume->type, PEL_VOXEL_RGB8);
    assert_memory_equal(volume->voxels, first, sizeof first);
    pel_volume_destroy(volume);
}

static void test_time(void **state) {
    static const char *const headers[] = {
        "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 2 2 3\nkinds: domain domain domain time\n"
        "encoding: raw\n\n",
        "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 2 2 3\nencoding: raw\n\n",
        "NRRD0004\ntype: uint8\ndimension: 4\nspace: RAST\nsizes: 2 2 2 3\n"
        "space directions: (1,0,0,0) (0,1,0,0) (0,0,1,0) (0,0,0,5)\nencoding: raw\n\n",
    };
    for (int i = 0; i < 3; i++) {
        struct pel_load_options options = {.time = 1};
        struct pel_volume *volume = load_text("time.nrrd", headers[i], bytes24, 24, &options);
        assert_memory_equal(volume->voxels, bytes24 + 8, 8);
        assert_memory_equal(volume->dims, ((int[]){2, 2, 2}), sizeof volume->dims);
        pel_volume_destroy(volume);
    }
    test_watch_warnings(state);
    struct pel_volume *volume = load_text("first.nrrd", headers[0], bytes24, 24, NULL);
    assert_non_null(strstr(test_warning(), "3 time steps, only the first is read"));
    pel_volume_destroy(volume);
    struct pel_load_options options = {.time = 3};
    test_assert_load_fails(test_temporary_path("first.nrrd"), &options, PEL_ERROR_ARGUMENT,
                           "no time step 3, the file has 3");
}

static void test_wide_types(void **state) {
    test_watch_warnings(state);
    struct test_bytes data = {0};
    test_put_integer(&data, -30000, 4, false);
    test_put_integer(&data, 12, 4, false);
    struct pel_volume *volume = load_text(
        "wide.nrrd",
        "NRRD0004\ntype: int\ndimension: 3\nsizes: 2 1 1\nendian: little\nencoding: raw\n\n",
        data.bytes, data.count, NULL);
    assert_int_equal(volume->type, PEL_VOXEL_I16);
    assert_int_equal(((int16_t *)volume->voxels)[0], -30000);
    assert_int_equal(test_warning_count(), 0);
    pel_volume_destroy(volume);
    test_release(&data);
}

#define SMALL "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\n"

static void test_errors(void **state) {
    (void)state;
    assert_text_fails(SMALL "encoding: raw\n\n", bytes24, 23, PEL_ERROR_FORMAT,
                      "need 24 bytes, the file has 23");
    assert_text_fails(
        "NRRD0004\ntype: double\ndimension: 3\nsizes: 3000 3000 3000\nendian: little\n"
        "encoding: raw\n\n",
        bytes24, 24, PEL_ERROR_FORMAT, "need 216000000000 bytes");
    assert_text_fails("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1000 1000 1000\n"
                      "encoding: gzip\n\n",
                      bytes24, 24, PEL_ERROR_FORMAT, "need 1000000000 bytes");
    assert_text_fails("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 65536 1000 1000\n"
                      "encoding: bz2\n\n",
                      bytes24, 24, PEL_ERROR_FORMAT, "need 65536000000 bytes");
    assert_text_fails("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 0 3 2\nencoding: raw\n\n",
                      bytes24, 24, PEL_ERROR_FORMAT, "");
    assert_text_fails("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 100000 3 2\nencoding: raw\n\n",
                      bytes24, 24, PEL_ERROR_FORMAT, "100000 voxels along axis 0");
    assert_text_fails("NRRD0004\ntype: block\nblock size: 3\ndimension: 3\nsizes: 2 2 2\n"
                      "endian: little\nencoding: raw\n\n",
                      bytes24, 24, PEL_ERROR_UNSUPPORTED, "type block");
    assert_text_fails("NRRD0004\ntype: uint8\ndimension: 3\nspace: RAS\nsizes: 4 3 2\n"
                      "space directions: (1,0,0) (2,0,0) (0,0,1)\nencoding: raw\n\n",
                      bytes24, 24, PEL_ERROR_FORMAT, "lie in one plane");
    assert_text_fails("NRRD0004\ntype: nonsense\n\n", bytes24, 24, PEL_ERROR_FORMAT, "nonsense");
    // Truncated gzip.
    struct test_bytes gzip = test_deflate(bytes24, 24, 31);
    assert_text_fails(SMALL "encoding: gzip\n\n", gzip.bytes, gzip.count - 12, PEL_ERROR_FORMAT,
                      "compressed data");
    test_release(&gzip);
}

static void test_what_teem_must_not_see(void **state) {
    (void)state;
    // Each of these would crash, hang, print or read what it must not.
    assert_text_fails(SMALL "encoding: raw\ndata file: -\n", "", 0, PEL_ERROR_UNSUPPORTED,
                      "standard input");
    assert_text_fails(SMALL "encoding: raw\ndata file: %d%s%n.raw 1 2 1\n", "", 0, PEL_ERROR_FORMAT,
                      "not a pattern");
    assert_text_fails(SMALL "encoding: raw\ndatafile: %999999999d.raw 1 2 1\n", "", 0,
                      PEL_ERROR_FORMAT, "not a pattern");
    assert_text_fails(SMALL "encoding: raw\ndata file: a%d.raw 1 2000000000 1\n", "", 0,
                      PEL_ERROR_FORMAT, "no range");
    assert_text_fails(SMALL "encoding: raw\ndata file: a%d.raw 1 2 0\n", "", 0, PEL_ERROR_FORMAT,
                      "no range");
    assert_int_equal(mkfifo(test_temporary_path("fifo"), 0600), 0);
    assert_text_fails(SMALL "encoding: raw\ndata file: fifo\n", "", 0, PEL_ERROR_FILE,
                      "not a regular file");
    assert_text_fails(SMALL "encoding: raw\ndata file: /dev/zero\n", "", 0, PEL_ERROR_FILE,
                      "not a regular file");
    assert_text_fails(SMALL "encoding: raw\ndata file: missing.raw\n", "", 0, PEL_ERROR_FILE,
                      "No such file");
    char *line = malloc(5000);
    memset(line, 'x', 5000);
    memcpy(line, "NRRD0004\n", 9);
    strcpy(line + 4990, ": 1\n\n");
    assert_text_fails(line, "", 0, PEL_ERROR_FORMAT, "header line of 4984 bytes");
    free(line);
}

static void test_round_trip(void **state) {
    (void)state;
    static const char *const leaves[] = {"trip.nrrd", "trip.nhdr"};
    for (int type = PEL_VOXEL_U8; type <= PEL_VOXEL_RGBA8; type++) {
        for (int i = 0; i < 2; i++) {
            struct pel_volume *volume = test_small_volume((enum pel_voxel_type)type);
            volume->world_from_voxel.m[0][1] = 1.0 / 3;
            strcpy(volume->unit, "HU");
            if (!pel_volume_save(volume, test_temporary_path(leaves[i])))
                fail_msg("%s", pel_error_message());
            struct pel_volume *again = pel_volume_load(test_temporary_path(leaves[i]), NULL);
            if (!again)
                fail_msg("%s", pel_error_message());
            test_assert_same_volume(again, volume, 0);
            assert_string_equal(again->unit, "HU");
            pel_volume_destroy(again);
            pel_volume_destroy(volume);
        }
    }
}

static void test_rescaled_values_are_saved_as_floats(void **state) {
    struct pel_volume *volume = test_small_volume(PEL_VOXEL_I16);
    volume->slope = 0.5;
    volume->intercept = -1024;
    test_watch_warnings(state);
    assert_true(pel_volume_save(volume, test_temporary_path("rescaled.nrrd")));
    assert_int_equal(test_warning_count(), 1);
    struct pel_volume *again = pel_volume_load(test_temporary_path("rescaled.nrrd"), NULL);
    assert_int_equal(again->type, PEL_VOXEL_F32);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 5; i++)
            assert_true(pel_volume_value(again, i, 2, k) == pel_volume_value(volume, i, 2, k));
    pel_volume_destroy(again);
    pel_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_spaces_become_ras),
        cmocka_unit_test(test_spacings_without_space),
        cmocka_unit_test(test_space_units),
        cmocka_unit_test(test_encodings),
        cmocka_unit_test(test_skips),
        cmocka_unit_test(test_several_data_files),
        cmocka_unit_test(test_colours_and_channels),
        cmocka_unit_test(test_time),
        cmocka_unit_test(test_wide_types),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_what_teem_must_not_see),
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_rescaled_values_are_saved_as_floats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
