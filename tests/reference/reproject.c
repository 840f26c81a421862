// reproject.c - the right second eye from a first one. For each pixel of the second picture, all
// pairs of neighbours of the first one are asked whether they come to lie around it.
#include "reference/reproject.h"

#include <math.h>

static double nearness(const struct reference_row *row, int i) {
    if (!row->orthographic)
        return 1 / (double)row->depth[i];
    return isinf(row->depth[i]) ? -1e30 : -row->lean * (i + 0.5) - row->fall * row->depth[i];
}

static double place(const struct reference_row *row, int i) {
    if (row->orthographic)
        return row->scale * (i + 0.5) + row->shift +
               row->slope * (isinf(row->depth[i]) ? row->empty : row->depth[i]);
    return i + 0.5 + row->shift - row->reach / (double)row->depth[i];
}

// The parts of one surface are between half a pixel and one and a half apart.
static bool torn(const struct reference_row *row, int i) {
    double apart = place(row, i + 1) - place(row, i);
    return apart < 0.5 || apart > 1.5;
}

// How near the nearest edge within a pixel of x is; -INFINITY without one.
static double nearest_edge(const struct reference_row *row, double x) {
    double nearest = -INFINITY;
    for (int i = 0; i < row->width; i++) {
        bool edge = (i > 0 && torn(row, i - 1)) || (i + 1 < row->width && torn(row, i));
        if (edge && fabs(place(row, i) - x) <= 1)
            nearest = fmax(nearest, nearness(row, i));
    }
    return nearest;
}

bool reference_reproject(double rgba[4], const struct reference_row *row, int k) {
    double x = k + 0.5, nearest = -INFINITY;
    for (int i = 0; i + 1 < row->width; i++) {
        double a = place(row, i), b = place(row, i + 1);
        if (torn(row, i) || x < a || x > b)
            continue;
        double share = (x - a) / (b - a);
        double near = nearness(row, i) + share * (nearness(row, i + 1) - nearness(row, i));
        if (near <= nearest)
            continue;
        nearest = near;
        for (int c = 0; c < 4; c++)
            rgba[c] = (1 - share) * row->rgba[i][c] + share * row->rgba[i + 1][c];
    }
    return nearest > -INFINITY && nearest_edge(row, x) < nearest;
}
