// tiff_image.c - writes a picture as computed: TIFF with four 32-bit floats a pixel, associated
// (premultiplied) alpha, deflate with the floating-point predictor of Adobe's TIFF Technical
// Note 3.
#include "output/image.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tiffio.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

static int on_error(TIFF *tiff, void *user, const char *module, const char *format,
                    va_list arguments) {
    (void)tiff, (void)user, (void)module;
    char message[512];
    vsnprintf(message, sizeof message, format, arguments);
    pel_fail(PEL_ERROR_FILE, "TIFF: %s", message);
    return 1;
}

static int on_warning(TIFF *tiff, void *user, const char *module, const char *format,
                      va_list arguments) {
    (void)tiff, (void)user, (void)module;
    char message[512];
    vsnprintf(message, sizeof message, format, arguments);
    pel_warn("TIFF: %s", message);
    return 1;
}

static TIFF *open_tiff(const char *path) {
    TIFFOpenOptions *options = TIFFOpenOptionsAlloc();
    if (!options) {
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a TIFF encoder");
        return NULL;
    }
    TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, NULL);
    TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, NULL);
    TIFF *tiff = TIFFOpenExt(path, "w", options);
    TIFFOpenOptionsFree(options);
    return tiff;
}

static bool write_header(TIFF *tiff, const struct pel_image *image) {
    return TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, (uint32_t)image->width) &&
           TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, (uint32_t)image->height) &&
           TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 4) &&
           TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32) &&
           TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP) &&
           TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, (uint16_t[]){EXTRASAMPLE_ASSOCALPHA}) &&
           TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB) &&
           TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) &&
           TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT) &&
           TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE) &&
           TIFFSetField(tiff, TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT) &&
           TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff, 0));
}

static bool write_pixels(TIFF *tiff, const struct pel_image *image) {
    // libtiff's predictor works in place, so it gets a copy of every row.
    size_t row_floats = (size_t)image->width * 4;
    float *row = pel_allocate(row_floats, sizeof *row);
    bool good = row && write_header(tiff, image);
    for (int y = 0; good && y < image->height; y++) {
        memcpy(row, image->rgba + (size_t)y * row_floats, row_floats * sizeof *row);
        good = TIFFWriteScanline(tiff, row, (uint32_t)y, 0) == 1;
    }
    free(row);
    return good && TIFFFlush(tiff);
}

bool pel_tiff_image_save(const struct pel_image *image, const char *path) {
    struct pel_output output;
    if (!pel_output_open(&output, path))
        return false;
    pel_error_clear();
    TIFF *tiff = open_tiff(output.temporary);
    bool good = tiff && write_pixels(tiff, image);
    if (tiff)
        TIFFClose(tiff);
    if (!good) {
        if (pel_error_code() == PEL_OK)
            pel_fail(PEL_ERROR_FILE, "cannot write TIFF");
        pel_output_abandon(&output);
        return pel_fail_in("%s", path);
    }
    return pel_output_commit(&output);
}
