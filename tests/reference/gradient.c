// gradient.c - docs/picture.md, "Gradients".
#include "reference/gradient.h"

#include <math.h>

// The value at a place; `value` where it is absent.
static double value_at(const struct reference_body *body, enum pel_filter filter,
                       const double p_voxel[3], double value, double *spread) {
    struct reference_sample sample;
    if (!reference_sample_volume(&sample, body->volume, filter, p_voxel))
        return value;
    *spread = fmax(*spread, sample.spread);
    return sample.value;
}

static double moved_value(const struct reference_body *body, const double p_voxel[3], int i, int j,
                          int k, double value, double *spread) {
    const double moved[3] = {p_voxel[0] + i, p_voxel[1] + j, p_voxel[2] + k};
    return value_at(body, body->instance->filter, moved, value, spread);
}

// The product of a central difference along one axis and 1-2-1 along the two others.
static void sobel(double along[3], const struct reference_body *body, const double p_voxel[3],
                  double value, double *spread) {
    static const double difference[3] = {-0.5, 0, 0.5}, smooth[3] = {0.25, 0.5, 0.25};
    along[0] = along[1] = along[2] = 0;
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++)
            for (int i = 0; i < 3; i++) {
                double v = moved_value(body, p_voxel, i - 1, j - 1, k - 1, value, spread);
                along[0] += difference[i] * smooth[j] * smooth[k] * v;
                along[1] += smooth[i] * difference[j] * smooth[k] * v;
                along[2] += smooth[i] * smooth[j] * difference[k] * v;
            }
}

// A filter is a polynomial between voxels: of degree 1 or 3 along each axis. Differences of so few
// points within a cell give its derivative exactly, but for rounding.
static void analytic(double along[3], const struct reference_body *body, const double p_voxel[3],
                     double value, double *spread) {
    enum pel_filter filter = body->instance->filter;
    bool cubic = filter == PEL_FILTER_CUBIC_B_SPLINE || filter == PEL_FILTER_CATMULL_ROM;
    for (int axis = 0; axis < 3; axis++) {
        double cell = floor(p_voxel[axis]), f = p_voxel[axis] - cell;
        // Lagrange's polynomial through so many places of the cell, differentiated at f.
        const double places[4] = {0, cubic ? 1 / 3.0 : 1 - 1e-9, 2 / 3.0, 1 - 1e-9};
        int count = cubic ? 4 : 2;
        along[axis] = 0;
        for (int n = 0; n < count; n++) {
            double slope = 0, moved[3] = {p_voxel[0], p_voxel[1], p_voxel[2]};
            for (int skipped = 0; skipped < count; skipped++) {
                if (skipped == n)
                    continue;
                double product = 1 / (places[n] - places[skipped]);
                for (int m = 0; m < count; m++)
                    if (m != n && m != skipped)
                        product *= (f - places[m]) / (places[n] - places[m]);
                slope += product;
            }
            moved[axis] = cell + places[n];
            along[axis] +=
                slope * value_at(body, cubic ? filter : PEL_FILTER_LINEAR, moved, value, spread);
        }
    }
}

void reference_gradient(double along[3], const struct reference_body *body, const double p_voxel[3],
                        double value, double *spread) {
    *spread = 0;
    if (body->instance->gradient == PEL_GRADIENT_SOBEL) {
        sobel(along, body, p_voxel, value, spread);
        return;
    }
    if (body->instance->gradient == PEL_GRADIENT_ANALYTIC) {
        analytic(along, body, p_voxel, value, spread);
        return;
    }
    for (int axis = 0; axis < 3; axis++) {
        double values[2];
        for (int side = 0; side < 2; side++) {
            int step[3] = {0, 0, 0};
            step[axis] = side == 0 ? -1 : 1;
            values[side] = moved_value(body, p_voxel, step[0], step[1], step[2], value, spread);
        }
        along[axis] = (values[1] - values[0]) / 2;
    }
}
