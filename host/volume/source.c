// source.c - files read from front to back, gunzipped on the way, and never believed about their
// size.
#include "volume/source.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "volume/volume.h"

// The most zlib is asked for at once; its counters are 32 bits wide.
enum { CHUNK = 1 << 30, DEFLATE_RATIO = 1032 };

size_t pel_inflated_limit(size_t file_bytes) {
    size_t limit;
    return __builtin_mul_overflow(file_bytes, (size_t)DEFLATE_RATIO, &limit) ? SIZE_MAX : limit;
}

bool pel_source_open(struct pel_source *source, const char *path) {
    *source = (struct pel_source){0};
    size_t size;
    if (!pel_file_size(path, &size))
        return false;
    source->stream = gzopen(path, "rb");
    if (!source->stream)
        return pel_fail(PEL_ERROR_FILE, "%s: %s", path, strerror(errno ? errno : ENOMEM));
    gzbuffer(source->stream, 1 << 17);
    source->compressed = !gzdirect(source->stream);
    source->capacity = source->compressed ? pel_inflated_limit(size) : size;
    return true;
}

void pel_source_close(struct pel_source *source) {
    if (source->stream)
        gzclose_r(source->stream);
    source->stream = NULL;
}

size_t pel_source_read_some(struct pel_source *source, void *bytes, size_t count) {
    size_t done = 0;
    while (done < count) {
        size_t part = count - done < CHUNK ? count - done : CHUNK;
        int got = gzread(source->stream, (char *)bytes + done, (unsigned)part);
        if (got <= 0)
            break;
        done += (size_t)got;
    }
    source->position += done;
    return done;
}

// Sets the sentence when decompression failed for another reason than the end of the file.
static bool fail_if_damaged(struct pel_source *source) {
    int code = Z_OK;
    const char *message = gzerror(source->stream, &code);
    if (code != Z_DATA_ERROR)
        return false;
    // zlib puts its own copy of the path and ": " before the reason.
    const char *colon = strrchr(message, ':');
    pel_fail(PEL_ERROR_FORMAT, "compressed data is damaged (%s)",
             colon && colon[1] ? colon + 2 : message);
    return true;
}

bool pel_source_read(struct pel_source *source, void *bytes, size_t count) {
    size_t before = source->position;
    if (pel_source_read_some(source, bytes, count) == count)
        return true;
    if (fail_if_damaged(source))
        return false;
    return pel_fail(PEL_ERROR_FORMAT, "ends after %zu bytes where %zu are needed", source->position,
                    before + count);
}

bool pel_source_skip(struct pel_source *source, size_t count) {
    if (count > source->capacity - source->position)
        return pel_fail(PEL_ERROR_FORMAT, "data starts at byte %zu of at most %zu",
                        source->position + count, source->capacity);
    if (gzseek(source->stream, (z_off_t)count, SEEK_CUR) < 0)
        return pel_fail(PEL_ERROR_FORMAT, "cannot skip %zu bytes", count);
    source->position += count;
    return true;
}

bool pel_source_finish(struct pel_source *source, bool *more) {
    char byte;
    int got = gzread(source->stream, &byte, 1);
    *more = got == 1;
    return got >= 0 || !fail_if_damaged(source);
}

char *pel_source_head(const char *path, size_t limit, size_t *bytes) {
    if (!pel_file_size(path, bytes))
        return NULL;
    if (*bytes > limit)
        *bytes = limit;
    FILE *stream = fopen(path, "rb");
    if (!stream) {
        pel_fail(PEL_ERROR_FILE, "%s: %s", path, strerror(errno));
        return NULL;
    }
    char *text = pel_allocate(*bytes + 1, 1);
    if (text)
        *bytes = fread(text, 1, *bytes, stream);
    fclose(stream);
    return text;
}

bool pel_block_bytes(const int64_t dims[3], size_t voxel_bytes, size_t available_bytes,
                     size_t *bytes) {
    size_t factors[4] = {voxel_bytes};
    for (int axis = 0; axis < 3; axis++) {
        if (dims[axis] < 1 || dims[axis] > PEL_DIMENSION_MAX)
            return pel_fail(PEL_ERROR_FORMAT, "%lld voxels along axis %d, outside 1..%d",
                            (long long)dims[axis], axis, PEL_DIMENSION_MAX);
        factors[axis + 1] = (size_t)dims[axis];
    }
    if (!pel_size_multiply(bytes, 4, factors))
        return false;
    if (*bytes > available_bytes)
        return pel_fail(PEL_ERROR_FORMAT,
                        "%lld x %lld x %lld voxels of %zu bytes need %zu bytes, the file has %zu",
                        (long long)dims[0], (long long)dims[1], (long long)dims[2], voxel_bytes,
                        *bytes, available_bytes);
    return true;
}

// Reads a type that no volume can have, and converts it.
static struct pel_volume *read_wide(struct pel_source *source, const char *name, const int dims[3],
                                    enum pel_element element, bool swap, size_t bytes) {
    void *values = pel_allocate_voxels(bytes);
    struct pel_volume *volume = NULL;
    if (values && pel_source_read(source, values, bytes)) {
        if (swap)
            pel_swap_bytes(values, bytes / pel_element_bytes(element), pel_element_bytes(element));
        volume = pel_volume_from_wide(name, dims, pel_element_wide(element), values);
    }
    free(values);
    return volume;
}

struct pel_volume *pel_source_read_volume(struct pel_source *source, const char *name,
                                          const int64_t dims[3], enum pel_element element,
                                          int components, bool swap) {
    size_t bytes, voxel_bytes = pel_element_bytes(element) * (size_t)components;
    if (!pel_block_bytes(dims, voxel_bytes, source->capacity - source->position, &bytes))
        return NULL;
    int small_dims[3] = {(int)dims[0], (int)dims[1], (int)dims[2]};
    if (element > PEL_ELEMENT_F32)
        return read_wide(source, name, small_dims, element, swap, bytes);
    enum pel_voxel_type type = components == 3   ? PEL_VOXEL_RGB8
                               : components == 4 ? PEL_VOXEL_RGBA8
                                                 : (enum pel_voxel_type)element;
    struct pel_volume *volume = pel_volume_create(name, small_dims, type);
    if (!volume)
        return NULL;
    if (!pel_source_read(source, volume->voxels, bytes)) {
        pel_volume_destroy(volume);
        return NULL;
    }
    if (swap)
        pel_swap_bytes(volume->voxels, bytes / pel_element_bytes(element),
                       pel_element_bytes(element));
    pel_volume_mark_absent(volume);
    return volume;
}

bool pel_inflate(void *out, size_t out_bytes, const void *in, size_t in_bytes) {
    z_stream stream = {.next_in = (z_const Bytef *)in, .next_out = out};
    // 32 lets zlib tell gzip from zlib by itself.
    if (inflateInit2(&stream, 15 + 32) != Z_OK)
        return pel_fail(PEL_ERROR_MEMORY, "cannot start decompression");
    size_t in_left = in_bytes, out_left = out_bytes;
    int status = Z_OK;
    while (status == Z_OK) {
        uInt in_part = (uInt)(in_left < CHUNK ? in_left : CHUNK);
        uInt out_part = (uInt)(out_left < CHUNK ? out_left : CHUNK);
        stream.avail_in = in_part;
        stream.avail_out = out_part;
        status = inflate(&stream, Z_NO_FLUSH);
        in_left -= in_part - stream.avail_in;
        out_left -= out_part - stream.avail_out;
    }
    inflateEnd(&stream);
    if (status == Z_DATA_ERROR || status == Z_NEED_DICT)
        return pel_fail(PEL_ERROR_FORMAT, "compressed data is damaged after %zu bytes",
                        out_bytes - out_left);
    if (out_left > 0)
        return pel_fail(PEL_ERROR_FORMAT, "compressed data ends after %zu of %zu bytes",
                        out_bytes - out_left, out_bytes);
    return true;
}
