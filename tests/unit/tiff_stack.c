// tiff_stack.c - TIFF stacks: spacing and order of pages out of resolution tags, ImageJ's
// description and OME-XML; folders of slices; files that lie.
#include "support/test.h"

#include <sys/stat.h>
#include <tiffio.h>
#include <unistd.h>

#include "support/tiff_recipe.h"
#include "volume/volume.h"

static int warning_count;

static void on_warning(const char *message, void *user) {
    (void)message, (void)user;
    warning_count++;
}

// ---- Stacks and metadata -----------------------------------------------------------------------

static void test_resolution(void **state) {
    (void)state;
    struct pel_volume *volume = tiff_recipe_load(tiff_recipe_write(
        "cm.tif",
        (struct tiff_recipe){.pages = 2, .unit = RESUNIT_CENTIMETER, .per_unit = {20, 40}}));
    tiff_recipe_assert_spacing(volume, 0.5, 0.25, 0.5);
    // x to the right is -x of RAS, y down is -y.
    assert_true(volume->world_from_voxel.m[0][0] < 0 && volume->world_from_voxel.m[1][1] < 0);
    assert_true(volume->world_from_voxel.m[2][2] > 0 && volume->world_from_voxel.m[0][3] == 0);
    pel_volume_destroy(volume);
    volume = tiff_recipe_load(tiff_recipe_write(
        "inch.tif", (struct tiff_recipe){.unit = RESUNIT_INCH, .per_unit = {254, 254}}));
    tiff_recipe_assert_spacing(volume, 0.1, 0.1, 0.1);
    pel_volume_destroy(volume);
    volume = tiff_recipe_load(tiff_recipe_write(
        "screen.tif", (struct tiff_recipe){.unit = RESUNIT_INCH, .per_unit = {72, 72}}));
    tiff_recipe_assert_spacing(volume, 1, 1, 1);
    pel_volume_destroy(volume);
    volume = tiff_recipe_load(tiff_recipe_write(
        "none.tif", (struct tiff_recipe){.unit = RESUNIT_NONE, .per_unit = {3, 3}}));
    tiff_recipe_assert_spacing(volume, 1, 1, 1);
    pel_volume_destroy(volume);
}

// Checks that plane z of a volume is page pages[z].
static void assert_pages(const char *path, struct pel_load_options options, int count,
                         const int pages[]) {
    struct pel_volume *volume = pel_tiff_load(path, &options);
    if (!volume)
        print_message("%s\n", pel_error_message());
    assert_non_null(volume);
    assert_int_equal(volume->dims[2], count);
    for (int z = 0; z < count; z++)
        assert_true(pel_volume_value(volume, 2, 1, z) == tiff_recipe_value(2, 1, pages[z], 0));
    pel_volume_destroy(volume);
}

static void test_imagej(void **state) {
    (void)state;
    const char *path = tiff_recipe_write(
        "hyperstack.tif",
        (struct tiff_recipe){.bits = 16,
                             .pages = 12,
                             .unit = RESUNIT_NONE,
                             .per_unit = {4, 5},
                             .description =
                                 "ImageJ=1.53c\nimages=12\nchannels=2\nslices=3\nframes=2\n"
                                 "hyperstack=true\nunit=micron\nspacing=2.5\n"
                                 "cf=0\nc0=-32768\nc1=0.5\nvunit=HU\n"});
    struct pel_load_options options = {.split_channels = true, .channel = 1, .time = 1};
    struct pel_volume *volume = pel_tiff_load(path, &options);
    assert_non_null(volume);
    assert_int_equal(volume->dims[2], 3);
    tiff_recipe_assert_spacing(volume, 0.25e-3, 0.2e-3, 2.5e-3);
    assert_string_equal(volume->unit, "HU");
    // Channel fastest: the pages of channel 1 at time 1 are 7, 9, 11.
    for (int z = 0; z < 3; z++)
        assert_true(pel_volume_value(volume, 1, 1, z) ==
                    0.5 * tiff_recipe_value(1, 1, 7 + 2 * z, 0) - 32768);
    pel_volume_destroy(volume);
    options.time = 2;
    assert_null(pel_tiff_load(path, &options));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
}

static void test_imagej_one_page(void **state) {
    (void)state;
    const char *path = test_temporary_path("large.tif");
    // Header and directory by hand, big endian: 8 bytes, 9 entries, planes.
    FILE *stream = fopen(path, "wb");
    const char description[] = "ImageJ=1.53c\nimages=3\nslices=3\nspacing=2\nunit=mm\n";
    const uint32_t entries[9][4] = {
        {256, 4, 1, 7},       {257, 4, 1, 5},       {258, 3, 1, 16 << 16},
        {259, 3, 1, 1 << 16}, {262, 3, 1, 1 << 16}, {270, 2, sizeof description, 200},
        {273, 4, 1, 300},     {277, 3, 1, 1 << 16}, {279, 4, 1, 70}};
    uint8_t head[300] = {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 9};
    for (int e = 0; e < 9; e++) {
        uint8_t *at = head + 10 + 12 * e;
        at[0] = (uint8_t)(entries[e][0] >> 8), at[1] = (uint8_t)entries[e][0];
        at[3] = (uint8_t)entries[e][1];
        for (int b = 0; b < 4; b++) {
            at[4 + b] = (uint8_t)(entries[e][2] >> (24 - 8 * b));
            at[8 + b] = (uint8_t)(entries[e][3] >> (24 - 8 * b));
        }
    }
    memcpy(head + 200, description, sizeof description);
    fwrite(head, 1, sizeof head, stream);
    for (int k = 0; k < 3; k++)
        for (int y = 0; y < 5; y++)
            for (int x = 0; x < 7; x++)
                fwrite((uint8_t[]){1, (uint8_t)tiff_recipe_value(x, y, k, 0)}, 1, 2, stream);
    fclose(stream);
    struct pel_volume *volume = tiff_recipe_load(path);
    assert_int_equal(volume->dims[2], 3);
    tiff_recipe_assert_spacing(volume, 1, 1, 2);
    for (int k = 0; k < 3; k++)
        assert_true(pel_volume_value(volume, 6, 4, k) == 256 + tiff_recipe_value(6, 4, k, 0));
    pel_volume_destroy(volume);
    // Cut short by a byte it is refused.
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(truncate(path, status.st_size - 1), 0);
    assert_null(pel_tiff_load(path, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
}

static const char *write_ome(const char *leaf, const char *pixels, const char *children) {
    static char xml[2048];
    snprintf(
        xml, sizeof xml,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><OME xmlns=\"x\" UUID=\"urn:uuid:1\"><Image "
        "ID=\"Image:0\"><Pixels ID=\"P\" SizeX=\"7\" SizeY=\"5\" Type=\"uint16\" %s>%s</Pixels>"
        "</Image><Image><Pixels SizeZ=\"99\" SizeC=\"1\" SizeT=\"1\"/></Image></OME>",
        pixels, children);
    return tiff_recipe_write(leaf,
                             (struct tiff_recipe){.bits = 16, .pages = 12, .description = xml});
}

static void test_ome_orders(void **state) {
    (void)state;
    const struct pel_load_options one = {.split_channels = true, .channel = 1, .time = 1};
    const char *sizes = "SizeZ=\"3\" SizeC=\"2\" SizeT=\"2\" DimensionOrder=\"%s\"";
    const struct {
        const char *order;
        int pages[3];
    } orders[] = {{"XYZCT", {9, 10, 11}}, {"XYZTC", {9, 10, 11}}, {"XYCZT", {7, 9, 11}},
                  {"XYTZC", {7, 9, 11}},  {"XYCTZ", {3, 7, 11}},  {"XYTCZ", {3, 7, 11}}};
    for (int i = 0; i < 6; i++) {
        char pixels[256];
        snprintf(pixels, sizeof pixels, sizes, orders[i].order);
        assert_pages(write_ome("order.ome.tif", pixels, "<TiffData/>"), one, 3, orders[i].pages);
        assert_pages(write_ome("order.ome.tif", pixels, ""), one, 3, orders[i].pages);
    }
    // XYCZT and XYTZC differ where channel and time do.
    char pixels[256];
    snprintf(pixels, sizeof pixels, sizes, "XYTZC");
    assert_pages(write_ome("order.ome.tif", pixels, ""),
                 (struct pel_load_options){.split_channels = true, .channel = 1}, 3,
                 (int[]){6, 8, 10});
}

static void test_ome_planes(void **state) {
    (void)state;
    const char *pixels = "SizeZ=\"2\" SizeC=\"1\" SizeT=\"1\" DimensionOrder=\"XYZCT\"";
    assert_pages(
        write_ome("planes.ome.tif", pixels,
                  "<TiffData IFD=\"7\" FirstZ=\"1\" PlaneCount=\"1\"/><TiffData IFD=\"3\"/>"),
        (struct pel_load_options){0}, 2, (int[]){3, 7});
    assert_pages(write_ome("planes.ome.tif", pixels, "<TiffData IFD=\"4\" PlaneCount=\"2\"/>"),
                 (struct pel_load_options){0}, 2, (int[]){4, 5});
    assert_null(pel_tiff_load(write_ome("planes.ome.tif", pixels, "<TiffData IFD=\"4\"/>"), NULL));
    assert_non_null(strstr(pel_error_message(), "no page holds slice 1"));
    assert_null(pel_tiff_load(
        write_ome(
            "planes.ome.tif", pixels,
            "<TiffData PlaneCount=\"2\"><UUID FileName=\"b.tif\">urn:uuid:2</UUID></TiffData>"),
        NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_UNSUPPORTED);
}

static void test_ome_spacing(void **state) {
    (void)state;
    struct pel_volume *volume = tiff_recipe_load(write_ome(
        "spacing.ome.tif",
        "SizeZ=\"2\" SizeC=\"1\" SizeT=\"1\" DimensionOrder=\"XYZCT\" PhysicalSizeX=\"0.5\" "
        "PhysicalSizeY=\"250\" PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"2\" "
        "PhysicalSizeZUnit=\"\302\265m\"",
        "<TiffData PlaneCount=\"2\" IFD=\"0\"/>"));
    tiff_recipe_assert_spacing(volume, 0.5e-3, 0.25e-3, 2e-3);
    pel_volume_destroy(volume);
}

static void test_folder(void **state) {
    (void)state;
    const char *folder = test_temporary_path("slices");
    assert_int_equal(mkdir(folder, 0700), 0);
    const char *names[] = {"slices/slice1.tif", "slices/slice2.tif", "slices/slice10.TIF",
                           "slices/slice011.tif"};
    for (int i = 0; i < 4; i++)
        tiff_recipe_write(
            names[i], (struct tiff_recipe){.width = 4, .height = 1, .orientation = i == 2 ? 2 : 1});
    fclose(fopen(test_temporary_path("slices/._slice1.tif"), "w"));
    fclose(fopen(test_temporary_path("slices/notes.txt"), "w"));
    for (int way = 0; way < 2; way++) {
        struct pel_volume *volume =
            tiff_recipe_load(test_temporary_path(way ? "slices/slice*" : "slices"));
        assert_int_equal(volume->dims[2], 4);
        // Only slice10 is mirrored, and it is the third.
        for (int z = 0; z < 4; z++)
            assert_true(pel_volume_value(volume, 0, 0, z) == (z == 2 ? 3 : 0));
        pel_volume_destroy(volume);
    }
    tiff_recipe_write("slices/slice3.tif", (struct tiff_recipe){.width = 5, .height = 1});
    assert_null(pel_tiff_load(test_temporary_path("slices"), NULL));
    assert_non_null(strstr(pel_error_message(), "slice3.tif"));
    assert_null(pel_tiff_load(test_temporary_path("slices/none*.tif"), NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
}

// Each file of an OME set tells of the whole set; in a folder each is a slice, and the placement
// still holds.
static void test_folder_of_ome(void **state) {
    (void)state;
    assert_int_equal(mkdir(test_temporary_path("set"), 0700), 0);
    const char *names[] = {"set/a_z0.ome.tif", "set/a_z1.ome.tif", "set/a_z2.ome.tif"};
    for (int i = 0; i < 3; i++)
        tiff_recipe_write(
            names[i], (struct tiff_recipe){
                          .description = "<OME><Image><Pixels SizeZ=\"3\" SizeC=\"1\" SizeT=\"1\" "
                                         "DimensionOrder=\"XYZCT\" PhysicalSizeX=\"2\" "
                                         "PhysicalSizeZ=\"5\"/></Image></OME>"});
    struct pel_volume *volume = tiff_recipe_load(test_temporary_path("set"));
    assert_int_equal(volume->dims[2], 3);
    tiff_recipe_assert_spacing(volume, 2e-3, 2e-3, 5e-3);
    pel_volume_destroy(volume);
}

// ---- Broken files ------------------------------------------------------------------------------

static void add_page(TIFF *tiff, int width, int subfile) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_SUBFILETYPE, subfile);
    TIFFWriteScanline(tiff, (uint8_t[16]){0}, 0, 0);
    TIFFWriteDirectory(tiff);
}

static void test_unlike_pages(void **state) {
    (void)state;
    const char *path = test_temporary_path("unlike.tif");
    TIFF *tiff = TIFFOpen(path, "w");
    add_page(tiff, 8, 0);
    add_page(tiff, 4, FILETYPE_REDUCEDIMAGE);
    add_page(tiff, 8, 0);
    TIFFClose(tiff);
    struct pel_volume *volume = tiff_recipe_load(path);
    assert_int_equal(volume->dims[2], 2);
    pel_volume_destroy(volume);
    tiff = TIFFOpen(path, "a");
    add_page(tiff, 9, 0);
    TIFFClose(tiff);
    assert_null(pel_tiff_load(path, NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
    assert_non_null(strstr(pel_error_message(), "page 2: 9 x 1 pixels, the first page has 8 x 1"));
}

// A directory that claims 60000 x 60000 pixels, and one whose next directory is itself.
static void test_lies(void **state) {
    (void)state;
    const char *path = test_temporary_path("lie.tif");
    for (int loop = 0; loop < 2; loop++) {
        uint8_t side = loop ? 2 : 0;
        uint8_t file[] = {'I', 'I', 42,   0,
                          8,   0,   0,    0,
                          7,   0,   0,    1,
                          3,   0,   1,    0,
                          0,   0,   side, loop ? 0 : 0xea,
                          0,   0,   1,    1,
                          3,   0,   1,    0,
                          0,   0,   side, loop ? 0 : 0xea,
                          0,   0,   2,    1,
                          3,   0,   1,    0,
                          0,   0,   8,    0,
                          0,   0,   3,    1,
                          3,   0,   1,    0,
                          0,   0,   1,    0,
                          0,   0,   6,    1,
                          3,   0,   1,    0,
                          0,   0,   1,    0,
                          0,   0,   17,   1,
                          4,   0,   1,    0,
                          0,   0,   8,    0,
                          0,   0,   23,   1,
                          4,   0,   1,    0,
                          0,   0,   4,    0,
                          0,   0,   8,    0,
                          0,   0};
        if (!loop)
            memset(file + sizeof file - 4, 0, 4);
        FILE *stream = fopen(path, "wb");
        fwrite(file, 1, sizeof file, stream);
        fclose(stream);
        warning_count = 0;
        struct pel_volume *volume = pel_tiff_load(path, NULL);
        if (loop) {
            assert_non_null(volume);
            assert_int_equal(volume->dims[2], 1);
            assert_int_equal(warning_count, 1);
            pel_volume_destroy(volume);
        } else {
            assert_null(volume);
            assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
        }
    }
    assert_null(pel_tiff_load(test_temporary_path("missing.tif"), NULL));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
}

int main(void) {
    pel_on_warning(on_warning, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_resolution),      cmocka_unit_test(test_imagej),
        cmocka_unit_test(test_imagej_one_page), cmocka_unit_test(test_ome_orders),
        cmocka_unit_test(test_ome_planes),      cmocka_unit_test(test_ome_spacing),
        cmocka_unit_test(test_folder),          cmocka_unit_test(test_folder_of_ome),
        cmocka_unit_test(test_unlike_pages),    cmocka_unit_test(test_lies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
