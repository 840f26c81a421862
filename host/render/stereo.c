// stereo.c - the pictures of two eyes, in one launch.
//
// The kernel takes tiles of either eye in turns, so that the second one finds the voxels in the
// caches, and everything but a camera is prepared and sent once. Of an interlaced picture it
// follows only the rays that are shown: a packet then has rays of both eyes.
#include <string.h>

#include "render/frame.h"

static bool is_debug(const struct pel_scene *scene) {
    return scene->render.debug != PEL_DEBUG_NONE;
}

// Which pixels of an interlaced picture are the second eye's: odd rows, columns, or both. False
// for other kinds, and where a pixel's light depends on its neighbours in the same eye's picture.
static bool find_weave(const struct pel_scene *scene, int weave[2]) {
    const struct pel_supersampling *supersampling = &scene->render.supersampling;
    weave[0] = scene->stereo.kind != PEL_STEREO_ROW_INTERLACED;
    weave[1] = scene->stereo.kind != PEL_STEREO_COLUMN_INTERLACED;
    return (scene->stereo.kind == PEL_STEREO_ROW_INTERLACED ||
            scene->stereo.kind == PEL_STEREO_COLUMN_INTERLACED ||
            scene->stereo.kind == PEL_STEREO_CHECKERBOARD) &&
           !is_debug(scene) && !(supersampling->adaptive > 0) &&
           supersampling->filter == PEL_RECONSTRUCTION_BOX;
}

// Progress of one eye, as a part of both.
struct part {
    const struct pel_render_options *options;
    double begin;
};

static bool report_part(double finished, void *user) {
    const struct part *part = user;
    return part->options->progress(part->begin + finished / 2, part->options->user);
}

// What is counted or timed adds up; what was chosen is that of the last eye.
static void add_statistics(struct pel_render_statistics *sum,
                           const struct pel_render_statistics *eye, int i) {
    struct pel_render_statistics both = *eye;
    both.samples += sum->samples;
    both.samples_skipped += sum->samples_skipped;
    both.samples_terminated += sum->samples_terminated;
    both.rays += sum->rays;
    both.uploaded_bytes += sum->uploaded_bytes;
    both.prepare_ms += sum->prepare_ms;
    both.build_ms += sum->build_ms;
    both.upload_ms += sum->upload_ms;
    both.skip_ms += sum->skip_ms;
    both.render_ms += sum->render_ms;
    both.download_ms += sum->download_ms;
    both.stereo = sum->stereo;
    both.stereo.eye_samples[i] = eye->samples;
    *sum = both;
}

// A debug view's numbers are those of a launch of its own, with a range of its own: so each eye
// has its frame there.
static struct pel_image *render_apart(struct pel_renderer *renderer, struct pel_scene *seen,
                                      const struct pel_camera *second,
                                      const struct pel_render_options *options,
                                      struct pel_render_statistics *statistics) {
    int width = seen->render.width, height = seen->render.height;
    struct pel_image *both = NULL;
    *statistics = (struct pel_render_statistics){0};
    for (int i = 0; i < 2; i++) {
        struct part part = {options, i / 2.0};
        struct pel_render_options of_eye = options ? *options : (struct pel_render_options){0};
        if (of_eye.progress) {
            of_eye.progress = report_part;
            of_eye.user = &part;
        }
        struct pel_render_statistics of_frame;
        struct pel_image *eye =
            pel_frame_render(renderer, seen, &(struct pel_frame_eyes){0}, &of_eye, &of_frame);
        if (eye && !both)
            both = pel_image_create(width, 2 * height);
        if (!eye || !both) {
            pel_image_destroy(eye);
            pel_image_destroy(both);
            return NULL;
        }
        size_t floats = (size_t)width * (size_t)height * 4;
        memcpy(both->rgba + (size_t)i * floats, eye->rgba, floats * sizeof *eye->rgba);
        pel_image_destroy(eye);
        add_statistics(statistics, &of_frame, i);
        seen->camera = *second;
    }
    return both;
}

// Renders what two cameras see. The caller owns the picture.
static struct pel_image *render_pair(struct pel_renderer *renderer, const struct pel_scene *scene,
                                     struct pel_frame_eyes *eyes,
                                     const struct pel_render_options *options,
                                     struct pel_render_statistics *statistics) {
    struct pel_camera cameras[2];
    struct pel_stereo used;
    if (!pel_stereo_cameras(scene, cameras, &used))
        return NULL;
    // The copy borrows everything the scene owns.
    struct pel_scene seen = *scene;
    seen.camera = cameras[0];
    eyes->second = &cameras[1];
    struct pel_image *image = is_debug(scene)
                                  ? render_apart(renderer, &seen, &cameras[1], options, statistics)
                                  : pel_frame_render(renderer, &seen, eyes, options, statistics);
    statistics->stereo.separation_mm = used.separation_mm;
    statistics->stereo.convergence_mm = used.convergence_mm;
    return image;
}

bool pel_renderer_render_eyes(struct pel_renderer *renderer, const struct pel_scene *scene,
                              const struct pel_render_options *options,
                              struct pel_render_statistics *statistics, struct pel_image *eyes[2]) {
    struct pel_render_statistics unwanted;
    if (!statistics)
        statistics = &unwanted;
    *statistics = (struct pel_render_statistics){0};
    eyes[0] = eyes[1] = NULL;
    struct pel_frame_eyes both = {.eyes = EYES_BOTH};
    struct pel_image *image = render_pair(renderer, scene, &both, options, statistics);
    for (int i = 0; image && i < 2; i++)
        eyes[i] = pel_image_create(image->width, image->height / 2);
    bool good = eyes[0] && eyes[1];
    size_t floats = good ? (size_t)image->width * (size_t)eyes[0]->height * 4 : 0;
    for (int i = 0; good && i < 2; i++)
        memcpy(eyes[i]->rgba, image->rgba + (size_t)i * floats, floats * sizeof *image->rgba);
    for (int i = 0; !good && i < 2; i++) {
        pel_image_destroy(eyes[i]);
        eyes[i] = NULL;
    }
    pel_image_destroy(image);
    return good;
}

struct pel_image *pel_renderer_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                                      const struct pel_render_options *options,
                                      struct pel_render_statistics *statistics) {
    struct pel_render_statistics unwanted;
    if (!statistics)
        statistics = &unwanted;
    *statistics = (struct pel_render_statistics){0};
    struct pel_frame_eyes eyes = {.eyes = EYES_ONE};
    if (scene->stereo.kind == PEL_STEREO_NONE)
        return pel_frame_render(renderer, scene, &eyes, options, statistics);
    eyes.eyes = find_weave(scene, eyes.weave) ? EYES_WOVEN : EYES_BOTH;
    struct pel_image *image = render_pair(renderer, scene, &eyes, options, statistics);
    if (!image || eyes.eyes == EYES_WOVEN)
        return image;
    double begin_ms = pel_clock_ms();
    int height = image->height / 2;
    size_t floats = (size_t)image->width * (size_t)height * 4;
    const struct pel_image left = {image->width, height, image->rgba};
    const struct pel_image right = {image->width, height, image->rgba + floats};
    struct pel_image *composed = pel_stereo_compose(&scene->stereo, &left, &right);
    statistics->stereo.compose_ms = pel_clock_ms() - begin_ms;
    pel_image_destroy(image);
    return composed;
}
