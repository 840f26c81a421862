// pictures.c - full pictures by the device against those of other systems. What is expected of the
// conventions is in reference.c, and in support/oracle.c.
#include <math.h>

#include "support/judge.h"
#include "support/oracle.h"
#include "support/picture.h"
#include "support/scenes.h"

// One picture, or where the phase depends on the ray, a picture patched together from those with
// this many phases: each pixel comes from the one whose phase is just below its own.
enum { PHASES = 32 };

// Both pictures hold bytes, as floats.
static const double BYTE_SLACK = 1e-3;

static struct pel_image *render(const struct oracle_picture *picture, struct pel_scene *scene) {
    // What texture hardware with weights of 8 bits makes of T2 is not what correct renderers do.
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 0);
    struct pel_image *result = pel_image_create(scene->render.width, scene->render.height);
    bool one = picture->system != ORACLE_CUDA;
    for (int n = 0; n < (one ? 1 : PHASES); n++) {
        if (!one)
            scene->render.phase = n / (double)PHASES;
        struct pel_image *image = pel_renderer_render(renderer, scene, NULL, NULL);
        if (!image)
            fail_msg("%s: %s", picture->file, pel_error_message());
        for (int i = 0; i < image->width * image->height; i++) {
            double phase = oracle_phase(picture, scene, i % image->width, i / image->width);
            if (one || (int)(phase * PHASES) == n)
                memcpy(result->rgba + 4 * i, image->rgba + 4 * i, 4 * sizeof(float));
        }
        pel_image_destroy(image);
    }
    pel_renderer_destroy(renderer);
    for (int i = 0; i < 4 * result->width * result->height; i++)
        result->rgba[i] = (float)oracle_stored(picture, (double)result->rgba[i]);
    return result;
}

static void test_picture(void **state) {
    const struct oracle_picture *picture = *state;
    struct pel_image *expected = oracle_read(picture);
    struct pel_scene *scene = oracle_scene(picture);
    struct pel_image *actual = render(picture, scene);

    struct picture_difference difference =
        picture_compare(actual, expected, picture->bound_255 + BYTE_SLACK);
    print_message("%s: off by %.3f of 255 at (%d, %d), %d pixels by more than %g, %.1f dB\n",
                  picture->file, difference.greatest, difference.x, difference.y,
                  difference.beyond_count, picture->bound_255, difference.psnr_db);
    assert_pictures_within(actual, expected, picture->bound_255 + BYTE_SLACK,
                           picture->exception_count, picture->file);
    assert_pictures_within(actual, expected,
                           fmax(picture->bound_255, picture->exception_255) + BYTE_SLACK, 0,
                           picture->file);
    pel_image_destroy(expected);
    pel_image_destroy(actual);
    pel_scene_destroy(scene);
}

int main(void) {
    return oracle_run("pictures", test_picture);
}
