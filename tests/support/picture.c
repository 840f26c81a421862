// picture.c - comparing pictures, pixel by pixel.
#include "support/picture.h"

#include <math.h>

#include <png.h>

#include "support/test.h"

static const float *pixel_at(const struct pel_image *image, int x, int y) {
    return image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

// The greatest difference of a channel. What is not finite differs from everything.
static double pixel_difference_255(const float a[4], const float b[4]) {
    double greatest = 0;
    for (int c = 0; c < 4; c++) {
        double difference = isfinite(a[c]) && isfinite(b[c]) ? fabs((double)a[c] - b[c]) : INFINITY;
        greatest = fmax(greatest, 255 * difference);
    }
    return greatest;
}

static void print_pixel(const char *label, const float rgba[4]) {
    print_error("  %-8s %10.4f %10.4f %10.4f %10.4f (of 255)\n", label, 255 * rgba[0],
                255 * rgba[1], 255 * rgba[2], 255 * rgba[3]);
}

static void report(const struct pel_image *actual, const struct pel_image *expected,
                   const struct picture_difference *difference, const char *title) {
    print_error("%s: worst pixel (%d, %d) of %dx%d is off by %.4f of 255, %d pixels beyond, "
                "%.1f dB\n",
                title, difference->x, difference->y, actual->width, actual->height,
                difference->greatest, difference->beyond_count, difference->psnr_db);
    print_pixel("actual", pixel_at(actual, difference->x, difference->y));
    print_pixel("expected", pixel_at(expected, difference->x, difference->y));

    const char *folder = getenv("PELLUCID_TEST_KEEP");
    if (folder) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s.png", folder, title);
        if (picture_write_difference(path, actual, expected, 16))
            print_error("  the difference, 16-fold, is in %s\n", path);
    }
}

struct picture_difference picture_compare(const struct pel_image *a, const struct pel_image *b,
                                          double bound_255) {
    struct picture_difference result = {0};
    double squares = 0;
    for (int y = 0; y < a->height; y++) {
        for (int x = 0; x < a->width; x++) {
            const float *pa = pixel_at(a, x, y), *pb = pixel_at(b, x, y);
            double difference = pixel_difference_255(pa, pb);
            if (difference > result.greatest) {
                result.greatest = difference;
                result.x = x, result.y = y;
            }
            result.beyond_count += difference > bound_255;
            for (int c = 0; c < 4; c++)
                squares += ((double)pa[c] - pb[c]) * ((double)pa[c] - pb[c]);
        }
    }
    result.psnr_db = -10 * log10(squares / (4.0 * a->width * a->height));
    return result;
}

struct pel_image *picture_read_png(const char *path) {
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&png, path))
        fail_msg("%s: %s", path, png.message);
    png.format = PNG_FORMAT_RGBA;
    uint8_t *bytes = malloc(PNG_IMAGE_SIZE(png));
    struct pel_image *image = pel_image_create((int)png.width, (int)png.height);
    if (!bytes || !image || !png_image_finish_read(&png, NULL, bytes, 0, NULL))
        fail_msg("%s: %s", path, png.message);
    for (size_t i = 0; i < PNG_IMAGE_SIZE(png); i++)
        image->rgba[i] = (float)bytes[i] / 255;
    free(bytes);
    return image;
}

bool picture_write_difference(const char *path, const struct pel_image *a,
                              const struct pel_image *b, double gain) {
    png_image png = {.version = PNG_IMAGE_VERSION,
                     .width = (png_uint_32)a->width,
                     .height = (png_uint_32)a->height,
                     .format = PNG_FORMAT_RGB};
    uint8_t *bytes = malloc(PNG_IMAGE_SIZE(png)), *byte = bytes;
    if (!bytes)
        return false;
    for (int y = 0; y < a->height; y++)
        for (int x = 0; x < a->width; x++)
            for (int c = 0; c < 3; c++) {
                double difference = (double)pixel_at(a, x, y)[c] - pixel_at(b, x, y)[c];
                *byte++ = (uint8_t)fmin(255, 255 * gain * fabs(difference));
            }
    bool written = png_image_write_to_file(&png, path, 0, bytes, 0, NULL);
    free(bytes);
    return written;
}

void picture_assert_within(const struct pel_image *actual, const struct pel_image *expected,
                           double bound_255, int allowed_beyond, const char *title,
                           const char *file, int line) {
    if (!actual) {
        print_error("%s: no picture: %s\n", title, pel_error_message());
        _fail(file, line);
    }
    assert_int_equal(actual->width, expected->width);
    assert_int_equal(actual->height, expected->height);
    struct picture_difference difference = picture_compare(actual, expected, bound_255);
    if (difference.beyond_count > allowed_beyond) {
        report(actual, expected, &difference, title);
        _fail(file, line);
    }
}

void picture_assert_equal(const struct pel_image *actual, const struct pel_image *expected,
                          const char *title, const char *file, int line) {
    picture_assert_within(actual, expected, 0, 0, title, file, line);
}
