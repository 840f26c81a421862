// sample.c - one volume's value and look at a place of the world.
#include "viewer/sample.h"

#include "viewer/vector.h"

enum { CORNERS = 8, CHANNELS = 4 };

// The raw channels of a voxel: its value, and for colour volumes red, green and blue.
static void fetch(const struct pel_volume *volume, const int voxel[3], double channels[CHANNELS]) {
    channels[0] = pel_volume_value(volume, voxel[0], voxel[1], voxel[2]);
    int stride = volume->type == PEL_VOXEL_RGB8 ? 3 : 4;
    if (volume->type != PEL_VOXEL_RGB8 && volume->type != PEL_VOXEL_RGBA8)
        return;
    size_t index =
        ((size_t)voxel[2] * (size_t)volume->dims[1] + (size_t)voxel[1]) * (size_t)volume->dims[0] +
        (size_t)voxel[0];
    const uint8_t *bytes = (const uint8_t *)volume->voxels + (size_t)stride * index;
    for (int c = 0; c < 3; c++)
        channels[1 + c] = bytes[c] / 255.0;
    // Luminance is rounded in a voxel, before it is interpolated.
    if (volume->type == PEL_VOXEL_RGB8)
        channels[0] =
            volume->slope * floor(0.2126 * bytes[0] + 0.7152 * bytes[1] + 0.0722 * bytes[2] + 0.5) +
            volume->intercept;
}

static int clamp(double index, int count) {
    return index < 0 ? 0 : index > count - 1 ? count - 1 : (int)index;
}

// The channels at a place in voxel coordinates; false where a voxel is absent.
static bool interpolate(const struct pel_sampler *sampler, const double p[3],
                        double channels[CHANNELS]) {
    const struct pel_volume *volume = sampler->volume;
    bool nearest = sampler->instance->filter == PEL_FILTER_NEAREST;
    int voxels[3][2];
    double weights[3][2];
    for (int axis = 0; axis < 3; axis++) {
        double base = floor(nearest ? p[axis] + 0.5 : p[axis]);
        double share = nearest ? 0 : p[axis] - base;
        voxels[axis][0] = clamp(base, volume->dims[axis]);
        voxels[axis][1] = clamp(base + 1, volume->dims[axis]);
        weights[axis][0] = 1 - share;
        weights[axis][1] = share;
    }
    for (int c = 0; c < CHANNELS; c++)
        channels[c] = 0;
    for (int corner = 0; corner < (nearest ? 1 : CORNERS); corner++) {
        int bits[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
        int voxel[3] = {voxels[0][bits[0]], voxels[1][bits[1]], voxels[2][bits[2]]};
        double weight = weights[0][bits[0]] * weights[1][bits[1]] * weights[2][bits[2]];
        double found[CHANNELS] = {0};
        fetch(volume, voxel, found);
        for (int c = 0; c < CHANNELS; c++)
            channels[c] += weight * found[c];
    }
    return !isnan(channels[0]);
}

bool pel_sampler_make(struct pel_sampler *sampler, const struct pel_scene *scene, int instance) {
    const struct pel_instance *shown = &scene->instances[instance];
    *sampler = (struct pel_sampler){.instance = shown,
                                    .volume = scene->volumes[shown->volume],
                                    .low = shown->extent == PEL_EXTENT_CELL ? -0.5 : 0};
    for (int axis = 0; axis < 3; axis++)
        sampler->high[axis] = sampler->volume->dims[axis] - 1 - sampler->low;
    sampler->world_from_voxel =
        matrix_multiply(&shown->transform, &sampler->volume->world_from_voxel);
    return matrix_invert(&sampler->voxel_from_world, &sampler->world_from_voxel);
}

struct pel_sample pel_sampler_take(const struct pel_sampler *sampler, const double world[3]) {
    struct pel_sample sample = {0};
    const struct pel_transfer *transfer = sampler->instance->transfer;
    enum pel_voxel_type type = sampler->volume->type;
    double p[3], channels[CHANNELS], rgba[4];
    matrix_point(p, &sampler->voxel_from_world, world);
    for (int axis = 0; axis < 3; axis++)
        if (!(p[axis] >= sampler->low && p[axis] <= sampler->high[axis]))
            return sample;
    sample.inside = true;
    sample.absent = !interpolate(sampler, p, channels);
    sample.value = channels[0];
    if (sample.absent)
        return sample;
    pel_transfer_evaluate(transfer, sample.value, rgba);
    bool colour = type == PEL_VOXEL_RGB8 || type == PEL_VOXEL_RGBA8;
    vector_set(sample.rgb, colour ? channels + 1 : rgba);
    sample.opacity = rgba[3];
    sample.extinction = -log1p(-fmin(sample.opacity, 1 - 0x1p-24)) / transfer->opacity_unit_mm *
                        sampler->instance->density;
    return sample;
}

bool pel_sampler_span(const struct pel_sampler *sampler, const double origin[3],
                      const double direction[3], double *near, double *far) {
    double o[3], d[3];
    matrix_point(o, &sampler->voxel_from_world, origin);
    matrix_direction(d, &sampler->voxel_from_world, direction);
    *near = 0;
    *far = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double a = (sampler->low - o[axis]) / d[axis],
               b = (sampler->high[axis] - o[axis]) / d[axis];
        if (d[axis] == 0) {
            if (o[axis] < sampler->low || o[axis] >= sampler->high[axis])
                return false;
            continue;
        }
        *near = fmax(*near, fmin(a, b));
        *far = fmin(*far, fmax(a, b));
    }
    return *near < *far;
}

double pel_sampler_spacing(const struct pel_sampler *sampler) {
    double spacing[3];
    pel_volume_spacing(sampler->volume, spacing);
    return fmin(spacing[0], fmin(spacing[1], spacing[2]));
}
