// stereo.c - the pictures of two eyes: two frames of one renderer, of scenes that differ in the
// camera only, so that nothing else travels to the device for the second one.

#include "render/frame.h"

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
                           const struct pel_render_statistics *eye) {
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
    *sum = both;
}

bool pel_renderer_render_eyes(struct pel_renderer *renderer, const struct pel_scene *scene,
                              const struct pel_render_options *options,
                              struct pel_render_statistics *statistics, struct pel_image *eyes[2]) {
    struct pel_render_statistics unwanted;
    if (!statistics)
        statistics = &unwanted;
    *statistics = (struct pel_render_statistics){0};
    eyes[0] = eyes[1] = NULL;
    struct pel_camera cameras[2];
    struct pel_stereo used;
    if (!pel_stereo_cameras(scene, cameras, &used))
        return false;
    statistics->stereo.separation_mm = used.separation_mm;
    statistics->stereo.convergence_mm = used.convergence_mm;

    // The copy borrows everything the scene owns.
    struct pel_scene seen = *scene;
    for (int i = 0; i < 2; i++) {
        struct part part = {options, i / 2.0};
        struct pel_render_options of_eye = options ? *options : (struct pel_render_options){0};
        if (of_eye.progress) {
            of_eye.progress = report_part;
            of_eye.user = &part;
        }
        seen.camera = cameras[i];
        struct pel_render_statistics of_frame;
        double begin_ms = pel_clock_ms();
        eyes[i] = pel_frame_render(renderer, &seen, &of_eye, &of_frame);
        if (!eyes[i]) {
            pel_image_destroy(eyes[0]);
            eyes[0] = NULL;
            return false;
        }
        statistics->stereo.eye_ms[i] = pel_clock_ms() - begin_ms;
        statistics->stereo.eye_samples[i] = of_frame.samples;
        add_statistics(statistics, &of_frame);
    }
    return true;
}

// Rows and columns are counted in the whole picture.
static bool begins_with_the_other_eye(const struct pel_scene *scene) {
    const int *region = scene->render.region;
    switch (scene->stereo.kind) {
    case PEL_STEREO_ROW_INTERLACED:
        return region[1] % 2 != 0;
    case PEL_STEREO_COLUMN_INTERLACED:
        return region[0] % 2 != 0;
    case PEL_STEREO_CHECKERBOARD:
        return (region[0] + region[1]) % 2 != 0;
    default:
        return false;
    }
}

struct pel_image *pel_renderer_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                                      const struct pel_render_options *options,
                                      struct pel_render_statistics *statistics) {
    if (scene->stereo.kind == PEL_STEREO_NONE)
        return pel_frame_render(renderer, scene, options, statistics);
    struct pel_render_statistics unwanted;
    if (!statistics)
        statistics = &unwanted;
    struct pel_image *eyes[2];
    if (!pel_renderer_render_eyes(renderer, scene, options, statistics, eyes))
        return NULL;
    double begin_ms = pel_clock_ms();
    bool odd = begins_with_the_other_eye(scene);
    struct pel_image *image = pel_stereo_compose(&scene->stereo, eyes[odd], eyes[!odd]);
    statistics->stereo.compose_ms = pel_clock_ms() - begin_ms;
    pel_image_destroy(eyes[0]);
    pel_image_destroy(eyes[1]);
    return image;
}
