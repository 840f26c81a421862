// fuzz_pvm.c - the PVM reader, compressed or not.
#include "support/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_load(fuzz_file("input.pvm", data, size), NULL);
    return 0;
}
