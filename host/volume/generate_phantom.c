// generate_phantom.c - the three-dimensional head of Shepp and Logan.
//
// Ten ellipsoids whose values add up: geometry after Kak & Slaney, "Principles of Computerized
// Tomographic Imaging" (1988), p. 102. Their contrast between tissues is 1 % of the skull's, which
// no transfer function shows, so the values are those of Yu, Ye & Wang, "Katsevich-type algorithms
// for variable radius spiral cone-beam CT" (SPIE 5535, 2004): 1 in the skull, 0.2 in the brain, 0
// to 0.4 in what it holds.
#include "volume/generate.h"

#include <math.h>

#include "base/math.h"

static const struct {
    double semi_axes[3], centre[3]; // the phantom is within [-1, 1]^3
    double turn_deg;                // about z
    int tenths;                     // of the skull's value, added inside
} ellipsoids[] = {
    {{0.69, 0.92, 0.9}, {0, 0, 0}, 0, 10},
    {{0.6624, 0.874, 0.88}, {0, 0, 0}, 0, -8},
    {{0.41, 0.16, 0.21}, {-0.22, 0, -0.25}, 108, -2},
    {{0.31, 0.11, 0.22}, {0.22, 0, -0.25}, 72, -2},
    {{0.21, 0.25, 0.5}, {0, 0.35, -0.25}, 0, 2},
    {{0.046, 0.046, 0.046}, {0, 0.1, -0.25}, 0, 2},
    {{0.046, 0.023, 0.02}, {-0.08, -0.65, -0.25}, 0, 1},
    {{0.046, 0.023, 0.02}, {0.06, -0.65, -0.25}, 90, 1},
    {{0.056, 0.04, 0.1}, {0.06, -0.105, 0.625}, 90, 2},
    {{0.056, 0.056, 0.1}, {0, 0.1, 0.625}, 0, -2},
};

enum { ELLIPSOID_COUNT = sizeof ellipsoids / sizeof *ellipsoids };

// Adds ellipsoid `e` to the samples inside it. Along the row, the implicit function
// |S^-1 R^T (p - c)|^2 - 1 is a quadratic a x^2 + 2 b x + c of the distance x from the row's start.
static void add_ellipsoid(int e, const struct pel_generate_row *row, float *values) {
    double turn = ellipsoids[e].turn_deg * PEL_PI / 180;
    double cosine = cos(turn), sine = sin(turn);
    const double *semi = ellipsoids[e].semi_axes;
    double p[3];
    for (int i = 0; i < 3; i++)
        p[i] = row->start[i] / PEL_SHEPP_LOGAN_UNIT_MM - ellipsoids[e].centre[i];
    double local[3] = {(cosine * p[0] + sine * p[1]) / semi[0],
                       (cosine * p[1] - sine * p[0]) / semi[1], p[2] / semi[2]};
    double direction[3] = {cosine / semi[0], -sine / semi[1], 0};

    double a = pel_dot(direction, direction), b = pel_dot(direction, local);
    double discriminant = b * b - a * (pel_dot(local, local) - 1);
    if (discriminant < 0)
        return;
    double step = row->spacing[0] / PEL_SHEPP_LOGAN_UNIT_MM, half = sqrt(discriminant) / a;
    int first = (int)fmax(ceil((-b / a - half) / step), 0);
    int last = (int)fmin(floor((-b / a + half) / step), row->count - 1);
    for (int i = first; i <= last; i++)
        values[i] += (float)ellipsoids[e].tenths;
}

void pel_generate_shepp_logan(const struct pel_generate_row *row, float *values) {
    for (int i = 0; i < row->count; i++)
        values[i] = 0;
    for (int e = 0; e < ELLIPSOID_COUNT; e++)
        add_ellipsoid(e, row, values);
    for (int i = 0; i < row->count; i++)
        values[i] /= 10;
}
