// fuzz_raw.c - headerless voxels and the JSON that describes them.
//
// The input is the sidecar's text, a zero byte, and the voxels.
#include "support/fuzz.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const uint8_t *end = size ? memchr(data, 0, size) : NULL;
    size_t text = end ? (size_t)(end - data) : size;
    size_t skip = end ? text + 1 : size;
    fuzz_file("input.raw.json", data, text);
    fuzz_load(fuzz_file("input.raw", data + skip, size - skip), NULL);
    return 0;
}
