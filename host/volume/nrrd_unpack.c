// nrrd_unpack.c - voxels of NRRD files that are compressed.
//
// teem can read them, too, but loses memory over each stream that is damaged: 60 KB for gzip and
// 4 MB for bzip2.
#include "volume/nrrd_unpack.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <bzlib.h>
#include <zlib.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

// Both libraries count in 32 bits. What is skipped is a header; a few KB of bzip2 can hold GB.
enum { CHUNK = 1 << 30, SCRATCH_BYTES = 1 << 16, SKIP_BYTES_MAX = 1 << 24 };

struct stream {
    bool bzip2, end;
    z_stream gzip_state;
    bz_stream bzip2_state;
    char *in;
    size_t in_left, done; // bytes not yet read, and bytes that came out
};

static bool stream_open(struct stream *stream, bool bzip2, char *in, size_t in_bytes) {
    *stream = (struct stream){.bzip2 = bzip2, .in = in, .in_left = in_bytes};
    // 32 lets zlib tell gzip from zlib by itself.
    bool good = bzip2 ? BZ2_bzDecompressInit(&stream->bzip2_state, 0, 0) == BZ_OK
                      : inflateInit2(&stream->gzip_state, 15 + 32) == Z_OK;
    return good || pel_fail(PEL_ERROR_MEMORY, "cannot start decompression");
}

static void stream_close(struct stream *stream) {
    if (stream->bzip2)
        BZ2_bzDecompressEnd(&stream->bzip2_state);
    else
        inflateEnd(&stream->gzip_state);
}

// One step of decompression; the parts become what is left of them. False when it is damaged.
static bool stream_step(struct stream *stream, char *out, unsigned *in_part, unsigned *out_part) {
    if (stream->bzip2) {
        bz_stream *state = &stream->bzip2_state;
        state->next_in = stream->in;
        state->avail_in = *in_part;
        state->next_out = out;
        state->avail_out = *out_part;
        int status = BZ2_bzDecompress(state);
        *in_part = state->avail_in;
        *out_part = state->avail_out;
        stream->end = status == BZ_STREAM_END;
        return stream->end || status == BZ_OK;
    }
    z_stream *state = &stream->gzip_state;
    state->next_in = (Bytef *)stream->in;
    state->avail_in = *in_part;
    state->next_out = (Bytef *)out;
    state->avail_out = *out_part;
    int status = inflate(state, Z_NO_FLUSH);
    *in_part = state->avail_in;
    *out_part = state->avail_out;
    stream->end = status == Z_STREAM_END;
    return stream->end || status == Z_OK || status == Z_BUF_ERROR;
}

// Reads up to `room` bytes; `*got` is less only at the end.
static bool stream_read(struct stream *stream, char *out, size_t room, size_t *got) {
    *got = 0;
    while (*got < room && !stream->end) {
        unsigned in_part = stream->in_left < CHUNK ? (unsigned)stream->in_left : CHUNK;
        unsigned out_part = room - *got < CHUNK ? (unsigned)(room - *got) : CHUNK;
        unsigned in_before = in_part, out_before = out_part;
        bool good = stream_step(stream, out + *got, &in_part, &out_part);
        stream->in += in_before - in_part;
        stream->in_left -= in_before - in_part;
        stream->done += out_before - out_part;
        *got += out_before - out_part;
        if (!good)
            return pel_fail(PEL_ERROR_FORMAT, "compressed data is damaged after %zu bytes",
                            stream->done);
        // Nothing came and nothing went: the file ends before its compressed data does.
        stream->end = stream->end || (in_part == in_before && out_part == out_before);
    }
    return true;
}

// Reads up to `count` bytes for nothing.
static bool stream_discard(struct stream *stream, size_t count, size_t *got) {
    char scratch[SCRATCH_BYTES];
    *got = 0;
    size_t part = 1;
    while (*got < count && part > 0) {
        size_t room = count - *got < sizeof scratch ? count - *got : sizeof scratch;
        if (!stream_read(stream, scratch, room, &part))
            return false;
        *got += part;
    }
    return true;
}

// Turns bytes left at the end into bytes to skip at the start, which takes a pass of its own.
static bool skip_from_end(size_t *skip, bool bzip2, char *in, size_t in_bytes, long byte_skip,
                          size_t bytes) {
    struct stream stream;
    size_t total, limit, behind = (size_t)(-(byte_skip + 1));
    if (behind > SKIP_BYTES_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "a byte skip of %ld in compressed data", byte_skip);
    if (__builtin_add_overflow(bytes, 2 * (size_t)SKIP_BYTES_MAX, &limit))
        limit = SIZE_MAX;
    bool good = stream_open(&stream, bzip2, in, in_bytes) && stream_discard(&stream, limit, &total);
    stream_close(&stream);
    if (!good)
        return false;
    if (total < behind || total - behind < bytes)
        return pel_fail(PEL_ERROR_FORMAT, "compressed data has %zu bytes, %zu and %zu are needed",
                        total, bytes, behind);
    *skip = total - behind - bytes;
    return true;
}

// Decompresses the voxels to `out`.
static bool unpack(char *out, size_t bytes, bool bzip2, long byte_skip, char *in, size_t in_bytes) {
    struct stream stream;
    size_t skip = (size_t)byte_skip, got = 0;
    if (byte_skip < 0 && !skip_from_end(&skip, bzip2, in, in_bytes, byte_skip, bytes))
        return false;
    if (skip > SKIP_BYTES_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "%zu bytes to skip in compressed data", skip);
    bool good = stream_open(&stream, bzip2, in, in_bytes) && stream_discard(&stream, skip, &got) &&
                stream_read(&stream, out, bytes, &got);
    stream_close(&stream);
    return good &&
           (got == bytes ||
            pel_fail(PEL_ERROR_FORMAT, "compressed data ends after %zu of %zu bytes", got, bytes));
}

void *pel_nrrd_unpack(const struct pel_nrrd_data *data, bool bzip2,
                      const struct pel_nrrd_skip *skip, size_t bytes) {
    if (!data->path) {
        pel_fail(PEL_ERROR_UNSUPPORTED, "compressed data in several files is not read");
        return NULL;
    }
    size_t file_bytes, start = data->offset;
    char *file = pel_file_read(data->path, PTRDIFF_MAX, &file_bytes);
    void *block = file ? pel_allocate_voxels(bytes) : NULL;
    bool good = block != NULL;
    for (unsigned i = 0; good && i < skip->lines; i++) {
        const char *end = memchr(file + start, '\n', file_bytes - start);
        good = end || pel_fail(PEL_ERROR_FORMAT, "ends before the %u lines to skip", skip->lines);
        start = end ? (size_t)(end - file) + 1 : start;
    }
    if (!good || !unpack(block, bytes, bzip2, skip->bytes, file + start, file_bytes - start)) {
        free(block);
        block = NULL;
    }
    free(file);
    return block;
}
