// raw.c - voxels without a header, described by options or by a JSON file beside them.
//
// The sidecar of NAME.raw is NAME.raw.json or NAME.json:
//
//     {"dims": [32, 32, 32], "type": "uint8", "spacing": [1, 1, 2], "origin": [0, 0, 0],
//      "endian": "little", "offset": 0, "slope": 1, "intercept": 0, "unit": "HU"}
//
// dims and type are required. "world_from_voxel", a 4x4 array of rows, may stand in place of
// spacing and origin; "labels" (boolean) and "space" (text) are what the volume's members say.
#include "volume/volume.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <jansson.h>

#include "base/error.h"
#include "base/file.h"
#include "base/math.h"
#include "base/memory.h"
#include "volume/save.h"
#include "volume/widen.h"
#include "volume/source.h"

enum { SIDECAR_BYTES_MAX = 1 << 20 };

// What is known about the bytes of a raw file.
struct description {
    int64_t dims[3];
    enum pel_voxel_type type;
    int64_t offset;
    bool big_endian, labels;
    double slope, intercept;
    struct pel_matrix world_from_voxel;
    char unit[16], space[64];
};

// ---- The sidecar -------------------------------------------------------------------------------

static bool read_numbers(const json_t *array, double *numbers, size_t count) {
    if (json_array_size(array) != count)
        return pel_fail(PEL_ERROR_FORMAT, "must be an array of %zu", count);
    for (size_t i = 0; i < count; i++) {
        const json_t *number = json_array_get(array, i);
        if (!json_is_number(number))
            return pel_fail(PEL_ERROR_FORMAT, "element %zu is not a number", i);
        numbers[i] = json_number_value(number);
    }
    return true;
}

static bool read_number(const json_t *value, double *number) {
    if (!json_is_number(value))
        return pel_fail(PEL_ERROR_FORMAT, "is not a number");
    *number = json_number_value(value);
    return true;
}

static bool read_text(const json_t *value, char *text, size_t bytes) {
    if (!json_is_string(value) || json_string_length(value) >= bytes)
        return pel_fail(PEL_ERROR_FORMAT, "must be a text of fewer than %zu bytes", bytes);
    memcpy(text, json_string_value(value), json_string_length(value) + 1);
    return true;
}

static bool read_dims(const json_t *array, int64_t dims[3]) {
    if (json_array_size(array) != 3)
        return pel_fail(PEL_ERROR_FORMAT, "must be an array of 3");
    for (size_t i = 0; i < 3; i++) {
        if (!json_is_integer(json_array_get(array, i)))
            return pel_fail(PEL_ERROR_FORMAT, "element %zu is not an integer", i);
        dims[i] = json_integer_value(json_array_get(array, i));
    }
    return true;
}

static bool read_type(const json_t *value, enum pel_voxel_type *type) {
    char name[16];
    if (!read_text(value, name, sizeof name))
        return false;
    if (pel_voxel_type_from_name(name, type))
        return true;
    return pel_fail(PEL_ERROR_FORMAT,
                    "'%s' is none of uint8, int8, uint16, int16, float32, rgb8, rgba8", name);
}

static bool read_endian(const json_t *value, bool *big_endian) {
    char name[8];
    if (!read_text(value, name, sizeof name))
        return false;
    *big_endian = strcmp(name, "big") == 0;
    if (!*big_endian && strcmp(name, "little") != 0)
        return pel_fail(PEL_ERROR_FORMAT, "'%s' is neither little nor big", name);
    return true;
}

static bool read_matrix(const json_t *rows, struct pel_matrix *matrix) {
    if (json_array_size(rows) != 4)
        return pel_fail(PEL_ERROR_FORMAT, "must be an array of 4 rows");
    for (size_t r = 0; r < 4; r++)
        if (!read_numbers(json_array_get(rows, r), matrix->m[r], 4))
            return pel_fail_in("row %zu", r);
    const double *last = matrix->m[3];
    if (last[0] != 0 || last[1] != 0 || last[2] != 0 || last[3] != 1)
        return pel_fail(PEL_ERROR_FORMAT, "the last row must be 0 0 0 1");
    return true;
}

// Reads one key. `*spacing`, `*origin` and the matrix are put together by the caller.
static bool read_key(struct description *description, double spacing[3], double origin[3],
                     const char *key, const json_t *value) {
    if (strcmp(key, "dims") == 0)
        return read_dims(value, description->dims);
    if (strcmp(key, "type") == 0)
        return read_type(value, &description->type);
    if (strcmp(key, "spacing") == 0)
        return read_numbers(value, spacing, 3);
    if (strcmp(key, "origin") == 0)
        return read_numbers(value, origin, 3);
    if (strcmp(key, "offset") == 0) {
        description->offset = json_is_integer(value) ? json_integer_value(value) : -1;
        return description->offset >= 0 || pel_fail(PEL_ERROR_FORMAT, "must be a count of bytes");
    }
    if (strcmp(key, "endian") == 0)
        return read_endian(value, &description->big_endian);
    if (strcmp(key, "slope") == 0)
        return read_number(value, &description->slope);
    if (strcmp(key, "intercept") == 0)
        return read_number(value, &description->intercept);
    if (strcmp(key, "unit") == 0)
        return read_text(value, description->unit, sizeof description->unit);
    if (strcmp(key, "space") == 0)
        return read_text(value, description->space, sizeof description->space);
    if (strcmp(key, "world_from_voxel") == 0)
        return read_matrix(value, &description->world_from_voxel);
    if (strcmp(key, "labels") == 0) {
        description->labels = json_is_true(value);
        return json_is_boolean(value) || pel_fail(PEL_ERROR_FORMAT, "must be true or false");
    }
    return pel_fail(PEL_ERROR_FORMAT,
                    "unknown key, there are dims, type, spacing, origin, offset, endian, slope, "
                    "intercept, unit, world_from_voxel, labels, space");
}

static struct pel_matrix matrix_from_spacing(const double spacing[3], const double origin[3]) {
    struct pel_matrix matrix = pel_matrix_scaling(spacing);
    for (int i = 0; i < 3; i++)
        matrix.m[i][3] = origin[i];
    return matrix;
}

static bool describe(struct description *description, const json_t *root) {
    double spacing[3] = {1, 1, 1}, origin[3] = {0};
    const char *key;
    json_t *value;
    if (!json_is_object(root))
        return pel_fail(PEL_ERROR_FORMAT, "not a JSON object");
    json_object_foreach((json_t *)root, key, value) if (!read_key(description, spacing, origin, key,
                                                                  value)) return pel_fail_in("%s",
                                                                                             key);
    if (!json_object_get(root, "dims") || !json_object_get(root, "type"))
        return pel_fail(PEL_ERROR_FORMAT, "dims and type must be given");
    bool has_spacing = json_object_get(root, "spacing") || json_object_get(root, "origin");
    if (json_object_get(root, "world_from_voxel")) {
        if (has_spacing)
            return pel_fail(PEL_ERROR_FORMAT,
                            "world_from_voxel stands in place of spacing and origin");
    } else {
        description->world_from_voxel = matrix_from_spacing(spacing, origin);
    }
    struct pel_matrix inverse;
    if (!pel_matrix_invert(&inverse, &description->world_from_voxel))
        return pel_fail(PEL_ERROR_FORMAT, "the placement is singular");
    if (!isfinite(description->slope) || description->slope == 0 ||
        !isfinite(description->intercept))
        return pel_fail(PEL_ERROR_FORMAT, "a slope of %g cannot be", description->slope);
    return true;
}

// Reads NAME.raw.json or NAME.json; sentences carry the sidecar's name.
static bool read_sidecar(struct description *description, const char *path) {
    char *sidecar = pel_raw_sidecar(path), *text = NULL;
    bool good = false;
    if (!sidecar)
        return pel_fail(PEL_ERROR_FORMAT,
                        "a headerless file: give its dimensions and type, or write them to %s.json",
                        pel_path_leaf(path));
    size_t bytes;
    text = pel_file_read(sidecar, SIDECAR_BYTES_MAX, &bytes);
    if (!text)
        goto done;
    json_error_t error;
    json_t *root = json_loadb(text, bytes, JSON_REJECT_DUPLICATES, &error);
    if (!root)
        pel_fail(PEL_ERROR_FORMAT, "%s:%d:%d: %s", pel_path_leaf(sidecar), error.line, error.column,
                 error.text);
    else if (!(good = describe(description, root)))
        pel_fail_in("%s", pel_path_leaf(sidecar));
    json_decref(root);
done:
    free(text);
    free(sidecar);
    return good;
}

// ---- The voxels --------------------------------------------------------------------------------

static void describe_from_options(struct description *description,
                                  const struct pel_load_options *options) {
    double spacing[3];
    for (int i = 0; i < 3; i++) {
        description->dims[i] = options->raw.dims[i];
        spacing[i] = options->raw.spacing[i] != 0 ? options->raw.spacing[i] : 1;
    }
    description->type = options->raw.type;
    description->offset = (int64_t)options->raw.offset;
    description->big_endian = options->raw.big_endian;
    description->world_from_voxel = matrix_from_spacing(spacing, options->raw.origin);
}

static struct pel_volume *read_voxels(struct pel_source *source, const char *name,
                                      const struct description *description) {
    int components = description->type == PEL_VOXEL_RGB8    ? 3
                     : description->type == PEL_VOXEL_RGBA8 ? 4
                                                            : 1;
    enum pel_element element =
        components > 1 ? PEL_ELEMENT_U8 : (enum pel_element)description->type;
    if (!pel_source_skip(source, (size_t)description->offset))
        return NULL;
    struct pel_volume *volume =
        pel_source_read_volume(source, name, description->dims, element, components,
                               description->big_endian == pel_little_endian());
    bool more;
    if (!volume || !pel_source_finish(source, &more)) {
        pel_volume_destroy(volume);
        return NULL;
    }
    if (more && !source->compressed)
        pel_warn("%s: %zu bytes follow the voxels and are ignored", name,
                 source->capacity - source->position);
    volume->slope = description->slope;
    volume->intercept = description->intercept;
    volume->labels = description->labels;
    volume->world_from_voxel = description->world_from_voxel;
    memcpy(volume->unit, description->unit, sizeof volume->unit);
    memcpy(volume->space, description->space, sizeof volume->space);
    return volume;
}

char *pel_raw_sidecar(const char *path) {
    const char *leaf = pel_path_leaf(path), *dot = strrchr(leaf, '.');
    int stem = dot && dot > leaf ? (int)(dot - path) : (int)strlen(path);
    const int lengths[] = {(int)strlen(path), stem};
    for (int i = 0; i < 2; i++) {
        char *sidecar = NULL;
        if (asprintf(&sidecar, "%.*s.json", lengths[i], path) < 0)
            return NULL;
        if (strcmp(sidecar, path) != 0 && access(sidecar, R_OK) == 0)
            return sidecar;
        free(sidecar);
    }
    return NULL;
}

struct pel_volume *pel_raw_load(const char *path, const struct pel_load_options *options) {
    struct description description = {.slope = 1, .space = "raw"};
    if (options->raw.dims[0] > 0)
        describe_from_options(&description, options);
    else if (!read_sidecar(&description, path))
        return NULL;
    struct pel_source source;
    struct pel_volume *volume = NULL;
    if (pel_source_open(&source, path))
        volume = read_voxels(&source, pel_path_leaf(path), &description);
    pel_source_close(&source);
    return volume;
}

// ---- Saving ------------------------------------------------------------------------------------

static bool write_sidecar(FILE *stream, const struct pel_volume *volume, const char *data_file) {
    (void)data_file;
    json_t *rows = json_array();
    for (int r = 0; r < 4; r++) {
        const double *row = volume->world_from_voxel.m[r];
        json_array_append_new(rows, json_pack("[f,f,f,f]", row[0], row[1], row[2], row[3]));
    }
    json_t *root =
        json_pack("{s:[i,i,i], s:s, s:s, s:f, s:f, s:s, s:s, s:b, s:o}", "dims", volume->dims[0],
                  volume->dims[1], volume->dims[2], "type", pel_voxel_type_name(volume->type),
                  "endian", pel_little_endian() ? "little" : "big", "slope", volume->slope,
                  "intercept", volume->intercept, "unit", volume->unit, "space", volume->space,
                  "labels", volume->labels, "world_from_voxel", rows);
    if (!root)
        return pel_fail(PEL_ERROR_MEMORY, "cannot describe the voxels as JSON");
    bool good = json_dumpf(root, stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == 0 &&
                fputc('\n', stream) != EOF;
    json_decref(root);
    return good || pel_fail(PEL_ERROR_FILE, "cannot write the sidecar");
}

bool pel_raw_save(const struct pel_volume *volume, const char *path) {
    char *sidecar_path = NULL;
    if (asprintf(&sidecar_path, "%s.json", path) < 0)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
    bool good = pel_save_with_header(volume, sidecar_path, path, write_sidecar);
    free(sidecar_path);
    return good;
}
