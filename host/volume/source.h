// source.h - files read from front to back, gunzipped on the way, and never believed about their
// size.
//
// A header says how many bytes of voxels follow. The bytes a file can hold at most are known before
// anything is read: its size, or 1032 times that when it is compressed, the most that deflate
// expands (258 bytes from 2 bits). No reader allocates more.
#ifndef PEL_VOLUME_SOURCE_H
#define PEL_VOLUME_SOURCE_H

#include "pellucid.h"
#include "volume/widen.h"

struct pel_source {
    struct gzFile_s *stream;
    bool compressed;
    size_t capacity; // bytes it can hold at most, after decompression
    size_t position; // bytes read or skipped so far
};

// What a file whose size is `file_bytes` can hold once it is inflated.
size_t pel_inflated_limit(size_t file_bytes);

// Opens a file, gzip or not. Afterwards close it.
bool pel_source_open(struct pel_source *source, const char *path);
void pel_source_close(struct pel_source *source);

// Reads up to `count` bytes and returns how many there were; damaged compression counts as the end.
size_t pel_source_read_some(struct pel_source *source, void *bytes, size_t count);

// Reads or skips exactly `count` bytes; false (FORMAT) with both numbers when the file ends before.
bool pel_source_read(struct pel_source *source, void *bytes, size_t count);
bool pel_source_skip(struct pel_source *source, size_t count);

// Asks for one byte more, so that a compressed file which ends here has its checksum verified
// (FORMAT). Returns true with `*more` set when there is more.
bool pel_source_finish(struct pel_source *source, bool *more);

// The first `limit` bytes of a file as it lies there, or all of it, with a zero byte behind; to
// free(), or NULL (FILE, MEMORY).
char *pel_source_head(const char *path, size_t limit, size_t *bytes);

// The bytes of `dims` voxels of `voxel_bytes` each; fails (FORMAT, MEMORY) for absurd dimensions
// and for more than `available_bytes`.
bool pel_block_bytes(const int64_t dims[3], size_t voxel_bytes, size_t available_bytes,
                     size_t *bytes);

// Reads the `components` times dims[0] * dims[1] * dims[2] elements that come next into a volume;
// 3 or 4 components of uint8 are a colour. Checks the size first.
struct pel_volume *pel_source_read_volume(struct pel_source *source, const char *name,
                                          const int64_t dims[3], enum pel_element element,
                                          int components, bool swap);

// Inflates zlib or gzip data to exactly `out_bytes`; false (FORMAT) when it is damaged or shorter.
// What it holds beyond is ignored.
bool pel_inflate(void *out, size_t out_bytes, const void *in, size_t in_bytes);

#endif
