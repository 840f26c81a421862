// nrrd_guard.c - looks at an NRRD header before teem does.
#include "volume/nrrd_guard.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "volume/file_list.h"
#include "volume/nrrd_header.h"
#include "volume/source.h"

// teem's messages have room for about a thousand characters, the longest sane field line needs 300.
enum { HEADER_BYTES_MAX = 1 << 20, LINE_BYTES_MAX = 512, PATH_BYTES_MAX = 768 };

// Adds up the data files, each of which must be a regular one.
static bool measure_files(struct pel_nrrd_data *data, const struct pel_file_list *list,
                          const char *path) {
    for (int i = 0; i < list->count; i++) {
        if (strcmp(list->names[i], "-") == 0)
            return pel_fail(PEL_ERROR_UNSUPPORTED, "its data file is the standard input");
        char *file = pel_path_beside(path, list->names[i]);
        size_t bytes;
        bool good = file && pel_file_size(file, &bytes);
        if (good && strlen(file) > PATH_BYTES_MAX)
            good = pel_fail(PEL_ERROR_UNSUPPORTED, "a data file's path has more than %d bytes",
                            PATH_BYTES_MAX);
        if (good && list->count == 1)
            data->path = file;
        else
            free(file);
        if (!good)
            return false;
        data->bytes += bytes;
    }
    return true;
}

// The value of a "data file: " line, whose two spellings are the only ones teem takes; NULL for
// other lines.
static const char *data_file_value(const char *line) {
    static const char *const fields[] = {"data file:", "datafile:"};
    for (int i = 0; i < 2; i++) {
        size_t length = strlen(fields[i]);
        if (strncasecmp(line, fields[i], length) == 0 && line[length] != '=')
            return line + length + strspn(line + length, " \t");
    }
    return NULL;
}

static bool check_line(const char *line, size_t length) {
    const char *colon = memchr(line, ':', length);
    bool free_text = line[0] == '#' || (colon && colon[1] == '=');
    if (!free_text && length > LINE_BYTES_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "a header line of %zu bytes", length);
    return true;
}

static bool check_data_file(struct pel_nrrd_data *data, const char *value, size_t length,
                            const char *next_line, const char *path) {
    char copy[LINE_BYTES_MAX + 1];
    while (length > 0 && strchr(" \t\r", value[length - 1]))
        length--;
    memcpy(copy, value, length);
    copy[length] = '\0';
    if (strncmp(copy, "SKIPLIST", 8) == 0)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "data file SKIPLIST is not read");
    struct pel_file_list list = {0};
    bool good = pel_file_list_parse(&list, copy, next_line) && measure_files(data, &list, path);
    pel_file_list_finish(&list);
    return good;
}

// Goes over the lines up to the blank one. `text` has a zero byte behind it.
static bool check_lines(struct pel_nrrd_data *data, const char *text, const char *path,
                        size_t file_bytes) {
    bool detached = false, complete = file_bytes <= HEADER_BYTES_MAX;
    const char *line = text;
    while (*line && *line != '\n' && strncmp(line, "\r\n", 2) != 0) {
        size_t length = strcspn(line, "\n");
        const char *next = line + length + (line[length] == '\n');
        const char *value = data_file_value(line);
        if (!check_line(line, length))
            return false;
        if (value) {
            if (detached)
                return pel_fail(PEL_ERROR_FORMAT, "more than one data file field");
            detached = true;
            bool is_list = strncmp(value, "LIST", 4) == 0;
            if (is_list && !complete)
                return pel_fail(PEL_ERROR_FORMAT, "a header of more than %d bytes",
                                HEADER_BYTES_MAX);
            if (!check_data_file(data, value, length - (size_t)(value - line), next, path))
                return false;
            // What follows a list are its names.
            if (is_list)
                return true;
        }
        line = next;
    }
    if (!*line && !complete)
        return pel_fail(PEL_ERROR_FORMAT, "a header of more than %d bytes", HEADER_BYTES_MAX);
    if (detached)
        return true;
    // The voxels follow the blank line, if there is one.
    line += *line == '\r';
    data->offset = (size_t)(line - text) + (*line == '\n');
    data->bytes = file_bytes - data->offset;
    data->path = pel_copy_text(path);
    return data->path != NULL;
}

bool pel_nrrd_guard(struct pel_nrrd_data *data, const char *path) {
    size_t file_bytes, bytes;
    *data = (struct pel_nrrd_data){0};
    if (strlen(path) > PATH_BYTES_MAX)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "a path of more than %d bytes", PATH_BYTES_MAX);
    if (!pel_file_size(path, &file_bytes))
        return false;
    char *text = pel_source_head(path, HEADER_BYTES_MAX, &bytes);
    bool good =
        text && pel_nrrd_check_header(text, bytes) && check_lines(data, text, path, file_bytes);
    free(text);
    return good;
}

void pel_nrrd_data_finish(struct pel_nrrd_data *data) {
    free(data->path);
    data->path = NULL;
}
