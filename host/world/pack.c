// pack.c - a volume's slices as the device stores them.
#include "world/pack.h"

#include <string.h>

#include "world/layout.h"

// One row of voxels, in the class the device stores.
static void pack_row(enum pel_voxel_type type, const void *in, size_t count, void *out) {
    const uint8_t *bytes = in;
    uint8_t *out_bytes = out;
    switch (type) {
    case PEL_VOXEL_U8:
    case PEL_VOXEL_U16:
    case PEL_VOXEL_F32:
    case PEL_VOXEL_RGBA8:
        memcpy(out, in, count * pel_voxel_bytes(type));
        break;
    case PEL_VOXEL_I8:
        for (size_t i = 0; i < count; i++)
            out_bytes[i] = bytes[i] ^ 0x80;
        break;
    case PEL_VOXEL_I16:
        for (size_t i = 0; i < count; i++)
            ((uint16_t *)out)[i] = ((const uint16_t *)in)[i] ^ 0x8000;
        break;
    case PEL_VOXEL_RGB8:
        for (size_t i = 0; i < count; i++) {
            const uint8_t *rgb = bytes + 3 * i;
            memcpy(out_bytes + 4 * i, rgb, 3);
            // The luminance in ten thousandths, rounded halves up.
            out_bytes[4 * i + 3] =
                (uint8_t)((2126 * rgb[0] + 7152 * rgb[1] + 722 * rgb[2] + 5000) / 10000);
        }
        break;
    }
}

static int clamp_index(int i, int count) {
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

void pel_pack_slice(const struct pel_volume *volume, int z, void *out) {
    size_t width = (size_t)volume->dims[0], height = (size_t)volume->dims[1];
    size_t in_bytes = pel_voxel_bytes(volume->type);
    size_t out_bytes = pel_voxel_class_bytes(pel_voxel_class(volume->type));
    size_t out_row = (width + 2) * out_bytes;
    const char *slice = (const char *)volume->voxels +
                        (size_t)clamp_index(z, volume->dims[2]) * width * height * in_bytes;
    for (int y = -1; y <= volume->dims[1]; y++) {
        const char *in = slice + (size_t)clamp_index(y, volume->dims[1]) * width * in_bytes;
        char *row = (char *)out + (size_t)(y + 1) * out_row;
        pack_row(volume->type, in, width, row + out_bytes);
        memcpy(row, row + out_bytes, out_bytes);
        memcpy(row + (width + 1) * out_bytes, row + width * out_bytes, out_bytes);
    }
}
