// classify.c - docs/picture.md, "Classification".
#include "reference/classify.h"

#include <math.h>
#include <stdlib.h>

// One column of control points at a value. A point is `width` numbers, its value first: so lie
// pel_colour_point and pel_opacity_point. Of two points of one value the later one counts.
static double interpolate(const double *points, int count, int width, int column, double value) {
    int i = count - 1;
    while (i > 0 && points[i * width] > value)
        i--;
    const double *point = points + i * width, *next = point + width;
    if (i == count - 1 || value <= point[0])
        return point[column];
    double share = (value - point[0]) / (next[0] - point[0]);
    return point[column] + share * (next[column] - point[column]);
}

static void evaluate(double rgba[4], const struct pel_transfer *transfer, double value) {
    const double *colours = (const double *)transfer->colours;
    for (int c = 0; c < 3; c++)
        rgba[c] = interpolate(colours, transfer->colour_count, 4, 1 + c, value);
    const double *opacities = (const double *)transfer->opacities;
    rgba[3] = interpolate(opacities, transfer->opacity_count, 2, 1, value);
}

// The raw values an 8-bit type can hold; false for wider types, whose tables follow their points.
static bool range_of_type(enum pel_voxel_type type, double range[2]) {
    switch (type) {
    case PEL_VOXEL_U8:
    case PEL_VOXEL_RGB8:
    case PEL_VOXEL_RGBA8:
        range[0] = 0, range[1] = 255;
        return true;
    case PEL_VOXEL_I8:
        range[0] = -128, range[1] = 127;
        return true;
    default:
        return false;
    }
}

static bool steps_at(const struct pel_transfer *transfer, double value) {
    const struct pel_colour_point *colours = transfer->colours;
    const struct pel_opacity_point *opacities = transfer->opacities;
    return (transfer->colour_count > 1 && colours[0].value == value && colours[1].value == value) ||
           (transfer->opacity_count > 1 && opacities[0].value == value &&
            opacities[1].value == value);
}

// Wider types: from the first to the last control point, or a little more where values below the
// first one would not show what is below it.
static void follow_points(struct reference_table *table, const struct pel_transfer *transfer) {
    double low = fmin(transfer->colours[0].value, transfer->opacities[0].value);
    double high = fmax(transfer->colours[transfer->colour_count - 1].value,
                       transfer->opacities[transfer->opacity_count - 1].value);
    if (high - low <= 0x1p-20 * fabs(high))
        low = high - 0x1p-10 * (high != 0 ? fabs(high) : 1);
    else if (steps_at(transfer, low))
        low -= (high - low) / (table->count - 2);
    table->low = low;
    table->high = high;
}

void reference_table_init(struct reference_table *table, const struct pel_transfer *transfer,
                          const struct pel_volume *volume) {
    double range[2];
    bool whole_type = range_of_type(volume->type, range);
    table->count = transfer->table_entries ? transfer->table_entries : whole_type ? 256 : 4096;
    table->nearest = transfer->nearest;
    if (whole_type) {
        double first = volume->slope * range[0] + volume->intercept;
        double last = volume->slope * range[1] + volume->intercept;
        table->low = fmin(first, last);
        table->high = fmax(first, last);
    } else {
        follow_points(table, transfer);
    }

    table->entries = malloc((size_t)table->count * sizeof *table->entries);
    if (!table->entries)
        abort();
    double spacing = (table->high - table->low) / (table->count - 1);
    // A step that falls on an entry should not miss it by rounding of the entry's value.
    for (int j = 0; j < table->count; j++)
        evaluate(table->entries[j], transfer, table->low + (j + 1e-9) * spacing);
}

void reference_table_finish(struct reference_table *table) {
    free(table->entries);
}

void reference_table_look_up(double rgba[4], const struct reference_table *table, double value) {
    // A table over a single value has one answer.
    double x = table->high > table->low
                   ? (value - table->low) / (table->high - table->low) * (table->count - 1)
                   : 0;
    x = fmin(fmax(x, 0), table->count - 1);
    int lower = table->nearest ? (int)floor(x + 0.5) : (int)floor(x);
    int upper = lower + 1 < table->count ? lower + 1 : lower;
    double share = table->nearest ? 0 : x - lower;
    for (int c = 0; c < 4; c++)
        rgba[c] = (1 - share) * table->entries[lower][c] + share * table->entries[upper][c];
}

struct reference_medium reference_classify(const struct pel_instance *instance,
                                           const struct reference_table *table,
                                           const struct reference_sample *sample) {
    double rgba[4];
    reference_table_look_up(rgba, table, sample->value);
    struct reference_medium medium = {
        .extinction = -log(1 - fmin(rgba[3], 1 - 0x1p-24)) / instance->transfer->opacity_unit_mm *
                      instance->density,
    };
    for (int c = 0; c < 3; c++)
        medium.rgb[c] = sample->coloured ? sample->rgb[c] : rgba[c];
    return medium;
}
