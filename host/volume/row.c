// row.c - rows of voxels as doubles, whatever their type.
#include "volume/row.h"

#include <math.h>

#include "volume/volume.h"

int pel_row_channels(enum pel_voxel_type type) {
    return type == PEL_VOXEL_RGB8 ? 3 : type == PEL_VOXEL_RGBA8 ? 4 : 1;
}

void *pel_row_at(const struct pel_volume *volume, int j, int k) {
    size_t row = (size_t)k * (size_t)volume->dims[1] + (size_t)j;
    return (char *)volume->voxels + row * (size_t)volume->dims[0] * pel_voxel_bytes(volume->type);
}

void pel_row_read(const struct pel_volume *volume, int j, int k, double *out) {
    const void *row = pel_row_at(volume, j, k);
    int count = volume->dims[0] * pel_row_channels(volume->type);
    switch (volume->type) {
    case PEL_VOXEL_I8:
        for (int i = 0; i < count; i++)
            out[i] = ((const int8_t *)row)[i];
        break;
    case PEL_VOXEL_U16:
        for (int i = 0; i < count; i++)
            out[i] = ((const uint16_t *)row)[i];
        break;
    case PEL_VOXEL_I16:
        for (int i = 0; i < count; i++)
            out[i] = ((const int16_t *)row)[i];
        break;
    case PEL_VOXEL_F32:
        for (int i = 0; i < count; i++)
            out[i] = ((const float *)row)[i];
        break;
    case PEL_VOXEL_U8:
    case PEL_VOXEL_RGB8:
    case PEL_VOXEL_RGBA8:
        for (int i = 0; i < count; i++)
            out[i] = ((const uint8_t *)row)[i];
        break;
    }
}

void pel_row_type_range(enum pel_voxel_type type, double *low, double *high) {
    *low = type == PEL_VOXEL_I8 ? -128 : type == PEL_VOXEL_I16 ? -32768 : 0;
    *high = type == PEL_VOXEL_I8    ? 127
            : type == PEL_VOXEL_I16 ? 32767
            : type == PEL_VOXEL_U16 ? 65535
                                    : 255;
}

size_t pel_row_write(struct pel_volume *volume, int j, int k, const double *in) {
    void *row = pel_row_at(volume, j, k);
    int count = volume->dims[0] * pel_row_channels(volume->type);
    size_t clamped = 0;
    if (volume->type == PEL_VOXEL_F32) {
        for (int i = 0; i < count; i++)
            ((float *)row)[i] = (float)in[i];
        return 0;
    }
    double low, high;
    pel_row_type_range(volume->type, &low, &high);
    for (int i = 0; i < count; i++) {
        double rounded = floor(in[i] + 0.5), fitting = fmin(fmax(rounded, low), high);
        clamped += rounded != fitting && !isnan(rounded);
        if (volume->type == PEL_VOXEL_U16)
            ((uint16_t *)row)[i] = (uint16_t)fitting;
        else if (volume->type == PEL_VOXEL_I16)
            ((int16_t *)row)[i] = (int16_t)fitting;
        else if (volume->type == PEL_VOXEL_I8)
            ((int8_t *)row)[i] = (int8_t)fitting;
        else
            ((uint8_t *)row)[i] = (uint8_t)fitting;
    }
    return clamped;
}
