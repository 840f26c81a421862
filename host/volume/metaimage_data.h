// metaimage_data.h - where the voxels of a MetaImage are, and how they are fetched.
#ifndef PEL_VOLUME_METAIMAGE_DATA_H
#define PEL_VOLUME_METAIMAGE_DATA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "volume/file_list.h"

struct pel_metaimage_data {
    bool local;                 // the voxels follow the header, `local_offset` bytes into the file
    size_t local_offset;        //
    struct pel_file_list files; // relative to the header
    bool compressed;            //
    int64_t compressed_bytes;   // 0: to the end of the file
    int64_t header_bytes;       // to skip in each file; -1: all that is before the last voxels
};

// Understands the value of ElementDataFile; `next_line` is the text behind it, where a LIST has its
// names, and `offset` where that lies in the file.
bool pel_metaimage_data_parse(struct pel_metaimage_data *data, const char *value,
                              const char *next_line, size_t offset);
void pel_metaimage_data_finish(struct pel_metaimage_data *data);

// The bytes of voxels in a single uncompressed file; false, without a sentence, in other cases.
bool pel_metaimage_data_held(const struct pel_metaimage_data *data, const char *path,
                             size_t *bytes);

// Reads all `bytes`; memory to free(), or NULL. Sizes are checked before anything is allocated.
void *pel_metaimage_data_read(const struct pel_metaimage_data *data, const char *path,
                              size_t bytes);

#endif
