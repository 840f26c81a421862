// tiff_save.c - writes a volume as one TIFF file, a page per slice.
//
// Compressed with deflate and the predictor that suits the type. Spacing goes where ImageJ and Fiji
// look for it: resolution tags in pixels per millimetre, and an ImageJ description with `unit`,
// `spacing`, and the linear calibration of values. Resolution is a fraction of 32-bit numbers from
// a float, so spacing is kept to 6 digits. TIFF has no place for position and direction.
#include "volume/tiff.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "volume/row.h"
#include "volume/volume.h"

// About this many bytes make a strip.
enum { STRIP_BYTES = 1 << 18 };

static void write_description(char *text, size_t bytes, const struct pel_volume *volume,
                              double spacing_mm) {
    int length =
        snprintf(text, bytes, "ImageJ=1.54f\nimages=%d\nslices=%d\nunit=mm\nspacing=%.17g\n",
                 volume->dims[2], volume->dims[2], spacing_mm);
    if (volume->slope != 1 || volume->intercept != 0)
        snprintf(text + length, bytes - (size_t)length, "cf=0\nc0=%.17g\nc1=%.17g\nvunit=%s\n",
                 volume->intercept, volume->slope, volume->unit);
}

static void set_tags(TIFF *handle, const struct pel_volume *volume, const double spacing_mm[3]) {
    int channels = pel_row_channels(volume->type);
    size_t bytes = pel_voxel_bytes(volume->type);
    size_t row_bytes = (size_t)volume->dims[0] * bytes;
    uint32_t rows = row_bytes < STRIP_BYTES ? (uint32_t)(STRIP_BYTES / row_bytes) : 1;
    bool floats = volume->type == PEL_VOXEL_F32;
    bool is_signed = volume->type == PEL_VOXEL_I8 || volume->type == PEL_VOXEL_I16;
    TIFFSetField(handle, TIFFTAG_IMAGEWIDTH, (uint32_t)volume->dims[0]);
    TIFFSetField(handle, TIFFTAG_IMAGELENGTH, (uint32_t)volume->dims[1]);
    TIFFSetField(handle, TIFFTAG_BITSPERSAMPLE, (int)(8 * bytes) / channels);
    TIFFSetField(handle, TIFFTAG_SAMPLESPERPIXEL, channels);
    TIFFSetField(handle, TIFFTAG_SAMPLEFORMAT,
                 floats      ? SAMPLEFORMAT_IEEEFP
                 : is_signed ? SAMPLEFORMAT_INT
                             : SAMPLEFORMAT_UINT);
    TIFFSetField(handle, TIFFTAG_PHOTOMETRIC,
                 channels > 1 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
    if (channels == 4)
        TIFFSetField(handle, TIFFTAG_EXTRASAMPLES, 1, (uint16_t[]){EXTRASAMPLE_UNASSALPHA});
    TIFFSetField(handle, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(handle, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    TIFFSetField(handle, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    TIFFSetField(handle, TIFFTAG_PREDICTOR,
                 floats ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
    TIFFSetField(handle, TIFFTAG_ROWSPERSTRIP, rows);
    TIFFSetField(handle, TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
    TIFFSetField(handle, TIFFTAG_XRESOLUTION, 1 / spacing_mm[0]);
    TIFFSetField(handle, TIFFTAG_YRESOLUTION, 1 / spacing_mm[1]);
    TIFFSetField(handle, TIFFTAG_SOFTWARE, "Pellucid");
}

// libtiff's writers may change what they are given (predictors, byte order), hence the copy.
static bool write_slice(TIFF *handle, const struct pel_volume *volume, int k, void *row) {
    size_t row_bytes = (size_t)volume->dims[0] * pel_voxel_bytes(volume->type);
    for (int j = 0; j < volume->dims[1]; j++) {
        memcpy(row, pel_row_at(volume, j, k), row_bytes);
        if (TIFFWriteScanline(handle, row, (uint32_t)j, 0) < 0)
            return false;
    }
    return TIFFWriteDirectory(handle);
}

static void warn_about(const struct pel_volume *volume, const double spacing_mm[3]) {
    double lost = 0;
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++) {
            double kept = r != c ? 0 : c < 2 ? -spacing_mm[c] : spacing_mm[c];
            lost = fmax(lost, fabs(volume->world_from_voxel.m[r][c] - kept));
        }
    if (lost > 1e-6 * fmin(spacing_mm[0], fmin(spacing_mm[1], spacing_mm[2])))
        pel_warn("%s: TIFF keeps the spacing, but neither position nor direction", volume->name);
}

static bool write_all(const char *path, const struct pel_volume *volume) {
    double spacing_mm[3];
    char description[512];
    struct pel_tiff_reports reports;
    pel_volume_spacing(volume, spacing_mm);
    write_description(description, sizeof description, volume, spacing_mm[2]);
    warn_about(volume, spacing_mm);
    // Deflate makes noise a little larger, and the tags need room; beyond 4 GB it is BigTIFF.
    bool big = pel_volume_bytes(volume) > (size_t)3900 << 20;
    TIFF *handle = pel_tiff_handle(path, big ? "w8" : "w", 0, &reports);
    if (!handle)
        return false;
    void *row = pel_allocate((size_t)volume->dims[0], pel_voxel_bytes(volume->type));
    bool done = row;
    for (int k = 0; done && k < volume->dims[2]; k++) {
        set_tags(handle, volume, spacing_mm);
        if (k == 0)
            TIFFSetField(handle, TIFFTAG_IMAGEDESCRIPTION, description);
        done = write_slice(handle, volume, k, row);
        if (!done)
            pel_fail(PEL_ERROR_FILE, "slice %d: %s", k,
                     reports.error[0] ? reports.error : "cannot write");
    }
    free(row);
    TIFFClose(handle);
    if (done && reports.error[0])
        return pel_fail(PEL_ERROR_FILE, "%s", reports.error);
    return done;
}

bool pel_tiff_save(const struct pel_volume *volume, const char *path) {
    struct pel_output output;
    if (!pel_output_open(&output, path))
        return false;
    if (!write_all(output.temporary, volume)) {
        pel_output_abandon(&output);
        return pel_fail_in("%s", path);
    }
    return pel_output_commit(&output);
}
