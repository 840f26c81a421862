// nrrd_header.c - mistakes in NRRD headers that teem must not see.
//
// teem 1.12 reports them, but never frees what it holds at that moment: quoted words without an
// end, more space units than dimensions of space, fields that count axes before `dimension`, and
// axes whose size is not that of their kind.
#include "volume/nrrd_header.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <teem/nrrd.h>

#include "base/error.h"

// What was said so far that later lines depend on.
struct progress {
    bool dimension;
    long space_dimension;
    const char *sizes, *kinds; // values of these fields, or NULL
};

// The value of a line whose field has that name, in one of its two spellings; NULL for other lines.
static const char *field_value(const char *line, const char *name, const char *other_name) {
    const char *const names[] = {name, other_name};
    for (int i = 0; i < 2; i++) {
        size_t length = strlen(names[i]);
        if (strncasecmp(line, names[i], length) == 0 && strncmp(line + length, ": ", 2) == 0)
            return line + length + 2;
    }
    return NULL;
}

// Counts the "quoted" words up to `end`, in which \" is a quote; -1 when the last has no end.
static int count_quoted(const char *value, const char *end) {
    int count = 0;
    bool inside = false;
    for (; value < end; value++) {
        if (inside && *value == '\\' && value + 1 < end && value[1] == '"') {
            value++;
        } else if (*value == '"') {
            inside = !inside;
            count += inside;
        }
    }
    return inside ? -1 : count;
}

static bool check_quotes(const char *line, const char *end, const struct progress *progress) {
    const char *labels = field_value(line, "labels", "units");
    const char *space_units = field_value(line, "space units", "spaceunits");
    if (!labels && !space_units)
        return true;
    int count = count_quoted(labels ? labels : space_units, end);
    if (count < 0)
        return pel_fail(PEL_ERROR_FORMAT, "a quote without end in '%.*s'",
                        (int)(end - line < 40 ? end - line : 40), line);
    return labels || count <= progress->space_dimension ||
           pel_fail(PEL_ERROR_FORMAT, "%d space units for %ld dimensions of space", count,
                    progress->space_dimension);
}

// Fields that come for each axis and are kept in memory while they are read.
static bool check_order(const char *line, const char *end, const struct progress *progress) {
    bool counts_axes = field_value(line, "centers", "centerings") ||
                       field_value(line, "kinds", "kinds") ||
                       field_value(line, "data file", "datafile");
    return !counts_axes || progress->dimension ||
           pel_fail(PEL_ERROR_FORMAT, "'%.*s' stands before the dimension",
                    (int)(end - line < 40 ? end - line : 40), line);
}

// Spaces with time have names that end in T or in -time.
static void note(const char *line, const char *end, struct progress *progress) {
    const char *space = field_value(line, "space", "space");
    const char *space_dimension = field_value(line, "space dimension", "spacedimension");
    const char *sizes = field_value(line, "sizes", "sizes");
    const char *kinds = field_value(line, "kinds", "kinds");
    progress->dimension = progress->dimension || field_value(line, "dimension", "dimension");
    progress->sizes = sizes ? sizes : progress->sizes;
    progress->kinds = kinds ? kinds : progress->kinds;
    if (space_dimension)
        progress->space_dimension = strtol(space_dimension, NULL, 10);
    else if (space)
        progress->space_dimension = strchr("tTeE", end[-1]) ? 4 : 3;
}

// An RGB-color axis has 3 elements, and so on; sizes and kinds come in either order.
static bool check_kinds(const struct progress *progress) {
    const char *size = progress->sizes, *kind = progress->kinds;
    for (int axis = 0; size && kind && axis < NRRD_DIM_MAX; axis++) {
        char word[32] = "", *after;
        size += strspn(size, " \t");
        kind += strspn(kind, " \t");
        size_t length = strcspn(kind, " \t\r\n");
        unsigned long long elements = strtoull(size, &after, 10);
        if (length == 0 || after == size || *size == '\r' || *size == '\n')
            break;
        if (length < sizeof word)
            memcpy(word, kind, length);
        unsigned expected = nrrdKindSize(airEnumVal(nrrdKind, word));
        if (expected && expected != elements)
            return pel_fail(PEL_ERROR_FORMAT, "axis %d has %llu elements, its kind %s needs %u",
                            axis, elements, word, expected);
        size = after;
        kind += length;
    }
    return true;
}

// teem takes a file whose first line is not one of these for another format, and tries them all.
static bool check_magic(const char *text) {
    size_t length = strcspn(text, "\r\n");
    return (length == 8 && strncmp(text, "NRRD000", 7) == 0 && text[7] >= '1' && text[7] <= '5') ||
           pel_fail(PEL_ERROR_FORMAT, "its first line is none of NRRD0001 to NRRD0005");
}

bool pel_nrrd_check_header(const char *text, size_t bytes) {
    struct progress progress = {0};
    if (!check_magic(text))
        return false;
    const char *line = text;
    while (*line && *line != '\n' && strncmp(line, "\r\n", 2) != 0) {
        const char *end = line + strcspn(line, "\n"), *next = end + (*end == '\n');
        // teem ends lines at a lone carriage return, too.
        const char *carriage = memchr(line, '\r', (size_t)(end - line));
        if (carriage && carriage + 1 != end)
            return pel_fail(PEL_ERROR_FORMAT, "a carriage return within a header line");
        while (end > line && strchr(" \t\r", end[-1]))
            end--;
        if (!check_quotes(line, end, &progress) || !check_order(line, end, &progress))
            return false;
        note(line, end, &progress);
        // What follows a list are its names.
        const char *data_file = field_value(line, "data file", "datafile");
        if (data_file && strncmp(data_file + strspn(data_file, " \t"), "LIST", 4) == 0)
            break;
        line = next;
    }
    // teem reads on behind a zero byte.
    if (!*line && (size_t)(line - text) < bytes)
        return pel_fail(PEL_ERROR_FORMAT, "a zero byte in its header");
    return check_kinds(&progress);
}
