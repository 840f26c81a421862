// source.c - puts a kernel's includes in place.
//
// OpenCL 1.2 has headers for programs, but drivers disagree on how -I and embedded headers meet; a
// single text is what all of them take. Includes are named by their path below kernels/. Each file
// is put in once, where it is named first, so a file that several others need must not be named
// first between #if and #endif.
#include "device/source.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "device/kernel_table.h"

enum { INCLUDE_MAX = 128, NAME_BYTES = 256, KERNEL_FILE_LIMIT = 1 << 20 };

struct expansion {
    FILE *out;
    char seen[INCLUDE_MAX][NAME_BYTES];
    int seen_count;
};

// Memory to free(), or NULL (BUILD, FILE).
static char *read_kernel_file(const char *name) {
    const char *folder = getenv("PELLUCID_KERNELS");
    if (folder && *folder) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", folder, name);
        return pel_file_read(path, KERNEL_FILE_LIMIT, NULL);
    }
    for (const struct pel_kernel_file *file = pel_kernel_table; file->name; file++)
        if (strcmp(file->name, name) == 0)
            return pel_copy_text(file->text);
    pel_fail(PEL_ERROR_BUILD, "no kernel file '%s'", name);
    return NULL;
}

// If the line is an include, its name goes to `name`.
static bool parse_include(const char *line, size_t length, char *name) {
    char text[NAME_BYTES * 2];
    if (length >= sizeof text)
        return false;
    memcpy(text, line, length);
    text[length] = '\0';
    return sscanf(text, " #include \"%255[^\"]\"", name) == 1;
}

static bool expand(struct expansion *expansion, const char *name) {
    for (int i = 0; i < expansion->seen_count; i++)
        if (strcmp(expansion->seen[i], name) == 0)
            return true;
    if (expansion->seen_count == INCLUDE_MAX)
        return pel_fail(PEL_ERROR_BUILD, "more than %d kernel files", INCLUDE_MAX);
    snprintf(expansion->seen[expansion->seen_count++], NAME_BYTES, "%s", name);

    char *text = read_kernel_file(name);
    if (!text)
        return false;
    bool good = true;
    int number = 1;
    fprintf(expansion->out, "#line 1 \"%s\"\n", name);
    for (const char *line = text; good && *line; number++) {
        size_t length = strcspn(line, "\n");
        char include[NAME_BYTES];
        if (parse_include(line, length, include)) {
            good = expand(expansion, include);
            fprintf(expansion->out, "#line %d \"%s\"\n", number + 1, name);
        } else {
            fprintf(expansion->out, "%.*s\n", (int)length, line);
        }
        line += length + (line[length] == '\n');
    }
    free(text);
    return good;
}

char *pel_kernel_source(const char *file) {
    char *text = NULL;
    size_t bytes;
    struct expansion *expansion = pel_allocate(1, sizeof *expansion);
    if (!expansion)
        return NULL;
    expansion->out = open_memstream(&text, &bytes);
    bool good = expansion->out != NULL && expand(expansion, file);
    if (expansion->out && fclose(expansion->out) != 0)
        good = pel_fail(PEL_ERROR_MEMORY, "cannot allocate a kernel's text");
    free(expansion);
    if (!good) {
        free(text);
        return NULL;
    }
    return text;
}
