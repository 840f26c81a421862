// fuzz_transform.c - the readers of rigid transforms: every input as each of the three formats.
#include "support/fuzz.h"

#include <math.h>
#include <stdlib.h>

static void load(const char *path, const struct pel_volume *moving,
                 const struct pel_volume *fixed) {
    struct pel_matrix matrix;
    if (!pel_transform_load(&matrix, path, moving, fixed)) {
        fuzz_expect_error();
        return;
    }
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            if (!isfinite(matrix.m[row][column]))
                abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    struct pel_volume *moving = pel_volume_create("moving", (int[]){4, 5, 6}, PEL_VOXEL_U8);
    struct pel_volume *fixed = pel_volume_create("fixed", (int[]){7, 8, 9}, PEL_VOXEL_U8);
    if (!moving || !fixed)
        abort();
    load(fuzz_file("input.tfm", data, size), NULL, NULL);
    load(fuzz_file("input.txt", data, size), NULL, NULL);
    load(fuzz_file("input.mat", data, size), moving, fixed);
    pel_volume_destroy(moving);
    pel_volume_destroy(fixed);
    return 0;
}
