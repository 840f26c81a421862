// fuzz_metaimage.c - the MetaImage reader, header and voxels in one file.
#include "support/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_load(fuzz_file("input.mha", data, size), NULL);
    return 0;
}
