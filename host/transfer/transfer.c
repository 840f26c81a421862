// transfer.c - transfer functions: two piecewise linear curves over the value.
//
// Both curves are found alike: the last point at or below the value is the segment's start. With
// two points of one value that is the later one, so a step takes effect at the value itself.
#include "transfer/transfer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

struct pel_transfer *pel_transfer_create(int colour_count, int opacity_count) {
    struct pel_transfer *transfer = pel_allocate(1, sizeof *transfer);
    if (!transfer)
        return NULL;
    *transfer = (struct pel_transfer){
        .colours = pel_allocate((size_t)colour_count, sizeof *transfer->colours),
        .opacities = pel_allocate((size_t)opacity_count, sizeof *transfer->opacities),
        .colour_count = colour_count,
        .opacity_count = opacity_count,
        .opacity_unit_mm = 1,
    };
    if (!transfer->colours || !transfer->opacities) {
        pel_transfer_destroy(transfer);
        return NULL;
    }
    return transfer;
}

void pel_transfer_destroy(struct pel_transfer *transfer) {
    if (!transfer)
        return;
    free(transfer->colours);
    free(transfer->opacities);
    free(transfer);
}

struct pel_transfer *pel_transfer_copy(const struct pel_transfer *transfer) {
    struct pel_transfer *copy =
        pel_transfer_create(transfer->colour_count, transfer->opacity_count);
    if (!copy)
        return NULL;
    struct pel_colour_point *colours = copy->colours;
    struct pel_opacity_point *opacities = copy->opacities;
    *copy = *transfer;
    copy->colours = colours;
    copy->opacities = opacities;
    memcpy(colours, transfer->colours, (size_t)copy->colour_count * sizeof *colours);
    memcpy(opacities, transfer->opacities, (size_t)copy->opacity_count * sizeof *opacities);
    return copy;
}

static bool check_value(const struct pel_transfer *transfer, const char *curve, int point,
                        double value, double before) {
    if (!(fabs(value) <= PEL_TRANSFER_VALUE_MAX))
        return pel_fail(PEL_ERROR_FORMAT, "%s point %d: value %g is beyond %g", curve, point, value,
                        PEL_TRANSFER_VALUE_MAX);
    if (transfer->scale == PEL_VALUES_PERCENTILE && (value < 0 || value > 100))
        return pel_fail(PEL_ERROR_FORMAT, "%s point %d: percentile %g is outside 0..100", curve,
                        point, value);
    if (value < before)
        return pel_fail(PEL_ERROR_FORMAT, "%s point %d: value %g is less than %g before it", curve,
                        point, value, before);
    return true;
}

bool pel_transfer_check_colour(const struct pel_transfer *transfer, int point) {
    static const char *const channels[] = {"red", "green", "blue"};
    const struct pel_colour_point *colour = &transfer->colours[point];
    for (int i = 0; i < 3; i++)
        if (!(colour->rgb[i] >= 0 && colour->rgb[i] <= 1))
            return pel_fail(PEL_ERROR_FORMAT, "colour point %d: %s %g is outside 0..1", point,
                            channels[i], colour->rgb[i]);
    return check_value(transfer, "colour", point, colour->value,
                       point ? colour[-1].value : -INFINITY);
}

bool pel_transfer_check_opacity(const struct pel_transfer *transfer, int point) {
    const struct pel_opacity_point *opacity = &transfer->opacities[point];
    if (!(opacity->opacity >= 0 && opacity->opacity <= 1))
        return pel_fail(PEL_ERROR_FORMAT, "opacity point %d: opacity %g is outside 0..1", point,
                        opacity->opacity);
    return check_value(transfer, "opacity", point, opacity->value,
                       point ? opacity[-1].value : -INFINITY);
}

bool pel_transfer_check(const struct pel_transfer *transfer) {
    if (transfer->colour_count < 1 || transfer->opacity_count < 1)
        return pel_fail(PEL_ERROR_FORMAT, "%d colour points and %d opacity points, not 1 or more",
                        transfer->colour_count, transfer->opacity_count);
    if (!(transfer->opacity_unit_mm > 0 && transfer->opacity_unit_mm <= PEL_TRANSFER_VALUE_MAX))
        return pel_fail(PEL_ERROR_FORMAT, "opacity unit of %g mm is not a positive length",
                        transfer->opacity_unit_mm);
    if (transfer->table_entries != 0 && (transfer->table_entries < PEL_TRANSFER_ENTRIES_MIN ||
                                         transfer->table_entries > PEL_TRANSFER_ENTRIES_MAX))
        return pel_fail(PEL_ERROR_FORMAT, "%d table entries are outside %d..%d",
                        transfer->table_entries, PEL_TRANSFER_ENTRIES_MIN,
                        PEL_TRANSFER_ENTRIES_MAX);
    for (int i = 0; i < transfer->colour_count; i++)
        if (!pel_transfer_check_colour(transfer, i))
            return false;
    for (int i = 0; i < transfer->opacity_count; i++)
        if (!pel_transfer_check_opacity(transfer, i))
            return false;
    return true;
}

// The percentiles are known at whole percents, and linear between.
static double value_of_percentile(const struct pel_statistics *statistics, double percent) {
    double clamped = fmin(fmax(percent, 0), 100);
    int below = (int)fmin(clamped, 99);
    double share = clamped - below;
    return (1 - share) * statistics->percentiles[below] +
           share * statistics->percentiles[below + 1];
}

static double resolve(const struct pel_transfer *transfer, const struct pel_statistics *statistics,
                      double value) {
    switch (transfer->scale) {
    case PEL_VALUES_RELATIVE:
        return statistics->min + value * (statistics->max - statistics->min);
    case PEL_VALUES_PERCENTILE:
        return value_of_percentile(statistics, value);
    case PEL_VALUES_ABSOLUTE:
        break;
    }
    return value;
}

// Rounding may put a value a last digit below its predecessor, so each is at least that.
void pel_transfer_resolve(struct pel_transfer *transfer, const struct pel_statistics *statistics) {
    double before = -INFINITY;
    for (int i = 0; i < transfer->colour_count; i++) {
        double *value = &transfer->colours[i].value;
        before = *value = fmax(before, resolve(transfer, statistics, *value));
    }
    before = -INFINITY;
    for (int i = 0; i < transfer->opacity_count; i++) {
        double *value = &transfer->opacities[i].value;
        before = *value = fmax(before, resolve(transfer, statistics, *value));
    }
    transfer->scale = PEL_VALUES_ABSOLUTE;
}

void pel_transfer_stretch(struct pel_transfer *transfer, double low, double high) {
    struct pel_statistics range = {.min = low, .max = high};
    transfer->scale = PEL_VALUES_RELATIVE;
    pel_transfer_resolve(transfer, &range);
}

// The share of the way from value a to value b, a <= value < b.
static double share_of(double value, double a, double b) {
    return (value - a) / (b - a);
}

static void evaluate_colour(const struct pel_transfer *transfer, double value, double rgb[3]) {
    const struct pel_colour_point *points = transfer->colours;
    int low = 0, high = transfer->colour_count;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (points[middle].value <= value)
            low = middle + 1;
        else
            high = middle;
    }
    const struct pel_colour_point *a = &points[low > 0 ? low - 1 : 0];
    const struct pel_colour_point *b = &points[low < transfer->colour_count ? low : low - 1];
    double share = a == b ? 0 : share_of(value, a->value, b->value);
    for (int i = 0; i < 3; i++)
        rgb[i] = (1 - share) * a->rgb[i] + share * b->rgb[i];
}

static double evaluate_opacity(const struct pel_transfer *transfer, double value) {
    const struct pel_opacity_point *points = transfer->opacities;
    int low = 0, high = transfer->opacity_count;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (points[middle].value <= value)
            low = middle + 1;
        else
            high = middle;
    }
    const struct pel_opacity_point *a = &points[low > 0 ? low - 1 : 0];
    const struct pel_opacity_point *b = &points[low < transfer->opacity_count ? low : low - 1];
    double share = a == b ? 0 : share_of(value, a->value, b->value);
    return (1 - share) * a->opacity + share * b->opacity;
}

void pel_transfer_evaluate(const struct pel_transfer *transfer, double value, double rgba[4]) {
    evaluate_colour(transfer, value, rgba);
    rgba[3] = evaluate_opacity(transfer, value);
}
