// transfer_file.c - transfer functions in JSON. Pellucid's own format is read here, and strictly,
// so that a slip of the pen is found: each key is known, and what is wrong is named.
#include "transfer/transfer_file.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/text.h"
#include "transfer/transfer.h"
#include "transfer/transfer_file_vtk.h"

enum { file_limit = 16 << 20, point_limit = 65536 };

void pel_transfer_reader_at(struct pel_transfer_reader *reader, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reader->place, sizeof reader->place, format, arguments);
    va_end(arguments);
}

// What is under `key`, or under its other spelling, with the reader put there; NULL if neither is.
static const json_t *get(struct pel_transfer_reader *reader, const json_t *object, const char *key,
                         const char *alias) {
    const json_t *value = json_object_get(object, key);
    if (!value && alias)
        value = json_object_get(object, key = alias);
    if (value)
        pel_transfer_reader_at(reader, "%s", key);
    return value;
}

bool pel_transfer_read_number(const json_t *json, double *number) {
    if (!json_is_number(json))
        return pel_fail(PEL_ERROR_FORMAT, "expected a number");
    *number = json_number_value(json);
    return true;
}

static const char *const known_keys[] = {"comment",      "preset",        "range",   "colours",
                                         "colors",       "opacities",     "points",  "scale",
                                         "opacity_unit", "interpolation", "entries", NULL};

// In the order of their enum.
static const char *const scales[] = {"absolute", "relative", "percentile", NULL};

static bool check_keys(struct pel_transfer_reader *reader, const json_t *object) {
    // jansson's iterators take a plain pointer but only read.
    for (void *entry = json_object_iter((json_t *)object); entry;
         entry = json_object_iter_next((json_t *)object, entry)) {
        const char *key = json_object_iter_key(entry);
        bool known = false;
        for (int i = 0; known_keys[i]; i++)
            known = known || strcmp(key, known_keys[i]) == 0;
        if (known)
            continue;
        pel_transfer_reader_at(reader, "%s", key);
        const char *nearest = pel_text_nearest(key, known_keys);
        return nearest ? pel_fail(PEL_ERROR_FORMAT, "unknown key; did you mean '%s'", nearest)
                       : pel_fail(PEL_ERROR_FORMAT, "unknown key");
    }
    return true;
}

static bool read_hex(const char *text, double rgb[3]) {
    unsigned value;
    if (text[0] != '#' || strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6 ||
        sscanf(text + 1, "%6x", &value) != 1)
        return pel_fail(PEL_ERROR_FORMAT, "'%.16s' is not a colour as '#rrggbb'", text);
    for (int i = 0; i < 3; i++)
        rgb[i] = (value >> (16 - 8 * i) & 0xff) / 255.0;
    return true;
}

// One control point: [value, colour, opacity], where `colour` is three numbers or one text. NULL
// for what this kind of point does not have.
static bool read_point(const json_t *row, double *value, double rgb[3], double *opacity) {
    const json_t *text = json_array_get(row, 1);
    bool hex = rgb && json_is_string(text);
    size_t colours = !rgb ? 0 : hex ? 1 : 3;
    if (json_array_size(row) != 1 + colours + (opacity ? 1 : 0))
        return pel_fail(PEL_ERROR_FORMAT, "expected [value%s%s]",
                        !rgb  ? ""
                        : hex ? ", \"#rrggbb\""
                              : ", red, green, blue",
                        opacity ? ", opacity" : "");
    if (!pel_transfer_read_number(json_array_get(row, 0), value))
        return false;
    if (hex && !read_hex(json_string_value(text), rgb))
        return false;
    for (size_t i = 0; rgb && !hex && i < 3; i++)
        if (!pel_transfer_read_number(json_array_get(row, 1 + i), &rgb[i]))
            return false;
    return !opacity || pel_transfer_read_number(json_array_get(row, 1 + colours), opacity);
}

// Replaces the colours, the opacities, or both by the points in `rows`, which is under `key`.
static bool read_curve(struct pel_transfer_reader *reader, const json_t *rows, bool colours,
                       bool opacities) {
    char key[PEL_PLACE_BYTES];
    strcpy(key, reader->place);
    size_t count = json_array_size(rows);
    if (count < 1 || count > point_limit)
        return pel_fail(PEL_ERROR_FORMAT, "expected a list of 1 to %d points", point_limit);

    struct pel_transfer *old = reader->transfer;
    struct pel_transfer *made = pel_transfer_create(colours ? (int)count : old->colour_count,
                                                    opacities ? (int)count : old->opacity_count);
    if (!made)
        return false;
    if (colours) {
        free(old->colours);
        old->colours = made->colours;
        old->colour_count = made->colour_count;
        made->colours = NULL;
    }
    if (opacities) {
        free(old->opacities);
        old->opacities = made->opacities;
        old->opacity_count = made->opacity_count;
        made->opacities = NULL;
    }
    pel_transfer_destroy(made);

    for (int i = 0; i < (int)count; i++) {
        pel_transfer_reader_at(reader, "%.*s.%d", PEL_PLACE_BYTES - 16, key, i);
        struct pel_colour_point *colour = colours ? &old->colours[i] : NULL;
        struct pel_opacity_point *opacity = opacities ? &old->opacities[i] : NULL;
        double value = 0;
        if (!read_point(json_array_get(rows, (size_t)i), &value, colour ? colour->rgb : NULL,
                        opacity ? &opacity->opacity : NULL))
            return false;
        if (colour)
            colour->value = value;
        if (opacity)
            opacity->value = value;
        if ((colour && !pel_transfer_check_colour(old, i)) ||
            (opacity && !pel_transfer_check_opacity(old, i)))
            return false;
    }
    return true;
}

static bool read_curves(struct pel_transfer_reader *reader, const json_t *object) {
    const json_t *points = get(reader, object, "points", NULL);
    if (points) {
        const json_t *other = get(reader, object, "colours", "colors");
        other = other ? other : get(reader, object, "opacities", NULL);
        if (other)
            return pel_fail(PEL_ERROR_FORMAT, "'points' gives this already");
        get(reader, object, "points", NULL);
        return read_curve(reader, points, true, true);
    }
    const json_t *colours = get(reader, object, "colours", "colors");
    if (colours && !read_curve(reader, colours, true, false))
        return false;
    const json_t *opacities = get(reader, object, "opacities", NULL);
    return !opacities || read_curve(reader, opacities, false, true);
}

// Finds a word in a list; -1 (FORMAT) when it is not there.
static int read_word(const json_t *json, const char *const *words) {
    const char *word = json_string_value(json);
    for (int i = 0; word && words[i]; i++)
        if (strcmp(word, words[i]) == 0)
            return i;
    const char *nearest = word ? pel_text_nearest(word, words) : NULL;
    if (nearest)
        pel_fail(PEL_ERROR_FORMAT, "unknown word '%.32s'; did you mean '%s'", word, nearest);
    else
        pel_fail(PEL_ERROR_FORMAT, "expected one of \"%s\", \"%s\"%s%s%s%s%.32s%s", words[0],
                 words[1], words[2] ? ", \"" : "", words[2] ? words[2] : "", words[2] ? "\"" : "",
                 word ? ", not \"" : "", word ? word : "", word ? "\"" : "");
    return -1;
}

static bool read_settings(struct pel_transfer_reader *reader, const json_t *object) {
    struct pel_transfer *transfer = reader->transfer;
    const json_t *json = get(reader, object, "opacity_unit", NULL);
    if (json) {
        if (!pel_transfer_read_number(json, &transfer->opacity_unit_mm))
            return false;
        if (!(transfer->opacity_unit_mm > 0))
            return pel_fail(PEL_ERROR_FORMAT, "%g mm is not a positive length",
                            transfer->opacity_unit_mm);
    }
    json = get(reader, object, "interpolation", NULL);
    if (json) {
        int word = read_word(json, (const char *const[]){"linear", "nearest", NULL});
        if (word < 0)
            return false;
        transfer->nearest = word == 1;
    }
    json = get(reader, object, "entries", NULL);
    if (json) {
        json_int_t entries = json_integer_value(json);
        if (entries < PEL_TRANSFER_ENTRIES_MIN || entries > PEL_TRANSFER_ENTRIES_MAX)
            return pel_fail(PEL_ERROR_FORMAT, "expected a whole number in %d..%d",
                            PEL_TRANSFER_ENTRIES_MIN, PEL_TRANSFER_ENTRIES_MAX);
        transfer->table_entries = (int)entries;
    }
    return true;
}

// Starts with the preset, or with white and no opacity at all.
static bool read_start(struct pel_transfer_reader *reader, const json_t *object) {
    const json_t *preset = get(reader, object, "preset", NULL);
    if (preset) {
        if (!json_is_string(preset))
            return pel_fail(PEL_ERROR_FORMAT, "expected the name of a preset");
        reader->transfer = pel_transfer_preset(json_string_value(preset));
        return reader->transfer != NULL;
    }
    if (!json_object_get(object, "points") && !json_object_get(object, "opacities"))
        return pel_fail(PEL_ERROR_FORMAT, "needs 'opacities', 'points' or 'preset'");
    reader->transfer = pel_transfer_create(1, 1);
    if (!reader->transfer)
        return false;
    for (int i = 0; i < 3; i++)
        reader->transfer->colours[0].rgb[i] = 1;
    return true;
}

// "range" places relative values. A preset that is placed can take further curves in absolute
// values, if "scale" says so; otherwise theirs are relative, too.
static bool read_values(struct pel_transfer_reader *reader, const json_t *object) {
    struct pel_transfer *transfer = reader->transfer;
    bool preset = json_object_get(object, "preset") != NULL;
    const json_t *range = json_object_get(object, "range");
    enum pel_value_scale wanted = transfer->scale;
    const json_t *json = get(reader, object, "scale", NULL);
    if (json) {
        int word = read_word(json, scales);
        if (word < 0)
            return false;
        wanted = (enum pel_value_scale)word;
    }
    bool early = range && preset && wanted == PEL_VALUES_ABSOLUTE;
    if (preset && wanted != transfer->scale && !early)
        return pel_fail(PEL_ERROR_FORMAT, "the preset's values are %s%s", scales[transfer->scale],
                        transfer->scale == PEL_VALUES_RELATIVE ? "; 'range' places them" : "");
    if (!preset)
        transfer->scale = wanted;
    if (!range)
        return read_curves(reader, object);

    get(reader, object, "range", NULL);
    double low, high;
    if (json_array_size(range) != 2 || !json_is_number(json_array_get(range, 0)) ||
        !json_is_number(json_array_get(range, 1)))
        return pel_fail(PEL_ERROR_FORMAT, "expected [low, high]");
    low = json_number_value(json_array_get(range, 0));
    high = json_number_value(json_array_get(range, 1));
    if (!(low < high))
        return pel_fail(PEL_ERROR_FORMAT, "%g is not below %g", low, high);
    if (transfer->scale != PEL_VALUES_RELATIVE)
        return pel_fail(PEL_ERROR_FORMAT, "only relative values take a range, and these are %s",
                        scales[transfer->scale]);
    if (early)
        pel_transfer_stretch(transfer, low, high);
    if (!read_curves(reader, object))
        return false;
    if (!early)
        pel_transfer_stretch(transfer, low, high);
    return true;
}

static bool read_own(struct pel_transfer_reader *reader, const json_t *object) {
    if (!check_keys(reader, object))
        return false;
    if (json_object_get(object, "colours") && get(reader, object, "colors", NULL))
        return pel_fail(PEL_ERROR_FORMAT, "'colours' is there already");
    return read_start(reader, object) && read_values(reader, object) &&
           read_settings(reader, object);
}

static bool read_any(struct pel_transfer_reader *reader, const json_t *json) {
    if (json_is_string(json)) {
        reader->transfer = pel_transfer_preset(json_string_value(json));
        return reader->transfer != NULL;
    }
    if (json_is_array(json)) {
        if (json_array_size(json) > 1)
            pel_warn("of %zu colour maps the first is taken", json_array_size(json));
        return pel_transfer_read_paraview(reader, json_array_get(json, 0), "0.");
    }
    if (!json_is_object(json))
        return pel_fail(PEL_ERROR_FORMAT, "expected an object or the name of a preset");
    if (json_object_get(json, "RGBPoints") || json_object_get(json, "IndexedColors"))
        return pel_transfer_read_paraview(reader, json, "");
    if (json_object_get(json, "volumeProperties"))
        return pel_transfer_read_slicer(reader, json);
    return read_own(reader, json);
}

struct pel_transfer *pel_transfer_parse(const json_t *json, const char **bad_key) {
    static _Thread_local char bad_place[PEL_PLACE_BYTES];
    struct pel_transfer_reader reader = {0};
    bool good = read_any(&reader, json);
    if (good) {
        pel_transfer_reader_at(&reader, "%s", "");
        good = pel_transfer_check(reader.transfer);
    }
    if (good)
        return reader.transfer;
    memcpy(bad_place, reader.place, sizeof bad_place);
    *bad_key = bad_place;
    pel_transfer_destroy(reader.transfer);
    return NULL;
}

struct pel_transfer *pel_transfer_load(const char *path) {
    size_t bytes;
    char *text = pel_file_read(path, file_limit, &bytes);
    if (!text)
        return NULL;
    json_error_t error;
    struct pel_transfer *transfer = NULL;
    json_t *json = json_loadb(text, bytes, JSON_REJECT_DUPLICATES | JSON_DECODE_ANY, &error);
    if (!json) {
        pel_fail(PEL_ERROR_FORMAT, "%s:%d:%d: %s", path, error.line, error.column, error.text);
    } else {
        const char *key;
        transfer = pel_transfer_parse(json, &key);
        if (!transfer) {
            int line, column;
            pel_text_locate(text, key, &line, &column);
            pel_fail_in("%s:%d:%d%s%s", path, line, column, *key ? ": " : "", key);
        }
    }
    json_decref(json);
    free(text);
    return transfer;
}

// ---- Writing -----------------------------------------------------------------------------------

// A colour as #rrggbb where that says it exactly, otherwise as three numbers of the row.
static void write_colour(json_t *row, const double rgb[3]) {
    char text[8] = "#";
    bool exact = true;
    for (int i = 0; i < 3; i++) {
        int byte = (int)(rgb[i] * 255 + 0.5);
        exact = exact && byte / 255.0 == rgb[i];
        snprintf(text + 1 + 2 * i, 3, "%02x", (unsigned)byte & 0xff);
    }
    if (exact)
        json_array_append_new(row, json_string(text));
    for (int i = 0; !exact && i < 3; i++)
        json_array_append_new(row, json_real(rgb[i]));
}

// One curve, or both in one list; NULL for the one that is not wanted.
static json_t *write_curve(const struct pel_colour_point *colours,
                           const struct pel_opacity_point *opacities, int count) {
    json_t *rows = json_array();
    for (int i = 0; i < count; i++) {
        json_t *row = json_array();
        json_array_append_new(row, json_real(colours ? colours[i].value : opacities[i].value));
        if (colours)
            write_colour(row, colours[i].rgb);
        if (opacities)
            json_array_append_new(row, json_real(opacities[i].opacity));
        json_array_append_new(rows, row);
    }
    return rows;
}

static bool same_values(const struct pel_transfer *transfer) {
    if (transfer->colour_count != transfer->opacity_count)
        return false;
    for (int i = 0; i < transfer->colour_count; i++)
        if (transfer->colours[i].value != transfer->opacities[i].value)
            return false;
    return true;
}

json_t *pel_transfer_write(const struct pel_transfer *transfer) {
    json_t *object = json_object();
    if (same_values(transfer)) {
        json_object_set_new(
            object, "points",
            write_curve(transfer->colours, transfer->opacities, transfer->colour_count));
    } else {
        json_object_set_new(object, "colours",
                            write_curve(transfer->colours, NULL, transfer->colour_count));
        json_object_set_new(object, "opacities",
                            write_curve(NULL, transfer->opacities, transfer->opacity_count));
    }
    if (transfer->scale != PEL_VALUES_ABSOLUTE)
        json_object_set_new(object, "scale", json_string(scales[transfer->scale]));
    if (transfer->opacity_unit_mm != 1)
        json_object_set_new(object, "opacity_unit", json_real(transfer->opacity_unit_mm));
    if (transfer->nearest)
        json_object_set_new(object, "interpolation", json_string("nearest"));
    if (transfer->table_entries > 0)
        json_object_set_new(object, "entries", json_integer(transfer->table_entries));
    return object;
}

bool pel_transfer_save(const struct pel_transfer *transfer, const char *path) {
    json_t *object = pel_transfer_write(transfer);
    bool good = object ? pel_json_save(object, path, 100)
                       : pel_fail(PEL_ERROR_MEMORY, "cannot allocate a transfer function's text");
    json_decref(object);
    return good;
}
