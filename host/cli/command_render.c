// command_render.c - `pellucid render`: a scene or volumes in, a picture out.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/options.h"
#include "cli/probe.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/report.h"

// What one run makes, and how long its parts took.
struct run {
    struct pel_scene *scene;
    struct pel_renderer *renderer;
    struct pel_image *images[2]; // the second one of two-files only
    struct pel_render_statistics statistics;
    char pictures[2][4096];
    int picture_count;
    double load_ms, save_ms, total_ms;
};

static struct pel_scene *load(const struct render_options *options) {
    const char *const *overrides = (const char *const *)options->overrides.texts;
    if (options->input_count == 1 && cli_is_scene(options->inputs[0]))
        return pel_scene_load(options->inputs[0], overrides, options->overrides.count);
    return pel_scene_from_files((const char *const *)options->inputs, options->input_count,
                                overrides, options->overrides.count);
}

// The first input's name in the working directory with .png in place of its extension:
// "scans/head.nii.gz" gives "head.png", and so does a folder of slices "scans/head/". The letters
// of a glob pattern are left out.
static void default_picture(char *picture, size_t bytes, const char *input) {
    char name[256];
    size_t length = strlen(input);
    while (length > 1 && input[length - 1] == '/')
        length--;
    size_t begin = length;
    while (begin > 0 && input[begin - 1] != '/')
        begin--;
    snprintf(name, sizeof name, "%.*s", (int)(length - begin), input + begin);
    char *dot = strrchr(name, '.');
    if (dot && dot > name && strcasecmp(dot, ".gz") == 0) {
        *dot = '\0';
        dot = strrchr(name, '.');
    }
    if (dot && dot > name)
        *dot = '\0';
    size_t end = 0;
    for (const char *c = name; *c; c++)
        if (!strchr("*?[]", *c))
            name[end++] = *c;
    name[end] = '\0';
    snprintf(picture, bytes, "%s.png", end ? name : "picture");
}

static bool is_same_file(const char *a, const char *b) {
    struct stat status_a, status_b;
    return stat(a, &status_a) == 0 && stat(b, &status_b) == 0 &&
           status_a.st_dev == status_b.st_dev && status_a.st_ino == status_b.st_ino;
}

// "head.png" becomes "head_left.png" and "head_right.png".
static void name_eyes(struct run *run) {
    char *name = run->pictures[0];
    char whole[sizeof run->pictures[0]];
    memcpy(whole, name, sizeof whole);
    const char *slash = strrchr(whole, '/'), *dot = strrchr(whole, '.');
    if (!dot || (slash && dot < slash))
        dot = whole + strlen(whole);
    // A name too long to take the addition is cut, and then refused for want of an extension.
    for (int i = 0; i < 2; i++)
        snprintf(run->pictures[i], sizeof run->pictures[i], "%.*s_%s%s", (int)(dot - whole), whole,
                 i == 0 ? "left" : "right", dot);
    run->picture_count = 2;
}

static int check_picture(const char *picture, const struct render_options *options) {
    for (int i = 0; i < options->input_count; i++)
        if (is_same_file(picture, options->inputs[i]))
            return cli_fail(PEL_ERROR_ARGUMENT,
                            "%s: the picture would overwrite its input; name "
                            "another file with -o",
                            picture);
    return pel_image_check_path(picture) ? PEL_OK : cli_fail_library();
}

// Decides where the picture goes, or the two of them, before any work is done for it.
static int choose_pictures(struct run *run, const struct render_options *options) {
    char *picture = run->pictures[0];
    size_t bytes = sizeof run->pictures[0];
    run->picture_count = 1;
    if (options->output)
        snprintf(picture, bytes, "%s", options->output);
    else if (run->scene->output.path[0])
        snprintf(picture, bytes, "%s", run->scene->output.path);
    else
        default_picture(picture, bytes, options->inputs[0]);
    bool piped = strcmp(picture, "-") == 0;
    if (options->json && piped)
        return cli_fail(PEL_ERROR_ARGUMENT, "--json and the picture both want standard output");
    if (run->scene->stereo.kind == PEL_STEREO_TWO_FILES) {
        if (piped)
            return cli_fail(PEL_ERROR_ARGUMENT, "two files cannot go to standard output");
        name_eyes(run);
    }
    int status = PEL_OK;
    for (int i = 0; i < run->picture_count && !status; i++)
        status = check_picture(run->pictures[i], options);
    return status;
}

static int render(struct run *run, const struct render_options *options) {
    double begin_ms = report_clock_ms();
    run->scene = load(options);
    run->load_ms = report_clock_ms() - begin_ms;
    if (!run->scene)
        return cli_fail_library();
    if (options->probe) {
        run->renderer = pel_renderer_create(&options->renderer);
        return run->renderer ? probe_print(run->renderer, run->scene, options->pixel, options->json)
                             : cli_fail_library();
    }
    int status = choose_pictures(run, options);
    if (status)
        return status;
    struct progress progress;
    progress_begin(&progress, options->quiet);
    const struct pel_render_options how = {.progress = progress_update, .user = &progress};
    run->renderer = pel_renderer_create(&options->renderer);
    if (run->renderer && run->picture_count == 2)
        pel_renderer_render_eyes(run->renderer, run->scene, &how, &run->statistics, run->images);
    else if (run->renderer)
        run->images[0] = pel_renderer_render(run->renderer, run->scene, &how, &run->statistics);
    progress_end(&progress);
    return run->images[0] ? PEL_OK : cli_fail_library();
}

// The camera as the scene format writes it; memory to free(), or NULL.
static char *camera_text(const struct pel_camera *camera) {
    json_t *object = json_object();
    json_object_set_new(object, "eye", report_numbers(camera->eye, 3));
    json_object_set_new(object, "target", report_numbers(camera->target, 3));
    json_object_set_new(object, "up", report_numbers(camera->up, 3));
    if (camera->orthographic) {
        json_object_set_new(object, "orthographic", json_true());
        json_object_set_new(object, "height", report_number(camera->height_mm));
    } else {
        json_object_set_new(object, "fov", report_number(camera->fov_deg));
    }
    json_object_set_new(object, "shift", report_numbers(camera->shift, 2));
    char *text = json_dumps(object, JSON_REAL_PRECISION(12));
    json_decref(object);
    return text;
}

// The picture says how it was made, so that it can be made again.
static int save(struct run *run) {
    double begin_ms = report_clock_ms();
    char software[64];
    snprintf(software, sizeof software, "Pellucid %s", pel_version());
    char *camera = camera_text(&run->scene->camera);
    const char *const texts[][2] = {
        {"Software", software},
        {"scene", run->scene->text ? run->scene->text : ""},
        {"camera", camera ? camera : ""},
        {"device", run->statistics.device},
        {"driver", run->statistics.driver},
    };
    struct pel_image_options options = {
        .depth = run->scene->output.depth,
        .premultiplied = run->scene->output.premultiplied,
        .texts = texts,
        .text_count = sizeof texts / sizeof *texts,
    };
    bool good = true;
    for (int i = 0; i < run->picture_count && good; i++)
        good = pel_image_save(run->images[i], run->pictures[i], &options);
    free(camera);
    run->save_ms = report_clock_ms() - begin_ms;
    return good ? PEL_OK : cli_fail_library();
}

// What the second eye cost: the time of both and of composing them, over that of the first.
static json_t *describe_stereo(const struct run *run) {
    const struct pel_render_statistics *statistics = &run->statistics;
    const double *eye_ms = statistics->stereo.eye_ms;
    const uint64_t *samples = statistics->stereo.eye_samples;
    json_t *object = json_object();
    json_object_set_new(object, "kind", json_string(pel_stereo_names()[run->scene->stereo.kind]));
    json_object_set_new(object, "separation_mm", report_number(statistics->stereo.separation_mm));
    json_object_set_new(object, "convergence_mm", report_number(statistics->stereo.convergence_mm));
    json_object_set_new(object, "eye_ms", report_numbers(eye_ms, 2));
    json_object_set_new(object, "eye_samples",
                        json_pack("[I, I]", (json_int_t)samples[0], (json_int_t)samples[1]));
    json_object_set_new(object, "compose_ms", report_number(statistics->stereo.compose_ms));
    json_object_set_new(
        object, "relative_cost",
        report_number((eye_ms[0] + eye_ms[1] + statistics->stereo.compose_ms) / eye_ms[0]));
    return object;
}

static json_t *describe_bricks(const struct pel_brick_statistics *bricks) {
    json_t *object = json_object();
    json_object_set_new(object, "size", json_integer(bricks->size));
    json_object_set_new(object, "total", json_integer((json_int_t)bricks->total));
    json_object_set_new(object, "active", json_integer((json_int_t)bricks->active));
    json_object_set_new(object, "clusters", json_integer((json_int_t)bricks->clusters));
    json_object_set_new(object, "activity_ms", report_number(bricks->activity_ms));
    json_object_set_new(object, "cluster_ms", report_number(bricks->cluster_ms));
    json_object_set_new(object, "tree_ms", report_number(bricks->tree_ms));
    return object;
}

static int print_json(const struct run *run) {
    const struct pel_render_statistics *statistics = &run->statistics;
    json_t *object = json_object();
    json_object_set_new(object, "picture", report_text(run->pictures[0]));
    if (run->picture_count == 2)
        json_object_set_new(object, "right_picture", report_text(run->pictures[1]));
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
    json_object_set_new(object, "device_bytes", json_integer((json_int_t)statistics->device_bytes));
    json_object_set_new(object, "uploaded_bytes",
                        json_integer((json_int_t)statistics->uploaded_bytes));
    if (run->scene->render.debug != PEL_DEBUG_NONE)
        json_object_set_new(object, "debug",
                            json_pack("{s:f, s:f, s:f}", "min", statistics->debug.min, "max",
                                      statistics->debug.max, "mean", statistics->debug.mean));
    json_object_set_new(object, "skip", json_string(report_skip(statistics->skip)));
    json_object_set_new(object, "skip_bytes", json_integer((json_int_t)statistics->skip_bytes));
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

int command_render(int argc, char **argv) {
    double begin_ms = report_clock_ms();
    struct render_options options;
    struct run run = {0};
    int status = render_options_parse(&options, argc, argv);
    if (status)
        goto done;
    cli_show_warnings(!options.quiet);
    status = render(&run, &options);
    if (options.probe)
        goto done;
    if (!status)
        status = save(&run);
    run.total_ms = report_clock_ms() - begin_ms;
    if (!status && options.json)
        status = print_json(&run);
    else if (!status && !options.quiet && isatty(STDERR_FILENO) &&
             strcmp(run.pictures[0], "-") != 0)
        fprintf(stderr, "pellucid: %s: %d x %d pixels in %.2f s on %s\n", run.pictures[0],
                run.images[0]->width, run.images[0]->height, run.total_ms / 1e3,
                run.statistics.device);
done:
    pel_image_destroy(run.images[0]);
    pel_image_destroy(run.images[1]);
    pel_renderer_destroy(run.renderer);
    pel_scene_destroy(run.scene);
    render_options_finish(&options);
    return status;
}
