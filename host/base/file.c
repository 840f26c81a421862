// file.c - whole files in, and files that appear at once or not at all.
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/memory.h"

bool pel_file_size(const char *path, size_t *bytes) {
    struct stat status;
    if (stat(path, &status) != 0)
        return pel_fail(PEL_ERROR_FILE, "%s: %s", path, strerror(errno));
    if (!S_ISREG(status.st_mode))
        return pel_fail(PEL_ERROR_FILE, "%s: not a regular file", path);
    *bytes = (size_t)status.st_size;
    return true;
}

char *pel_file_read(const char *path, size_t limit, size_t *bytes) {
    size_t size;
    if (!pel_file_size(path, &size))
        return NULL;
    if (size > limit) {
        pel_fail(PEL_ERROR_MEMORY, "%s: %zu bytes, more than the %zu allowed here", path, size,
                 limit);
        return NULL;
    }
    FILE *stream = fopen(path, "rb");
    if (!stream) {
        pel_fail(PEL_ERROR_FILE, "%s: %s", path, strerror(errno));
        return NULL;
    }
    char *text = pel_allocate(size + 1, 1);
    if (text && fread(text, 1, size, stream) != size) {
        pel_fail(PEL_ERROR_FILE, "%s: cannot read %zu bytes", path, size);
        free(text);
        text = NULL;
    }
    fclose(stream);
    if (text && bytes)
        *bytes = size;
    return text;
}

// A file without a name in the folder of `path`: whatever ends the program, nothing of it stays.
// Until it is named it is known by its place among this process's open files.
static int open_nameless(struct pel_output *output) {
    const char *slash = strrchr(output->path, '/');
    char *folder = slash ? strndup(output->path, (size_t)(slash - output->path) + 1) : NULL;
    int descriptor =
        slash && !folder ? -1 : open(folder ? folder : ".", O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    free(folder);
    if (descriptor < 0)
        return -1;
    if (asprintf(&output->temporary, "/proc/self/fd/%d", descriptor) < 0)
        output->temporary = NULL;
    if (!output->temporary || access(output->temporary, F_OK) != 0) {
        free(output->temporary);
        output->temporary = NULL;
        close(descriptor);
        return -1;
    }
    output->nameless = true;
    return descriptor;
}

// Where the file system knows no such files, one that carries its name with a suffix.
static int open_named(struct pel_output *output) {
    if (asprintf(&output->temporary, "%s.XXXXXX", output->path) < 0) {
        output->temporary = NULL;
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
        return -1;
    }
    int descriptor = mkstemp(output->temporary);
    if (descriptor < 0) {
        pel_fail(PEL_ERROR_FILE, "%s: cannot write: %s", output->path, strerror(errno));
        free(output->temporary);
        output->temporary = NULL;
        return -1;
    }
    // mkstemp makes private files; a picture gets the rights any new file gets here.
    mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, 0666 & ~mask);
    return descriptor;
}

// Gives a nameless file a name to rename, for no call replaces an older file by it.
static bool give_name(struct pel_output *output) {
    char *name = NULL;
    if (asprintf(&name, "%s.%ld.%d", output->path, (long)getpid(), fileno(output->stream)) < 0)
        return false;
    unlink(name);
    if (linkat(AT_FDCWD, output->temporary, AT_FDCWD, name, AT_SYMLINK_FOLLOW) != 0) {
        free(name);
        return false;
    }
    free(output->temporary);
    output->temporary = name;
    output->nameless = false;
    return true;
}

// The file that a link leads to, so that it is replaced and the link stays; other paths as they
// are. Memory to free(), or NULL (MEMORY).
static char *follow_link(const char *path) {
    struct stat status;
    bool is_link = lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
    char *target = is_link ? realpath(path, NULL) : NULL;
    return target ? target : pel_copy_text(path);
}

bool pel_output_open(struct pel_output *output, const char *path) {
    *output = (struct pel_output){.path = follow_link(path)};
    if (!output->path)
        return false;
    int descriptor = open_nameless(output);
    if (descriptor < 0)
        descriptor = open_named(output);
    if (descriptor < 0) {
        pel_output_abandon(output);
        return false;
    }
    output->stream = fdopen(descriptor, "wb");
    if (!output->stream) {
        pel_fail(PEL_ERROR_FILE, "%s: cannot write: %s", path, strerror(errno));
        close(descriptor);
        pel_output_abandon(output);
        return false;
    }
    return true;
}

static void output_free(struct pel_output *output) {
    free(output->temporary);
    free(output->path);
    *output = (struct pel_output){0};
}

bool pel_output_commit(struct pel_output *output) {
    bool good = !ferror(output->stream) && fflush(output->stream) == 0;
    good = good && (!output->nameless || give_name(output));
    good = fclose(output->stream) == 0 && good;
    output->stream = NULL;
    if (!good || rename(output->temporary, output->path) != 0) {
        pel_fail(PEL_ERROR_FILE, "%s: cannot write: %s", output->path, strerror(errno));
        pel_output_abandon(output);
        return false;
    }
    output_free(output);
    return true;
}

void pel_output_abandon(struct pel_output *output) {
    if (output->stream)
        fclose(output->stream);
    if (output->temporary && !output->nameless)
        unlink(output->temporary);
    output_free(output);
}

const char *pel_path_leaf(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

char *pel_path_beside(const char *base, const char *name) {
    const char *slash = base ? strrchr(base, '/') : NULL;
    if (name[0] == '/' || !slash)
        return pel_copy_text(name);
    char *path = NULL;
    if (asprintf(&path, "%.*s/%s", (int)(slash - base), base, name) < 0) {
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a file name");
        return NULL;
    }
    return path;
}

bool pel_path_has_extension(const char *path, const char *extension) {
    size_t path_length = strlen(path), extension_length = strlen(extension);
    return path_length > extension_length &&
           strcasecmp(path + path_length - extension_length, extension) == 0;
}
