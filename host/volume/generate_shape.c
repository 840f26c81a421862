// generate_shape.c - fields that are one formula: sphere, box, shells, Marschner-Lobb.
#include "volume/generate.h"

#include <math.h>

#include "base/math.h"

// Signed distance to a sphere, positive inside: its iso-surface at v is the sphere of radius R - v.
void pel_generate_sphere(const struct pel_generate_row *row, float *values) {
    double yz2 = row->start[1] * row->start[1] + row->start[2] * row->start[2];
    for (int i = 0; i < row->count; i++) {
        double x = row->start[0] + i * row->spacing[0];
        values[i] = (float)(PEL_SPHERE_RADIUS_MM - sqrt(x * x + yz2));
    }
}

// The share of the cell [centre - spacing/2, centre + spacing/2] that lies in [-half, half].
static double covered(double centre, double spacing, double half) {
    double low = fmax(centre - spacing / 2, -half), high = fmin(centre + spacing / 2, half);
    return fmax(high - low, 0) / spacing;
}

// A solid box of 40 x 28 x 20 mm. A voxel holds the share of its cell that is in the box, so the
// sum over all cells is the box's volume at any resolution.
void pel_generate_box(const struct pel_generate_row *row, float *values) {
    double yz =
        covered(row->start[1], row->spacing[1], 14) * covered(row->start[2], row->spacing[2], 10);
    for (int i = 0; i < row->count; i++) {
        double x = row->start[0] + i * row->spacing[0];
        values[i] = (float)(yz * covered(x, row->spacing[0], 20));
    }
}

// Five concentric shells of radius 6, 12 ... 30 mm and value 0.2, 0.4 ... 1. Across a shell the
// value is a Gaussian of 0.75 mm standard deviation: neighbours are 8 deviations away.
void pel_generate_shells(const struct pel_generate_row *row, float *values) {
    const double distance = 6, deviation = 0.75;
    double yz2 = row->start[1] * row->start[1] + row->start[2] * row->start[2];
    for (int i = 0; i < row->count; i++) {
        double x = row->start[0] + i * row->spacing[0];
        double radius = sqrt(x * x + yz2);
        double shell = fmin(fmax(floor(radius / distance + 0.5), 1), 5);
        double u = (radius - shell * distance) / deviation;
        values[i] = (float)(shell / 5 * exp(-u * u / 2));
    }
}

// Marschner & Lobb, "An evaluation of reconstruction filters for volume rendering", Visualization
// 1994, with their fM = 6 and alpha = 0.25 over [-1, 1]^3.
void pel_generate_marschner_lobb(const struct pel_generate_row *row, float *values) {
    const double fm = 6, alpha = 0.25;
    double y = row->start[1] / PEL_MARSCHNER_LOBB_UNIT_MM;
    double z = row->start[2] / PEL_MARSCHNER_LOBB_UNIT_MM;
    double base = 1 - sin(PEL_PI * z / 2);
    for (int i = 0; i < row->count; i++) {
        double x = (row->start[0] + i * row->spacing[0]) / PEL_MARSCHNER_LOBB_UNIT_MM;
        double rho = cos(2 * PEL_PI * fm * cos(PEL_PI / 2 * sqrt(x * x + y * y)));
        values[i] = (float)((base + alpha * (1 + rho)) / (2 * (1 + alpha)));
    }
}
