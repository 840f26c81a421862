// fuzz.h - what the fuzz targets share: input as a file, and a look at all that came out of it.
//
// A target defines LLVMFuzzerTestOneInput. It is built with libFuzzer, or with replay.c, whose
// main() feeds it files. A target aborts when the library breaks its own word; memory errors and
// leaks are the sanitizers' to find.
#ifndef PEL_TEST_FUZZ_H
#define PEL_TEST_FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "pellucid.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Writes the bytes to a file of that name in this process's temporary folder, over the last one.
const char *fuzz_file(const char *leaf, const uint8_t *data, size_t size);

// Removes a file that an earlier input may have left.
void fuzz_remove(const char *leaf);

// Loads the file as users do. Either there is a volume whose every voxel can be read, or an error
// with a code and a sentence.
void fuzz_load(const char *path, const struct pel_load_options *options);

// Aborts unless the last failure has a code and a sentence.
void fuzz_expect_error(void);

#endif
