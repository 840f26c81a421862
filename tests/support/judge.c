// judge.c - is a picture that a device made the right one?
#include "support/judge.h"

#include <math.h>

#include "reference/reference.h"
#include "support/picture.h"
#include "support/test.h"

struct judge {
    struct reference *reference;
    struct pel_image *expected;
};

// Positions lie at most a few hundred voxels away, computed in floats by a handful of operations.
static const double rounding = 0x1p-20;

static bool interpolates_in_floats(const char *device) {
    return strncmp(device, "pthread", 7) == 0 || strncmp(device, "cpu", 3) == 0 ||
           strstr(device, "Oclgrind") != NULL;
}

static struct reference_errors errors_of(const struct pel_render_statistics *statistics) {
    bool texture =
        statistics->reader == PEL_READER_IMAGE && !interpolates_in_floats(statistics->device);
    return (struct reference_errors){
        .rounding = rounding,
        .weight = texture ? 0x1p-8 : 0,
        .value = texture ? 3 : 0,
    };
}

struct judge *judge_create(const struct pel_scene *scene) {
    struct judge *judge = malloc(sizeof *judge);
    if (!judge)
        abort();
    judge->reference = reference_create(scene);
    judge->expected = reference_render(scene);
    return judge;
}

void judge_destroy(struct judge *judge) {
    reference_destroy(judge->reference);
    pel_image_destroy(judge->expected);
    free(judge);
}

void judge_check(const struct judge *judge, const struct pel_image *picture,
                 const struct pel_render_statistics *statistics, const char *title) {
    if (!picture)
        fail_msg("%s: no picture: %s", title, pel_error_message());
    const struct pel_image *expected = judge->expected;
    assert_int_equal(picture->width, expected->width);
    assert_int_equal(picture->height, expected->height);

    struct reference_errors errors = errors_of(statistics);
    int wrong_count = 0, worst = 0;
    double worst_excess = 0, worst_bound = 0;
    for (int i = 0; i < expected->width * expected->height; i++) {
        double off = 0;
        for (int c = 0; c < 4; c++) {
            double difference =
                fabs((double)picture->rgba[4 * i + c] - (double)expected->rgba[4 * i + c]);
            off = isfinite(difference) ? fmax(off, difference) : INFINITY;
        }
        if (off <= 1 / 255.0)
            continue;
        double bound = 1 / 255.0 + reference_pixel_bound(judge->reference, i % expected->width,
                                                         i / expected->width, &errors);
        if (off <= bound)
            continue;
        wrong_count++;
        if (off - bound > worst_excess) {
            worst_excess = off - bound;
            worst_bound = bound;
            worst = i;
        }
    }
    if (wrong_count == 0)
        return;

    const float *actual = picture->rgba + 4 * worst, *right = expected->rgba + 4 * worst;
    fail_msg("%s: %d pixels are wrong; (%d, %d) is %.3f %.3f %.3f %.3f, not %.3f %.3f %.3f %.3f "
             "within %.3f (of 255)",
             title, wrong_count, worst % expected->width, worst / expected->width, 255 * actual[0],
             255 * actual[1], 255 * actual[2], 255 * actual[3], 255 * right[0], 255 * right[1],
             255 * right[2], 255 * right[3], 255 * worst_bound);
}

// A reprojected picture is none of many right ones; it has to look like the true one: to be off by
// less than the true one changes from pixel to pixel along its rows.
static void judge_near(const struct pel_image *picture, const struct pel_image *expected,
                       const char *title) {
    double squares = 0, changes = 0;
    int count = 4 * expected->width * expected->height;
    assert_int_equal(picture->width * picture->height * 4, count);
    for (int i = 0; i < count; i++)
        squares += pow((double)picture->rgba[i] - expected->rgba[i], 2);
    for (int i = 4; i < count; i++)
        changes += pow((double)expected->rgba[i] - expected->rgba[i - 4], 2);
    double error = 255 * sqrt(squares / count), change = 255 * sqrt(changes / count);
    if (!(error < 0.5 * change))
        fail_msg("%s: reprojected, it is off by %.2f of 255, with changes of %.2f", title, error,
                 change);
}

void judge_composed(const struct pel_image *picture, const struct pel_image *composed,
                    enum pel_stereo_kind kind, const char *title) {
    if (kind >= PEL_STEREO_TRUE_RED_CYAN && kind <= PEL_STEREO_MATRIX)
        assert_pictures_within(picture, composed, 255e-5, 0, title);
    else
        assert_pictures_equal(picture, composed, title);
}

// Each eye has to be what the reference sees from its camera, and the picture what they compose.
static struct pel_image *judge_stereo(struct pel_renderer *renderer, const struct pel_scene *scene,
                                      struct pel_render_statistics *statistics, const char *title) {
    struct pel_camera cameras[2];
    struct pel_image *eyes[2];
    struct pel_scene seen = *scene;
    seen.stereo.reproject = false;
    if (!pel_stereo_cameras(scene, cameras, NULL) ||
        !pel_renderer_render_eyes(renderer, &seen, NULL, statistics, eyes))
        fail_msg("%s: no eyes: %s", title, pel_error_message());
    seen.stereo = (struct pel_stereo){0};
    for (int i = 0; i < 2; i++) {
        seen.camera = cameras[i];
        struct judge *judge = judge_create(&seen);
        judge_check(judge, eyes[i], statistics, title);
        judge_destroy(judge);
    }
    struct pel_image *composed = pel_stereo_compose(&scene->stereo, eyes[0], eyes[1]);
    struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, statistics);
    if (!composed || !picture)
        fail_msg("%s: no picture: %s", title, pel_error_message());
    if (scene->stereo.reproject)
        judge_near(picture, composed, title);
    else
        judge_composed(picture, composed, scene->stereo.kind, title);
    pel_image_destroy(eyes[0]);
    pel_image_destroy(eyes[1]);
    pel_image_destroy(composed);
    return picture;
}

struct pel_image *judge_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                               struct pel_render_statistics *statistics, const char *title) {
    struct pel_render_statistics own;
    if (!statistics)
        statistics = &own;
    if (scene->stereo.kind != PEL_STEREO_NONE)
        return judge_stereo(renderer, scene, statistics, title);
    struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, statistics);
    struct judge *judge = judge_create(scene);
    judge_check(judge, picture, statistics, title);
    judge_destroy(judge);
    return picture;
}

struct pel_renderer *judge_renderer(enum pel_reader reader, int lanes) {
    struct pel_renderer_options options = {.reader = reader, .lanes = lanes};
    struct pel_renderer *renderer = pel_renderer_create(&options);
    if (!renderer)
        fail_msg("no renderer: %s", pel_error_message());
    return renderer;
}

bool judge_has_images(struct pel_renderer *renderer, const struct pel_scene *scene) {
    struct pel_image *picture = pel_renderer_render(renderer, scene, NULL, NULL);
    bool missing = !picture && pel_error_code() == PEL_ERROR_UNSUPPORTED;
    if (missing)
        print_message("no images here: %s\n", pel_error_message());
    pel_image_destroy(picture);
    return !missing;
}

int judge_packet_lanes(void) {
    const char *lanes = getenv("PELLUCID_TEST_LANES");
    return lanes ? atoi(lanes) : 16;
}

int judge_lanes(int lanes) {
    return lanes < judge_packet_lanes() ? lanes : judge_packet_lanes();
}
