// tiff.c - TIFF pages written here with libtiff and read back: every way pixels can lie in a file
// gives the same numbers; and what is written by pel_tiff_save comes back as it was.
#include "support/test.h"

#include <math.h>
#include <tiffio.h>

#include "support/tiff_recipe.h"
#include "volume/volume.h"

static int warning_count;

static void on_warning(const char *message, void *user) {
    (void)message, (void)user;
    warning_count++;
}

// ---- Number types and layouts ------------------------------------------------------------------

static void test_greys(void **state) {
    (void)state;
    const int u = SAMPLEFORMAT_UINT, i = SAMPLEFORMAT_INT, f = SAMPLEFORMAT_IEEEFP;
    const struct {
        struct tiff_recipe recipe;
        enum pel_voxel_type type;
        double scale;
    } cases[] = {
        {{.bits = 8}, PEL_VOXEL_U8, 1},
        {{.bits = 8, .format = i, .pages = 1}, PEL_VOXEL_I8, 1},
        {{.bits = 16, .pages = 3}, PEL_VOXEL_U16, 1},
        {{.bits = 16, .format = i, .pages = 3}, PEL_VOXEL_I16, 1},
        {{.bits = 16, .mode = "wb", .pages = 2}, PEL_VOXEL_U16, 1},
        {{.bits = 16, .mode = "w8", .pages = 2}, PEL_VOXEL_U16, 1},
        {{.bits = 16, .tile = 16, .width = 35, .height = 19}, PEL_VOXEL_U16, 1},
        {{.bits = 32, .format = f, .pages = 2}, PEL_VOXEL_F32, 0.25},
        {{.bits = 32, .format = f, .mode = "wb", .compression = COMPRESSION_LZW},
         PEL_VOXEL_F32,
         0.25},
        {{.bits = 64, .format = f, .pages = 2}, PEL_VOXEL_F32, 0.25},
        {{.bits = 12, .pages = 2}, PEL_VOXEL_U16, 1},
        {{.bits = 32, .format = u, .pages = 2}, PEL_VOXEL_I16, 1},
        {{.bits = 8, .compression = COMPRESSION_ADOBE_DEFLATE}, PEL_VOXEL_U8, 1},
        {{.bits = 8, .compression = COMPRESSION_PACKBITS, .pages = 2}, PEL_VOXEL_U8, 1},
        {{.bits = 16, .compression = COMPRESSION_ZSTD, .tile = 16}, PEL_VOXEL_U16, 1},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct pel_volume *volume =
            tiff_recipe_load(tiff_recipe_write("grey.tif", cases[c].recipe));
        assert_int_equal(volume->type, cases[c].type);
        assert_int_equal(volume->dims[2], cases[c].recipe.pages ? cases[c].recipe.pages : 1);
        for (int k = 0; k < volume->dims[2]; k++)
            for (int y = 0; y < volume->dims[1]; y++)
                for (int x = 0; x < volume->dims[0]; x++)
                    assert_float_equal(pel_volume_value(volume, x, y, k),
                                       cases[c].scale * tiff_recipe_value(x, y, k, 0), 0);
        pel_volume_destroy(volume);
    }
}

static void test_few_bits(void **state) {
    (void)state;
    // Value x + 10 y of a 4-bit page is stored modulo 16 and expanded by 17; white is 0 inverted.
    struct pel_volume *volume =
        tiff_recipe_load(tiff_recipe_write("four.tif", (struct tiff_recipe){.bits = 4}));
    assert_true(volume->type == PEL_VOXEL_U8 && pel_volume_value(volume, 3, 1, 0) == 13 * 17);
    pel_volume_destroy(volume);
    volume = tiff_recipe_load(tiff_recipe_write("one.tif", (struct tiff_recipe){.bits = 1}));
    assert_true(pel_volume_value(volume, 3, 0, 0) == 255 && pel_volume_value(volume, 4, 0, 0) == 0);
    pel_volume_destroy(volume);
    volume =
        tiff_recipe_load(tiff_recipe_write("white.tif", (struct tiff_recipe){.photometric = -1}));
    assert_true(pel_volume_value(volume, 3, 1, 0) == 255 - 13);
    pel_volume_destroy(volume);
    volume = tiff_recipe_load(
        tiff_recipe_write("white16.tif", (struct tiff_recipe){.photometric = -1, .bits = 16}));
    assert_true(pel_volume_value(volume, 3, 1, 0) == 65535 - 13);
    pel_volume_destroy(volume);
}

static void test_colours(void **state) {
    (void)state;
    const struct tiff_recipe recipes[] = {
        {.samples = 3},
        {.samples = 3, .planar = PLANARCONFIG_SEPARATE},
        {.samples = 3, .planar = PLANARCONFIG_SEPARATE, .tile = 16, .width = 20},
        {.samples = 3, .tile = 16, .compression = COMPRESSION_LZW},
    };
    for (size_t r = 0; r < sizeof recipes / sizeof *recipes; r++) {
        struct pel_volume *volume = tiff_recipe_load(tiff_recipe_write("rgb.tif", recipes[r]));
        assert_int_equal(volume->type, PEL_VOXEL_RGB8);
        const uint8_t *rgb = (uint8_t *)volume->voxels + 3 * (2 * volume->dims[0] + 5);
        assert_memory_equal(rgb, ((uint8_t[]){25, 28, 31}), 3);
        pel_volume_destroy(volume);
    }
    // 16-bit colours are scaled by 255/65535; one channel of them stays what it is.
    const char *path =
        tiff_recipe_write("rgb16.tif", (struct tiff_recipe){.samples = 3, .bits = 16});
    struct pel_volume *volume =
        pel_tiff_load(path, &(struct pel_load_options){.split_channels = true, .channel = 2});
    assert_true(volume->type == PEL_VOXEL_U16 && pel_volume_value(volume, 1, 2, 0) == 27);
    pel_volume_destroy(volume);
    assert_null(pel_tiff_load(path, &(struct pel_load_options){.channel = 1}));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
}

static void test_alpha(void **state) {
    (void)state;
    struct tiff_recipe recipe = {
        .samples = 4, .photometric = PHOTOMETRIC_RGB, .extra = EXTRASAMPLE_UNASSALPHA + 1};
    struct pel_volume *volume = tiff_recipe_load(tiff_recipe_write("rgba.tif", recipe));
    const uint8_t *rgba = (uint8_t *)volume->voxels + 4 * (2 * 7 + 5);
    assert_int_equal(volume->type, PEL_VOXEL_RGBA8);
    assert_memory_equal(rgba, ((uint8_t[]){25, 28, 31, 34}), 4);
    pel_volume_destroy(volume);
    // Premultiplied: 25 * 255 / 34 = 187.5, 28 * 255 / 34 = 210, 31 * 255 / 34 = 232.5.
    recipe.extra = EXTRASAMPLE_ASSOCALPHA + 1;
    volume = tiff_recipe_load(tiff_recipe_write("premultiplied.tif", recipe));
    rgba = (uint8_t *)volume->voxels + 4 * (2 * 7 + 5);
    assert_memory_equal(rgba, ((uint8_t[]){188, 210, 233, 34}), 4);
    pel_volume_destroy(volume);
    recipe.extra = EXTRASAMPLE_UNSPECIFIED + 1;
    volume = tiff_recipe_load(tiff_recipe_write("rgbx.tif", recipe));
    assert_int_equal(volume->type, PEL_VOXEL_RGB8);
    pel_volume_destroy(volume);
}

static void test_cmyk(void **state) {
    (void)state;
    struct tiff_recipe recipe = {.samples = 4, .photometric = PHOTOMETRIC_SEPARATED};
    for (int planar = PLANARCONFIG_CONTIG; planar <= PLANARCONFIG_SEPARATE; planar++) {
        recipe.planar = planar;
        struct pel_volume *volume = tiff_recipe_load(tiff_recipe_write("cmyk.tif", recipe));
        assert_int_equal(volume->type, PEL_VOXEL_RGB8);
        // Inks 25 28 31 and black 34: 230 * 221 / 255 = 199.3, 227 * 221 / 255 = 196.7,
        // 224 * 221 / 255 = 194.1.
        const uint8_t *rgb = (uint8_t *)volume->voxels + 3 * (2 * 7 + 5);
        assert_memory_equal(rgb, ((uint8_t[]){199, 197, 194}), 3);
        pel_volume_destroy(volume);
    }
}

static void test_channels(void **state) {
    (void)state;
    const char *path = tiff_recipe_write(
        "five.tif",
        (struct tiff_recipe){.samples = 5, .bits = 16, .photometric = PHOTOMETRIC_MINISBLACK});
    for (int channel = 0; channel < 5; channel++) {
        struct pel_volume *volume =
            pel_tiff_load(path, &(struct pel_load_options){.channel = channel});
        assert_non_null(volume);
        assert_true(pel_volume_value(volume, 6, 4, 0) == tiff_recipe_value(6, 4, 0, channel));
        pel_volume_destroy(volume);
    }
    assert_null(pel_tiff_load(path, &(struct pel_load_options){.channel = 5}));
}

static void write_palette(const char *path, bool grey, const char *description) {
    uint16_t maps[3][256];
    for (int i = 0; i < 256; i++) {
        maps[0][i] = (uint16_t)((255 - i) * 257);
        maps[1][i] = (uint16_t)(grey ? (255 - i) * 257 : i * 257);
        maps[2][i] = (uint16_t)(grey ? (255 - i) * 257 : 0);
    }
    TIFF *tiff = TIFFOpen(path, "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 4);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_PALETTE);
    TIFFSetField(tiff, TIFFTAG_COLORMAP, maps[0], maps[1], maps[2]);
    if (description)
        TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, description);
    TIFFWriteScanline(tiff, (uint8_t[]){0, 1, 200, 255}, 0, 0);
    TIFFClose(tiff);
}

static void test_palettes(void **state) {
    (void)state;
    const char *path = test_temporary_path("palette.tif");
    write_palette(path, true, NULL);
    struct pel_volume *volume = tiff_recipe_load(path);
    assert_int_equal(volume->type, PEL_VOXEL_U8);
    assert_memory_equal(volume->voxels, ((uint8_t[]){255, 254, 55, 0}), 4);
    pel_volume_destroy(volume);
    write_palette(path, false, NULL);
    volume = tiff_recipe_load(path);
    assert_int_equal(volume->type, PEL_VOXEL_RGB8);
    assert_memory_equal(volume->voxels, ((uint8_t[]){255, 0, 0, 254, 1, 0, 55, 200, 0, 0, 255, 0}),
                        12);
    pel_volume_destroy(volume);
    write_palette(path, false, "ImageJ=1.53c\n");
    volume = tiff_recipe_load(path);
    assert_int_equal(volume->type, PEL_VOXEL_U8);
    assert_memory_equal(volume->voxels, ((uint8_t[]){0, 1, 200, 255}), 4);
    pel_volume_destroy(volume);
}

static void test_orientations(void **state) {
    (void)state;
    // Where the stored pixel x = 6, y = 1 of 7 x 5 is to be seen.
    const int at[9][2] = {{0, 0}, {6, 1}, {0, 1}, {0, 3}, {6, 3}, {1, 6}, {3, 6}, {3, 0}, {1, 0}};
    for (int orientation = 1; orientation <= 8; orientation++) {
        struct pel_volume *volume = tiff_recipe_load(
            tiff_recipe_write("turned.tif", (struct tiff_recipe){.orientation = orientation}));
        assert_int_equal(volume->dims[0], orientation < 5 ? 7 : 5);
        assert_true(pel_volume_value(volume, at[orientation][0], at[orientation][1], 0) == 16);
        pel_volume_destroy(volume);
    }
}

// ---- Saving ------------------------------------------------------------------------------------

static void test_save(void **state) {
    (void)state;
    const char *path = test_temporary_path("saved.tif");
    for (int type = PEL_VOXEL_U8; type <= PEL_VOXEL_RGBA8; type++) {
        struct pel_volume *volume =
            pel_volume_create("saved", (int[]){33, 17, 5}, (enum pel_voxel_type)type);
        size_t bytes = pel_volume_bytes(volume);
        uint64_t seed = (uint64_t)type;
        for (size_t i = 0; i < bytes; i++)
            ((uint8_t *)volume->voxels)[i] = (uint8_t)(256 * test_random(&seed));
        if (type == PEL_VOXEL_F32)
            for (size_t i = 0; i < bytes / 4; i++)
                ((float *)volume->voxels)[i] = i % 7 ? (float)test_random(&seed) : NAN;
        volume->slope = 0.5, volume->intercept = -1024;
        strcpy(volume->unit, "HU");
        const double spacing[3] = {-0.7, -0.3, 1.3};
        for (int axis = 0; axis < 3; axis++)
            volume->world_from_voxel.m[axis][axis] = spacing[axis];
        warning_count = 0;
        assert_true(pel_tiff_save(volume, path));
        struct pel_volume *again = tiff_recipe_load(path);
        assert_int_equal(warning_count, 0);
        assert_int_equal(again->type, type);
        assert_memory_equal(again->voxels, volume->voxels, bytes);
        tiff_recipe_assert_spacing(again, 0.7, 0.3, 1.3);
        assert_true(again->slope == 0.5 && again->intercept == -1024);
        assert_string_equal(again->unit, "HU");
        pel_volume_destroy(again);
        pel_volume_destroy(volume);
    }
    struct pel_volume *volume = pel_volume_create("saved", (int[]){1, 1, 1}, PEL_VOXEL_U8);
    assert_false(pel_tiff_save(volume, test_temporary_path("no/such/folder.tif")));
    assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
    pel_volume_destroy(volume);
}

int main(void) {
    pel_on_warning(on_warning, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_greys),    cmocka_unit_test(test_few_bits),
        cmocka_unit_test(test_colours),  cmocka_unit_test(test_alpha),
        cmocka_unit_test(test_cmyk),     cmocka_unit_test(test_channels),
        cmocka_unit_test(test_palettes), cmocka_unit_test(test_orientations),
        cmocka_unit_test(test_save),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
