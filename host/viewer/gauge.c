// gauge.c - the scale bar and the orientation cube.
#include "viewer/gauge.h"

#include <stdio.h>
#include <stdlib.h>

#include "viewer/vector.h"

// Nano- to kilometres, each a thousand times the one before but for centimetres, which people use.
static const struct {
    const char *name;
    double mm;
} units[] = {{"nm", 1e-6}, {"um", 1e-3}, {"mm", 1}, {"cm", 10}, {"m", 1e3}, {"km", 1e6}};

enum { UNIT_COUNT = sizeof units / sizeof *units };

bool pel_scale_bar_make(struct pel_scale_bar *bar, const struct pel_view *view, double most_px) {
    double mm_per_px = pel_view_target_mm_per_px(view), most_mm = most_px * mm_per_px;
    if (!(most_mm > 0) || !isfinite(most_mm))
        return false;
    double power = pow(10, floor(log10(most_mm)));
    // What rounding took away is given back, so that exactly 10 mm fits into 10 mm.
    double factor = most_mm / power * (1 + 1e-12);
    double round = factor >= 10 ? 10 : factor >= 5 ? 5 : factor >= 2 ? 2 : 1;
    bar->length_mm = round * power;
    bar->length_px = bar->length_mm / mm_per_px;
    int unit = 0;
    while (unit + 1 < UNIT_COUNT && bar->length_mm >= 0.999999 * units[unit + 1].mm)
        unit++;
    // Up to ten centimetres are told in millimetres.
    if (unit == 3 && bar->length_mm < 99.9)
        unit = 2;
    snprintf(bar->text, sizeof bar->text, "%.6g %s", bar->length_mm / units[unit].mm,
             units[unit].name);
    return true;
}

// The outward direction of a face, and what is right of and below its letter. Letters stand
// upright where superior is up; from above and below anterior is up, as in the named views.
static const struct {
    char letter;
    const char *view;
    double out[3], right[3], down[3];
} sides[] = {
    {'R', "right", {1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
    {'L', "left", {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
    {'A', "anterior", {0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
    {'P', "posterior", {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {'S', "superior", {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    {'I', "inferior", {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
};

// A direction of the world as one of the picture, y down.
static void flatten(double flat[2], const struct pel_view *view, const double direction[3],
                    double scale) {
    flat[0] = scale * vector_dot(direction, view->right);
    flat[1] = -scale * vector_dot(direction, view->up);
}

static int by_brightness(const void *a, const void *b) {
    double x = ((const struct pel_cube_face *)a)->brightness;
    double y = ((const struct pel_cube_face *)b)->brightness;
    return (x > y) - (x < y);
}

int pel_orientation_cube(struct pel_cube_face faces[3], const struct pel_view *view,
                         const double centre_px[2], double size_px) {
    static const int signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    int count = 0;
    for (int i = 0; i < 6 && count < 3; i++) {
        double facing = -vector_dot(sides[i].out, view->forward), out[2];
        if (!(facing > 1e-6))
            continue;
        struct pel_cube_face *face = &faces[count++];
        *face = (struct pel_cube_face){
            .letter = sides[i].letter, .view = sides[i].view, .brightness = facing};
        flatten(out, view, sides[i].out, size_px / 2);
        flatten(face->right, view, sides[i].right, size_px / 2);
        flatten(face->down, view, sides[i].down, size_px / 2);
        for (int axis = 0; axis < 2; axis++) {
            face->centre[axis] = centre_px[axis] + out[axis];
            for (int corner = 0; corner < 4; corner++)
                face->corners[corner][axis] = face->centre[axis] +
                                              signs[corner][0] * face->right[axis] +
                                              signs[corner][1] * face->down[axis];
        }
    }
    qsort(faces, (size_t)count, sizeof *faces, by_brightness);
    return count;
}

int pel_orientation_cube_hit(const struct pel_cube_face *faces, int count, const double pixel[2]) {
    for (int i = count; i-- > 0;) {
        // Inside when the pixel lies on one side of all four edges.
        int left = 0;
        for (int corner = 0; corner < 4; corner++) {
            const double *a = faces[i].corners[corner], *b = faces[i].corners[(corner + 1) % 4];
            left += (b[0] - a[0]) * (pixel[1] - a[1]) - (b[1] - a[1]) * (pixel[0] - a[0]) >= 0;
        }
        if (left == 0 || left == 4)
            return i;
    }
    return -1;
}
