// nrrd_header.h - inside the NRRD reader: mistakes that teem must not see.
#ifndef PEL_VOLUME_NRRD_HEADER_H
#define PEL_VOLUME_NRRD_HEADER_H

#include <stdbool.h>
#include <stddef.h>

// Goes over the header in `text`, the first `bytes` of the file with a zero byte behind. Fails
// (FORMAT) at what makes teem 1.12 lose memory, try other formats, or see other lines than a reader
// that splits the text at '\n'.
bool pel_nrrd_check_header(const char *text, size_t bytes);

#endif
