// convert.c - a volume in another voxel type.
//
// Between integers, and from integers to float, raw values stay what they are, and with them slope
// and intercept. A float becomes an integer through a line of its own that maps the range of the
// present values onto the whole range of the type, except in label volumes, where a rescaled number
// would name another label. A colour becomes grey by its value (alpha, or luminance), and grey
// becomes a colour of that grey; the alpha of a volume that had none is its value, so that the
// value stays the same.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "volume/row.h"
#include "volume/volume.h"

// raw of the target = scale * raw of the source + offset
struct line {
    double scale, offset;
};

static double value_of(const double *channels, int count) {
    if (count == 4)
        return channels[3];
    if (count == 3)
        return 0.2126 * channels[0] + 0.7152 * channels[1] + 0.0722 * channels[2];
    return channels[0];
}

// Makes the channels of one voxel of another kind; 1, 3 and 4 channels.
static void convert_channels(double *out, int out_count, const double *in, int in_count) {
    if (out_count == in_count || (out_count == 3 && in_count == 4)) {
        memcpy(out, in, (size_t)out_count * sizeof *out);
        return;
    }
    double value = value_of(in, in_count);
    for (int c = 0; c < out_count; c++)
        out[c] = c < 3 && in_count > 1 && out_count > 1 ? in[c] : value;
}

// The line onto the whole range of `type`, and how many voxels are absent.
static struct line whole_range(const struct pel_volume *source, enum pel_voxel_type type,
                               double *row, size_t *absent_count) {
    double low = INFINITY, high = -INFINITY, type_low, type_high;
    *absent_count = 0;
    for (int k = 0; k < source->dims[2]; k++) {
        for (int j = 0; j < source->dims[1]; j++) {
            pel_row_read(source, j, k, row);
            for (int i = 0; i < source->dims[0]; i++) {
                *absent_count += !isfinite(row[i]);
                low = isfinite(row[i]) && row[i] < low ? row[i] : low;
                high = isfinite(row[i]) && row[i] > high ? row[i] : high;
            }
        }
    }
    pel_row_type_range(type, &type_low, &type_high);
    if (source->labels)
        return (struct line){1, 0};
    if (!(high > low))
        return (struct line){1, isfinite(low) ? type_low - low : 0};
    double scale = (type_high - type_low) / (high - low);
    return (struct line){scale, type_low - low * scale};
}

static size_t convert(struct pel_volume *result, const struct pel_volume *source, struct line line,
                      double *in, double *out) {
    int in_count = pel_row_channels(source->type), out_count = pel_row_channels(result->type);
    size_t clamped = 0;
    for (int k = 0; k < source->dims[2]; k++) {
        for (int j = 0; j < source->dims[1]; j++) {
            pel_row_read(source, j, k, in);
            for (int i = 0; i < source->dims[0]; i++) {
                double *voxel = out + i * out_count;
                convert_channels(voxel, out_count, in + i * in_count, in_count);
                for (int c = 0; c < out_count; c++)
                    voxel[c] = line.scale * voxel[c] + line.offset;
            }
            clamped += pel_row_write(result, j, k, out);
        }
    }
    return clamped;
}

static void convert_warn(const struct pel_volume *source, const struct pel_volume *result,
                         size_t clamped, size_t absent_count) {
    const char *type = pel_voxel_type_name(result->type);
    if (clamped > 0)
        pel_warn("%s: %zu values do not fit %s and were clamped", source->name, clamped, type);
    if (absent_count > 0 && result->type != PEL_VOXEL_F32)
        pel_warn("%s: %s has no absent voxels; %zu became its least value", source->name, type,
                 absent_count);
    if (source->type == PEL_VOXEL_RGBA8 && result->type == PEL_VOXEL_RGB8)
        pel_warn("%s: alpha was dropped; the value of a voxel is its luminance now", source->name);
}

struct pel_volume *pel_volume_convert(const struct pel_volume *source, enum pel_voxel_type type) {
    if (!pel_volume_check_voxels(source))
        return NULL;
    struct pel_volume *result = pel_volume_create(source->name, source->dims, type);
    size_t count = (size_t)source->dims[0] * 4;
    double *in = pel_allocate(count, sizeof *in), *out = pel_allocate(count, sizeof *out);
    if (!result || !in || !out) {
        pel_volume_destroy(result);
        result = NULL;
        goto done;
    }
    result->world_from_voxel = source->world_from_voxel;
    result->slope = source->slope;
    result->intercept = source->intercept;
    memcpy(result->unit, source->unit, sizeof result->unit);
    memcpy(result->space, source->space, sizeof result->space);
    result->labels = source->labels;
    struct line line = {1, 0};
    size_t absent_count = 0;
    if (source->type == PEL_VOXEL_F32 && type != PEL_VOXEL_F32) {
        line = whole_range(source, type, in, &absent_count);
        result->slope = source->slope / line.scale;
        result->intercept = source->intercept - result->slope * line.offset;
    }
    convert_warn(source, result, convert(result, source, line, in, out), absent_count);
done:
    free(in);
    free(out);
    return result;
}
