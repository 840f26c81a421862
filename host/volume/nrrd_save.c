// nrrd_save.c - writes .nrrd (one file) and .nhdr (with the voxels in NAME.raw beside it).
//
// The header is a few lines of text, so teem is not asked. Numbers have 17 digits: what is read
// back is what was written.
#include "volume/volume.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "volume/save.h"
#include "volume/widen.h"

static const struct {
    const char *name, *kind; // the kind of the axis of colours
    int channels;
} types[] = {
    [PEL_VOXEL_U8] = {"uint8", NULL, 1},
    [PEL_VOXEL_I8] = {"int8", NULL, 1},
    [PEL_VOXEL_U16] = {"uint16", NULL, 1},
    [PEL_VOXEL_I16] = {"int16", NULL, 1},
    [PEL_VOXEL_F32] = {"float", NULL, 1},
    [PEL_VOXEL_RGB8] = {"uint8", "RGB-color", 3},
    [PEL_VOXEL_RGBA8] = {"uint8", "RGBA-color", 4},
};

static bool write_header(FILE *stream, const struct pel_volume *volume, const char *data_file) {
    const double(*m)[4] = volume->world_from_voxel.m;
    const char *kind = types[volume->type].kind;
    fprintf(stream, "NRRD0004\ntype: %s\ndimension: %d\nspace: right-anterior-superior\nsizes:",
            types[volume->type].name, kind ? 4 : 3);
    if (kind)
        fprintf(stream, " %d", types[volume->type].channels);
    fprintf(stream, " %d %d %d\nspace directions:%s", volume->dims[0], volume->dims[1],
            volume->dims[2], kind ? " none" : "");
    for (int axis = 0; axis < 3; axis++)
        fprintf(stream, " (%.17g,%.17g,%.17g)", m[0][axis], m[1][axis], m[2][axis]);
    fprintf(stream, "\nkinds:%s%s domain domain domain\n", kind ? " " : "", kind ? kind : "");
    fprintf(stream, "endian: %s\nencoding: raw\nspace origin: (%.17g,%.17g,%.17g)\n",
            pel_little_endian() ? "little" : "big", m[0][3], m[1][3], m[2][3]);
    if (volume->unit[0] && !strpbrk(volume->unit, "\"\n"))
        fprintf(stream, "sample units: %s\n", volume->unit);
    if (data_file)
        fprintf(stream, "data file: %s\n", data_file);
    else
        fprintf(stream, "\n");
    return true;
}

// NRRD has no slope and intercept: values that need them are written as floats.
static struct pel_volume *rescaled(const struct pel_volume *source) {
    struct pel_volume *volume = pel_volume_create(source->name, source->dims, PEL_VOXEL_F32);
    if (!volume)
        return NULL;
    memcpy(volume->unit, source->unit, sizeof volume->unit);
    volume->world_from_voxel = source->world_from_voxel;
    float *voxel = volume->voxels;
    for (int k = 0; k < source->dims[2]; k++)
        for (int j = 0; j < source->dims[1]; j++)
            for (int i = 0; i < source->dims[0]; i++)
                *voxel++ = (float)pel_volume_value(source, i, j, k);
    pel_warn("%s: NRRD has no slope and intercept, so the values are saved as float32",
             source->name);
    return volume;
}

bool pel_nrrd_save(const struct pel_volume *volume, const char *path) {
    struct pel_volume *copy = NULL;
    if ((volume->slope != 1 || volume->intercept != 0) && types[volume->type].channels == 1) {
        copy = rescaled(volume);
        if (!copy)
            return false;
        volume = copy;
    }
    char *data_path = NULL;
    bool detached = pel_path_has_extension(path, ".nhdr"), good;
    if (detached && asprintf(&data_path, "%.*s.raw", (int)strlen(path) - 5, path) < 0) {
        data_path = NULL;
        good = pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
    } else {
        good = (!detached || pel_save_check_data(path, data_path)) &&
               pel_save_with_header(volume, path, data_path, write_header);
    }
    free(data_path);
    pel_volume_destroy(copy);
    return good;
}
