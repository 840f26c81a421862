// nrrd_unpack.h - inside the NRRD reader: voxels that are compressed.
#ifndef PEL_VOLUME_NRRD_UNPACK_H
#define PEL_VOLUME_NRRD_UNPACK_H

#include "volume/nrrd_guard.h"

// What of the data file is not voxels, as the header says it.
struct pel_nrrd_skip {
    unsigned lines; // before the compressed data
    long bytes;     // of the decompressed data; -1 - n: voxels end n bytes before the end
};

// Decompresses `bytes` of voxels out of one data file, bzip2 or gzip. Returns memory to free(), in
// the file's byte order, or NULL (FILE, FORMAT, MEMORY).
void *pel_nrrd_unpack(const struct pel_nrrd_data *data, bool bzip2,
                      const struct pel_nrrd_skip *skip, size_t bytes);

#endif
