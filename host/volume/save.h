// save.h - a text header and the voxels it describes, in one file or in two.
#ifndef PEL_VOLUME_SAVE_H
#define PEL_VOLUME_SAVE_H

#include <stdio.h>

#include "pellucid.h"

// Writes a header. `data_file` is the name of the file with the voxels, or NULL when they follow.
// Returns false when it cannot; what the stream itself has to say is checked by the caller.
typedef bool pel_header_writer(FILE *stream, const struct pel_volume *volume,
                               const char *data_file);

// Makes sure that a new pair of files takes no other's voxels: fails when `data_path`, which
// follows from the name of the header, exists already without that header.
bool pel_save_check_data(const char *header_path, const char *data_path);

// Writes both files, or one when `data_path` is NULL, so that they appear at once: the voxels just
// before the header that makes a volume of them. The voxels have the byte order of this machine.
bool pel_save_with_header(const struct pel_volume *volume, const char *header_path,
                          const char *data_path, pel_header_writer *write_header);

#endif
