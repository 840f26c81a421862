// file_list.c - the data files that a detached header names.
#include "volume/file_list.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "volume/volume.h"

enum { FILE_COUNT_MAX = PEL_DIMENSION_MAX, NAME_BYTES_MAX = 4096, DIGITS_MAX = 9 };

static bool add_file(struct pel_file_list *list, const char *name, size_t length) {
    if (list->count == FILE_COUNT_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "more than %d files", FILE_COUNT_MAX);
    // The room doubles whenever the count reaches a power of two.
    if ((list->count & (list->count - 1)) == 0) {
        size_t room = list->count ? 2 * (size_t)list->count : 1;
        char **files = realloc(list->names, room * sizeof *files);
        if (!files)
            return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu file names", room);
        list->names = files;
    }
    char *copy = strndup(name, length);
    if (!copy)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
    list->names[list->count++] = copy;
    return true;
}

static bool parse_list(struct pel_file_list *list, const char *text) {
    while (*text) {
        size_t length = strcspn(text, "\r\n");
        if (length >= NAME_BYTES_MAX)
            return pel_fail(PEL_ERROR_FORMAT, "a file name of %zu bytes", length);
        if (length > 0 && !add_file(list, text, length))
            return false;
        text += length;
        text += strspn(text, "\r\n");
    }
    return list->count > 0 || pel_fail(PEL_ERROR_FORMAT, "the list names no file");
}

// "slice%03d.raw 1 40 1": the pattern is taken apart here, because printf would obey anything else
// that stands in it.
static bool parse_pattern(struct pel_file_list *list, const char *value) {
    char pattern[NAME_BYTES_MAX], name[NAME_BYTES_MAX + 64];
    int first, last, step = 1;
    if (strlen(value) >= NAME_BYTES_MAX ||
        sscanf(value, "%4095s %d %d %d", pattern, &first, &last, &step) < 3)
        return pel_fail(PEL_ERROR_FORMAT, "a pattern needs its first and last number");
    char *percent = strchr(pattern, '%'), *after = percent + 1;
    bool zeros = *after == '0';
    long width = strtol(after, &after, 10);
    if (*after != 'd' || width < 0 || width > DIGITS_MAX || strchr(after, '%'))
        return pel_fail(PEL_ERROR_FORMAT, "'%.60s' is not a pattern with one %%d", pattern);
    if (step < 1 || last < first || ((int64_t)last - first) / step >= FILE_COUNT_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "%d to %d in steps of %d is no range", first, last, step);
    for (int64_t number = first; number <= last; number += step) {
        int length =
            snprintf(name, sizeof name, zeros ? "%.*s%0*lld%s" : "%.*s%*lld%s",
                     (int)(percent - pattern), pattern, (int)width, (long long)number, after + 1);
        if (!add_file(list, name, (size_t)length))
            return false;
    }
    return true;
}

void pel_file_list_finish(struct pel_file_list *list) {
    for (int i = 0; i < list->count; i++)
        free(list->names[i]);
    free(list->names);
    *list = (struct pel_file_list){0};
}

bool pel_file_list_parse(struct pel_file_list *list, const char *value, const char *next_line) {
    if (strncmp(value, "LIST", 4) == 0 && (value[4] == '\0' || value[4] == ' '))
        return parse_list(list, next_line);
    if (strchr(value, '%'))
        return parse_pattern(list, value);
    if (value[0] == '\0')
        return pel_fail(PEL_ERROR_FORMAT, "names no file");
    return add_file(list, value, strlen(value));
}
