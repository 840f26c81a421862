// image.c - a picture in memory, and which file format its path asks for.
//
// Four floats a pixel: red, green and blue multiplied by alpha, then alpha; rows from the top,
// without padding.
#include "output/image.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

unsigned pel_image_quantise(double value, unsigned max) {
    // The comparison is false for NaN.
    if (!(value > 0))
        return 0;
    return value >= 1 ? max : (unsigned)(value * max + 0.5);
}

struct pel_image *pel_image_create_undefined(int width, int height) {
    if (width < 1 || height < 1) {
        pel_fail(PEL_ERROR_ARGUMENT, "a picture of %d x %d pixels", width, height);
        return NULL;
    }
    size_t bytes;
    if (!pel_size_multiply(&bytes, 3, (size_t[]){(size_t)width, (size_t)height, 4 * sizeof(float)}))
        return NULL;
    struct pel_image *image = pel_allocate(1, sizeof *image);
    if (!image)
        return NULL;
    *image = (struct pel_image){width, height, pel_allocate_voxels(bytes)};
    if (!image->rgba) {
        pel_image_destroy(image);
        return NULL;
    }
    return image;
}

struct pel_image *pel_image_create(int width, int height) {
    struct pel_image *image = pel_image_create_undefined(width, height);
    if (image)
        memset(image->rgba, 0, (size_t)width * (size_t)height * 4 * sizeof *image->rgba);
    return image;
}

void pel_image_destroy(struct pel_image *image) {
    if (!image)
        return;
    free(image->rgba);
    free(image);
}

enum image_format { FORMAT_UNKNOWN, FORMAT_PNG, FORMAT_TIFF, FORMAT_PPM };

static enum image_format format_of(const char *path) {
    if (strcmp(path, "-") == 0 || pel_path_has_extension(path, ".ppm"))
        return FORMAT_PPM;
    if (pel_path_has_extension(path, ".png"))
        return FORMAT_PNG;
    if (pel_path_has_extension(path, ".tif") || pel_path_has_extension(path, ".tiff"))
        return FORMAT_TIFF;
    pel_fail(PEL_ERROR_ARGUMENT,
             "%s: a picture's name ends in .png, .tif, .tiff or .ppm, or is - for PPM on the "
             "standard output",
             path);
    return FORMAT_UNKNOWN;
}

bool pel_image_check_path(const char *path) {
    if (format_of(path) == FORMAT_UNKNOWN)
        return false;
    if (strcmp(path, "-") == 0)
        return true;
    char *folder = pel_path_beside(path, ".");
    if (!folder)
        return false;
    bool good = access(folder, W_OK | X_OK) == 0;
    if (!good)
        pel_fail(PEL_ERROR_FILE, "%s: cannot write: %s", path, strerror(errno));
    free(folder);
    return good;
}

bool pel_image_save(const struct pel_image *image, const char *path,
                    const struct pel_image_options *options) {
    struct pel_image_options chosen = options ? *options : (struct pel_image_options){0};
    if (chosen.depth == 0)
        chosen.depth = 8;
    if (chosen.depth != 8 && chosen.depth != 16)
        return pel_fail(PEL_ERROR_ARGUMENT, "a depth of %d bits: PNG has 8 or 16", chosen.depth);
    switch (format_of(path)) {
    case FORMAT_PNG:
        return pel_png_save(image, path, &chosen);
    case FORMAT_TIFF:
        return pel_tiff_image_save(image, path);
    case FORMAT_PPM:
        return pel_ppm_save(image, path);
    default:
        return false;
    }
}
