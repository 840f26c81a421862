// nifti.c - NIfTI-1, NIfTI-2 and ANALYZE 7.5, as .nii, .nii.gz and .hdr/.img pairs.
//
// niftilib defines the headers and does the quaternion arithmetic. It does not see the file: its
// reader believes the header, and allocates 18 GB for a file of 377 bytes. Here the header is read,
// checked against the file's size, and the voxels follow through source.h.
//
// Standard: nifti1.h and nifti2.h of niftilib. Placement follows them: the sform if it has a code,
// else the qform, else the spacing alone.
#include "volume/volume.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include <nifti2_io.h>

#include "base/error.h"
#include "base/file.h"
#include "base/math.h"
#include "base/memory.h"
#include "volume/source.h"

// What all three headers say, in native byte order.
struct header {
    int version;      // 1, 2, or 0 for ANALYZE
    bool swap, pair;  // the voxels are in a second file
    int64_t dims[8];  // as in the file, those not used set to 1
    double pixdim[8]; //
    int datatype, intent_code, units, qform_code, sform_code;
    double slope, intercept, data_offset;
    double quatern[3], offset[3], rows[3][4];
};

_Static_assert(sizeof(nifti_1_header) == 348, "NIfTI-1 headers have 348 bytes");
_Static_assert(sizeof(nifti_2_header) == 540, "NIfTI-2 headers have 540 bytes");

static void header_from_nifti1(struct header *header, nifti_1_header *file) {
    bool nifti = memcmp(file->magic, "n+1", 4) == 0 || memcmp(file->magic, "ni1", 4) == 0;
    if (header->swap && nifti)
        nifti_swap_as_nifti1(file);
    else if (header->swap)
        nifti_swap_as_analyze((nifti_analyze75 *)file);
    header->version = nifti;
    header->pair = file->magic[1] != '+';
    for (int i = 0; i < 8; i++) {
        header->dims[i] = file->dim[i];
        header->pixdim[i] = (double)file->pixdim[i];
    }
    header->datatype = file->datatype;
    header->data_offset = (double)file->vox_offset;
    if (!nifti)
        return;
    header->intent_code = file->intent_code;
    header->units = file->xyzt_units;
    header->qform_code = file->qform_code;
    header->sform_code = file->sform_code;
    header->slope = (double)file->scl_slope;
    header->intercept = (double)file->scl_inter;
    const float quatern[] = {file->quatern_b, file->quatern_c, file->quatern_d};
    const float offset[] = {file->qoffset_x, file->qoffset_y, file->qoffset_z};
    const float *rows[] = {file->srow_x, file->srow_y, file->srow_z};
    for (int r = 0; r < 3; r++) {
        header->quatern[r] = (double)quatern[r];
        header->offset[r] = (double)offset[r];
        for (int c = 0; c < 4; c++)
            header->rows[r][c] = (double)rows[r][c];
    }
}

static void header_from_nifti2(struct header *header, nifti_2_header *file) {
    if (header->swap)
        nifti_swap_as_nifti2(file);
    header->version = 2;
    header->pair = file->magic[1] != '+';
    for (int i = 0; i < 8; i++) {
        header->dims[i] = file->dim[i];
        header->pixdim[i] = file->pixdim[i];
    }
    header->datatype = file->datatype;
    header->data_offset = (double)file->vox_offset;
    header->intent_code = file->intent_code;
    header->units = file->xyzt_units;
    header->qform_code = file->qform_code;
    header->sform_code = file->sform_code;
    header->slope = file->scl_slope;
    header->intercept = file->scl_inter;
    const double quatern[] = {file->quatern_b, file->quatern_c, file->quatern_d};
    const double offset[] = {file->qoffset_x, file->qoffset_y, file->qoffset_z};
    memcpy(header->quatern, quatern, sizeof quatern);
    memcpy(header->offset, offset, sizeof offset);
    memcpy(header->rows[0], file->srow_x, sizeof header->rows[0]);
    memcpy(header->rows[1], file->srow_y, sizeof header->rows[1]);
    memcpy(header->rows[2], file->srow_z, sizeof header->rows[2]);
}

// Reads the header; the source stands behind it afterwards.
static bool read_header(struct header *header, struct pel_source *source) {
    *header = (struct header){0};
    union {
        int32_t size;
        nifti_1_header nifti1;
        nifti_2_header nifti2;
    } file = {0};
    if (!pel_source_read(source, &file, sizeof file.nifti1))
        return false;
    int32_t swapped = (int32_t)__builtin_bswap32((uint32_t)file.size);
    header->swap = swapped == 348 || swapped == 540;
    if (file.size == 348 || swapped == 348) {
        header_from_nifti1(header, &file.nifti1);
    } else if (file.size == 540 || swapped == 540) {
        if (!pel_source_read(source, (char *)&file + 348, 540 - 348))
            return false;
        header_from_nifti2(header, &file.nifti2);
    } else {
        return pel_fail(PEL_ERROR_FORMAT, "not a NIfTI header, which starts with 348 or 540");
    }
    // Dimensions that are not counted, and zeros behind the first, mean one.
    if (header->dims[0] < 1 || header->dims[0] > 7)
        return pel_fail(PEL_ERROR_FORMAT, "%lld dimensions, outside 1..7",
                        (long long)header->dims[0]);
    for (int i = 1; i < 8; i++) {
        if (i > header->dims[0] || (i > 1 && header->dims[i] == 0))
            header->dims[i] = 1;
        if (header->dims[i] < 1)
            return pel_fail(PEL_ERROR_FORMAT, "%lld elements along dimension %d",
                            (long long)header->dims[i], i);
    }
    return true;
}

static bool element_of_datatype(int datatype, enum pel_element *element, int *components) {
    static const struct {
        int datatype;
        enum pel_element element;
        int components;
    } types[] = {
        {DT_UINT8, PEL_ELEMENT_U8, 1},    {DT_INT8, PEL_ELEMENT_I8, 1},
        {DT_UINT16, PEL_ELEMENT_U16, 1},  {DT_INT16, PEL_ELEMENT_I16, 1},
        {DT_UINT32, PEL_ELEMENT_U32, 1},  {DT_INT32, PEL_ELEMENT_I32, 1},
        {DT_UINT64, PEL_ELEMENT_U64, 1},  {DT_INT64, PEL_ELEMENT_I64, 1},
        {DT_FLOAT32, PEL_ELEMENT_F32, 1}, {DT_FLOAT64, PEL_ELEMENT_F64, 1},
        {DT_RGB24, PEL_ELEMENT_U8, 3},    {DT_RGBA32, PEL_ELEMENT_U8, 4},
    };
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (types[i].datatype == datatype) {
            *element = types[i].element;
            *components = types[i].components;
            return true;
        }
    }
    return pel_fail(PEL_ERROR_UNSUPPORTED, "voxels of type %d (%s) cannot be shown", datatype,
                    nifti_datatype_to_string(datatype));
}

// ---- Placement ---------------------------------------------------------------------------------

static const char *code_name(int code) {
    static const char *const names[] = {"unknown",   "scanner", "aligned",
                                        "talairach", "mni",     "template"};
    return code >= 0 && code < 6 ? names[code] : "other";
}

static bool is_invertible(const struct pel_matrix *matrix) {
    struct pel_matrix inverse;
    bool good = pel_matrix_invert(&inverse, matrix);
    pel_error_clear();
    return good;
}

static void place(struct pel_volume *volume, const struct header *header) {
    // Lengths are stored in m, mm or um; unknown ones are taken for mm.
    int unit = header->units & 7;
    double mm = unit == NIFTI_UNITS_METER ? 1e3 : unit == NIFTI_UNITS_MICRON ? 1e-3 : 1;
    double spacing[3];
    for (int i = 0; i < 3; i++) {
        double size = fabs(header->pixdim[i + 1]);
        spacing[i] = isfinite(size) && size > 0 ? size : 1;
    }
    struct pel_matrix millimetres = pel_matrix_scaling((double[]){mm, mm, mm});
    struct pel_matrix matrix = pel_matrix_identity();
    bool placed = false;
    if (header->sform_code > 0) {
        memcpy(matrix.m, header->rows, sizeof header->rows);
        placed = is_invertible(&matrix);
        if (placed)
            snprintf(volume->space, sizeof volume->space, "sform (%s)",
                     code_name(header->sform_code));
        else
            pel_warn("%s: the sform is singular and ignored", volume->name);
    }
    if (!placed && header->qform_code > 0) {
        nifti_dmat44 qform = nifti_quatern_to_dmat44(
            header->quatern[0], header->quatern[1], header->quatern[2], header->offset[0],
            header->offset[1], header->offset[2], spacing[0], spacing[1], spacing[2],
            header->pixdim[0] < 0 ? -1 : 1);
        memcpy(matrix.m, qform.m, sizeof matrix.m);
        placed = is_invertible(&matrix);
        if (placed)
            snprintf(volume->space, sizeof volume->space, "qform (%s)",
                     code_name(header->qform_code));
        else
            pel_warn("%s: the qform is not finite and ignored", volume->name);
    }
    if (!placed) {
        matrix = pel_matrix_scaling(spacing);
        snprintf(volume->space, sizeof volume->space, "spacing only");
        pel_warn("%s: %s, so voxel (0,0,0) is placed at the origin and its axes are taken for RAS",
                 volume->name,
                 header->version ? "neither sform nor qform" : "ANALYZE has no orientation");
    }
    volume->world_from_voxel = pel_matrix_multiply(&millimetres, &matrix);
}

// ---- Reading -----------------------------------------------------------------------------------

// The path of the other file of a pair: `from` (".hdr") at the end, before an optional ".gz", gives
// way to `to`. Of compressed and plain the one that exists is taken; NULL (FILE) if there is none.
static char *other_of_pair(const char *path, const char *from, const char *to) {
    size_t length = strlen(path);
    if (pel_path_has_extension(path, ".gz"))
        length -= 3;
    if (length < 4 || strncasecmp(path + length - 4, from, 4) != 0) {
        pel_fail(PEL_ERROR_FORMAT, "a header of a pair whose name does not end in .hdr");
        return NULL;
    }
    static const char *const endings[] = {"", ".gz"};
    for (int i = 0; i < 2; i++) {
        char *other = NULL;
        if (asprintf(&other, "%.*s%s%s", (int)(length - 4), path, to, endings[i]) < 0) {
            pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
            return NULL;
        }
        if (access(other, R_OK) == 0)
            return other;
        free(other);
    }
    const char *leaf = pel_path_leaf(path);
    pel_fail(PEL_ERROR_FILE, "the file %.*s%s that belongs to it is missing",
             (int)(path + length - 4 - leaf), leaf, to);
    return NULL;
}

// Moves the source to the first voxel of the time step and channel that are wanted.
static bool seek_volume(struct pel_source *source, const struct header *header, const char *name,
                        size_t voxel_bytes, const struct pel_load_options *options) {
    double least = header->pair ? 0 : header->version == 2 ? 540 : 348;
    double offset = header->data_offset;
    if (!header->pair && offset == 0)
        offset = least + 4;
    if (!(offset >= least && offset < 0x1p53 && offset == floor(offset)))
        return pel_fail(PEL_ERROR_FORMAT, "voxels start at byte %g, which cannot be", offset);
    size_t start = (size_t)offset, volume_bytes, skipped_bytes;
    if (!pel_source_skip(source, start - source->position) ||
        !pel_block_bytes(header->dims + 1, voxel_bytes, source->capacity - start, &volume_bytes))
        return false;
    struct pel_selection selection = {.element = PEL_ELEMENT_F64};
    if (!pel_select_time(&selection, name, header->dims[4], 1, options) ||
        !pel_select_channel(&selection, name, header->dims[5], (size_t)header->dims[4], options))
        return false;
    if (header->dims[6] > 1 || header->dims[7] > 1)
        pel_warn("%s: only the first of its sixth and seventh dimension is read", name);
    return pel_size_multiply(&skipped_bytes, 2, (size_t[]){selection.first, volume_bytes}) &&
           pel_source_skip(source, skipped_bytes);
}

static struct pel_volume *read_volume(struct pel_source *source, const struct header *header,
                                      const char *name, const struct pel_load_options *options) {
    enum pel_element element = PEL_ELEMENT_U8;
    int components = 1;
    if (!element_of_datatype(header->datatype, &element, &components) ||
        !seek_volume(source, header, name, pel_element_bytes(element) * (size_t)components,
                     options))
        return NULL;
    struct pel_volume *volume =
        pel_source_read_volume(source, name, header->dims + 1, element, components, header->swap);
    bool more;
    if (!volume || !pel_source_finish(source, &more)) {
        pel_volume_destroy(volume);
        return NULL;
    }
    if (isfinite(header->slope) && header->slope != 0 && isfinite(header->intercept) &&
        components == 1) {
        volume->slope = header->slope;
        volume->intercept = header->intercept;
    }
    volume->labels = header->intent_code == NIFTI_INTENT_LABEL;
    place(volume, header);
    return volume;
}

struct pel_volume *pel_nifti_load(const char *path, const struct pel_load_options *options) {
    struct pel_source source = {0};
    struct header header;
    struct pel_volume *volume = NULL;
    char *header_path = NULL, *data_path = NULL;
    if (pel_path_has_extension(path, ".img") || pel_path_has_extension(path, ".img.gz"))
        header_path = other_of_pair(path, ".img", ".hdr");
    else
        header_path = pel_copy_text(path);
    if (!header_path || !pel_source_open(&source, header_path) || !read_header(&header, &source))
        goto done;
    if (header.pair) {
        data_path = other_of_pair(header_path, ".hdr", ".img");
        pel_source_close(&source);
        if (!data_path || !pel_source_open(&source, data_path))
            goto done;
    }
    volume = read_volume(&source, &header, pel_path_leaf(path), options);
done:
    pel_source_close(&source);
    free(header_path);
    free(data_path);
    return volume;
}
