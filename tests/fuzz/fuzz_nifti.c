// fuzz_nifti.c - the NIfTI reader: one file, one compressed file, or a pair.
//
// Input that starts as gzip does is a .nii.gz. Input whose magic is that of a pair (offset 344) is
// split behind its header into .hdr and .img.
#include "support/fuzz.h"

#include <string.h>

enum { HEADER_BYTES = 348 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    bool gzip = size >= 2 && data[0] == 0x1f && data[1] == 0x8b;
    bool pair = size >= HEADER_BYTES && memcmp(data + 344, "ni1", 4) == 0;
    if (pair) {
        fuzz_file("input.img", data + HEADER_BYTES, size - HEADER_BYTES);
        fuzz_load(fuzz_file("input.hdr", data, HEADER_BYTES), NULL);
    } else {
        fuzz_load(fuzz_file(gzip ? "input.nii.gz" : "input.nii", data, size), NULL);
    }
    return 0;
}
