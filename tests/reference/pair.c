// pair.c - docs/picture.md, "Pre-integration".
//
// Every pair that is asked for is integrated numerically, in many small steps.
#include "reference/pair.h"

#include <math.h>
#include <stdlib.h>

enum { VALUES = 256 };

double (*reference_pairs_create(void))[4] {
    double(*pairs)[4] = malloc(sizeof *pairs * VALUES * VALUES);
    if (!pairs)
        abort();
    for (int i = 0; i < VALUES * VALUES; i++)
        pairs[i][0] = NAN;
    return pairs;
}

bool reference_is_preintegrated(const struct pel_scene *scene,
                                const struct pel_instance *instance) {
    enum pel_model model =
        instance->model != PEL_MODEL_DEFAULT ? instance->model : scene->render.model;
    return (scene->render.preintegration || instance->preintegration) &&
           (model == PEL_MODEL_DEFAULT || model == PEL_MODEL_ABSORPTION);
}

// Depth and straight colour of the step from value number f to value number b.
static void integrate(double pair[4], const struct reference_body *body, int f, int b,
                      double step_mm) {
    const struct reference_table *table = &body->table;
    const double first = body->pair_range[0], apart = (body->pair_range[1] - first) / (VALUES - 1);
    int count = 40 * (abs(b - f) > 0 ? abs(b - f) : 1);
    double depth = 0, rgb[3] = {0};
    for (int n = 0; n < count; n++) {
        double number = f + (b - f) * (n + 0.5) / count;
        struct reference_sample sample = {.value = first + number * apart};
        struct reference_medium medium = reference_classify(body->instance, table, &sample);
        double part = medium.extinction * step_mm / count;
        for (int c = 0; c < 3; c++)
            rgb[c] += exp(-depth) * (1 - exp(-part)) * medium.rgb[c];
        depth += part;
    }
    pair[0] = depth;
    for (int c = 0; c < 3; c++)
        pair[1 + c] = depth > 0 ? rgb[c] / (1 - exp(-depth)) : 0;
}

struct reference_medium reference_pair(const struct reference_body *body, double front, double back,
                                       double step_mm) {
    double values[2] = {front, back}, weights[2];
    int below[2];
    for (int n = 0; n < 2; n++) {
        double x = (values[n] - body->pair_range[0]) / (body->pair_range[1] - body->pair_range[0]);
        x = fmin(fmax(x, 0), 1) * (VALUES - 1);
        below[n] = (int)fmin(floor(x), VALUES - 2);
        weights[n] = x - below[n];
    }
    double depth = 0, weighted[3] = {0};
    for (int n = 0; n < 4; n++) {
        int f = below[0] + n / 2, b = below[1] + n % 2;
        double *pair = body->pairs[f * VALUES + b];
        if (isnan(pair[0]))
            integrate(pair, body, f, b, step_mm);
        double weight =
            (n / 2 ? weights[0] : 1 - weights[0]) * (n % 2 ? weights[1] : 1 - weights[1]) * pair[0];
        depth += weight;
        for (int c = 0; c < 3; c++)
            weighted[c] += weight * pair[1 + c];
    }
    struct reference_medium medium = {.extinction = depth / step_mm};
    for (int c = 0; c < 3; c++)
        medium.rgb[c] = depth > 0 ? weighted[c] / depth : 0;
    return medium;
}
