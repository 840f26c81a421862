// volume.c - what every volume can do, whatever file it came from.
#include "volume/volume.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "volume/hypertexture.h"
#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

static const struct {
    const char *name;
    size_t bytes;
} voxel_types[] = {
    [PEL_VOXEL_U8] = {"uint8", 1},    [PEL_VOXEL_I8] = {"int8", 1},
    [PEL_VOXEL_U16] = {"uint16", 2},  [PEL_VOXEL_I16] = {"int16", 2},
    [PEL_VOXEL_F32] = {"float32", 4}, [PEL_VOXEL_RGB8] = {"rgb8", 3},
    [PEL_VOXEL_RGBA8] = {"rgba8", 4},
};

enum { VOXEL_TYPE_COUNT = sizeof voxel_types / sizeof *voxel_types };

size_t pel_voxel_bytes(enum pel_voxel_type type) {
    return voxel_types[type].bytes;
}

const char *pel_voxel_type_name(enum pel_voxel_type type) {
    return voxel_types[type].name;
}

bool pel_voxel_type_from_name(const char *name, enum pel_voxel_type *type) {
    for (int i = 0; i < VOXEL_TYPE_COUNT; i++) {
        if (strcmp(name, voxel_types[i].name) == 0) {
            *type = (enum pel_voxel_type)i;
            return true;
        }
    }
    return pel_fail(PEL_ERROR_ARGUMENT,
                    "no voxel type '%.32s'; there are uint8, int8, uint16, int16, float32, rgb8 "
                    "and rgba8",
                    name);
}

bool pel_volume_check_size(const int64_t dims[3], enum pel_voxel_type type, size_t available_bytes,
                           size_t *bytes) {
    for (int i = 0; i < 3; i++)
        if (dims[i] < 1 || dims[i] > PEL_DIMENSION_MAX)
            return pel_fail(PEL_ERROR_FORMAT, "%lld voxels along axis %d, outside 1..%d",
                            (long long)dims[i], i, PEL_DIMENSION_MAX);
    size_t factors[] = {(size_t)dims[0], (size_t)dims[1], (size_t)dims[2], pel_voxel_bytes(type)};
    if (!pel_size_multiply(bytes, 4, factors))
        return false;
    if (*bytes > available_bytes)
        return pel_fail(PEL_ERROR_FORMAT,
                        "%lld x %lld x %lld voxels of %s need %zu bytes, the file has %zu",
                        (long long)dims[0], (long long)dims[1], (long long)dims[2],
                        pel_voxel_type_name(type), *bytes, available_bytes);
    return true;
}

void pel_volume_mark_absent(struct pel_volume *volume) {
    if (volume->type != PEL_VOXEL_F32)
        return;
    float *voxels = volume->voxels;
    size_t count = pel_volume_voxel_count(volume);
    for (size_t i = 0; i < count; i++)
        if (isinf(voxels[i]))
            voxels[i] = NAN;
}

// Serial numbers start at 1. Like the warning callback this is one per process.
static atomic_uint_fast64_t last_serial;

struct pel_volume *pel_volume_create(const char *name, const int dims[3],
                                     enum pel_voxel_type type) {
    size_t bytes;
    if (!pel_volume_check_size((int64_t[]){dims[0], dims[1], dims[2]}, type, SIZE_MAX, &bytes))
        return NULL;
    struct pel_volume *volume = pel_allocate(1, sizeof *volume);
    if (!volume)
        return NULL;
    *volume = (struct pel_volume){
        .name = pel_copy_text(name),
        .dims = {dims[0], dims[1], dims[2]},
        .type = type,
        .world_from_voxel = pel_matrix_identity(),
        .slope = 1,
        .serial = atomic_fetch_add(&last_serial, 1) + 1,
        .voxels = pel_allocate_voxels(bytes),
    };
    if (!volume->name || !volume->voxels) {
        pel_volume_destroy(volume);
        return NULL;
    }
    return volume;
}

void pel_hypertexture_destroy(struct pel_hypertexture *hypertexture) {
    if (!hypertexture)
        return;
    pel_volume_destroy(hypertexture->object);
    free(hypertexture->recipe);
    free(hypertexture->program);
    free(hypertexture);
}

void pel_volume_destroy(struct pel_volume *volume) {
    if (!volume || __atomic_fetch_sub(&volume->shares, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    pel_hypertexture_destroy(volume->hypertexture);
    free(volume->name);
    free(volume->voxels);
    free(volume);
}

struct pel_volume *pel_volume_share(struct pel_volume *volume) {
    __atomic_fetch_add(&volume->shares, 1, __ATOMIC_RELAXED);
    return volume;
}

size_t pel_volume_voxel_count(const struct pel_volume *volume) {
    return (size_t)volume->dims[0] * (size_t)volume->dims[1] * (size_t)volume->dims[2];
}

size_t pel_volume_bytes(const struct pel_volume *volume) {
    return pel_volume_voxel_count(volume) * pel_voxel_bytes(volume->type);
}

void pel_volume_spacing(const struct pel_volume *volume, double spacing_mm[3]) {
    for (int axis = 0; axis < 3; axis++) {
        const struct pel_matrix *matrix = &volume->world_from_voxel;
        spacing_mm[axis] =
            pel_length((double[]){matrix->m[0][axis], matrix->m[1][axis], matrix->m[2][axis]});
    }
}

bool pel_volume_check_voxels(const struct pel_volume *volume) {
    return volume->voxels ||
           pel_fail(PEL_ERROR_ARGUMENT,
                    "'%s' is a hypertexture, which has no voxels until it is baked", volume->name);
}

double pel_volume_value(const struct pel_volume *volume, int i, int j, int k) {
    if (!volume->voxels)
        return NAN;
    size_t index =
        ((size_t)k * (size_t)volume->dims[1] + (size_t)j) * (size_t)volume->dims[0] + (size_t)i;
    double raw = 0;
    switch (volume->type) {
    case PEL_VOXEL_U8:
        raw = ((const uint8_t *)volume->voxels)[index];
        break;
    case PEL_VOXEL_I8:
        raw = ((const int8_t *)volume->voxels)[index];
        break;
    case PEL_VOXEL_U16:
        raw = ((const uint16_t *)volume->voxels)[index];
        break;
    case PEL_VOXEL_I16:
        raw = ((const int16_t *)volume->voxels)[index];
        break;
    case PEL_VOXEL_F32:
        raw = ((const float *)volume->voxels)[index];
        break;
    case PEL_VOXEL_RGB8: {
        const uint8_t *rgb = (const uint8_t *)volume->voxels + 3 * index;
        raw = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        break;
    }
    case PEL_VOXEL_RGBA8:
        raw = ((const uint8_t *)volume->voxels)[4 * index + 3];
        break;
    }
    return volume->slope * raw + volume->intercept;
}
