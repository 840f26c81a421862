// metaimage.c - MetaImage (.mhd, .mha), the format of ITK.
//
// No Debian package has MetaIO as a C library, and the format is small: lines "Key = value" up to
// ElementDataFile, which names where the voxels are - LOCAL for right behind that line, a file, a
// LIST of files one per line, or a printf pattern with first, last and step. Reference: ITK's
// MetaIO documentation and metaImage.cxx.
//
// Coordinates are LPS. Row a of TransformMatrix is the direction of axis a.
#include "volume/volume.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "base/file.h"
#include "base/math.h"
#include "base/memory.h"
#include "volume/metaimage_data.h"
#include "volume/source.h"

enum { HEADER_BYTES_MAX = 1 << 20, VALUE_BYTES_MAX = 4096, NDIMS_MAX = 10 };

struct header {
    struct pel_metaimage_data data;
    int ndims;
    int64_t dims[NDIMS_MAX];
    int64_t channels;
    enum pel_element element;
    bool has_element, big_endian, ascii, has_transform;
    double spacing[NDIMS_MAX], offset[NDIMS_MAX], transform[NDIMS_MAX * NDIMS_MAX];
    double slope, intercept, unit_mm;
};

// ---- Keys --------------------------------------------------------------------------------------

static bool parse_doubles(const char *text, double *numbers, int count) {
    for (int i = 0; i < count; i++) {
        char *after;
        numbers[i] = strtod(text, &after);
        if (after == text || !isfinite(numbers[i]))
            return pel_fail(PEL_ERROR_FORMAT, "%d numbers are needed, number %d is missing", count,
                            i + 1);
        text = after;
    }
    return true;
}

static bool parse_integers(const char *text, int64_t *numbers, int count) {
    for (int i = 0; i < count; i++) {
        char *after;
        errno = 0;
        numbers[i] = strtoll(text, &after, 10);
        if (after == text || errno != 0)
            return pel_fail(PEL_ERROR_FORMAT, "%d integers are needed, number %d is missing", count,
                            i + 1);
        text = after;
    }
    return true;
}

static bool is_true(const char *text) {
    return *text == 'T' || *text == 't' || *text == '1' || *text == 'Y' || *text == 'y';
}

static bool parse_element(const char *text, struct header *header) {
    static const struct {
        const char *name;
        enum pel_element element;
    } types[] = {
        {"MET_CHAR", PEL_ELEMENT_I8},       {"MET_UCHAR", PEL_ELEMENT_U8},
        {"MET_SHORT", PEL_ELEMENT_I16},     {"MET_USHORT", PEL_ELEMENT_U16},
        {"MET_INT", PEL_ELEMENT_I32},       {"MET_UINT", PEL_ELEMENT_U32},
        {"MET_LONG", PEL_ELEMENT_I32},      {"MET_ULONG", PEL_ELEMENT_U32},
        {"MET_LONG_LONG", PEL_ELEMENT_I64}, {"MET_ULONG_LONG", PEL_ELEMENT_U64},
        {"MET_FLOAT", PEL_ELEMENT_F32},     {"MET_DOUBLE", PEL_ELEMENT_F64},
    };
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        size_t length = strlen(types[i].name);
        // The array types name the element of several channels.
        if (strncmp(text, types[i].name, length) == 0 &&
            (text[length] == '\0' || strcmp(text + length, "_ARRAY") == 0)) {
            header->element = types[i].element;
            return header->has_element = true;
        }
    }
    return pel_fail(PEL_ERROR_UNSUPPORTED, "'%s' is no type of numbers that is read", text);
}

static bool parse_unit(const char *text, struct header *header) {
    static const struct {
        const char *name;
        double mm;
    } units[] = {{"mm", 1}, {"um", 1e-3}, {"cm", 10}, {"m", 1e3}, {"nm", 1e-6}, {"?", 1}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(text, units[i].name) == 0) {
            header->unit_mm = units[i].mm;
            return true;
        }
    }
    return pel_fail(PEL_ERROR_FORMAT, "'%s' is no unit of length", text);
}

// Keys that only people read, and CenterOfRotation, are passed over like unknown ones: programs add
// their own.
static bool read_key(struct header *header, const char *key, const char *value) {
    int ndims = header->ndims;
    if (strcmp(key, "NDims") == 0) {
        int64_t number;
        if (!parse_integers(value, &number, 1))
            return false;
        if (number < 1 || number > NDIMS_MAX)
            return pel_fail(PEL_ERROR_FORMAT, "%lld is outside 1..%d", (long long)number,
                            NDIMS_MAX);
        header->ndims = (int)number;
        return true;
    }
    if (strcmp(key, "ObjectType") == 0)
        return strcasecmp(value, "Image") == 0 ||
               pel_fail(PEL_ERROR_UNSUPPORTED, "'%s' is not an image", value);
    if (strcmp(key, "DimSize") == 0)
        return parse_integers(value, header->dims, ndims);
    if (strcmp(key, "ElementType") == 0)
        return parse_element(value, header);
    if (strcmp(key, "ElementNumberOfChannels") == 0)
        return parse_integers(value, &header->channels, 1);
    // ElementSize is the voxel's extent; it stands in where ElementSpacing is missing.
    if (strcmp(key, "ElementSpacing") == 0 ||
        (strcmp(key, "ElementSize") == 0 && header->spacing[0] == 0))
        return parse_doubles(value, header->spacing, ndims);
    if (strcmp(key, "Offset") == 0 || strcmp(key, "Position") == 0 || strcmp(key, "Origin") == 0)
        return parse_doubles(value, header->offset, ndims);
    if (strcmp(key, "TransformMatrix") == 0 || strcmp(key, "Rotation") == 0 ||
        strcmp(key, "Orientation") == 0)
        return header->has_transform = parse_doubles(value, header->transform, ndims * ndims);
    if (strcmp(key, "ElementByteOrderMSB") == 0 || strcmp(key, "BinaryDataByteOrderMSB") == 0)
        header->big_endian = is_true(value);
    else if (strcmp(key, "BinaryData") == 0)
        header->ascii = !is_true(value);
    else if (strcmp(key, "CompressedData") == 0)
        header->data.compressed = is_true(value);
    else if (strcmp(key, "CompressedDataSize") == 0)
        return parse_integers(value, &header->data.compressed_bytes, 1);
    else if (strcmp(key, "HeaderSize") == 0)
        return parse_integers(value, &header->data.header_bytes, 1);
    else if (strcmp(key, "ElementToIntensityFunctionSlope") == 0)
        return parse_doubles(value, &header->slope, 1);
    else if (strcmp(key, "ElementToIntensityFunctionOffset") == 0)
        return parse_doubles(value, &header->intercept, 1);
    else if (strcmp(key, "DistanceUnits") == 0)
        return parse_unit(value, header);
    return true;
}

// Copies text[0..length) without blanks at its ends.
static bool copy_trimmed(char *out, const char *text, size_t length) {
    while (length > 0 && (*text == ' ' || *text == '\t'))
        text++, length--;
    while (length > 0 && strchr(" \t\r", text[length - 1]))
        length--;
    if (length >= VALUE_BYTES_MAX || memchr(text, '\0', length))
        return pel_fail(PEL_ERROR_FORMAT, "a line of its header is not text");
    memcpy(out, text, length);
    out[length] = '\0';
    return true;
}

// Reads all lines up to ElementDataFile. `text` has a zero byte behind it.
static bool parse_header(struct header *header, const char *text, size_t bytes) {
    const char *line = text, *end = text + bytes;
    char key[VALUE_BYTES_MAX], value[VALUE_BYTES_MAX];
    while (line < end) {
        const char *line_end = memchr(line, '\n', (size_t)(end - line));
        if (!line_end)
            line_end = end;
        const char *equals = memchr(line, '=', (size_t)(line_end - line));
        if (!equals) {
            if (!copy_trimmed(value, line, (size_t)(line_end - line)))
                return false;
            if (value[0] != '\0')
                return pel_fail(PEL_ERROR_FORMAT, "'%.40s' is not Key = value", value);
            line = line_end + 1;
            continue;
        }
        if (!copy_trimmed(key, line, (size_t)(equals - line)) ||
            !copy_trimmed(value, equals + 1, (size_t)(line_end - equals - 1)))
            return false;
        line = line_end < end ? line_end + 1 : end;
        if (strcmp(key, "ElementDataFile") == 0)
            return pel_metaimage_data_parse(&header->data, value, line, (size_t)(line - text)) ||
                   pel_fail_in("ElementDataFile");
        if (!read_key(header, key, value))
            return pel_fail_in("%s", key);
    }
    return pel_fail(PEL_ERROR_FORMAT, "no ElementDataFile");
}

static bool check_header(struct header *header) {
    if (header->ndims == 0 || header->dims[0] == 0)
        return pel_fail(PEL_ERROR_FORMAT, "NDims and DimSize are needed, in this order");
    if (!header->has_element)
        return pel_fail(PEL_ERROR_FORMAT, "no ElementType");
    if (header->ascii)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "voxels written as text are not read");
    if (header->channels < 1 || header->channels > PEL_DIMENSION_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "%lld channels", (long long)header->channels);
    for (int i = 0; i < NDIMS_MAX; i++) {
        if (i >= header->ndims)
            header->dims[i] = 1;
        if (header->dims[i] < 1 || header->dims[i] > PEL_DIMENSION_MAX)
            return pel_fail(PEL_ERROR_FORMAT, "%lld voxels along axis %d, outside 1..%d",
                            (long long)header->dims[i], i, PEL_DIMENSION_MAX);
        if (i > 3 && header->dims[i] > 1)
            return pel_fail(PEL_ERROR_UNSUPPORTED, "more than four dimensions");
    }
    return true;
}

// ---- The volume --------------------------------------------------------------------------------

static void place(struct pel_volume *volume, const struct header *header) {
    struct pel_matrix matrix = pel_matrix_identity(), inverse;
    int axes = header->ndims < 3 ? header->ndims : 3;
    double spacing[3] = {1, 1, 1};
    for (int axis = 0; axis < axes; axis++) {
        if (header->spacing[axis] != 0)
            spacing[axis] = fabs(header->spacing[axis]);
        for (int r = 0; header->has_transform && r < axes; r++)
            matrix.m[r][axis] = header->transform[axis * header->ndims + r];
    }
    if (!pel_matrix_invert(&inverse, &matrix)) {
        pel_error_clear();
        pel_warn("%s: its TransformMatrix is singular and ignored", volume->name);
        matrix = pel_matrix_identity();
    }
    for (int r = 0; r < 3; r++) {
        // LPS to RAS. Adding zero turns -0 into 0, for those who print it.
        double sign = (r < 2 ? -1 : 1) * header->unit_mm;
        for (int axis = 0; axis < 3; axis++)
            matrix.m[r][axis] = sign * spacing[axis] * matrix.m[r][axis] + 0.0;
        matrix.m[r][3] = r < axes ? sign * header->offset[r] + 0.0 : 0;
    }
    volume->world_from_voxel = matrix;
    strcpy(volume->space,
           header->has_transform ? "MetaImage TransformMatrix (LPS)" : "MetaImage spacing (LPS)");
}

static struct pel_volume *read_volume(struct header *header, const char *path,
                                      const struct pel_load_options *options) {
    const char *name = pel_path_leaf(path);
    size_t voxel_bytes = pel_element_bytes(header->element), step_bytes, bytes;
    if (!pel_block_bytes(header->dims, voxel_bytes, SIZE_MAX, &step_bytes))
        return NULL;
    // Headers exist that claim the channels of a picture made of the volume.
    size_t held;
    if (header->channels > 1 && pel_metaimage_data_held(&header->data, path, &held) &&
        held == step_bytes * (size_t)header->dims[3]) {
        pel_warn("%s: %lld channels are claimed, but the data file has one, which is read", name,
                 (long long)header->channels);
        header->channels = 1;
    }
    if (!pel_size_multiply(
            &bytes, 3, (size_t[]){step_bytes, (size_t)header->channels, (size_t)header->dims[3]}))
        return NULL;

    struct pel_selection selection = {
        .dims = {(int)header->dims[0], (int)header->dims[1], (int)header->dims[2]},
        .element = header->element,
        .swap = header->big_endian == pel_little_endian(),
    };
    size_t stride = (size_t)header->channels;
    for (int axis = 0; axis < 3; axis++) {
        selection.stride[axis] = stride;
        stride *= (size_t)header->dims[axis];
    }
    if (!pel_select_time(&selection, name, header->dims[3], stride, options) ||
        !pel_select_channel(&selection, name, header->channels, 1, options))
        return NULL;
    void *block = pel_metaimage_data_read(&header->data, path, bytes);
    struct pel_volume *volume = block ? pel_volume_select(name, &selection, block) : NULL;
    free(block);
    if (volume) {
        place(volume, header);
        if (header->slope != 0) {
            volume->slope = header->slope;
            volume->intercept = header->intercept;
        }
    }
    return volume;
}

struct pel_volume *pel_metaimage_load(const char *path, const struct pel_load_options *options) {
    struct header header = {.channels = 1, .slope = 1, .unit_mm = 1};
    struct pel_volume *volume = NULL;
    size_t bytes;
    char *text = pel_source_head(path, HEADER_BYTES_MAX, &bytes);
    if (text && parse_header(&header, text, bytes) && check_header(&header))
        volume = read_volume(&header, path, options);
    pel_metaimage_data_finish(&header.data);
    free(text);
    return volume;
}
