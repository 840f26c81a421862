// render_frames.c - many frames of an animation, to numbered pictures or to a video.
#include "cli/render_frames.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cli/frames.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"

struct sequence {
    struct pel_scene *scene;
    const struct pictures *pictures; // patterns
    struct frames frames;
    struct pel_renderer *renderer;
    struct pel_video *videos[2]; // NULL: numbered pictures
    struct progress progress;
    int done;      // frames
    json_t *lines; // what is reported of each, or NULL
};

static bool report_frame(double finished, void *user) {
    struct sequence *sequence = user;
    return progress_update((sequence->done + finished) / frames_count(&sequence->frames),
                           &sequence->progress);
}

static void add_line(struct sequence *sequence, int frame, const char *name,
                     const struct pel_render_statistics *statistics) {
    json_t *line = json_object();
    json_object_set_new(line, "frame", json_integer(frame));
    if (!sequence->videos[0])
        json_object_set_new(line, "picture", report_text(name));
    json_object_set_new(line, "samples", json_integer((json_int_t)statistics->samples));
    json_object_set_new(line, "uploaded_bytes",
                        json_integer((json_int_t)statistics->uploaded_bytes));
    json_object_set_new(line, "render_ms", report_number(statistics->render_ms));
    json_array_append_new(sequence->lines, line);
}

// Puts one frame's picture, or one eye's, where it belongs.
static bool put_picture(struct sequence *sequence, int eye, int frame,
                        const struct pel_image *image,
                        const struct pel_render_statistics *statistics) {
    const char *pattern = sequence->pictures->names[eye];
    struct pel_video **video = &sequence->videos[eye];
    if (!pel_video_is_path(pattern)) {
        char name[PICTURE_NAME_BYTES];
        frames_name(name, sizeof name, pattern, frame);
        if (sequence->lines && eye == 0)
            add_line(sequence, frame, name, statistics);
        return picture_save(image, name, sequence->scene, statistics);
    }
    if (!*video)
        *video =
            pel_video_create(pattern, image->width, image->height, sequence->scene->timeline.fps);
    if (sequence->lines && eye == 0)
        add_line(sequence, frame, pattern, statistics);
    return *video && pel_video_add(*video, image);
}

static bool render_one(struct sequence *sequence, int frame) {
    const struct pel_render_options how = {.progress = report_frame, .user = sequence};
    struct pel_render_statistics statistics;
    struct pel_image *images[2] = {NULL, NULL};
    if (!pel_scene_set_frame(sequence->scene, frame))
        return false;
    if (sequence->pictures->count == 2)
        pel_renderer_render_eyes(sequence->renderer, sequence->scene, &how, &statistics, images);
    else
        images[0] = pel_renderer_render(sequence->renderer, sequence->scene, &how, &statistics);
    bool good = images[0] != NULL;
    for (int eye = 0; eye < sequence->pictures->count && good; eye++)
        good = put_picture(sequence, eye, frame, images[eye], &statistics);
    pel_image_destroy(images[0]);
    pel_image_destroy(images[1]);
    return good;
}

// Ends the videos: whole ones, or none at all.
static bool finish_videos(struct sequence *sequence, bool good) {
    for (int eye = 0; eye < 2; eye++) {
        if (good && sequence->videos[eye])
            good = pel_video_finish(sequence->videos[eye]);
        else
            pel_video_destroy(sequence->videos[eye]);
        sequence->videos[eye] = NULL;
    }
    return good;
}

static bool render_all(struct sequence *sequence, const struct render_options *options) {
    sequence->renderer = pel_renderer_create(&options->renderer);
    bool good = sequence->renderer != NULL;
    progress_begin(&sequence->progress, options->quiet);
    const struct frames *frames = &sequence->frames;
    for (int frame = frames->first; good && frame < frames->end; frame += frames->stride) {
        good = render_one(sequence, frame);
        sequence->done++;
    }
    progress_end(&sequence->progress);
    pel_renderer_destroy(sequence->renderer);
    return finish_videos(sequence, good);
}

bool render_frames_wanted(const struct pel_scene *scene, const struct render_options *options) {
    const char *name = options->output ? options->output : scene->output.path;
    bool animated = scene->timeline.frame_count > 0 && frames_is_pattern(name);
    return options->frames || (options->frame < 0 && (pel_video_is_path(name) || animated));
}

int render_frames(struct pel_scene *scene, const struct pictures *pictures,
                  const struct render_options *options) {
    double begin_ms = pel_clock_ms();
    struct sequence sequence = {.scene = scene, .pictures = pictures};
    if (scene->timeline.frame_count == 0)
        return cli_fail(PEL_ERROR_ARGUMENT, "the scene has no animation");
    if (!frames_parse(&sequence.frames, options->frames ? options->frames : "all",
                      scene->timeline.frame_count))
        return PEL_ERROR_ARGUMENT;
    sequence.lines = options->json ? json_array() : NULL;
    int count = frames_count(&sequence.frames);
    if (!render_all(&sequence, options)) {
        json_decref(sequence.lines);
        return cli_fail_library();
    }
    double total_ms = pel_clock_ms() - begin_ms;
    if (options->json) {
        json_t *object = json_object();
        json_object_set_new(object, "picture", report_text(pictures->names[0]));
        if (pictures->count == 2)
            json_object_set_new(object, "right_picture", report_text(pictures->names[1]));
        json_object_set_new(object, "fps", report_number(scene->timeline.fps));
        json_object_set_new(object, "frames", sequence.lines);
        json_object_set_new(object, "total_ms", report_number(total_ms));
        return report_json(object);
    }
    if (!options->quiet && isatty(STDERR_FILENO))
        fprintf(stderr, "pellucid: %s: %d frames in %.2f s\n", pictures->names[0], count,
                total_ms / 1e3);
    return PEL_OK;
}
