// metaimage_save.c - writes .mha (one file) and .mhd (with the voxels in NAME.raw beside it).
#include "volume/volume.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "volume/save.h"
#include "volume/widen.h"

static const struct {
    const char *name;
    int channels;
} types[] = {
    [PEL_VOXEL_U8] = {"MET_UCHAR", 1},    [PEL_VOXEL_I8] = {"MET_CHAR", 1},
    [PEL_VOXEL_U16] = {"MET_USHORT", 1},  [PEL_VOXEL_I16] = {"MET_SHORT", 1},
    [PEL_VOXEL_F32] = {"MET_FLOAT", 1},   [PEL_VOXEL_RGB8] = {"MET_UCHAR", 3},
    [PEL_VOXEL_RGBA8] = {"MET_UCHAR", 4},
};

// The matrix is taken apart into unit directions and spacing, RAS turned to LPS.
static bool write_header(FILE *stream, const struct pel_volume *volume, const char *data_file) {
    const struct pel_matrix *matrix = &volume->world_from_voxel;
    double spacing[3];
    pel_volume_spacing(volume, spacing);
    fprintf(stream,
            "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
            "BinaryDataByteOrderMSB = %s\nCompressedData = False\nTransformMatrix =",
            pel_little_endian() ? "False" : "True");
    for (int axis = 0; axis < 3; axis++)
        for (int r = 0; r < 3; r++)
            fprintf(stream, " %.17g", (r < 2 ? -1 : 1) * matrix->m[r][axis] / spacing[axis] + 0.0);
    fprintf(stream, "\nOffset = %.17g %.17g %.17g\nCenterOfRotation = 0 0 0\n", -matrix->m[0][3],
            -matrix->m[1][3], matrix->m[2][3]);
    fprintf(stream, "ElementSpacing = %.17g %.17g %.17g\n", spacing[0], spacing[1], spacing[2]);
    fprintf(stream, "DimSize = %d %d %d\n", volume->dims[0], volume->dims[1], volume->dims[2]);
    if (volume->slope != 1 || volume->intercept != 0)
        fprintf(stream,
                "ElementToIntensityFunctionSlope = %.17g\n"
                "ElementToIntensityFunctionOffset = %.17g\n",
                volume->slope, volume->intercept);
    if (types[volume->type].channels > 1)
        fprintf(stream, "ElementNumberOfChannels = %d\n", types[volume->type].channels);
    fprintf(stream, "ElementType = %s\nElementDataFile = %s\n", types[volume->type].name,
            data_file ? data_file : "LOCAL");
    return true;
}

bool pel_metaimage_save(const struct pel_volume *volume, const char *path) {
    char *data_path = NULL;
    if (pel_path_has_extension(path, ".mhd") &&
        asprintf(&data_path, "%.*s.raw", (int)strlen(path) - 4, path) < 0)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
    bool good = (!data_path || pel_save_check_data(path, data_path)) &&
                pel_save_with_header(volume, path, data_path, write_header);
    free(data_path);
    return good;
}
