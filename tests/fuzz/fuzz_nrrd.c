// fuzz_nrrd.c - the NRRD reader, attached headers and all encodings.
#include "support/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_load(fuzz_file("input.nrrd", data, size), NULL);
    return 0;
}
