// image.h - inside the output module: one save function per format, and how a float becomes an
// integer in all of them.
#ifndef PEL_OUTPUT_IMAGE_H
#define PEL_OUTPUT_IMAGE_H

#include "pellucid.h"

// A picture of any content, for who writes every pixel; else as pel_image_create.
struct pel_image *pel_image_create_undefined(int width, int height);

// The integer nearest to value * max, for a value clamped to 0..1; NaN counts as 0. `max` is 255 or
// 65535.
unsigned pel_image_quantise(double value, unsigned max);

// Each writes `image` to `path`, all or nothing. The image is not empty and the depth is 8 or 16.
bool pel_png_save(const struct pel_image *image, const char *path,
                  const struct pel_image_options *options);
bool pel_tiff_image_save(const struct pel_image *image, const char *path);

// Writes to the standard output when the path is "-".
bool pel_ppm_save(const struct pel_image *image, const char *path);

#endif
