// nrrd_guard.h - looks at an NRRD header before teem does.
//
// teem 1.12 trusts what it reads: it prints a line of any length into a message of fixed size,
// hands the name pattern of data files to printf, opens whatever is named (a FIFO waits for ever,
// "-" is the standard input), and allocates what the sizes say. Nothing of that reaches it.
#ifndef PEL_VOLUME_NRRD_GUARD_H
#define PEL_VOLUME_NRRD_GUARD_H

#include <stdbool.h>
#include <stddef.h>

// Fails (FORMAT, FILE, UNSUPPORTED) for a header that teem must not see. `*data_bytes` is the size
// of all data files together, or of the file itself when the voxels follow the header.
bool pel_nrrd_guard(const char *path, size_t *data_bytes);

#endif
