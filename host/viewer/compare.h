// compare.h - two pictures in one, to see whether what they show lies in the same place; and
// slices through all volumes. Pure functions on images.
#ifndef PEL_VIEWER_COMPARE_H
#define PEL_VIEWER_COMPARE_H

#include "pellucid.h"

enum pel_compare_mode {
    PEL_COMPARE_NONE,         // the scene as it is
    PEL_COMPARE_BLEND,        // a and b in shares
    PEL_COMPARE_CHECKERBOARD, // squares of a and of b
    PEL_COMPARE_SPLIT,        // a on one side of a line, b on the other
    PEL_COMPARE_FLICKER,      // a and b in turns
    PEL_COMPARE_DIFFERENCE,   // grey where both are as bright, cyan where a is brighter, magenta
                              // where b is
    PEL_COMPARE_SLICES,       // three cross-hair planes beside the picture: see pel_slice_render
};

struct pel_compare {
    enum pel_compare_mode mode;
    double share;    // of b in a blend, 0..1
    int cell_px;     // of the checkerboard; 0 = 48
    double split;    // where the line is, 0..1 from the left or the top
    bool across;     // the line runs from left to right
    double period_s; // of the flicker; 0 = 1
    int offset[2];   // where the pictures begin in the whole that squares and the line belong to
    int whole[2];    // ... and its size; 0 = they are all of it
};

// The names of the modes, "none" first; the list ends with NULL.
const char *const *pel_compare_names(void);

// The scene with one instance visible alone; the caller owns it. NULL when memory ran out.
struct pel_scene *pel_compare_side(const struct pel_scene *scene, int instance);

// Which of the two pictures shows at a moment and place of the whole: 0 is a, 1 b; between them
// both do.
double pel_compare_weight(const struct pel_compare *compare, int width, int height, int x, int y,
                          double seconds);

// Puts two pictures of one size together. `rgba` are 8-bit pixels with straight alpha, rows from
// the top; `out` may be one of them.
void pel_compare_pixels(const struct pel_compare *compare, int width, int height, const uint8_t *a,
                        const uint8_t *b, double seconds, uint8_t *out);

// The same for pictures as they are rendered; the caller owns the result. NULL when sizes differ or
// memory ran out.
struct pel_image *pel_compare_images(const struct pel_compare *compare, const struct pel_image *a,
                                     const struct pel_image *b, double seconds);

#endif
