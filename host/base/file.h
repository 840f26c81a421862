// file.h - whole files in, and files that appear at once or not at all.
#ifndef PEL_BASE_FILE_H
#define PEL_BASE_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// Reads a whole file of at most `limit` bytes. Returns memory to free() with a zero byte behind the
// `*bytes` read, or NULL (FILE; MEMORY when it is larger than `limit`). The path is in the
// sentence.
char *pel_file_read(const char *path, size_t limit, size_t *bytes);

// The size of a regular file; false (FILE) when there is none.
bool pel_file_size(const char *path, size_t *bytes);

// A file being written: bytes go to a temporary beside `path`, which takes its place in
// pel_output_commit. Until then an old file of that name stays untouched. A link to a file stays,
// and the file is replaced; one that leads nowhere is replaced itself.
struct pel_output {
    char *path, *temporary; // owned
    FILE *stream;           // a library may open `temporary` itself and write there instead
    bool nameless;          // `temporary` is no name in a folder yet
};

// Opens the temporary (FILE on failure). Afterwards call exactly one of commit and abandon.
bool pel_output_open(struct pel_output *output, const char *path);
bool pel_output_commit(struct pel_output *output);
void pel_output_abandon(struct pel_output *output);

// The part of a path behind its last '/', and a new path beside `base` for a relative `name` (an
// absolute one is copied); the latter is memory to free(), or NULL (MEMORY).
const char *pel_path_leaf(const char *path);
char *pel_path_beside(const char *base, const char *name);

// True when `path` ends with `extension`, upper or lower case: ".nii.gz".
bool pel_path_has_extension(const char *path, const char *extension);

#endif
