// raw.c - headerless files, described by options or by a sidecar that is checked strictly.
#include "support/file.h"

#include <math.h>

static const unsigned char bytes24[24] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11,
                                          12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23};

static void test_options(void **state) {
    const char *path = test_write("voxels.raw", bytes24, 24);
    struct pel_load_options options = {.raw = {.dims = {2, 2, 2},
                                               .type = PEL_VOXEL_U16,
                                               .spacing = {0.5, 0, 2},
                                               .origin = {1, 2, 3},
                                               .offset = 8,
                                               .big_endian = true}};
    test_watch_warnings(state);
    struct pel_volume *volume = pel_volume_load(path, &options);
    assert_non_null(volume);
    assert_true(pel_volume_value(volume, 0, 0, 0) == 8 * 256 + 9);
    assert_true(pel_volume_value(volume, 1, 1, 1) == 22 * 256 + 23);
    test_assert_matrix(volume, (const double[3][4]){{0.5, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 2, 3}}, 0);
    assert_int_equal(test_warning_count(), 0);
    pel_volume_destroy(volume);

    options.raw.offset = 4;
    volume = pel_volume_load(path, &options);
    assert_non_null(volume);
    assert_non_null(strstr(test_warning(), "4 bytes follow the voxels"));
    pel_volume_destroy(volume);

    options.raw.offset = 9;
    test_assert_load_fails(path, &options, PEL_ERROR_FORMAT,
                           "2 x 2 x 2 voxels of 2 bytes need 16 bytes, the file has 15");
    options.raw.offset = 1000;
    test_assert_load_fails(path, &options, PEL_ERROR_FORMAT, "data starts at byte 1000");
    options.raw.dims[1] = -1;
    options.raw.offset = 0;
    test_assert_load_fails(path, &options, PEL_ERROR_FORMAT, "-1 voxels along axis 1");
}

static void test_sidecars(void **state) {
    (void)state;
    test_write("a.raw", bytes24, 24);
    test_assert_load_fails(test_temporary_path("a.raw"), NULL, PEL_ERROR_FORMAT, "headerless");
    test_write_text("a.json",
                    "{\"dims\": [3, 2, 2], \"type\": \"int16\", \"endian\": \"little\",\n"
                    " \"spacing\": [1, 2, 3], \"origin\": [-1, -2, 5.5], \"slope\": 0.5,\n"
                    " \"intercept\": -100, \"unit\": \"HU\", \"offset\": 0}\n");
    struct pel_volume *volume = pel_volume_load(test_temporary_path("a.raw"), NULL);
    if (!volume)
        fail_msg("%s", pel_error_message());
    assert_int_equal(volume->type, PEL_VOXEL_I16);
    assert_true(pel_volume_value(volume, 1, 0, 0) == 0.5 * (3 * 256 + 2) - 100);
    assert_string_equal(volume->unit, "HU");
    test_assert_matrix(volume, (const double[3][4]){{1, 0, 0, -1}, {0, 2, 0, -2}, {0, 0, 3, 5.5}},
                       0);
    pel_volume_destroy(volume);
    // NAME.raw.json goes before NAME.json, and options before both.
    test_write_text("a.raw.json",
                    "{\"dims\": [2, 2, 2], \"type\": \"rgb8\", \"world_from_voxel\":\n"
                    "[[0, -2, 0, 7], [1, 0, 0, 8], [0, 0, -3, 9], [0, 0, 0, 1]]}");
    volume = pel_volume_load(test_temporary_path("a.raw"), NULL);
    assert_non_null(volume);
    assert_int_equal(volume->type, PEL_VOXEL_RGB8);
    test_assert_matrix(volume, (const double[3][4]){{0, -2, 0, 7}, {1, 0, 0, 8}, {0, 0, -3, 9}}, 0);
    pel_volume_destroy(volume);
    struct pel_load_options options = {.raw = {.dims = {24, 1, 1}}};
    volume = pel_volume_load(test_temporary_path("a.raw"), &options);
    assert_non_null(volume);
    assert_int_equal(volume->dims[0], 24);
    pel_volume_destroy(volume);
}

static void test_sidecars_are_strict(void **state) {
    (void)state;
    static const struct {
        const char *text, *fragment;
    } cases[] = {
        {"{\"dims\": [3, 2, 2]", "bad.raw.json:1:18:"},
        {"{\"dims\": [3, 2, 2], \"type\": \"int16\", \"dims\": [1, 1, 1]}", "bad.raw.json:1:"},
        {"[]", "bad.raw.json: not a JSON object"},
        {"{\"type\": \"uint8\"}", "dims and type must be given"},
        {"{\"dims\": [3, 2], \"type\": \"uint8\"}", "dims: must be an array of 3"},
        {"{\"dims\": [3, 2.5, 2], \"type\": \"uint8\"}", "dims: element 1 is not an integer"},
        {"{\"dims\": [3, 2, 2], \"type\": \"int32\"}", "type: 'int32' is none of"},
        {"{\"dims\": [3, 2, 2], \"type\": \"uint8\", \"spaceing\": [1, 1, 1]}",
         "spaceing: unknown key"},
        {"{\"dims\": [3, 2, 2], \"type\": \"uint8\", \"spacing\": [1, 0, 1]}", "singular"},
        {"{\"dims\": [3, 2, 2], \"type\": \"uint8\", \"offset\": -1}", "offset: must be a count"},
        {"{\"dims\": [3, 2, 2], \"type\": \"uint8\", \"endian\": \"middle\"}",
         "endian: 'middle' is neither"},
        {"{\"dims\": [3, 2, 2], \"type\": \"uint8\", \"slope\": 0}", "slope of 0"},
        {"{\"dims\": [3, 2, 2], \"type\": \"uint8\", \"unit\": \"a unit that is too long\"}",
         "unit: must be a text"},
        {"{\"dims\": [3, 2, 2], \"type\": \"uint8\", \"origin\": [0, 0, 0], \"world_from_voxel\":"
         "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}",
         "stands in place of"},
        {"{\"dims\": [3, 2, 2], \"type\": \"uint8\", \"world_from_voxel\":"
         "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]}",
         "last row must be 0 0 0 1"},
        {"{\"dims\": [60000, 60000, 60000], \"type\": \"float32\"}",
         "need 864000000000000 bytes, the file has 24"},
    };
    test_write("bad.raw", bytes24, 24);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        test_write_text("bad.raw.json", cases[i].text);
        test_assert_load_fails(test_temporary_path("bad.raw"), NULL, PEL_ERROR_FORMAT,
                               cases[i].fragment);
    }
}

static void test_absent_voxels(void **state) {
    (void)state;
    struct test_bytes data = {0};
    test_put_float(&data, -INFINITY, 4, true);
    test_put_float(&data, 2.5, 4, true);
    struct pel_load_options options = {
        .raw = {.dims = {2, 1, 1}, .type = PEL_VOXEL_F32, .big_endian = true}};
    struct pel_volume *volume =
        pel_volume_load(test_write("inf.bin", data.bytes, data.count), &options);
    assert_non_null(volume);
    assert_true(isnan(((float *)volume->voxels)[0]) && ((float *)volume->voxels)[1] == 2.5f);
    pel_volume_destroy(volume);
    test_release(&data);
}

static void test_round_trip(void **state) {
    (void)state;
    for (int type = PEL_VOXEL_U8; type <= PEL_VOXEL_RGBA8; type++) {
        struct pel_volume *volume = test_small_volume((enum pel_voxel_type)type);
        volume->world_from_voxel.m[0][1] = 1.0 / 3;
        volume->slope = 0.1;
        volume->intercept = -1e-7;
        volume->labels = type == PEL_VOXEL_U8;
        strcpy(volume->unit, "mGy \"x\"");
        strcpy(volume->space, "sform (mni)");
        if (!pel_volume_save(volume, test_temporary_path("trip.raw")))
            fail_msg("%s", pel_error_message());
        struct pel_volume *again = pel_volume_load(test_temporary_path("trip.raw"), NULL);
        if (!again)
            fail_msg("%s", pel_error_message());
        test_assert_same_volume(again, volume, 0);
        assert_true(again->slope == volume->slope && again->intercept == volume->intercept);
        assert_string_equal(again->unit, volume->unit);
        assert_string_equal(again->space, volume->space);
        assert_int_equal(again->labels, volume->labels);
        pel_volume_destroy(again);
        pel_volume_destroy(volume);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_options),
        cmocka_unit_test(test_sidecars),
        cmocka_unit_test(test_sidecars_are_strict),
        cmocka_unit_test(test_absent_voxels),
        cmocka_unit_test(test_round_trip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
