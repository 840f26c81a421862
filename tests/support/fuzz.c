// fuzz.c - input as a file, and a look at all that came out of it.
#include "support/fuzz.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "support/test.h"

enum { MEASURED_VOXELS_MAX = 1 << 20 };

static void require(bool good, const char *what) {
    if (good)
        return;
    fprintf(stderr, "broken promise: %s\n", what);
    abort();
}

const char *fuzz_file(const char *leaf, const uint8_t *data, size_t size) {
    const char *path = test_temporary_path(leaf);
    FILE *stream = fopen(path, "wb");
    require(stream && fwrite(data, 1, size, stream) == size, "the temporary folder is writable");
    fclose(stream);
    return path;
}

void fuzz_remove(const char *leaf) {
    unlink(test_temporary_path(leaf));
}

void fuzz_expect_error(void) {
    const char *message = pel_error_message();
    require(pel_error_code() != PEL_OK && message[0], "a failure has a code and a sentence");
    require(!strchr(message, '\n'), "a sentence is one line");
}

// Reads what a renderer would read.
static void look_at(const struct pel_volume *volume) {
    for (int axis = 0; axis < 3; axis++)
        require(volume->dims[axis] >= 1, "every dimension is at least 1");
    require(volume->name && volume->voxels, "a volume has a name and voxels");
    require(memchr(volume->unit, 0, sizeof volume->unit) != NULL, "the unit is text");
    require(memchr(volume->space, 0, sizeof volume->space) != NULL, "the space is text");
    require(isfinite(volume->slope) && isfinite(volume->intercept),
            "slope and intercept are finite");
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            require(isfinite(volume->world_from_voxel.m[row][column]), "the placement is finite");
    // Going over all voxels of a large volume would only look like a hang of its reader.
    if (pel_volume_voxel_count(volume) > MEASURED_VOXELS_MAX) {
        pel_volume_value(volume, 0, 0, 0);
        pel_volume_value(volume, volume->dims[0] - 1, volume->dims[1] - 1, volume->dims[2] - 1);
        return;
    }
    struct pel_statistics statistics;
    pel_volume_measure(volume, &statistics);
    require(statistics.count + statistics.absent_count == pel_volume_voxel_count(volume),
            "every voxel is present or absent");
    require(statistics.min <= statistics.max, "the least value is not above the greatest");
}

void fuzz_load(const char *path, const struct pel_load_options *options) {
    struct pel_volume *volume = pel_volume_load(path, options);
    if (volume)
        look_at(volume);
    else
        fuzz_expect_error();
    pel_volume_destroy(volume);
}
