// blend.c - what is between two transfer functions.
//
// Both curves are handled as points of a value and up to three channels. A mix of two piecewise
// linear functions bends only where one of them does. Where one of them jumps, so does the mix: the
// curve then gets two points of one value, the limits from below and from above.
#include "transfer/blend.h"

#include <stdlib.h>

#include "base/memory.h"
#include "transfer/transfer.h"

struct point {
    double value, channels[3];
};

struct curve {
    struct point *points;
    int count;
};

static double mix(double a, double b, double share) {
    return (1 - share) * a + share * b;
}

// The curve at a value, coming from below or from above.
static void evaluate(const struct curve *curve, double value, bool from_below, double channels[3]) {
    const struct point *points = curve->points;
    int next = 0;
    while (next < curve->count &&
           (from_below ? points[next].value < value : points[next].value <= value))
        next++;
    const struct point *a = &points[next > 0 ? next - 1 : 0];
    const struct point *b = &points[next < curve->count ? next : curve->count - 1];
    double length = b->value - a->value;
    double share = length > 0 ? (value - a->value) / length : from_below;
    for (int i = 0; i < 3; i++)
        channels[i] = mix(a->channels[i], b->channels[i], share);
}

static int compare_values(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// The mix of two curves wherever either bends. `out` has room for two points of each in both.
static void mix_functions(struct curve *out, const struct curve *a, const struct curve *b,
                          double values[], double share) {
    int count = 0;
    for (int i = 0; i < a->count; i++)
        values[count++] = a->points[i].value;
    for (int i = 0; i < b->count; i++)
        values[count++] = b->points[i].value;
    qsort(values, (size_t)count, sizeof *values, compare_values);
    for (int i = 0; i < count; i++) {
        if (i > 0 && values[i] == values[i - 1])
            continue;
        for (int side = 0; side < 2; side++) {
            struct point *point = &out->points[out->count];
            double of_a[3], of_b[3];
            evaluate(a, values[i], side == 0, of_a);
            evaluate(b, values[i], side == 0, of_b);
            bool jumps = false;
            point->value = values[i];
            for (int c = 0; c < 3; c++) {
                point->channels[c] = mix(of_a[c], of_b[c], share);
                jumps |= side == 1 && point->channels[c] != point[-1].channels[c];
            }
            out->count += side == 0 || jumps;
        }
    }
}

static bool blend_curves(struct curve *out, const struct curve *a, const struct curve *b,
                         double share) {
    size_t most = (size_t)a->count + (size_t)b->count;
    *out = (struct curve){.points = pel_allocate(2 * most + 1, sizeof *out->points)};
    double *values = pel_allocate(most, sizeof *values);
    bool good = out->points && values;
    if (good && a->count == b->count) {
        out->count = a->count;
        for (int i = 0; i < a->count; i++) {
            out->points[i].value = mix(a->points[i].value, b->points[i].value, share);
            for (int c = 0; c < 3; c++)
                out->points[i].channels[c] =
                    mix(a->points[i].channels[c], b->points[i].channels[c], share);
        }
    } else if (good) {
        mix_functions(out, a, b, values, share);
    }
    free(values);
    return good;
}

static bool read_colours(struct curve *curve, const struct pel_transfer *transfer) {
    curve->count = transfer->colour_count;
    curve->points = pel_allocate((size_t)curve->count, sizeof *curve->points);
    for (int i = 0; curve->points && i < curve->count; i++) {
        const struct pel_colour_point *colour = &transfer->colours[i];
        curve->points[i] =
            (struct point){colour->value, {colour->rgb[0], colour->rgb[1], colour->rgb[2]}};
    }
    return curve->points != NULL;
}

static bool read_opacities(struct curve *curve, const struct pel_transfer *transfer) {
    curve->count = transfer->opacity_count;
    curve->points = pel_allocate((size_t)curve->count, sizeof *curve->points);
    for (int i = 0; curve->points && i < curve->count; i++)
        curve->points[i] =
            (struct point){transfer->opacities[i].value, {transfer->opacities[i].opacity}};
    return curve->points != NULL;
}

static struct pel_transfer *write_transfer(const struct curve *colours,
                                           const struct curve *opacities) {
    struct pel_transfer *transfer = pel_transfer_create(colours->count, opacities->count);
    if (!transfer)
        return NULL;
    for (int i = 0; i < colours->count; i++) {
        const struct point *point = &colours->points[i];
        transfer->colours[i] = (struct pel_colour_point){
            point->value, {point->channels[0], point->channels[1], point->channels[2]}};
    }
    for (int i = 0; i < opacities->count; i++)
        transfer->opacities[i] = (struct pel_opacity_point){opacities->points[i].value,
                                                            opacities->points[i].channels[0]};
    return transfer;
}

struct pel_transfer *pel_transfer_blend(const struct pel_transfer *a, const struct pel_transfer *b,
                                        double share) {
    // Colours and opacities of a, of b, and mixed.
    struct curve curves[3][2] = {{{0}}};
    struct pel_transfer *transfer = NULL;
    if (read_colours(&curves[0][0], a) && read_opacities(&curves[0][1], a) &&
        read_colours(&curves[1][0], b) && read_opacities(&curves[1][1], b) &&
        blend_curves(&curves[2][0], &curves[0][0], &curves[1][0], share) &&
        blend_curves(&curves[2][1], &curves[0][1], &curves[1][1], share))
        transfer = write_transfer(&curves[2][0], &curves[2][1]);
    if (transfer) {
        transfer->scale = a->scale;
        transfer->opacity_unit_mm = mix(a->opacity_unit_mm, b->opacity_unit_mm, share);
        transfer->nearest = a->nearest;
        transfer->table_entries = a->table_entries;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 2; j++)
            free(curves[i][j].points);
    return transfer;
}
