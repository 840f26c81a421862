// wall.c - where the windows of a display wall lie.
//
// Bezels are what lies between the regions: it belongs to the picture, but nothing shows it, so
// that lines go on straight behind the frames of the monitors.
#include "viewer/wall.h"

#include <math.h>

struct pel_wall_part pel_wall_place(const struct pel_wall *wall, int number, const int wall_px[2]) {
    const double *place = wall->regions[number].place;
    struct pel_wall_part part = {.whole = {wall_px[0], wall_px[1]}};
    for (int axis = 0; axis < 2; axis++) {
        double low = place[axis], high = fmin(low + place[2 + axis], 1);
        // The edge of one region and that of the next may differ by a rounding of their numbers.
        int first = (int)floor(low * wall_px[axis] + 0.5 + 1e-6);
        int end = (int)floor(high * wall_px[axis] + 0.5 + 1e-6);
        if (first > wall_px[axis] - 1)
            first = wall_px[axis] - 1;
        part.region[axis] = first;
        part.region[2 + axis] = end > first ? end - first : 1;
    }
    return part;
}

struct pel_wall_part pel_wall_fit(const struct pel_wall *wall, int number, const int wall_px[2],
                                  const int pixels[2]) {
    struct pel_wall_part part = pel_wall_place(wall, number, wall_px);
    const double *place = wall->regions[number].place;
    if (part.region[2] == pixels[0] && part.region[3] == pixels[1])
        return part;
    for (int axis = 0; axis < 2; axis++) {
        int whole = (int)fmin(lround(pixels[axis] / place[2 + axis]), 32768);
        int first = (int)lround(place[axis] * whole);
        part.whole[axis] = whole > pixels[axis] ? whole : pixels[axis];
        part.region[axis] =
            first + pixels[axis] > part.whole[axis] ? part.whole[axis] - pixels[axis] : first;
        part.region[2 + axis] = pixels[axis];
    }
    return part;
}
