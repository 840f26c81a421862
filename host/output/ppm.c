// ppm.c - writes a picture as binary PPM (P6, 8 bits), the format every pipe understands. It has no
// alpha: the colours are written premultiplied, which is the picture over black.
#include "output/image.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"

// Does not check the stream: its owner does, once, at the end.
static bool write_pixels(const struct pel_image *image, FILE *stream) {
    size_t row_bytes = (size_t)image->width * 3;
    unsigned char *row = pel_allocate(row_bytes, 1);
    if (!row)
        return false;
    fprintf(stream, "P6\n%d %d\n255\n", image->width, image->height);
    const float *rgba = image->rgba;
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++, rgba += 4)
            for (int c = 0; c < 3; c++)
                row[3 * x + c] = (unsigned char)pel_image_quantise(rgba[c], 255);
        fwrite(row, 1, row_bytes, stream);
    }
    free(row);
    return true;
}

bool pel_ppm_save(const struct pel_image *image, const char *path) {
    if (strcmp(path, "-") == 0) {
        if (!write_pixels(image, stdout))
            return false;
        if (fflush(stdout) != 0 || ferror(stdout))
            return pel_fail(PEL_ERROR_FILE, "standard output: cannot write: %s", strerror(errno));
        return true;
    }
    struct pel_output output;
    if (!pel_output_open(&output, path))
        return false;
    if (!write_pixels(image, output.stream)) {
        pel_output_abandon(&output);
        return false;
    }
    return pel_output_commit(&output);
}
