// fuzz_scene.c - the reader of scenes.
//
// A scene may ask for a generated volume of any size and gets it, so inputs with a number of three
// digits or more beside a generator would only find out how much memory there is: they are left
// out. Beside every scene lies voxels.raw, 24 bytes for scenes to name.
#include "support/fuzz.h"

#include <ctype.h>
#include <string.h>

static bool asks_for_much(const uint8_t *data, size_t size) {
    if (!memmem(data, size, "generate", 8))
        return false;
    int digits = 0;
    for (size_t i = 0; i < size; i++) {
        digits = isdigit(data[i]) ? digits + 1 : 0;
        // An exponent writes a large number with few digits.
        if (digits > 2 || (digits && i + 1 < size && (data[i + 1] | 32) == 'e'))
            return true;
    }
    return false;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (asks_for_much(data, size))
        return 0;
    fuzz_file("voxels.raw", (const uint8_t *)"abcdefghijklmnopqrstuvwx", 24);
    struct pel_scene *scene = pel_scene_load(fuzz_file("input.json", data, size), NULL, 0);
    if (!scene)
        fuzz_expect_error();
    pel_scene_destroy(scene);
    return 0;
}
