// metaimage_data.c - where the voxels of a MetaImage are, and how they are fetched.
#include "volume/metaimage_data.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "volume/source.h"
#include "volume/volume.h"

// The path of file `index`, to free().
static char *file_path(const struct pel_metaimage_data *data, const char *path, int index) {
    return data->local ? pel_copy_text(path) : pel_path_beside(path, data->files.names[index]);
}

bool pel_metaimage_data_held(const struct pel_metaimage_data *data, const char *path,
                             size_t *bytes) {
    if (data->compressed || data->local || data->files.count != 1)
        return false;
    char *file = file_path(data, path, 0);
    bool good = file && pel_file_size(file, bytes);
    free(file);
    if (!good)
        pel_error_clear();
    size_t header = data->header_bytes > 0 ? (size_t)data->header_bytes : 0;
    if (!good || *bytes < header)
        return false;
    *bytes -= header;
    return true;
}

// Where the voxels start in a file that holds `capacity` bytes of which `needed` are theirs.
static bool find_start(const struct pel_metaimage_data *data, size_t capacity, size_t needed,
                       size_t *start) {
    *start = data->local ? data->local_offset : 0;
    if (data->header_bytes < -1)
        return pel_fail(PEL_ERROR_FORMAT, "a HeaderSize of %lld", (long long)data->header_bytes);
    if (data->header_bytes == -1 && capacity >= needed && capacity - needed >= *start)
        *start = capacity - needed;
    else if (data->header_bytes > 0)
        *start += (size_t)data->header_bytes;
    return true;
}

static bool read_file(const struct pel_metaimage_data *data, const char *path, char *out,
                      size_t bytes) {
    struct pel_source source;
    size_t start;
    bool good = pel_source_open(&source, path) &&
                find_start(data, source.capacity, bytes, &start) &&
                pel_source_skip(&source, start) && pel_source_read(&source, out, bytes);
    pel_source_close(&source);
    return good;
}

static bool read_compressed(const struct pel_metaimage_data *data, const char *path, void **out,
                            size_t bytes) {
    size_t start, file_bytes, packed_bytes;
    char *file = pel_file_read(path, PTRDIFF_MAX, &file_bytes);
    if (!file || !find_start(data, file_bytes, 0, &start))
        goto failed;
    if (data->header_bytes == -1)
        start = data->local ? data->local_offset : 0;
    if (start > file_bytes) {
        pel_fail(PEL_ERROR_FORMAT, "data starts at byte %zu of %zu", start, file_bytes);
        goto failed;
    }
    packed_bytes = file_bytes - start;
    if (data->compressed_bytes > 0 && (uint64_t)data->compressed_bytes < packed_bytes)
        packed_bytes = (size_t)data->compressed_bytes;
    if (bytes > pel_inflated_limit(packed_bytes)) {
        pel_fail(PEL_ERROR_FORMAT, "%zu bytes of voxels cannot come from %zu compressed ones",
                 bytes, packed_bytes);
        goto failed;
    }
    *out = pel_allocate_voxels(bytes);
    bool good = *out && pel_inflate(*out, bytes, file + start, packed_bytes);
    free(file);
    return good;
failed:
    free(file);
    return false;
}

// Fails unless the files can hold `bytes` voxels each.
static bool check_sizes(const struct pel_metaimage_data *data, const char *path, int file_count,
                        size_t bytes) {
    for (int i = 0; i < file_count; i++) {
        struct pel_source source = {0};
        char *file = file_path(data, path, i);
        bool good = file && pel_source_open(&source, file);
        if (good && source.capacity < bytes)
            good = pel_fail(PEL_ERROR_FORMAT, "%s: %zu bytes of voxels are needed, it has %zu",
                            pel_path_leaf(file), bytes, source.capacity);
        pel_source_close(&source);
        free(file);
        if (!good)
            return false;
    }
    return true;
}

bool pel_metaimage_data_parse(struct pel_metaimage_data *data, const char *value,
                              const char *next_line, size_t offset) {
    data->local = strcasecmp(value, "LOCAL") == 0;
    data->local_offset = offset;
    return data->local || pel_file_list_parse(&data->files, value, next_line);
}

void pel_metaimage_data_finish(struct pel_metaimage_data *data) {
    pel_file_list_finish(&data->files);
}

void *pel_metaimage_data_read(const struct pel_metaimage_data *data, const char *path,
                              size_t bytes) {
    int file_count = data->local ? 1 : data->files.count;
    void *out = NULL;
    if (data->compressed && file_count > 1) {
        pel_fail(PEL_ERROR_UNSUPPORTED, "compressed slices in several files are not read");
        return NULL;
    }
    if (bytes % (size_t)file_count != 0) {
        pel_fail(PEL_ERROR_FORMAT, "%zu bytes of voxels do not spread over %d files", bytes,
                 file_count);
        return NULL;
    }
    size_t part = bytes / (size_t)file_count;
    bool good = true;
    if (!data->compressed) {
        good = check_sizes(data, path, file_count, part);
        out = good ? pel_allocate_voxels(bytes) : NULL;
        good = out != NULL;
    }
    for (int i = 0; good && i < file_count; i++) {
        char *file = file_path(data, path, i);
        good = file &&
               (data->compressed ? read_compressed(data, file, &out, bytes)
                                 : read_file(data, file, (char *)out + part * (size_t)i, part));
        if (!good && file && strncmp(pel_error_message(), file, strlen(file)) != 0 && !data->local)
            pel_fail_in("%s", pel_path_leaf(file));
        free(file);
    }
    if (!good) {
        free(out);
        out = NULL;
    }
    return out;
}
