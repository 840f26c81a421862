// tiff_recipe.c - TIFF stacks for tests.
#include "support/tiff_recipe.h"

#include <tiffio.h>

#include "support/test.h"
#include "volume/volume.h"

int tiff_recipe_value(int x, int y, int page, int s) {
    return x + 10 * y + 50 * page + 3 * s;
}

static void put(uint8_t *row, size_t index, int bits, int format, int value) {
    if (format == SAMPLEFORMAT_IEEEFP && bits == 32)
        ((float *)row)[index] = (float)value / 4;
    else if (format == SAMPLEFORMAT_IEEEFP)
        ((double *)row)[index] = (double)value / 4;
    else if (bits == 8)
        row[index] = (uint8_t)value;
    else if (bits == 16)
        ((uint16_t *)row)[index] = (uint16_t)value;
    else if (bits == 32)
        ((uint32_t *)row)[index] = (uint32_t)value;
    else
        for (int b = 0; b < bits; b++)
            row[(index * (size_t)bits + (size_t)b) / 8] |=
                (uint8_t)((value >> (bits - 1 - b) & 1)
                          << (7 - (index * (size_t)bits + (size_t)b) % 8));
}

static void set_tags(TIFF *tiff, const struct tiff_recipe *r) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, r->width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, r->height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, r->bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, r->samples);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, r->format);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, r->photometric);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, r->planar);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, r->compression);
    TIFFSetField(tiff, TIFFTAG_ORIENTATION, r->orientation);
    if (r->extra)
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, (uint16_t[]){(uint16_t)(r->extra - 1)});
    if (r->unit) {
        TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, r->unit);
        TIFFSetField(tiff, TIFFTAG_XRESOLUTION, r->per_unit[0]);
        TIFFSetField(tiff, TIFFTAG_YRESOLUTION, r->per_unit[1]);
    }
    if (r->tile) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, r->tile);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, r->tile);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
    }
}

static void write_page(TIFF *tiff, const struct tiff_recipe *r, int page) {
    bool separate = r->planar == PLANARCONFIG_SEPARATE;
    int planes = separate ? r->samples : 1, step = r->tile ? r->tile : r->height;
    for (int plane = 0; plane < planes; plane++)
        for (int top = 0; top < r->height; top += step)
            for (int left = 0; left < r->width; left += r->tile ? r->tile : r->width) {
                int samples = separate ? 1 : r->samples, width = r->tile ? r->tile : r->width;
                size_t row_bytes = ((size_t)(width * samples * r->bits) + 7) / 8;
                uint8_t *block = calloc((size_t)step, row_bytes);
                for (int y = 0; y < step && top + y < r->height; y++) {
                    uint8_t *row = block + (size_t)y * row_bytes;
                    for (int x = 0; x < width && left + x < r->width; x++)
                        for (int s = 0; s < samples; s++)
                            put(row, (size_t)(x * samples + s), r->bits, r->format,
                                tiff_recipe_value(left + x, top + y, page, separate ? plane : s));
                    if (!r->tile)
                        assert_int_equal(
                            TIFFWriteScanline(tiff, row, (uint32_t)(top + y), (uint16_t)plane), 1);
                }
                if (r->tile)
                    assert_true(TIFFWriteTile(tiff, block, (uint32_t)left, (uint32_t)top, 0,
                                              (uint16_t)plane) > 0);
                free(block);
            }
}

const char *tiff_recipe_write(const char *leaf, struct tiff_recipe r) {
    const char *path = test_temporary_path(leaf);
    r.width = r.width ? r.width : 7, r.height = r.height ? r.height : 5;
    r.pages = r.pages ? r.pages : 1, r.bits = r.bits ? r.bits : 8;
    r.samples = r.samples ? r.samples : 1, r.format = r.format ? r.format : SAMPLEFORMAT_UINT;
    r.photometric = r.samples == 3 && !r.photometric ? PHOTOMETRIC_RGB
                    : r.photometric < 0              ? PHOTOMETRIC_MINISWHITE
                    : r.photometric                  ? r.photometric
                                                     : PHOTOMETRIC_MINISBLACK;
    r.planar = r.planar ? r.planar : PLANARCONFIG_CONTIG;
    r.compression = r.compression ? r.compression : COMPRESSION_NONE;
    r.orientation = r.orientation ? r.orientation : ORIENTATION_TOPLEFT;
    TIFF *tiff = TIFFOpen(path, r.mode ? r.mode : "w");
    assert_non_null(tiff);
    for (int page = 0; page < r.pages; page++) {
        set_tags(tiff, &r);
        if (page == 0 && r.description)
            TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, r.description);
        write_page(tiff, &r, page);
        assert_int_equal(TIFFWriteDirectory(tiff), 1);
    }
    TIFFClose(tiff);
    return path;
}

struct pel_volume *tiff_recipe_load(const char *path) {
    struct pel_volume *volume = pel_tiff_load(path, NULL);
    if (!volume)
        print_message("%s\n", pel_error_message());
    assert_non_null(volume);
    return volume;
}

void tiff_recipe_assert_spacing(const struct pel_volume *volume, double x, double y, double z) {
    double spacing[3];
    pel_volume_spacing(volume, spacing);
    assert_float_equal(spacing[0] / x, 1, 1e-6);
    assert_float_equal(spacing[1] / y, 1, 1e-6);
    assert_float_equal(spacing[2] / z, 1, 1e-6);
}
