// level.c - docs/picture.md, "Level of detail", voxel by voxel.
#include "reference/level.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"

static int channels_of(enum pel_voxel_type type) {
    return type == PEL_VOXEL_RGB8 ? 3 : type == PEL_VOXEL_RGBA8 ? 4 : 1;
}

static double get(const struct pel_volume *volume, size_t at) {
    switch (volume->type) {
    case PEL_VOXEL_I8:
        return ((const int8_t *)volume->voxels)[at];
    case PEL_VOXEL_U16:
        return ((const uint16_t *)volume->voxels)[at];
    case PEL_VOXEL_I16:
        return ((const int16_t *)volume->voxels)[at];
    case PEL_VOXEL_F32:
        return ((const float *)volume->voxels)[at];
    default:
        return ((const uint8_t *)volume->voxels)[at];
    }
}

static void set(struct pel_volume *volume, size_t at, double value) {
    double whole = floor(value + 0.5);
    switch (volume->type) {
    case PEL_VOXEL_I8:
        ((int8_t *)volume->voxels)[at] = (int8_t)whole;
        break;
    case PEL_VOXEL_U16:
        ((uint16_t *)volume->voxels)[at] = (uint16_t)whole;
        break;
    case PEL_VOXEL_I16:
        ((int16_t *)volume->voxels)[at] = (int16_t)whole;
        break;
    case PEL_VOXEL_F32:
        ((float *)volume->voxels)[at] = (float)value;
        break;
    default:
        ((uint8_t *)volume->voxels)[at] = (uint8_t)whole;
    }
}

// How much of old voxel i is in new voxel q, in old voxels, along an axis.
static double overlap(int i, int old_dims, int q, int new_dims) {
    double low = (double)q * old_dims / new_dims, high = (double)(q + 1) * old_dims / new_dims;
    return fmax(0, fmin(high, i + 1) - fmax(low, i));
}

// The mean of a channel over new voxel q.
static double mean_at(const struct pel_volume *old, const struct pel_volume *new, const int q[3],
                      int channel) {
    int first[3], end[3], channels = channels_of(old->type);
    for (int c = 0; c < 3; c++) {
        first[c] = (int)((double)q[c] * old->dims[c] / new->dims[c]);
        end[c] = (int)fmin(old->dims[c], first[c] + 2 + (double)old->dims[c] / new->dims[c]);
    }
    double sum = 0, weights = 0;
    for (int k = first[2]; k < end[2]; k++)
        for (int j = first[1]; j < end[1]; j++)
            for (int i = first[0]; i < end[0]; i++) {
                double weight = overlap(i, old->dims[0], q[0], new->dims[0]) *
                                overlap(j, old->dims[1], q[1], new->dims[1]) *
                                overlap(k, old->dims[2], q[2], new->dims[2]);
                size_t at = ((size_t)k * (size_t)old->dims[1] + (size_t)j) * (size_t)old->dims[0] +
                            (size_t)i;
                double value = get(old, at * (size_t)channels + (size_t)channel);
                if (isnan(value))
                    continue;
                sum += weight * value;
                weights += weight;
            }
    return weights > 0 ? sum / weights : NAN;
}

struct pel_volume *reference_level(const struct pel_volume *volume, int level) {
    double spacing[3];
    int dims[3];
    pel_volume_spacing(volume, spacing);
    double target = ldexp(fmin(spacing[0], fmin(spacing[1], spacing[2])), level) * (1 + 1e-6);
    for (int c = 0; c < 3; c++) {
        int halvings = 0;
        while (ldexp(spacing[c], halvings + 1) <= target)
            halvings++;
        dims[c] = volume->dims[c];
        for (int n = 0; n < halvings; n++)
            dims[c] = (dims[c] + 1) / 2;
    }
    struct pel_volume *coarse = pel_volume_create("coarse", dims, volume->type);
    if (!coarse)
        abort();
    coarse->slope = volume->slope;
    coarse->intercept = volume->intercept;
    coarse->world_from_voxel = volume->world_from_voxel;
    for (int c = 0; c < 3; c++) {
        double scale = (double)volume->dims[c] / dims[c];
        for (int row = 0; row < 3; row++) {
            coarse->world_from_voxel.m[row][c] *= scale;
            coarse->world_from_voxel.m[row][3] +=
                volume->world_from_voxel.m[row][c] * (scale - 1) / 2;
        }
    }
    size_t at = 0;
    for (int k = 0; k < dims[2]; k++)
        for (int j = 0; j < dims[1]; j++)
            for (int i = 0; i < dims[0]; i++)
                for (int channel = 0; channel < channels_of(volume->type); channel++)
                    set(coarse, at++, mean_at(volume, coarse, (int[]){i, j, k}, channel));
    return coarse;
}

static double least_depth(const struct pel_scene *scene, const struct pel_instance *instance) {
    const struct pel_volume *volume = scene->volumes[instance->volume];
    double forward[3], least = INFINITY, margin = instance->extent == PEL_EXTENT_CELL ? 0.5 : 0;
    for (int c = 0; c < 3; c++)
        forward[c] = scene->camera.target[c] - scene->camera.eye[c];
    pel_normalize(forward);
    struct pel_matrix world_from_voxel =
        pel_matrix_multiply(&instance->transform, &volume->world_from_voxel);
    for (int n = 0; n < 8; n++) {
        double p[3];
        for (int c = 0; c < 3; c++)
            p[c] = n & 1 << c ? volume->dims[c] - 1 + margin : -margin;
        pel_matrix_point(p, &world_from_voxel, p);
        for (int c = 0; c < 3; c++)
            p[c] -= scene->camera.eye[c];
        least = fmin(least, pel_dot(p, forward));
    }
    return least;
}

int reference_level_of(const struct pel_scene *scene, int k) {
    const struct pel_instance *instance = &scene->instances[k];
    const struct pel_volume *volume = scene->volumes[instance->volume];
    bool decides = false;
    for (int n = 0; n < scene->instance_count; n++)
        decides |=
            scene->instances[n].mask.range_count > 0 && scene->instances[n].mask.instance == k;
    if (scene->render.lod == PEL_LOD_OFF || instance->filter == PEL_FILTER_NEAREST ||
        volume->labels || volume->hypertexture || decides)
        return 0;
    if (scene->render.lod == PEL_LOD_LEVEL)
        return scene->render.lod_level;
    const struct pel_camera *camera = &scene->camera;
    double height = camera->orthographic
                        ? camera->height_mm
                        : 2 * tan(camera->fov_deg * PEL_PI / 360) * least_depth(scene, instance);
    int rays = scene->render.supersampling.n > 1 ? scene->render.supersampling.n : 1, level = 0;
    double footprint = height / scene->render.height / rays, spacing[3];
    pel_volume_spacing(volume, spacing);
    double side = fmin(spacing[0], fmin(spacing[1], spacing[2]));
    while (level < PEL_LOD_LEVEL_MAX && ldexp(side, level + 1) <= footprint * (1 + 1e-6))
        level++;
    return level;
}

struct pel_scene *reference_coarsen(const struct pel_scene *scene) {
    if (scene->render.lod == PEL_LOD_OFF)
        return NULL;
    struct pel_scene *coarse = malloc(sizeof *coarse);
    if (!coarse)
        abort();
    *coarse = *scene;
    coarse->volume_count = scene->instance_count;
    for (int k = 0; k < scene->instance_count; k++) {
        int from = scene->instances[k].volume, level = reference_level_of(scene, k);
        coarse->volumes[k] = level > 0 ? reference_level(scene->volumes[from], level)
                                       : pel_volume_share(scene->volumes[from]);
        coarse->statistics[k] = scene->statistics[from];
        coarse->instances[k].volume = k;
    }
    return coarse;
}

void reference_coarsen_finish(struct pel_scene *coarse) {
    if (!coarse)
        return;
    for (int k = 0; k < coarse->volume_count; k++)
        pel_volume_destroy(coarse->volumes[k]);
    free(coarse);
}
