// nrrd_guard.h - looks at an NRRD header before teem does.
//
// teem 1.12 trusts what it reads: it prints a line of any length into a message of fixed size,
// hands the name pattern of data files to printf, opens whatever is named (a FIFO waits for ever,
// "-" is the standard input), and allocates what the sizes say. Nothing of that reaches it.
#ifndef PEL_VOLUME_NRRD_GUARD_H
#define PEL_VOLUME_NRRD_GUARD_H

#include <stdbool.h>
#include <stddef.h>

// Where the voxels are.
struct pel_nrrd_data {
    size_t bytes;  // of all data files together, or of what follows the header
    char *path;    // owned; the file with the voxels, NULL when there are several
    size_t offset; // of the first byte behind the header in that file, or 0
};

// Fails (FORMAT, FILE, UNSUPPORTED) for a header that teem must not see. Finish the data in any
// case.
bool pel_nrrd_guard(struct pel_nrrd_data *data, const char *path);
void pel_nrrd_data_finish(struct pel_nrrd_data *data);

#endif
