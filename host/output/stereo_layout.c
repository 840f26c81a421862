// stereo_layout.c - two pictures as one: beside each other, above each other, or interlaced, for
// screens and programs that take them apart again; or as an anaglyph.
//
// A squeezed picture's pixel is the mean of the two it stands for.
#include <string.h>

#include "base/error.h"
#include "output/image.h"
#include "output/stereo.h"

// How many pictures' widths and heights the result is wide and high.
static void count_pictures(enum pel_stereo_kind kind, int *across, int *down) {
    *across = kind == PEL_STEREO_SIDE_BY_SIDE || kind == PEL_STEREO_TWO_FILES ? 2 : 1;
    *down = kind == PEL_STEREO_TOP_BOTTOM ? 2 : 1;
}

static const float *pixel_of(const struct pel_image *image, int x, int y) {
    return &image->rgba[4 * ((size_t)y * (size_t)image->width + (size_t)x)];
}

static void mean(float out[4], const float a[4], const float b[4]) {
    for (int c = 0; c < 4; c++)
        out[c] = (a[c] + b[c]) / 2;
}

// Which eye a row of one that is laid whole is of, and where it begins there; NULL where rows are
// made pixel by pixel. A row of two pictures beside each other is two such rows.
static const float *find_row(enum pel_stereo_kind kind, const struct pel_image *const eyes[2],
                             int side, int y) {
    switch (kind) {
    case PEL_STEREO_SIDE_BY_SIDE:
    case PEL_STEREO_TWO_FILES:
        return pixel_of(eyes[side], 0, y);
    case PEL_STEREO_TOP_BOTTOM:
        return pixel_of(eyes[y / eyes[0]->height], 0, y % eyes[0]->height);
    case PEL_STEREO_ROW_INTERLACED:
        return pixel_of(eyes[y % 2], 0, y);
    case PEL_STEREO_NONE:
        return pixel_of(eyes[0], 0, y);
    default:
        return NULL;
    }
}

// One pixel of the result, of the other kinds.
static void lay_pixel(float out[4], enum pel_stereo_kind kind,
                      const struct pel_image *const eyes[2], int x, int y) {
    int width = eyes[0]->width, height = eyes[0]->height;
    const struct pel_image *eye = eyes[0];
    switch (kind) {
    case PEL_STEREO_SIDE_BY_SIDE_HALF:
        eye = eyes[x >= width / 2];
        x = 2 * (x % (width / 2));
        mean(out, pixel_of(eye, x, y), pixel_of(eye, x + 1, y));
        return;
    case PEL_STEREO_TOP_BOTTOM_HALF:
        eye = eyes[y >= height / 2];
        y = 2 * (y % (height / 2));
        mean(out, pixel_of(eye, x, y), pixel_of(eye, x, y + 1));
        return;
    case PEL_STEREO_COLUMN_INTERLACED:
        eye = eyes[x % 2];
        break;
    case PEL_STEREO_CHECKERBOARD:
        eye = eyes[(x + y) % 2];
        break;
    default:
        break;
    }
    memcpy(out, pixel_of(eye, x, y), 4 * sizeof *out);
}

static bool check_pictures(enum pel_stereo_kind kind, const struct pel_image *left,
                           const struct pel_image *right) {
    if ((int)kind < 0 || kind > PEL_STEREO_TWO_FILES)
        return pel_fail(PEL_ERROR_ARGUMENT, "there is no stereo of kind %d", (int)kind);
    if (left->width != right->width || left->height != right->height)
        return pel_fail(PEL_ERROR_ARGUMENT, "eyes of %d x %d and %d x %d pixels", left->width,
                        left->height, right->width, right->height);
    if (kind == PEL_STEREO_SIDE_BY_SIDE_HALF && left->width % 2 != 0)
        return pel_fail(PEL_ERROR_ARGUMENT, "side-by-side-half needs an even width, not %d",
                        left->width);
    if (kind == PEL_STEREO_TOP_BOTTOM_HALF && left->height % 2 != 0)
        return pel_fail(PEL_ERROR_ARGUMENT, "top-bottom-half needs an even height, not %d",
                        left->height);
    return true;
}

struct pel_image *pel_stereo_compose(const struct pel_stereo *stereo, const struct pel_image *left,
                                     const struct pel_image *right) {
    if (!check_pictures(stereo->kind, left, right))
        return NULL;
    if (pel_stereo_is_anaglyph(stereo->kind))
        return pel_anaglyph_compose(stereo, left, right);
    int across, down;
    count_pictures(stereo->kind, &across, &down);
    const struct pel_image *const eyes[2] = {left, right};
    struct pel_image *image = pel_image_create_undefined(across * left->width, down * left->height);
    if (!image)
        return NULL;
    float *out = image->rgba;
    size_t row_bytes = 4 * sizeof *out * (size_t)left->width;
    for (int y = 0; y < image->height; y++) {
        for (int side = 0; side < across; side++) {
            const float *row = find_row(stereo->kind, eyes, side, y);
            for (int x = 0; !row && x < left->width; x++)
                lay_pixel(out + 4 * x, stereo->kind, eyes, x, y);
            if (row)
                memcpy(out, row, row_bytes);
            out += 4 * left->width;
        }
    }
    return image;
}
