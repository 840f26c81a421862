// image.c - pictures written as PNG, TIFF and PPM, read back with libpng, libtiff and fscanf.
#include "support/test.h"

#include <math.h>
#include <png.h>
#include <sys/stat.h>
#include <tiffio.h>
#include <unistd.h>

// Four pixels with the hard cases: empty, opaque, half transparent, and out of range.
static const float pixels[4][4] = {
    {0, 0, 0, 0},
    {1, 0.5f, 0.25f, 1},
    {0.25f, 0.5f, 0.125f, 0.5f},
    {NAN, -1, 7, 2},
};

static struct pel_image *make_image(void) {
    struct pel_image *image = pel_image_create(2, 2);
    assert_non_null(image);
    memcpy(image->rgba, pixels, sizeof pixels);
    return image;
}

struct png_file {
    int width, height, depth, colour_type, text_count;
    unsigned samples[16];
    png_textp texts;
    png_structp png;
    png_infop info;
};

static struct png_file read_png(const char *path) {
    struct png_file file = {0};
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    file.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    file.info = png_create_info_struct(file.png);
    png_init_io(file.png, stream);
    png_read_png(file.png, file.info, PNG_TRANSFORM_IDENTITY, NULL);
    fclose(stream);
    file.width = (int)png_get_image_width(file.png, file.info);
    file.height = (int)png_get_image_height(file.png, file.info);
    file.depth = png_get_bit_depth(file.png, file.info);
    file.colour_type = png_get_color_type(file.png, file.info);
    assert_int_equal(file.width * file.height, 4);
    png_bytepp rows = png_get_rows(file.png, file.info);
    for (int i = 0; i < 16; i++) {
        const png_byte *row = rows[i / (4 * file.width)];
        int sample = i % (4 * file.width);
        file.samples[i] =
            file.depth == 16 ? row[2 * sample] * 256u + row[2 * sample + 1] : row[sample];
    }
    png_get_text(file.png, file.info, &file.texts, &file.text_count);
    return file;
}

static void close_png(struct png_file *file) {
    png_destroy_read_struct(&file->png, &file->info, NULL);
}

static void check_png(const struct pel_image_options *options, const unsigned expected[16]) {
    struct pel_image *image = make_image();
    const char *path = test_temporary_path("check.png");
    assert_true(pel_image_save(image, path, options));
    struct png_file file = read_png(path);
    assert_int_equal(file.width, 2);
    assert_int_equal(file.depth, options && options->depth ? options->depth : 8);
    assert_int_equal(file.colour_type, PNG_COLOR_TYPE_RGB_ALPHA);
    for (int i = 0; i < 16; i++)
        assert_int_equal(file.samples[i], expected[i]);
    close_png(&file);
    pel_image_destroy(image);
}

// 0.5 * 255 = 127.5 and 0.25 * 255 = 63.75 round to 128 and 64; 7 / 2 clamps.
static void png_is_straight_by_default(void **state) {
    (void)state;
    check_png(NULL,
              (unsigned[16]){0, 0, 0, 0, 255, 128, 64, 255, 128, 255, 64, 128, 0, 0, 255, 255});
}

static void png_premultiplied_is_what_was_computed(void **state) {
    (void)state;
    check_png(&(struct pel_image_options){.premultiplied = true},
              (unsigned[16]){0, 0, 0, 0, 255, 128, 64, 255, 64, 128, 32, 128, 0, 0, 255, 255});
}

// 0.5 * 65535 = 32767.5, 0.25 * 65535 = 16383.75.
static void png_has_16_bits(void **state) {
    (void)state;
    check_png(&(struct pel_image_options){.depth = 16},
              (unsigned[16]){0, 0, 0, 0, 65535, 32768, 16384, 65535, 32768, 65535, 16384, 32768, 0,
                             0, 65535, 65535});
}

static void png_carries_texts(void **state) {
    (void)state;
    char long_text[5001];
    memset(long_text, 'x', 5000);
    long_text[5000] = '\0';
    const char *const texts[][2] = {
        {"Software", "Pellucid"}, {"scene", long_text}, {"device", "caf\xc3\xa9"}};
    struct pel_image *image = make_image();
    const char *path = test_temporary_path("texts.png");
    struct pel_image_options options = {.texts = texts, .text_count = 3};
    assert_true(pel_image_save(image, path, &options));
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    assert_true(status.st_size < 1000);
    struct png_file file = read_png(path);
    assert_int_equal(file.text_count, 3);
    for (int i = 0; i < 3; i++) {
        assert_string_equal(file.texts[i].key, texts[i][0]);
        assert_string_equal(file.texts[i].text, texts[i][1]);
    }
    assert_int_equal(file.texts[0].compression, PNG_TEXT_COMPRESSION_NONE);
    assert_int_equal(file.texts[1].compression, PNG_TEXT_COMPRESSION_zTXt);
    assert_int_equal(file.texts[2].compression, PNG_ITXT_COMPRESSION_NONE);
    close_png(&file);
    pel_image_destroy(image);
}

static void tiff_keeps_every_float(void **state) {
    (void)state;
    struct pel_image *image = make_image();
    const char *path = test_temporary_path("check.tiff");
    assert_true(pel_image_save(image, path, NULL));
    TIFF *tiff = TIFFOpen(path, "r");
    assert_non_null(tiff);
    uint32_t width, height;
    uint16_t bits, format, samples, extra_count, *extra;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetField(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetField(tiff, TIFFTAG_SAMPLEFORMAT, &format);
    TIFFGetField(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
    TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extra);
    assert_int_equal(width, 2);
    assert_int_equal(height, 2);
    assert_int_equal(bits, 32);
    assert_int_equal(format, SAMPLEFORMAT_IEEEFP);
    assert_int_equal(samples, 4);
    assert_int_equal(extra_count, 1);
    assert_int_equal(extra[0], EXTRASAMPLE_ASSOCALPHA);
    for (uint32_t y = 0; y < 2; y++) {
        float row[8];
        assert_int_equal(TIFFReadScanline(tiff, row, y, 0), 1);
        assert_memory_equal(row, pixels[2 * y], sizeof row);
    }
    TIFFClose(tiff);
    pel_image_destroy(image);
}

static void ppm_is_over_black(void **state) {
    (void)state;
    struct pel_image *image = make_image();
    const char *path = test_temporary_path("check.PPM");
    assert_true(pel_image_save(image, path, NULL));
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    int width, height, max;
    assert_int_equal(fscanf(stream, "P6 %d %d %d", &width, &height, &max), 3);
    assert_int_equal(fgetc(stream), '\n');
    unsigned char rgb[13];
    assert_int_equal(fread(rgb, 1, 13, stream), 12);
    assert_memory_equal(rgb, ((unsigned char[]){0, 0, 0, 255, 128, 64, 64, 128, 32, 0, 0, 255}),
                        12);
    assert_int_equal(width, 2);
    assert_int_equal(height, 2);
    assert_int_equal(max, 255);
    fclose(stream);
    pel_image_destroy(image);
}

static size_t read_bytes(const char *path, char *bytes, size_t limit) {
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    size_t count = fread(bytes, 1, limit, stream);
    fclose(stream);
    return count;
}

static void saving_twice_gives_same_bytes(void **state) {
    (void)state;
    struct pel_image *image = make_image();
    for (int i = 0; i < 3; i++) {
        const char *extension = (const char *[]){"png", "tif", "ppm"}[i];
        char leaf[2][16], bytes[2][4096];
        size_t counts[2];
        for (int k = 0; k < 2; k++) {
            snprintf(leaf[k], sizeof leaf[k], "same%d.%s", k, extension);
            const char *path = test_temporary_path(leaf[k]);
            assert_true(pel_image_save(image, path, NULL));
            counts[k] = read_bytes(path, bytes[k], sizeof bytes[k]);
        }
        assert_int_equal(counts[0], counts[1]);
        assert_memory_equal(bytes[0], bytes[1], counts[0]);
    }
    assert_memory_equal(image->rgba, pixels, sizeof pixels);
    pel_image_destroy(image);
}

static void assert_fails(bool result, enum pel_error code, const char *part) {
    assert_false(result);
    assert_int_equal(pel_error_code(), code);
    if (!strstr(pel_error_message(), part))
        fail_msg("'%s' is not in '%s'", part, pel_error_message());
}

static void what_cannot_be_saved_is_said(void **state) {
    (void)state;
    struct pel_image *image = make_image();
    assert_fails(pel_image_save(image, "a.jpg", NULL), PEL_ERROR_ARGUMENT, ".png, .tif");
    assert_fails(pel_image_save(image, "a.png", &(struct pel_image_options){.depth = 12}),
                 PEL_ERROR_ARGUMENT, "12 bits");
    for (int i = 0; i < 3; i++)
        assert_fails(pel_image_save(
                         image,
                         (const char *[]){"/nowhere/a.png", "/nowhere/a.tif", "/nowhere/a.ppm"}[i],
                         NULL),
                     PEL_ERROR_FILE, "/nowhere/a.");
    pel_image_destroy(image);
}

static void a_path_is_checked_before_the_work(void **state) {
    (void)state;
    assert_true(pel_image_check_path("-"));
    assert_true(pel_image_check_path("picture.PNG"));
    assert_true(pel_image_check_path(test_temporary_path("a.tiff")));
    assert_fails(pel_image_check_path("a.jpg"), PEL_ERROR_ARGUMENT, ".png, .tif");
    assert_fails(pel_image_check_path("/nowhere/a.png"), PEL_ERROR_FILE, "/nowhere/a.png");
}

// libpng refuses pictures wider than a million pixels: a failure after the file has been opened.
static void failure_keeps_the_old_file(void **state) {
    (void)state;
    const char *path = test_temporary_path("old.png");
    struct pel_image *image = make_image();
    assert_true(pel_image_save(image, path, NULL));
    char before[4096], after[4096];
    size_t count = read_bytes(path, before, sizeof before);
    pel_image_destroy(image);
    image = pel_image_create(1000001, 1);
    assert_non_null(image);
    assert_fails(pel_image_save(image, path, NULL), PEL_ERROR_FILE, "old.png: PNG: ");
    assert_int_equal(read_bytes(path, after, sizeof after), count);
    assert_memory_equal(before, after, count);
    pel_image_destroy(image);
}

static void impossible_sizes_are_refused(void **state) {
    (void)state;
    assert_null(pel_image_create(0, 5));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_null(pel_image_create(5, -1));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_null(pel_image_create(INT32_MAX, INT32_MAX));
    assert_int_equal(pel_error_code(), PEL_ERROR_MEMORY);
    pel_image_destroy(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_is_straight_by_default),
        cmocka_unit_test(png_premultiplied_is_what_was_computed),
        cmocka_unit_test(png_has_16_bits),
        cmocka_unit_test(png_carries_texts),
        cmocka_unit_test(tiff_keeps_every_float),
        cmocka_unit_test(ppm_is_over_black),
        cmocka_unit_test(saving_twice_gives_same_bytes),
        cmocka_unit_test(what_cannot_be_saved_is_said),
        cmocka_unit_test(a_path_is_checked_before_the_work),
        cmocka_unit_test(failure_keeps_the_old_file),
        cmocka_unit_test(impossible_sizes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
