// tiff_recipe.h - TIFF stacks for tests, in every way pixels can lie in a file.
#ifndef PEL_TEST_TIFF_RECIPE_H
#define PEL_TEST_TIFF_RECIPE_H

#include "pellucid.h"

// How a test file is stored; zero members take the defaults of tiff_recipe_write.
struct tiff_recipe {
    const char *mode;        // "w"
    int width, height;       // 7 x 5
    int pages;               // 1
    int bits, samples;       // 8, 1
    int format, photometric; // UINT, MINISBLACK or RGB
    int planar, compression; // CONTIG, NONE
    int tile;                // side of tiles; 0 = strips of 2 rows
    int orientation;         // TOPLEFT
    int extra;               // EXTRASAMPLE_... + 1 of the last sample; 0 = tag not written
    int unit;                // RESUNIT_...; 0 = no resolution
    double per_unit[2];      //
    const char *description;
};

// The value stored for sample s of pixel (x, y) of a page; a quarter of it in floating point.
int tiff_recipe_value(int x, int y, int page, int s);

// Writes a temporary file and returns its path. Fails the test when libtiff does.
const char *tiff_recipe_write(const char *leaf, struct tiff_recipe recipe);

// Reads a stack, which must work, with default options.
struct pel_volume *tiff_recipe_load(const char *path);

// Fails the test unless the spacing is this one, to 6 digits.
void tiff_recipe_assert_spacing(const struct pel_volume *volume, double x, double y, double z);

#endif
