// metaimage.c - MetaImage headers with every way to name, place and pack the voxels.
#include "support/file.h"

#include <math.h>

static const unsigned char bytes24[24] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11,
                                          12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23};

static const char *write_file(const char *leaf, const char *header, const void *data,
                              size_t count) {
    struct test_bytes file = {0};
    test_put_text(&file, header);
    test_put(&file, data, count);
    const char *path = test_write(leaf, file.bytes, file.count);
    test_release(&file);
    return path;
}

static struct pel_volume *load_text(const char *leaf, const char *header, const void *data,
                                    size_t count) {
    struct pel_volume *volume = pel_volume_load(write_file(leaf, header, data, count), NULL);
    if (!volume)
        fail_msg("%s", pel_error_message());
    return volume;
}

static void test_placement(void **state) {
    (void)state;
    // Axis 0 runs to posterior, axis 1 to superior, axis 2 to left: LPS directions are the rows.
    static const char *const names[][2] = {
        {"TransformMatrix", "Offset"}, {"Rotation", "Position"}, {"Orientation", "Origin"}};
    for (int i = 0; i < 3; i++) {
        char header[512];
        snprintf(header, sizeof header,
                 "ObjectType = Image\nNDims = 3\nBinaryData = True\n%s = 0 1 0 0 0 1 1 0 0\n"
                 "%s = 10 20 30\nCenterOfRotation = 7 7 7\nAnatomicalOrientation = PSL\n"
                 "ElementSpacing = 2 3 4\nDimSize = 4 3 2\nElementType = MET_UCHAR\n"
                 "ElementDataFile = LOCAL\n",
                 names[i][0], names[i][1]);
        struct pel_volume *volume = load_text("place.mha", header, bytes24, 24);
        // In RAS left and posterior are negative.
        const double rows[3][4] = {{0, 0, -4, -10}, {-2, 0, 0, -20}, {0, 3, 0, 30}};
        test_assert_matrix(volume, rows, 1e-12);
        assert_memory_equal(volume->voxels, bytes24, 24);
        pel_volume_destroy(volume);
    }
}

static void test_oblique_and_left_handed(void **state) {
    (void)state;
    struct pel_volume *volume =
        load_text("oblique.mha",
                  "NDims = 3\nTransformMatrix = 0.8 0.6 0 -0.6 0.8 0 0 0 -1\nOffset = 1 2 3\n"
                  "ElementSpacing = 1 1 2.5\nDimSize = 4 3 2\nElementType = MET_CHAR\n"
                  "ElementDataFile = LOCAL\n",
                  bytes24, 24);
    const double rows[3][4] = {{-0.8, 0.6, 0, -1}, {-0.6, -0.8, 0, -2}, {0, 0, -2.5, 3}};
    test_assert_matrix(volume, rows, 1e-12);
    assert_int_equal(volume->type, PEL_VOXEL_I8);
    pel_volume_destroy(volume);
}

static void test_singular_transform_is_said(void **state) {
    test_watch_warnings(state);
    struct pel_volume *volume = load_text(
        "zeros.mha",
        "NDims = 3\nTransformMatrix = 0 0 0 0 0 0 0 0 0\nElementSize = 1 1 2\nDimSize = 4 3 2\n"
        "ElementType = MET_UCHAR\nDistanceUnits = cm\nElementDataFile = LOCAL\n",
        bytes24, 24);
    assert_non_null(strstr(test_warning(), "singular"));
    test_assert_matrix(volume, (const double[3][4]){{-10, 0, 0, 0}, {0, -10, 0, 0}, {0, 0, 20, 0}},
                       1e-12);
    pel_volume_destroy(volume);
}

static void test_byte_orders_and_rescale(void **state) {
    (void)state;
    static const char *const keys[] = {"ElementByteOrderMSB", "BinaryDataByteOrderMSB"};
    for (int big = 0; big < 2; big++) {
        struct test_bytes data = {0};
        for (int i = 0; i < 12; i++)
            test_put_integer(&data, 100 * i - 500, 2, big);
        char header[512];
        snprintf(header, sizeof header,
                 "NDims = 3\nDimSize = 3 2 2\nElementType = MET_SHORT\n%s = %s\n"
                 "ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -1024\n"
                 "ElementDataFile = LOCAL\n",
                 keys[big], big ? "True" : "False");
        struct pel_volume *volume = load_text("order.mha", header, data.bytes, data.count);
        assert_int_equal(volume->type, PEL_VOXEL_I16);
        for (int i = 0; i < 12; i++)
            assert_true(pel_volume_value(volume, i % 3, i / 3 % 2, i / 6) ==
                        2 * (100 * i - 500) - 1024);
        pel_volume_destroy(volume);
        test_release(&data);
    }
}

static void test_wide_and_float_types(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int bytes;
        bool real;
        enum pel_voxel_type type;
    } types[] = {
        {"MET_INT", 4, false, PEL_VOXEL_I16},        {"MET_UINT", 4, false, PEL_VOXEL_I16},
        {"MET_LONG", 4, false, PEL_VOXEL_I16},       {"MET_LONG_LONG", 8, false, PEL_VOXEL_I16},
        {"MET_ULONG_LONG", 8, false, PEL_VOXEL_I16}, {"MET_FLOAT", 4, true, PEL_VOXEL_F32},
        {"MET_DOUBLE", 8, true, PEL_VOXEL_F32},      {"MET_USHORT", 2, false, PEL_VOXEL_U16},
    };
    for (size_t t = 0; t < sizeof types / sizeof *types; t++) {
        struct test_bytes data = {0};
        for (int i = 0; i < 4; i++) {
            if (types[t].real)
                test_put_float(&data, 0.5 * i, types[t].bytes, false);
            else
                test_put_integer(&data, 300 * i, types[t].bytes, false);
        }
        char header[256];
        snprintf(header, sizeof header,
                 "NDims = 3\nDimSize = 2 2 1\nElementType = %s\nElementDataFile = LOCAL\n",
                 types[t].name);
        struct pel_volume *volume = load_text("type.mha", header, data.bytes, data.count);
        assert_int_equal(volume->type, types[t].type);
        assert_true(pel_volume_value(volume, 1, 1, 0) == (types[t].real ? 1.5 : 900));
        pel_volume_destroy(volume);
        test_release(&data);
    }
}

static void test_compressed_data(void **state) {
    (void)state;
    struct test_bytes packed = test_deflate(bytes24, 24, 15);
    char header[256];
    snprintf(header, sizeof header,
             "NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\nCompressedData = True\n"
             "CompressedDataSize = %zu\nElementDataFile = LOCAL\n",
             packed.count);
    struct pel_volume *volume = load_text("packed.mha", header, packed.bytes, packed.count);
    assert_memory_equal(volume->voxels, bytes24, 24);
    pel_volume_destroy(volume);
    // In a file of its own, without its size.
    test_write("packed.zraw", packed.bytes, packed.count);
    static const char detached[] =
        "NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\nCompressedData = True\n"
        "ElementDataFile = packed.zraw\n";
    volume = load_text("packed.mhd", detached, "", 0);
    assert_memory_equal(volume->voxels, bytes24, 24);
    pel_volume_destroy(volume);
    // Cut short, and with a claim that no such data could fulfil.
    test_write("packed.zraw", packed.bytes, packed.count - 8);
    test_assert_load_fails(test_temporary_path("packed.mhd"), NULL, PEL_ERROR_FORMAT,
                           "compressed data");
    test_assert_load_fails(
        write_file("bomb.mhd",
                   "NDims = 3\nDimSize = 4000 4000 400\nElementType = MET_UCHAR\n"
                   "CompressedData = True\nElementDataFile = packed.zraw\n",
                   "", 0),
        NULL, PEL_ERROR_FORMAT, "6400000000 bytes of voxels cannot come from");
    test_release(&packed);
}

static void test_data_files(void **state) {
    (void)state;
    struct test_bytes whole = {0};
    test_put_text(&whole, "HEAD");
    test_put(&whole, bytes24, 24);
    test_write("whole.raw", whole.bytes, whole.count);
    test_release(&whole);
    test_write("s1.raw", bytes24, 12);
    test_write("s3.raw", bytes24 + 12, 12);
    static const char *const fields[] = {
        "HeaderSize = 4\nElementDataFile = whole.raw\n",
        "HeaderSize = -1\nElementDataFile = whole.raw\n",
        "ElementDataFile = LIST\ns1.raw\ns3.raw\n",
        "ElementDataFile = LIST 2D\r\ns1.raw\r\ns3.raw\r\n",
        "ElementDataFile = s%d.raw 1 3 2\n",
    };
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        char header[256];
        snprintf(header, sizeof header, "NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\n%s",
                 fields[i]);
        struct pel_volume *volume = load_text("files.mhd", header, "", 0);
        assert_memory_equal(volume->voxels, bytes24, 24);
        pel_volume_destroy(volume);
    }
}

static void test_channels_and_time(void **state) {
    struct pel_volume *volume =
        load_text("rgb.mha",
                  "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR_ARRAY\n"
                  "ElementNumberOfChannels = 3\nElementDataFile = LOCAL\n",
                  bytes24, 24);
    assert_int_equal(volume->type, PEL_VOXEL_RGB8);
    assert_memory_equal(volume->voxels, bytes24, 24);
    pel_volume_destroy(volume);
    // Two channels of two time steps: voxels of step 1, channel 1.
    const char *path = write_file("many.mha",
                                  "NDims = 4\nDimSize = 3 2 1 2\nElementType = MET_UCHAR\n"
                                  "ElementNumberOfChannels = 2\nElementDataFile = LOCAL\n",
                                  bytes24, 24);
    struct pel_load_options options = {.time = 1, .channel = 1};
    test_watch_warnings(state);
    volume = pel_volume_load(path, &options);
    assert_non_null(volume);
    const unsigned char expected[] = {13, 15, 17, 19, 21, 23};
    assert_memory_equal(volume->voxels, expected, 6);
    assert_int_equal(test_warning_count(), 0);
    pel_volume_destroy(volume);
    options.channel = 2;
    test_assert_load_fails(path, &options, PEL_ERROR_ARGUMENT, "no channel 2, the file has 2");
}

static void test_claimed_channels(void **state) {
    test_watch_warnings(state);
    test_write("bear.raw", bytes24, 24);
    struct pel_volume *volume =
        load_text("bear.mhd",
                  "NDims = 3\nDimSize = 4 3 2\nHeaderSize = -1\nElementType = MET_UCHAR\n"
                  "ElementNumberOfChannels = 4\nElementDataFile = bear.raw\n",
                  "", 0);
    assert_int_equal(volume->type, PEL_VOXEL_U8);
    assert_memory_equal(volume->voxels, bytes24, 24);
    assert_int_equal(test_warning_count(), 1);
    pel_volume_destroy(volume);
}

static void assert_header_fails(const char *header, enum pel_error code, const char *fragment) {
    test_assert_load_fails(write_file("bad.mhd", header, "", 0), NULL, code, fragment);
}

static void test_errors(void **state) {
    (void)state;
    test_write("short.raw", bytes24, 23);
    assert_header_fails("NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\n"
                        "ElementDataFile = short.raw\n",
                        PEL_ERROR_FORMAT, "24 bytes of voxels are needed, it has 23");
    assert_header_fails("NDims = 3\nDimSize = 60000 60000 60000\nElementType = MET_DOUBLE\n"
                        "ElementDataFile = short.raw\n",
                        PEL_ERROR_FORMAT, "1728000000000000 bytes of voxels are needed");
    assert_header_fails("NDims = 3\nDimSize = 4 3\nElementType = MET_UCHAR\n"
                        "ElementDataFile = short.raw\n",
                        PEL_ERROR_FORMAT, "DimSize: 3 integers are needed");
    assert_header_fails("NDims = 11\n", PEL_ERROR_FORMAT, "NDims: 11 is outside 1..10");
    assert_header_fails("NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\n", PEL_ERROR_FORMAT,
                        "no ElementDataFile");
    assert_header_fails("NDims = 3\nDimSize = 4 3 2\nElementType = MET_COMPLEX\n",
                        PEL_ERROR_UNSUPPORTED, "ElementType: 'MET_COMPLEX'");
    assert_header_fails("ObjectType = Tube\n", PEL_ERROR_UNSUPPORTED, "'Tube' is not an image");
    assert_header_fails("NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\nBinaryData = False\n"
                        "ElementDataFile = short.raw\n",
                        PEL_ERROR_UNSUPPORTED, "written as text");
    assert_header_fails("NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\n"
                        "ElementDataFile = missing.raw\n",
                        PEL_ERROR_FILE, "No such file");
    assert_header_fails("NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\n"
                        "ElementDataFile = /dev/zero\n",
                        PEL_ERROR_FILE, "not a regular file");
    assert_header_fails("NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\n"
                        "ElementDataFile = %s%n.raw 1 2 1\n",
                        PEL_ERROR_FORMAT, "not a pattern");
    assert_header_fails("NDims = 3\nnonsense\n", PEL_ERROR_FORMAT, "'nonsense' is not Key = value");
}

static void test_round_trip(void **state) {
    (void)state;
    static const char *const leaves[] = {"trip.mha", "trip.mhd"};
    for (int type = PEL_VOXEL_U8; type <= PEL_VOXEL_RGBA8; type++) {
        for (int i = 0; i < 2; i++) {
            struct pel_volume *volume = test_small_volume((enum pel_voxel_type)type);
            volume->slope = type == PEL_VOXEL_U16 ? 0.1 : 1;
            volume->intercept = type == PEL_VOXEL_U16 ? -1024 : 0;
            if (!pel_volume_save(volume, test_temporary_path(leaves[i])))
                fail_msg("%s", pel_error_message());
            struct pel_volume *again = pel_volume_load(test_temporary_path(leaves[i]), NULL);
            if (!again)
                fail_msg("%s", pel_error_message());
            // Directions and spacing are kept apart and multiplied again.
            test_assert_same_volume(again, volume, 1e-14);
            assert_true(again->slope == volume->slope && again->intercept == volume->intercept);
            pel_volume_destroy(again);
            pel_volume_destroy(volume);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_placement),
        cmocka_unit_test(test_oblique_and_left_handed),
        cmocka_unit_test(test_singular_transform_is_said),
        cmocka_unit_test(test_byte_orders_and_rescale),
        cmocka_unit_test(test_wide_and_float_types),
        cmocka_unit_test(test_compressed_data),
        cmocka_unit_test(test_data_files),
        cmocka_unit_test(test_channels_and_time),
        cmocka_unit_test(test_claimed_channels),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_round_trip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
