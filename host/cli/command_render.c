// command_render.c - `pellucid render`: a scene or volumes in, a picture out.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/options.h"
#include "cli/picture.h"
#include "cli/probe.h"
#include "cli/progress.h"
#include "cli/render_frames.h"
#include "cli/report.h"

// What one run makes, and how long its parts took.
struct run {
    struct pel_scene *scene;
    struct pel_renderer *renderer;
    struct pel_image *images[2]; // the second one of two-files only
    struct pel_render_statistics statistics;
    struct pictures pictures;
    double load_ms, save_ms, total_ms;
};

static struct pel_scene *load(const struct render_options *options) {
    const char *const *overrides = (const char *const *)options->overrides.texts;
    if (options->input_count == 1 && cli_is_scene(options->inputs[0]))
        return pel_scene_load(options->inputs[0], overrides, options->overrides.count);
    return pel_scene_from_files((const char *const *)options->inputs, options->input_count,
                                overrides, options->overrides.count);
}

static int render(struct run *run, const struct render_options *options) {
    struct progress progress;
    progress_begin(&progress, options->quiet);
    const struct pel_render_options how = {.progress = progress_update, .user = &progress};
    run->renderer = pel_renderer_create(&options->renderer);
    if (run->renderer && run->pictures.count == 2)
        pel_renderer_render_eyes(run->renderer, run->scene, &how, &run->statistics, run->images);
    else if (run->renderer)
        run->images[0] = pel_renderer_render(run->renderer, run->scene, &how, &run->statistics);
    progress_end(&progress);
    return run->images[0] ? PEL_OK : cli_fail_library();
}

static int save(struct run *run) {
    double begin_ms = pel_clock_ms();
    bool good = true;
    for (int i = 0; i < run->pictures.count && good; i++)
        good = picture_save(run->images[i], run->pictures.names[i], run->scene, &run->statistics);
    run->save_ms = pel_clock_ms() - begin_ms;
    return good ? PEL_OK : cli_fail_library();
}

// Renders both eyes, and again, so that kernels and voxels are there, and takes the time.
static bool time_eyes(struct run *run, struct pel_image *eyes[2], double *ms) {
    for (int turn = 0; turn < 2; turn++) {
        double begin_ms = pel_clock_ms();
        if (!pel_renderer_render_eyes(run->renderer, run->scene, NULL, NULL, eyes))
            return false;
        *ms = pel_clock_ms() - begin_ms;
        if (turn == 0) {
            pel_image_destroy(eyes[0]);
            pel_image_destroy(eyes[1]);
        }
    }
    return true;
}

// How far the reprojected second eye is from the true one, in 255ths, and by how much it was
// faster to have both eyes; NULL when that cannot be rendered.
static json_t *measure_reprojection(struct run *run) {
    struct pel_image *moved[2] = {0}, *cast[2] = {0};
    double moved_ms, cast_ms, squares = 0, worst = 0;
    bool good = time_eyes(run, moved, &moved_ms);
    run->scene->stereo.reproject = false;
    good = good && time_eyes(run, cast, &cast_ms);
    run->scene->stereo.reproject = true;
    size_t count = good ? (size_t)cast[1]->width * (size_t)cast[1]->height * 4 : 0;
    for (size_t i = 0; i < count; i++) {
        double error = 255 * fabs((double)moved[1]->rgba[i] - cast[1]->rgba[i]);
        squares += error * error;
        worst = fmax(worst, error);
    }
    for (int i = 0; i < 2; i++) {
        pel_image_destroy(moved[i]);
        pel_image_destroy(cast[i]);
    }
    if (!good)
        return NULL;
    return json_pack("{s:o, s:o, s:o, s:o}", "reprojected",
                     report_number(run->statistics.stereo.reprojected), "error_rms",
                     report_number(sqrt(squares / (double)count)), "error_worst",
                     report_number(worst), "speed_up", report_number(cast_ms / moved_ms));
}

// What both eyes cost, in samples, over the first one; an interlaced picture costs what one does.
static json_t *describe_stereo(struct run *run) {
    const struct pel_render_statistics *statistics = &run->statistics;
    const uint64_t *samples = statistics->stereo.eye_samples;
    json_t *object = json_object();
    json_object_set_new(object, "kind", json_string(pel_stereo_names()[run->scene->stereo.kind]));
    json_object_set_new(object, "separation_mm", report_number(statistics->stereo.separation_mm));
    json_object_set_new(object, "convergence_mm", report_number(statistics->stereo.convergence_mm));
    json_object_set_new(object, "eye_samples",
                        json_pack("[I, I]", (json_int_t)samples[0], (json_int_t)samples[1]));
    json_object_set_new(object, "compose_ms", report_number(statistics->stereo.compose_ms));
    json_object_set_new(object, "relative_cost",
                        report_number((double)(samples[0] + samples[1]) /
                                      (double)(samples[0] > 0 ? samples[0] : 1)));
    if (statistics->stereo.reproject_ms > 0)
        json_object_set_new(object, "reproject", measure_reprojection(run));
    return object;
}

static json_t *describe_lod(const struct pel_scene *scene,
                            const struct pel_lod_statistics *statistics) {
    json_t *levels = json_array(), *object = json_object();
    for (int k = 0; k < scene->instance_count; k++)
        json_array_append_new(levels, json_integer(statistics->levels[k]));
    json_object_set_new(object, "levels", levels);
    json_object_set_new(object, "bytes", json_integer((json_int_t)statistics->bytes));
    json_object_set_new(object, "ms", report_number(statistics->ms));
    return object;
}

static json_t *describe_bricks(const struct pel_brick_statistics *bricks) {
    json_t *object = json_object();
    json_object_set_new(object, "size", json_integer(bricks->size));
    json_object_set_new(object, "total", json_integer((json_int_t)bricks->total));
    json_object_set_new(object, "active", json_integer((json_int_t)bricks->active));
    json_object_set_new(object, "resident", json_integer((json_int_t)bricks->resident));
    json_object_set_new(object, "clusters", json_integer((json_int_t)bricks->clusters));
    json_object_set_new(object, "activity_ms", report_number(bricks->activity_ms));
    json_object_set_new(object, "cluster_ms", report_number(bricks->cluster_ms));
    json_object_set_new(object, "tree_ms", report_number(bricks->tree_ms));
    return object;
}

static int print_json(struct run *run) {
    const struct pel_render_statistics *statistics = &run->statistics;
    json_t *object = json_object();
    json_object_set_new(object, "picture", report_text(run->pictures.names[0]));
    if (run->pictures.count == 2)
        json_object_set_new(object, "right_picture", report_text(run->pictures.names[1]));
    json_object_set_new(object, "width", json_integer(run->images[0]->width));
    json_object_set_new(object, "height", json_integer(run->images[0]->height));
    json_object_set_new(object, "device", report_text(statistics->device));
    json_object_set_new(object, "driver", report_text(statistics->driver));
    json_object_set_new(object, "reader", json_string(report_reader(statistics->reader)));
    json_object_set_new(object, "lanes", json_integer(statistics->lanes));
    json_object_set_new(object, "work_group", json_integer(statistics->work_group));
    json_object_set_new(object, "rays", json_integer((json_int_t)statistics->rays));
    json_object_set_new(object, "refined", report_number(statistics->refined));
    json_object_set_new(object, "samples", json_integer((json_int_t)statistics->samples));
    json_object_set_new(object, "samples_skipped",
                        json_integer((json_int_t)statistics->samples_skipped));
    json_object_set_new(object, "samples_terminated",
                        json_integer((json_int_t)statistics->samples_terminated));
    json_object_set_new(object, "samples_spared",
                        json_integer((json_int_t)statistics->samples_spared));
    json_object_set_new(object, "boxes_entered",
                        json_integer((json_int_t)statistics->boxes_entered));
    json_object_set_new(object, "device_bytes", json_integer((json_int_t)statistics->device_bytes));
    json_object_set_new(object, "uploaded_bytes",
                        json_integer((json_int_t)statistics->uploaded_bytes));
    if (run->scene->render.debug != PEL_DEBUG_NONE)
        json_object_set_new(object, "debug",
                            json_pack("{s:f, s:f, s:f}", "min", statistics->debug.min, "max",
                                      statistics->debug.max, "mean", statistics->debug.mean));
    json_object_set_new(object, "skip", json_string(report_skip(statistics->skip)));
    if (statistics->skip_reason[0])
        json_object_set_new(object, "skip_reason", json_string(statistics->skip_reason));
    json_object_set_new(object, "skip_bytes", json_integer((json_int_t)statistics->skip_bytes));
    if (statistics->lod.bytes > 0)
        json_object_set_new(object, "lod", describe_lod(run->scene, &statistics->lod));
    if (statistics->bricks.size > 0)
        json_object_set_new(object, "bricks", describe_bricks(&statistics->bricks));
    const struct {
        const char *name;
        double ms;
    } times[] = {
        {"load_ms", run->load_ms},
        {"prepare_ms", statistics->prepare_ms},
        {"build_ms", statistics->build_ms},
        {"upload_ms", statistics->upload_ms},
        {"skip_ms", statistics->skip_ms},
        {"render_ms", statistics->render_ms},
        {"download_ms", statistics->download_ms},
        {"save_ms", run->save_ms},
        {"total_ms", run->total_ms},
    };
    for (size_t i = 0; i < sizeof times / sizeof *times; i++)
        json_object_set_new(object, times[i].name, report_number(times[i].ms));
    if (run->scene->stereo.kind != PEL_STEREO_NONE)
        json_object_set_new(object, "stereo", describe_stereo(run));
    return report_json(object);
}

// One picture, of a still or of one frame.
static int render_still(struct run *run, const struct render_options *options, double begin_ms) {
    int status = render(run, options);
    if (!status)
        status = save(run);
    run->total_ms = pel_clock_ms() - begin_ms;
    if (!status && options->json)
        status = print_json(run);
    else if (!status && !options->quiet && isatty(STDERR_FILENO) &&
             strcmp(run->pictures.names[0], "-") != 0)
        fprintf(stderr, "pellucid: %s: %d x %d pixels in %.2f s on %s\n", run->pictures.names[0],
                run->images[0]->width, run->images[0]->height, run->total_ms / 1e3,
                run->statistics.device);
    return status;
}

int command_render(int argc, char **argv) {
    double begin_ms = pel_clock_ms();
    struct render_options options;
    struct run run = {0};
    int status = render_options_parse(&options, argc, argv);
    if (status)
        goto done;
    cli_show_warnings(!options.quiet);
    run.scene = load(&options);
    run.load_ms = pel_clock_ms() - begin_ms;
    if (!run.scene || (options.frame >= 0 && !pel_scene_set_frame(run.scene, options.frame))) {
        status = cli_fail_library();
        goto done;
    }
    if (options.probe) {
        run.renderer = pel_renderer_create(&options.renderer);
        status = run.renderer ? probe_print(run.renderer, run.scene, options.pixel, options.json)
                              : cli_fail_library();
        goto done;
    }
    bool many = render_frames_wanted(run.scene, &options);
    status = pictures_choose(&run.pictures, run.scene, &options, many);
    if (!status)
        status = many ? render_frames(run.scene, &run.pictures, &options)
                      : render_still(&run, &options, begin_ms);
done:
    pel_image_destroy(run.images[0]);
    pel_image_destroy(run.images[1]);
    pel_renderer_destroy(run.renderer);
    pel_scene_destroy(run.scene);
    render_options_finish(&options);
    return status;
}
