// json.c - JSON as people write it: objects and lists that fit on the rest of their line stay on
// it, others get a line for each member.
#include "base/json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "base/error.h"
#include "base/file.h"
#include "base/locale.h"

enum { INDENT = 4, NUMBER_BYTES = 32 };

// 15 digits are right for most numbers people write, 17 for all.
static void print_real(FILE *stream, double number) {
    char text[NUMBER_BYTES];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (strtod(text, NULL) == number)
            break;
    }
    fputs(text, stream);
}

static void print_key(FILE *stream, const char *key) {
    json_t *text = json_string(key);
    json_dumpf(text, stream, JSON_ENCODE_ANY);
    json_decref(text);
    fputs(": ", stream);
}

static void print_line(FILE *stream, const json_t *value) {
    const char *between = "";
    if (json_is_real(value)) {
        print_real(stream, json_real_value(value));
    } else if (json_is_object(value)) {
        // jansson's iterators take a plain pointer but only read.
        fputs("{", stream);
        for (void *entry = json_object_iter((json_t *)value); entry;
             entry = json_object_iter_next((json_t *)value, entry), between = ", ") {
            fputs(between, stream);
            print_key(stream, json_object_iter_key(entry));
            print_line(stream, json_object_iter_value(entry));
        }
        fputs("}", stream);
    } else if (json_is_array(value)) {
        fputs("[", stream);
        for (size_t i = 0; i < json_array_size(value); i++, between = ", ") {
            fputs(between, stream);
            print_line(stream, json_array_get(value, i));
        }
        fputs("]", stream);
    } else {
        json_dumpf(value, stream, JSON_ENCODE_ANY);
    }
}

// Prints into memory; NULL (MEMORY) when there is none.
static char *line_of(const json_t *value) {
    char *text = NULL;
    size_t bytes;
    FILE *stream = open_memstream(&text, &bytes);
    if (stream) {
        print_line(stream, value);
        if (fclose(stream) == 0)
            return text;
    }
    free(text);
    pel_fail(PEL_ERROR_MEMORY, "cannot allocate the text of a scene");
    return NULL;
}

static bool print(FILE *stream, const json_t *value, int indent, int room, int columns);

static bool print_member(FILE *stream, const char *key, const json_t *value, int indent,
                         int columns, bool last) {
    int room = columns - indent - !last;
    fprintf(stream, "\n%*s", indent, "");
    if (key) {
        print_key(stream, key);
        room -= (int)strlen(key) + 4;
    }
    bool good = print(stream, value, indent, room, columns);
    if (!last)
        fputs(",", stream);
    return good;
}

// Prints a value of which the first line has `room` left.
static bool print(FILE *stream, const json_t *value, int indent, int room, int columns) {
    char *line = line_of(value);
    if (!line)
        return false;
    bool fits = columns == 0 || (long)strlen(line) <= room;
    size_t count = json_is_object(value) ? json_object_size(value) : json_array_size(value);
    if (fits || count == 0)
        fputs(line, stream);
    free(line);
    if (fits || count == 0)
        return true;
    bool good = true, object = json_is_object(value);
    fputs(object ? "{" : "[", stream);
    void *entry = object ? json_object_iter((json_t *)value) : NULL;
    for (size_t i = 0; i < count && good; i++) {
        good = print_member(stream, object ? json_object_iter_key(entry) : NULL,
                            object ? json_object_iter_value(entry) : json_array_get(value, i),
                            indent + INDENT, columns, i + 1 == count);
        entry = object ? json_object_iter_next((json_t *)value, entry) : NULL;
    }
    fprintf(stream, "\n%*s%s", indent, "", object ? "}" : "]");
    return good;
}

char *pel_json_print(const json_t *value, int columns) {
    char *text = NULL;
    size_t bytes;
    struct pel_locale locale;
    pel_locale_begin(&locale);
    FILE *stream = open_memstream(&text, &bytes);
    bool good = stream && print(stream, value, 0, columns, columns);
    good = stream && fclose(stream) == 0 && good;
    pel_locale_finish(&locale);
    if (good)
        return text;
    free(text);
    pel_fail(PEL_ERROR_MEMORY, "cannot allocate the text of a scene");
    return NULL;
}

bool pel_json_save(const json_t *value, const char *path, int columns) {
    char *text = pel_json_print(value, columns);
    struct pel_output output;
    if (!text || !pel_output_open(&output, path)) {
        free(text);
        return false;
    }
    fputs(text, output.stream);
    fputs("\n", output.stream);
    free(text);
    return pel_output_commit(&output);
}
