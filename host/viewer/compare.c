// compare.c - two pictures in one.
//
// The difference shows a in green, b in red and the brighter of both in blue: equal pixels are
// grey, and what only one of them has is cyan or magenta, colours that nobody confuses.
#include "viewer/compare.h"

#include <math.h>
#include <string.h>

static const char *const names[] = {"none",    "blend",      "checkerboard", "split",
                                    "flicker", "difference", "slices",       NULL};

enum { CELL_DEFAULT = 48 };

const char *const *pel_compare_names(void) {
    return names;
}

struct pel_scene *pel_compare_side(const struct pel_scene *scene, int instance) {
    struct pel_scene *side = pel_scene_copy(scene);
    for (int i = 0; side && i < side->instance_count; i++)
        side->instances[i].hidden = i != instance;
    return side;
}

double pel_compare_weight(const struct pel_compare *compare, int width, int height, int x, int y,
                          double seconds) {
    int cell = compare->cell_px > 0 ? compare->cell_px : CELL_DEFAULT;
    double period = compare->period_s > 0 ? compare->period_s : 1;
    switch (compare->mode) {
    case PEL_COMPARE_BLEND:
        return fmin(fmax(compare->share, 0), 1);
    case PEL_COMPARE_CHECKERBOARD:
        return (x / cell + y / cell) % 2;
    case PEL_COMPARE_SPLIT:
        return compare->across ? y + 0.5 >= compare->split * height
                               : x + 0.5 >= compare->split * width;
    case PEL_COMPARE_FLICKER:
        return fmod(seconds, period) >= period / 2;
    default:
        return 0;
    }
}

// Rec. 709; the same for straight and premultiplied colours of opaque pixels.
static double luminance(const double rgba[4]) {
    return 0.2126 * rgba[0] + 0.7152 * rgba[1] + 0.0722 * rgba[2];
}

static void put_together(const struct pel_compare *compare, double weight, const double a[4],
                         const double b[4], double out[4]) {
    if (compare->mode == PEL_COMPARE_DIFFERENCE) {
        double of_a = luminance(a), of_b = luminance(b), alpha = fmax(a[3], b[3]);
        memcpy(out, (double[4]){of_b, of_a, fmax(of_a, of_b), alpha}, 4 * sizeof *out);
        return;
    }
    for (int c = 0; c < 4; c++)
        out[c] = weight == 0 ? a[c] : weight == 1 ? b[c] : a[c] + weight * (b[c] - a[c]);
}

// The same for a pixel of a picture that may be a part of the whole.
static double weight_at(const struct pel_compare *compare, int width, int height, int x, int y,
                        double seconds) {
    bool part = compare->whole[0] > 0;
    return pel_compare_weight(compare, part ? compare->whole[0] : width,
                              part ? compare->whole[1] : height, x + compare->offset[0],
                              y + compare->offset[1], seconds);
}

void pel_compare_pixels(const struct pel_compare *compare, int width, int height, const uint8_t *a,
                        const uint8_t *b, double seconds, uint8_t *out) {
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            size_t at = 4 * ((size_t)y * (size_t)width + (size_t)x);
            double of_a[4], of_b[4], mixed[4];
            for (int c = 0; c < 4; c++) {
                of_a[c] = a[at + (size_t)c];
                of_b[c] = b[at + (size_t)c];
            }
            put_together(compare, weight_at(compare, width, height, x, y, seconds), of_a, of_b,
                         mixed);
            for (int c = 0; c < 4; c++)
                out[at + (size_t)c] = (uint8_t)(mixed[c] + 0.5);
        }
    }
}

struct pel_image *pel_compare_images(const struct pel_compare *compare, const struct pel_image *a,
                                     const struct pel_image *b, double seconds) {
    if (a->width != b->width || a->height != b->height)
        return NULL;
    struct pel_image *image = pel_image_create(a->width, a->height);
    for (int y = 0; image && y < a->height; y++) {
        for (int x = 0; x < a->width; x++) {
            size_t at = 4 * ((size_t)y * (size_t)a->width + (size_t)x);
            double of_a[4], of_b[4], mixed[4];
            for (int c = 0; c < 4; c++) {
                of_a[c] = a->rgba[at + (size_t)c];
                of_b[c] = b->rgba[at + (size_t)c];
            }
            put_together(compare, weight_at(compare, a->width, a->height, x, y, seconds), of_a,
                         of_b, mixed);
            for (int c = 0; c < 4; c++)
                image->rgba[at + (size_t)c] = (float)mixed[c];
        }
    }
    return image;
}
