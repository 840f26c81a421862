// nrrd.c - NRRD and detached NHDR files, read by teem.
//
// teem reads the header alone first; what it says is compared with what the data files can hold
// before memory for the voxels exists. The expansion that is believed: raw 1, text one number from
// two bytes, hex half, gzip 1032 (the most deflate can), bzip2 65536 beyond the 46 MB that a single
// block of equal bytes makes.
//
// Standard: http://teem.sourceforge.net/nrrd/format.html, versions 1 to 5.
#include "volume/volume.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include <teem/nrrd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/math.h"
#include "base/memory.h"
#include "volume/nrrd_guard.h"
#include "volume/nrrd_unpack.h"
#include "volume/source.h"

enum { BZIP2_RATIO = 65536, BZIP2_BLOCK_BYTES = 46000000 };

// teem collects its messages in one list per process, so one file is read at a time.
static pthread_mutex_t teem_lock = PTHREAD_MUTEX_INITIALIZER;

// How the voxels are stored.
struct coding {
    const NrrdEncoding *encoding;
    struct pel_nrrd_skip skip;
    bool swap; // the other byte order than this machine's
};

// What the axes of the file are to the volume.
struct axes {
    int spatial[3], spatial_count;
    int time, channel; // -1 when there is none
};

// ---- Reading through teem ----------------------------------------------------------------------

// teem explains from the outermost function to the innermost; the last line is the reason.
static bool fail_from_teem(void) {
    char *text = biffGetDone(NRRD), reason[256] = "teem gives no reason";
    for (char *line = text; line && *line;) {
        size_t length = strcspn(line, "\n");
        char *next = line + length + (line[length] == '\n');
        line[length] = '\0';
        // "[nrrd] function: reason".
        char *colon = strncmp(line, "[nrrd] ", 7) == 0 ? strstr(line, ": ") : NULL;
        if (colon && colon[2])
            snprintf(reason, sizeof reason, "%s", colon + 2);
        line = next;
    }
    free(text);
    return pel_fail(PEL_ERROR_FORMAT, "%s", reason);
}

// Reads the header and what teem knows of its encoding, without voxels.
static bool read_header(Nrrd *nrrd, const char *path, struct coding *coding) {
    NrrdIoState *state = nrrdIoStateNew();
    nrrdIoStateSet(state, nrrdIoStateSkipData, 1);
    bool good = nrrdLoad(nrrd, path, state) == 0 || fail_from_teem();
    *coding = (struct coding){
        .encoding = state->encoding,
        .skip = {.lines = state->lineSkip, .bytes = state->byteSkip},
        .swap = state->endian != airEndianUnknown && state->endian != airMyEndian(),
    };
    if (good && !state->encoding->available())
        good = pel_fail(PEL_ERROR_UNSUPPORTED, "this build of teem cannot read %s data",
                        state->encoding->name);
    nrrdIoStateNix(state);
    return good;
}

// Lets teem read header and voxels. Returns the voxels to free(), in this machine's byte order.
static void *read_data(const char *path, size_t bytes) {
    Nrrd *nrrd = nrrdNew();
    void *block = NULL;
    if (nrrdLoad(nrrd, path, NULL) != 0) {
        fail_from_teem();
    } else if (nrrdElementNumber(nrrd) * nrrdElementSize(nrrd) != bytes) {
        pel_fail(PEL_ERROR_FORMAT, "its header changed while it was read");
    } else {
        block = nrrd->data;
        nrrd->data = NULL;
    }
    nrrdNuke(nrrd);
    return block;
}

// The most bytes of voxels that `data_bytes` of an encoding can hold.
static size_t decoded_limit(const NrrdEncoding *encoding, size_t data_bytes, size_t element_bytes) {
    size_t limit = data_bytes;
    if (encoding == nrrdEncodingGzip)
        return pel_inflated_limit(data_bytes);
    if (encoding == nrrdEncodingBzip2 &&
        (__builtin_mul_overflow(data_bytes, (size_t)BZIP2_RATIO, &limit) ||
         __builtin_add_overflow(limit, (size_t)BZIP2_BLOCK_BYTES, &limit)))
        return SIZE_MAX;
    if (encoding == nrrdEncodingAscii)
        return (data_bytes / 2 + 1) * element_bytes;
    return encoding == nrrdEncodingHex ? data_bytes / 2 : limit;
}

static bool element_of_type(int type, enum pel_element *element) {
    switch (type) {
    case nrrdTypeChar:
        *element = PEL_ELEMENT_I8;
        return true;
    case nrrdTypeUChar:
        *element = PEL_ELEMENT_U8;
        return true;
    case nrrdTypeShort:
        *element = PEL_ELEMENT_I16;
        return true;
    case nrrdTypeUShort:
        *element = PEL_ELEMENT_U16;
        return true;
    case nrrdTypeInt:
        *element = PEL_ELEMENT_I32;
        return true;
    case nrrdTypeUInt:
        *element = PEL_ELEMENT_U32;
        return true;
    case nrrdTypeLLong:
        *element = PEL_ELEMENT_I64;
        return true;
    case nrrdTypeULLong:
        *element = PEL_ELEMENT_U64;
        return true;
    case nrrdTypeFloat:
        *element = PEL_ELEMENT_F32;
        return true;
    case nrrdTypeDouble:
        *element = PEL_ELEMENT_F64;
        return true;
    default:
        return pel_fail(PEL_ERROR_UNSUPPORTED, "voxels of type %s cannot be shown",
                        airEnumStr(nrrdType, type));
    }
}

// ---- Axes --------------------------------------------------------------------------------------

static bool has_direction(const NrrdAxisInfo *axis) {
    double length = 0;
    for (int c = 0; c < 3; c++)
        length += axis->spaceDirection[c] * axis->spaceDirection[c];
    return isfinite(length) && length > 0;
}

// Kinds that do not say, such as "none" and "???", are told by the axis having a direction; without
// directions a first axis of 3 or 4 beside three larger ones is a colour, and what follows the
// third spatial axis is time.
static bool is_channel(const Nrrd *nrrd, unsigned a) {
    const NrrdAxisInfo *axis = &nrrd->axis[a];
    switch (axis->kind) {
    case nrrdKindDomain:
    case nrrdKindSpace:
    case nrrdKindTime:
        return false;
    case nrrdKindUnknown:
        if (nrrd->spaceDim > 0)
            return a == 0 && !has_direction(axis);
        return a == 0 && nrrd->dim > 3 && (axis->size == 3 || axis->size == 4) &&
               nrrd->axis[nrrd->dim - 1].size > 4;
    default:
        return true;
    }
}

static bool assign_axes(const Nrrd *nrrd, struct axes *axes) {
    *axes = (struct axes){.time = -1, .channel = -1};
    for (unsigned a = 0; a < nrrd->dim; a++) {
        const NrrdAxisInfo *axis = &nrrd->axis[a];
        bool spatial = axis->kind != nrrdKindTime && axes->spatial_count < 3 &&
                       (nrrd->spaceDim == 0 || has_direction(axis));
        int *slot = is_channel(nrrd, a) ? &axes->channel
                    : spatial           ? &axes->spatial[axes->spatial_count]
                                        : &axes->time;
        if (slot == &axes->spatial[axes->spatial_count])
            axes->spatial_count++;
        else if (*slot >= 0 && axis->size > 1)
            return pel_fail(PEL_ERROR_UNSUPPORTED,
                            "axis %u: only one axis of time and one of channels are read", a);
        *slot = (int)a;
    }
    if (axes->spatial_count == 0)
        return pel_fail(PEL_ERROR_FORMAT, "no axis is spatial");
    return true;
}

static int64_t axis_size(const Nrrd *nrrd, int axis) {
    if (axis < 0)
        return 1;
    size_t size = nrrd->axis[axis].size;
    return size > INT64_MAX ? INT64_MAX : (int64_t)size;
}

// ---- Placement ---------------------------------------------------------------------------------

// The signs that turn the file's space into RAS; names the space.
static const char *signs_from_space(int space, double signs[3]) {
    signs[0] = signs[1] = signs[2] = 1;
    switch (space) {
    case nrrdSpaceRightAnteriorSuperior:
    case nrrdSpaceRightAnteriorSuperiorTime:
        return "RAS";
    case nrrdSpaceLeftAnteriorSuperior:
    case nrrdSpaceLeftAnteriorSuperiorTime:
        signs[0] = -1;
        return "LAS";
    case nrrdSpaceLeftPosteriorSuperior:
    case nrrdSpaceLeftPosteriorSuperiorTime:
        signs[0] = signs[1] = -1;
        return "LPS";
    default:
        return NULL;
    }
}

static double millimetres(const char *unit) {
    static const struct {
        const char *name;
        double mm;
    } units[] = {{"mm", 1},    {"millimeter", 1}, {"um", 1e-3}, {"micron", 1e-3}, {"microns", 1e-3},
                 {"µm", 1e-3}, {"nm", 1e-6},      {"cm", 10},   {"m", 1e3},       {"meter", 1e3}};
    for (size_t i = 0; unit && i < sizeof units / sizeof *units; i++)
        if (strcmp(unit, units[i].name) == 0)
            return units[i].mm;
    return 1;
}

// A file without space: spacing and position along each axis, where it has them.
static void place_by_spacing(struct pel_volume *volume, const Nrrd *nrrd, const struct axes *axes) {
    for (int i = 0; i < axes->spatial_count; i++) {
        const NrrdAxisInfo *axis = &nrrd->axis[axes->spatial[i]];
        bool cell = axis->center == nrrdCenterCell;
        double spacing = axis->spacing, mm = millimetres(axis->units);
        double intervals = (double)axis->size - (cell ? 0 : 1);
        if (!isfinite(spacing) && isfinite(axis->max - axis->min) && intervals > 0)
            spacing = (axis->max - axis->min) / intervals;
        if (!isfinite(spacing) || spacing == 0)
            spacing = 1;
        volume->world_from_voxel.m[i][i] = spacing * mm;
        // The outer edge of the first cell is at min, or its centre.
        if (isfinite(axis->min))
            volume->world_from_voxel.m[i][3] = (axis->min + (cell ? spacing / 2 : 0)) * mm;
    }
    strcpy(volume->space, "spacings");
}

static bool place(struct pel_volume *volume, const Nrrd *nrrd, const struct axes *axes) {
    if (nrrd->spaceDim == 0) {
        place_by_spacing(volume, nrrd, axes);
        return true;
    }
    double signs[3];
    const char *space = signs_from_space(nrrd->space, signs);
    unsigned dims = nrrd->spaceDim < 3 ? nrrd->spaceDim : 3;
    struct pel_matrix *matrix = &volume->world_from_voxel, inverse;
    // Adding zero turns the -0 of a flipped axis into 0, for those who print it.
    for (unsigned r = 0; r < dims; r++) {
        double scale = signs[r] * millimetres(nrrd->spaceUnits[r]);
        for (int i = 0; i < axes->spatial_count; i++)
            matrix->m[r][i] = scale * nrrd->axis[axes->spatial[i]].spaceDirection[r] + 0.0;
        if (isfinite(nrrd->spaceOrigin[r]))
            matrix->m[r][3] = scale * nrrd->spaceOrigin[r] + 0.0;
    }
    // A picture gets a third direction of unit length.
    if (axes->spatial_count == 2 && dims == 3) {
        double a[3], b[3], c[3];
        for (int r = 0; r < 3; r++) {
            a[r] = matrix->m[r][0];
            b[r] = matrix->m[r][1];
        }
        pel_cross(c, a, b);
        if (pel_normalize(c))
            for (int r = 0; r < 3; r++)
                matrix->m[r][2] = c[r];
    }
    if (!pel_matrix_invert(&inverse, matrix))
        return pel_fail(PEL_ERROR_FORMAT, "its space directions lie in one plane");
    if (!space)
        pel_warn("%s: its space is not anatomical and taken for RAS", volume->name);
    snprintf(volume->space, sizeof volume->space, "space directions (%s)",
             space ? space : "unknown space");
    return true;
}

// ---- The volume --------------------------------------------------------------------------------

// The strides of the selection, and the bytes of all voxels, if the data can hold them.
static bool lay_out(struct pel_selection *selection, size_t strides[NRRD_DIM_MAX], size_t *bytes,
                    const Nrrd *header, const struct axes *axes, size_t limit) {
    size_t stride = 1, element_bytes = pel_element_bytes(selection->element);
    for (unsigned a = 0; a < header->dim; a++) {
        strides[a] = stride;
        if (!pel_size_multiply(&stride, 2, (size_t[]){stride, header->axis[a].size}))
            return false;
    }
    int64_t dims[3];
    for (int i = 0; i < 3; i++) {
        bool used = i < axes->spatial_count;
        dims[i] = axis_size(header, used ? axes->spatial[i] : -1);
        selection->stride[i] = used ? strides[axes->spatial[i]] : stride;
    }
    if (!pel_block_bytes(dims, element_bytes, limit, bytes) ||
        !pel_size_multiply(bytes, 2, (size_t[]){stride, element_bytes}))
        return false;
    for (int i = 0; i < 3; i++)
        selection->dims[i] = (int)dims[i];
    return *bytes <= limit ||
           pel_fail(PEL_ERROR_FORMAT, "%zu bytes of voxels are needed, the data has at most %zu",
                    *bytes, limit);
}

// Checks what the header says, reads the voxels and picks a volume out of them.
static struct pel_volume *read_volume(Nrrd *header, struct pel_nrrd_data *data, const char *path,
                                      const struct pel_load_options *options) {
    struct pel_selection selection = {0};
    struct coding coding;
    struct axes axes;
    size_t bytes, strides[NRRD_DIM_MAX];
    const char *name = pel_path_leaf(path);
    if (!pel_nrrd_guard(data, path) || !read_header(header, path, &coding) ||
        !element_of_type(header->type, &selection.element) || !assign_axes(header, &axes))
        return NULL;
    size_t limit =
        decoded_limit(coding.encoding, data->bytes, pel_element_bytes(selection.element));
    if (!lay_out(&selection, strides, &bytes, header, &axes, limit) ||
        !pel_select_time(&selection, name, axis_size(header, axes.time),
                         axes.time < 0 ? 0 : strides[axes.time], options) ||
        !pel_select_channel(&selection, name, axis_size(header, axes.channel),
                            axes.channel < 0 ? 0 : strides[axes.channel], options))
        return NULL;
    bool bzip2 = coding.encoding == nrrdEncodingBzip2;
    bool packed = bzip2 || coding.encoding == nrrdEncodingGzip;
    void *block =
        packed ? pel_nrrd_unpack(data, bzip2, &coding.skip, bytes) : read_data(path, bytes);
    selection.swap = packed && coding.swap;
    struct pel_volume *volume = block ? pel_volume_select(name, &selection, block) : NULL;
    free(block);
    if (volume && !place(volume, header, &axes)) {
        pel_volume_destroy(volume);
        return NULL;
    }
    if (volume && header->sampleUnits) {
        // The unit stands as it is; some writers quote it as axis units are.
        const char *unit = header->sampleUnits + (header->sampleUnits[0] == '"');
        snprintf(volume->unit, sizeof volume->unit, "%.*s", (int)strcspn(unit, "\""), unit);
    }
    return volume;
}

struct pel_volume *pel_nrrd_load(const char *path, const struct pel_load_options *options) {
    pthread_mutex_lock(&teem_lock);
    nrrdStateVerboseIO = 0;
    Nrrd *header = nrrdNew();
    struct pel_nrrd_data data = {0};
    struct pel_volume *volume = read_volume(header, &data, path, options);
    pel_nrrd_data_finish(&data);
    nrrdNuke(header);
    pthread_mutex_unlock(&teem_lock);
    return volume;
}
