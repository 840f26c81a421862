// widen.c - from the number types files hold to the few a renderer wants.
#include "volume/widen.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "volume/volume.h"

static const char *const wide_names[] = {"int32", "uint32", "int64", "uint64", "float64"};

static const size_t element_bytes[] = {1, 1, 2, 2, 4, 4, 4, 8, 8, 8};

// An integer of any of the wide types.
struct integer {
    bool negative;
    uint64_t magnitude;
};

static struct integer integer_at(enum pel_wide_type type, const void *values, size_t i) {
    int64_t value;
    switch (type) {
    case PEL_WIDE_I32:
        value = ((const int32_t *)values)[i];
        break;
    case PEL_WIDE_U32:
        value = ((const uint32_t *)values)[i];
        break;
    case PEL_WIDE_I64:
        value = ((const int64_t *)values)[i];
        break;
    default:
        return (struct integer){false, ((const uint64_t *)values)[i]};
    }
    // The negation is unsigned, because INT64_MIN has no positive counterpart.
    return (struct integer){value < 0, value < 0 ? -(uint64_t)value : (uint64_t)value};
}

// A float holds an integer exactly when its significant bits span no more than 24.
static bool float_is_exact(uint64_t magnitude) {
    return magnitude == 0 || magnitude >> __builtin_ctzll(magnitude) < (uint64_t)1 << 24;
}

// The narrowest of int16, uint16 and float32 that holds every value, or float32.
static enum pel_voxel_type type_for_integers(enum pel_wide_type type, const void *values,
                                             size_t count) {
    uint64_t most_positive = 0, most_negative = 0;
    for (size_t i = 0; i < count; i++) {
        struct integer value = integer_at(type, values, i);
        uint64_t *most = value.negative ? &most_negative : &most_positive;
        if (value.magnitude > *most)
            *most = value.magnitude;
    }
    if (most_positive <= INT16_MAX && most_negative <= (uint64_t)INT16_MAX + 1)
        return PEL_VOXEL_I16;
    return most_positive <= UINT16_MAX && most_negative == 0 ? PEL_VOXEL_U16 : PEL_VOXEL_F32;
}

// Returns how many values were rounded.
static size_t copy_integers(struct pel_volume *volume, enum pel_wide_type type, const void *values,
                            size_t count) {
    size_t rounded = 0;
    for (size_t i = 0; i < count; i++) {
        struct integer value = integer_at(type, values, i);
        int64_t small = value.negative ? -(int64_t)(value.magnitude & INT64_MAX)
                                       : (int64_t)(value.magnitude & INT64_MAX);
        if (volume->type == PEL_VOXEL_I16) {
            ((int16_t *)volume->voxels)[i] = (int16_t)small;
        } else if (volume->type == PEL_VOXEL_U16) {
            ((uint16_t *)volume->voxels)[i] = (uint16_t)small;
        } else {
            float rounded_magnitude = (float)value.magnitude;
            ((float *)volume->voxels)[i] = value.negative ? -rounded_magnitude : rounded_magnitude;
            rounded += !float_is_exact(value.magnitude);
        }
    }
    return rounded;
}

// Returns how many values were rounded. What a float cannot reach is absent.
static size_t copy_doubles(struct pel_volume *volume, const double *values, size_t count) {
    size_t rounded = 0;
    for (size_t i = 0; i < count; i++) {
        float value = fabs(values[i]) <= FLT_MAX ? (float)values[i] : NAN;
        ((float *)volume->voxels)[i] = value;
        rounded += isfinite(values[i]) && (double)value != values[i];
    }
    return rounded;
}

struct pel_volume *pel_volume_from_wide(const char *name, const int dims[3],
                                        enum pel_wide_type type, const void *values) {
    size_t count;
    size_t factors[] = {(size_t)dims[0], (size_t)dims[1], (size_t)dims[2]};
    if (!pel_size_multiply(&count, 3, factors))
        return NULL;
    enum pel_voxel_type to =
        type == PEL_WIDE_F64 ? PEL_VOXEL_F32 : type_for_integers(type, values, count);
    struct pel_volume *volume = pel_volume_create(name, dims, to);
    if (!volume)
        return NULL;
    size_t rounded = type == PEL_WIDE_F64 ? copy_doubles(volume, values, count)
                                          : copy_integers(volume, type, values, count);
    pel_volume_mark_absent(volume);
    if (rounded > 0)
        pel_warn("%s: %zu of %zu values were rounded from %s to float32", name, rounded, count,
                 wide_names[type]);
    return volume;
}

size_t pel_element_bytes(enum pel_element element) {
    return element_bytes[element];
}

enum pel_wide_type pel_element_wide(enum pel_element element) {
    return (enum pel_wide_type)(element - PEL_ELEMENT_I32);
}

bool pel_little_endian(void) {
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 1;
}

void pel_swap_bytes(void *values, size_t count, size_t bytes) {
    unsigned char *element = values;
    for (size_t i = 0; i < count; i++, element += bytes) {
        for (size_t low = 0, high = bytes - 1; low < high; low++, high--) {
            unsigned char swapped = element[low];
            element[low] = element[high];
            element[high] = swapped;
        }
    }
}

// Copies the selected elements to `out`, without gaps.
static void gather(const struct pel_selection *selection, const unsigned char *block,
                   unsigned char *out) {
    size_t bytes = pel_element_bytes(selection->element);
    size_t components = (size_t)selection->components, row = (size_t)selection->dims[0];
    bool dense =
        selection->stride[0] == components && (components == 1 || selection->component_stride == 1);
    for (size_t k = 0; k < (size_t)selection->dims[2]; k++) {
        for (size_t j = 0; j < (size_t)selection->dims[1]; j++) {
            const unsigned char *from =
                block +
                bytes * (selection->first + k * selection->stride[2] + j * selection->stride[1]);
            if (dense) {
                memcpy(out, from, bytes * row * components);
                out += bytes * row * components;
                continue;
            }
            for (size_t i = 0; i < row; i++)
                for (size_t c = 0; c < components; c++, out += bytes)
                    memcpy(out,
                           from +
                               bytes * (i * selection->stride[0] + c * selection->component_stride),
                           bytes);
        }
    }
}

bool pel_select_channel(struct pel_selection *selection, const char *name, int64_t channels,
                        size_t stride, const struct pel_load_options *options) {
    selection->components = 1;
    if ((channels == 3 || channels == 4) && selection->element == PEL_ELEMENT_U8 &&
        !options->split_channels) {
        selection->components = (int)channels;
        selection->component_stride = stride;
        return true;
    }
    if (options->channel < 0 || options->channel >= channels)
        return pel_fail(PEL_ERROR_ARGUMENT, "no channel %d, the file has %lld", options->channel,
                        (long long)channels);
    if (channels > 1 && options->channel == 0 && !options->split_channels)
        pel_warn("%s: %lld channels, only the first is read; 'channel' chooses another", name,
                 (long long)channels);
    selection->first += (size_t)options->channel * stride;
    return true;
}

bool pel_select_time(struct pel_selection *selection, const char *name, int64_t steps,
                     size_t stride, const struct pel_load_options *options) {
    if (options->time < 0 || options->time >= steps)
        return pel_fail(PEL_ERROR_ARGUMENT, "no time step %d, the file has %lld", options->time,
                        (long long)steps);
    if (steps > 1 && options->time == 0)
        pel_warn("%s: %lld time steps, only the first is read; 'time' chooses another", name,
                 (long long)steps);
    selection->first += (size_t)options->time * stride;
    return true;
}

struct pel_volume *pel_volume_select(const char *name, const struct pel_selection *selection,
                                     const void *block) {
    size_t bytes = pel_element_bytes(selection->element), count;
    size_t factors[] = {(size_t)selection->dims[0], (size_t)selection->dims[1],
                        (size_t)selection->dims[2], (size_t)selection->components};
    if (!pel_size_multiply(&count, 4, factors))
        return NULL;
    if (selection->element > PEL_ELEMENT_F32) {
        if (count > SIZE_MAX / 16) {
            pel_fail(PEL_ERROR_MEMORY, "%zu values are beyond what can be addressed", count);
            return NULL;
        }
        void *values = pel_allocate_voxels(count * bytes);
        if (!values)
            return NULL;
        gather(selection, block, values);
        if (selection->swap)
            pel_swap_bytes(values, count, bytes);
        struct pel_volume *volume = pel_volume_from_wide(
            name, selection->dims, pel_element_wide(selection->element), values);
        free(values);
        return volume;
    }
    enum pel_voxel_type type = selection->components == 3 ? PEL_VOXEL_RGB8
                               : selection->components == 4
                                   ? PEL_VOXEL_RGBA8
                                   : (enum pel_voxel_type)selection->element;
    struct pel_volume *volume = pel_volume_create(name, selection->dims, type);
    if (!volume)
        return NULL;
    gather(selection, block, volume->voxels);
    if (selection->swap)
        pel_swap_bytes(volume->voxels, count, bytes);
    pel_volume_mark_absent(volume);
    return volume;
}
