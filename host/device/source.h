// source.h - the text of a kernel, with its includes in place.
#ifndef PEL_DEVICE_SOURCE_H
#define PEL_DEVICE_SOURCE_H

// The text of `file`, a path below kernels/, with every `#include "..."` replaced by that file,
// once each, and #line marks so that compilers name the right place. Memory to free(), or NULL
// (FILE, BUILD). $PELLUCID_KERNELS names a folder to read from; otherwise the embedded files are
// taken.
char *pel_kernel_source(const char *file);

#endif
