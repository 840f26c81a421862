// reference.c - the reference against the pictures of other systems, at every few pixels. That the
// conventions of both are understood is known from here; pictures.c is then about the device.
#include <math.h>

#include "reference/reference.h"
#include "support/oracle.h"
#include "support/scenes.h"

enum { STRIDE = 7 };

// Both pictures hold bytes, as floats.
static const double BYTE_SLACK = 1e-3;

static void test_picture(void **state) {
    const struct oracle_picture *picture = *state;
    struct pel_image *expected = oracle_read(picture);
    struct pel_scene *scene = oracle_scene(picture);
    assert_int_equal(expected->width, scene->render.width);
    assert_int_equal(expected->height, scene->render.height);

    struct reference *reference = reference_create(scene);
    double greatest = 0;
    int worst_x = 0, worst_y = 0, beyond = 0;
    for (int y = 3; y < expected->height; y += STRIDE) {
        for (int x = 3; x < expected->width; x += STRIDE) {
            double rgba[4], off = 0;
            scene->render.phase = oracle_phase(picture, scene, x, y);
            reference_cast(reference, x, y, rgba, NULL);
            const float *pixel = expected->rgba + 4 * (y * expected->width + x);
            for (int c = 0; c < 3; c++)
                off = fmax(off, 255 * fabs(oracle_stored(picture, rgba[c]) - (double)pixel[c]));
            beyond += off > picture->bound_255 + BYTE_SLACK;
            if (off > greatest) {
                greatest = off;
                worst_x = x, worst_y = y;
            }
        }
    }
    print_message("%s: off by %.3f of 255 at (%d, %d), %d pixels by more than %g\n", picture->file,
                  greatest, worst_x, worst_y, beyond, picture->bound_255);
    assert_true(greatest <= fmax(picture->bound_255, picture->exception_255) + BYTE_SLACK);
    assert_true(beyond <= picture->exception_count);
    reference_destroy(reference);
    pel_scene_destroy(scene);
    pel_image_destroy(expected);
}

int main(void) {
    return oracle_run("reference", test_picture);
}
