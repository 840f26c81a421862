// table.c - samples a transfer function.
#include "transfer/table.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/memory.h"
#include "transfer/transfer.h"

// How wide the table is when all control points share one value, as a share of that value: its
// ends must differ as floats, too.
static const double narrow = 0x1p-10;

// What rounding may take from the value of an entry, in distances between entries.
static const double rounding = 1e-6;

enum { entries_8_bit = 256, entries_wide = 4096 };

// The raw values a narrow type can hold; false for a wide type.
static bool raw_range(enum pel_voxel_type type, double *first, double *last) {
    switch (type) {
    case PEL_VOXEL_U8:
    case PEL_VOXEL_RGB8:
    case PEL_VOXEL_RGBA8:
        *first = 0, *last = 255;
        return true;
    case PEL_VOXEL_I8:
        *first = -128, *last = 127;
        return true;
    case PEL_VOXEL_U16:
    case PEL_VOXEL_I16:
    case PEL_VOXEL_F32:
        break;
    }
    return false;
}

static bool begins_with_step(const struct pel_transfer *transfer, double low) {
    return (transfer->colour_count > 1 && transfer->colours[0].value == low &&
            transfer->colours[1].value == low) ||
           (transfer->opacity_count > 1 && transfer->opacities[0].value == low &&
            transfer->opacities[1].value == low);
}

// From the first to the last control point. Values below are read from entry 0; so that they get
// what is below a step at the very first control point, the table then begins one entry before it.
static void control_range(struct pel_table *table, const struct pel_transfer *transfer) {
    double low = fmin(transfer->colours[0].value, transfer->opacities[0].value);
    double high = fmax(transfer->colours[transfer->colour_count - 1].value,
                       transfer->opacities[transfer->opacity_count - 1].value);
    double least = narrow * (low != 0 ? fabs(low) : 1);
    table->low = low;
    table->high = high;
    if (high - low <= 0x1p-20 * fabs(low)) // too close for floats; also low == high == 0
        table->low = low - least;
    else if (begins_with_step(transfer, low))
        table->low = low - (high - low) / (table->entry_count > 2 ? table->entry_count - 2 : 1);
}

bool pel_table_build(struct pel_table *table, const struct pel_transfer *resolved,
                     const struct pel_volume *volume) {
    assert(resolved->scale == PEL_VALUES_ABSOLUTE);
    *table = (struct pel_table){.nearest = resolved->nearest};
    if (!pel_transfer_check(resolved))
        return false;

    double first = 0, last = 0;
    bool whole = raw_range(volume->type, &first, &last);
    table->entry_count = resolved->table_entries ? resolved->table_entries
                         : whole                 ? entries_8_bit
                                                 : entries_wide;
    if (whole) {
        double a = volume->slope * first + volume->intercept;
        double b = volume->slope * last + volume->intercept;
        table->low = fmin(a, b);
        table->high = fmax(a, b);
    }
    // A slope that is lost beside the intercept makes a volume of one value. The control points
    // frame it as well as anything.
    if (!(table->low < table->high))
        control_range(table, resolved);

    table->rgba = pel_allocate((size_t)table->entry_count, sizeof *table->rgba);
    if (!table->rgba)
        return false;
    double range = table->high - table->low;
    for (int j = 0; j < table->entry_count; j++) {
        // A step that falls on an entry must not miss it for a rounding error of the value.
        double place = (j + rounding) / (table->entry_count - 1);
        double value = table->low + place * range;
        double rgba[4];
        pel_transfer_evaluate(resolved, value, rgba);
        for (int i = 0; i < 4; i++)
            table->rgba[j][i] = (float)rgba[i];
    }
    return true;
}

void pel_table_finish(struct pel_table *table) {
    free(table->rgba);
    *table = (struct pel_table){0};
}
