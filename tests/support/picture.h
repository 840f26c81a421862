// picture.h - comparing pictures, pixel by pixel.
#ifndef PEL_TEST_PICTURE_H
#define PEL_TEST_PICTURE_H

#include "pellucid.h"

// How far two pictures are apart, over all four channels, in 1/255 of full scale.
struct picture_difference {
    double greatest;  // in absolute value; INFINITY where a number is not finite
    int x, y;         // the pixel it lies in
    int beyond_count; // pixels with a channel off by more than the bound asked for
    double psnr_db;   // INFINITY for equal pictures
};

// The pictures must be of one size.
struct picture_difference picture_compare(const struct pel_image *a, const struct pel_image *b,
                                          double bound_255);

// Reads a PNG as it is stored: rgba = byte / 255, not multiplied by alpha. Fails the test when it
// cannot be read. Give it back to pel_image_destroy.
struct pel_image *picture_read_png(const char *path);

// Writes the difference of the colours, enlarged `gain` times, as a PNG; false when that fails.
bool picture_write_difference(const char *path, const struct pel_image *a,
                              const struct pel_image *b, double gain);

// Fails the test unless the pictures agree within `bound_255` in all but `allowed_beyond` pixels.
// Failing, it prints the worst pixel with both values and, with PELLUCID_TEST_KEEP naming a folder,
// leaves the difference there as a PNG.
#define assert_pictures_within(actual, expected, bound_255, allowed_beyond, title)                 \
    picture_assert_within(actual, expected, bound_255, allowed_beyond, title, __FILE__, __LINE__)
void picture_assert_within(const struct pel_image *actual, const struct pel_image *expected,
                           double bound_255, int allowed_beyond, const char *title,
                           const char *file, int line);

// Fails the test unless every bit agrees.
#define assert_pictures_equal(actual, expected, title)                                             \
    picture_assert_equal(actual, expected, title, __FILE__, __LINE__)
void picture_assert_equal(const struct pel_image *actual, const struct pel_image *expected,
                          const char *title, const char *file, int line);

#endif
