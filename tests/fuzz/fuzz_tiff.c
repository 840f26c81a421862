// fuzz_tiff.c - the TIFF reader, with channels as colours and with one of them picked.
#include "support/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const char *path = fuzz_file("input.tif", data, size);
    fuzz_load(path, NULL);
    fuzz_load(path, &(struct pel_load_options){.split_channels = true, .channel = 1, .time = 1});
    return 0;
}
