// nifti_save.c - writes .nii and .nii.gz: NIfTI-1, which everything reads, or NIfTI-2 where a
// dimension is beyond the 32767 of NIfTI-1.
//
// The sform holds the placement; the qform holds it too, as far as a quaternion can (no shear).
#include "volume/volume.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include <nifti2_io.h>

#include "base/error.h"
#include "base/file.h"

enum { CHUNK = 1 << 30 };

static const struct {
    int datatype, bits;
} datatypes[] = {
    [PEL_VOXEL_U8] = {DT_UINT8, 8},      [PEL_VOXEL_I8] = {DT_INT8, 8},
    [PEL_VOXEL_U16] = {DT_UINT16, 16},   [PEL_VOXEL_I16] = {DT_INT16, 16},
    [PEL_VOXEL_F32] = {DT_FLOAT32, 32},  [PEL_VOXEL_RGB8] = {DT_RGB24, 24},
    [PEL_VOXEL_RGBA8] = {DT_RGBA32, 32},
};

// The code in "sform (mni)", or that of a scanner.
static int code_from_space(const char *space) {
    static const char *const names[] = {"(scanner)", "(aligned)", "(talairach)", "(mni)",
                                        "(template)"};
    for (int i = 0; i < 5; i++)
        if (strstr(space, names[i]))
            return i + 1;
    return NIFTI_XFORM_SCANNER_ANAT;
}

// The wider header of the two holds everything; NIfTI-1 is narrowed from it.
static nifti_2_header make_header(const struct pel_volume *volume) {
    nifti_2_header header = {
        .sizeof_hdr = 540,
        .magic = {'n', '+', '2', '\0', '\r', '\n', 032, '\n'},
        .datatype = (int16_t)datatypes[volume->type].datatype,
        .bitpix = (int16_t)datatypes[volume->type].bits,
        .dim = {3, volume->dims[0], volume->dims[1], volume->dims[2], 1, 1, 1, 1},
        .pixdim = {1, 1, 1, 1, 1, 1, 1, 1},
        .vox_offset = 544,
        .scl_slope = volume->slope,
        .scl_inter = volume->intercept,
        .xyzt_units = NIFTI_UNITS_MM,
        .intent_code = volume->labels ? NIFTI_INTENT_LABEL : NIFTI_INTENT_NONE,
    };
    header.qform_code = header.sform_code = code_from_space(volume->space);
    const struct pel_matrix *matrix = &volume->world_from_voxel;
    memcpy(header.srow_x, matrix->m[0], sizeof header.srow_x);
    memcpy(header.srow_y, matrix->m[1], sizeof header.srow_y);
    memcpy(header.srow_z, matrix->m[2], sizeof header.srow_z);
    nifti_dmat44 sform;
    memcpy(sform.m, matrix->m, sizeof sform.m);
    nifti_dmat44_to_quatern(sform, &header.quatern_b, &header.quatern_c, &header.quatern_d,
                            &header.qoffset_x, &header.qoffset_y, &header.qoffset_z,
                            &header.pixdim[1], &header.pixdim[2], &header.pixdim[3],
                            &header.pixdim[0]);
    return header;
}

static nifti_1_header narrow_header(const nifti_2_header *wide) {
    nifti_1_header header = {
        .sizeof_hdr = 348,
        .regular = 'r',
        .magic = "n+1",
        .datatype = wide->datatype,
        .bitpix = wide->bitpix,
        .vox_offset = 352,
        .scl_slope = (float)wide->scl_slope,
        .scl_inter = (float)wide->scl_inter,
        .xyzt_units = (char)wide->xyzt_units,
        .intent_code = (int16_t)wide->intent_code,
        .qform_code = (int16_t)wide->qform_code,
        .sform_code = (int16_t)wide->sform_code,
        .quatern_b = (float)wide->quatern_b,
        .quatern_c = (float)wide->quatern_c,
        .quatern_d = (float)wide->quatern_d,
        .qoffset_x = (float)wide->qoffset_x,
        .qoffset_y = (float)wide->qoffset_y,
        .qoffset_z = (float)wide->qoffset_z,
    };
    for (int i = 0; i < 8; i++) {
        header.dim[i] = (int16_t)wide->dim[i];
        header.pixdim[i] = (float)wide->pixdim[i];
    }
    for (int i = 0; i < 4; i++) {
        header.srow_x[i] = (float)wide->srow_x[i];
        header.srow_y[i] = (float)wide->srow_y[i];
        header.srow_z[i] = (float)wide->srow_z[i];
    }
    return header;
}

static bool write_all(gzFile stream, const void *bytes, size_t count) {
    while (count > 0) {
        unsigned part = (unsigned)(count < CHUNK ? count : CHUNK);
        if (gzwrite(stream, bytes, part) != (int)part)
            return false;
        bytes = (const char *)bytes + part;
        count -= part;
    }
    return true;
}

bool pel_nifti_save(const struct pel_volume *volume, const char *path) {
    nifti_2_header wide = make_header(volume);
    nifti_1_header narrow = narrow_header(&wide);
    bool large = false;
    for (int i = 0; i < 3; i++)
        large = large || volume->dims[i] > INT16_MAX;
    const char no_extension[4] = {0};

    struct pel_output output;
    if (!pel_output_open(&output, path))
        return false;
    // Mode "T" writes what it is given, uncompressed.
    gzFile stream =
        gzdopen(dup(fileno(output.stream)), pel_path_has_extension(path, ".gz") ? "wb6" : "wbT");
    bool good = stream && (large ? write_all(stream, &wide, sizeof wide)
                                 : write_all(stream, &narrow, sizeof narrow));
    good = good && write_all(stream, no_extension, sizeof no_extension) &&
           write_all(stream, volume->voxels, pel_volume_bytes(volume));
    good = stream && gzclose_w(stream) == Z_OK && good;
    if (!good) {
        pel_output_abandon(&output);
        return pel_fail(PEL_ERROR_FILE, "cannot write");
    }
    return pel_output_commit(&output);
}
