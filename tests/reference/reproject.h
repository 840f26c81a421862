// reproject.h - the right second eye from a first one: docs/stereo.md, "Reprojection", pixel by
// pixel of the second picture.
#ifndef PEL_REFERENCE_REPROJECT_H
#define PEL_REFERENCE_REPROJECT_H

#include <stdbool.h>

// A row of the first picture: premultiplied colours, and the depth along the view of each pixel,
// INFINITY where there is nothing. What is at depth z goes shift - reach / z pixels to the right.
struct reference_row {
    int width;
    const float (*rgba)[4];
    const float *depth;
    double shift, reach;
    // Orthographic: what is at x goes to scale x + shift + slope z, and is lean x + fall z away
    // there. What is empty goes where `empty` goes, behind everything.
    bool orthographic;
    double scale, slope, lean, fall, empty;
};

// The colour of pixel k of the second picture; false where a ray has to be cast.
bool reference_reproject(double rgba[4], const struct reference_row *row, int k);

#endif
