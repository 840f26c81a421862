// bench_run.c - the turns: every case and every peer once, then all of them again.
//
// Before the first turn each case renders a frame that is not counted, so that voxels and kernels
// are on the device, and in each turn at least another one, so that caches hold what they hold in a
// run of frames and not what the case before left there, and the device's threads are awake.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/bench.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"

// A renderer that holds some volumes. Cases share it where neither volumes nor kernels differ, so
// that no turn has to upload any.
struct bench_engine {
    struct bench_engine *next;
    enum pel_reader reader;
    int lanes, work_group, work_group_rows, compute_units, volume_count;
    struct pel_volume *volumes[PEL_VOLUME_MAX];
    struct pel_renderer *renderer;
};

static struct pel_renderer *find_renderer(struct bench *bench, const struct bench_case *one) {
    const struct pel_scene *scene = one->scene;
    size_t bytes = (size_t)scene->volume_count * sizeof *scene->volumes;
    for (struct bench_engine *engine = bench->engines; engine; engine = engine->next)
        if (engine->reader == one->reader && engine->lanes == one->lanes &&
            engine->work_group == one->work_group &&
            engine->work_group_rows == one->work_group_rows &&
            engine->compute_units == one->compute_units &&
            engine->volume_count == scene->volume_count &&
            memcmp(engine->volumes, scene->volumes, bytes) == 0)
            return engine->renderer;
    struct bench_engine *made = calloc(1, sizeof *made);
    if (!made)
        return NULL;
    struct pel_renderer_options options = bench->options.renderer;
    options.reader = made->reader = one->reader;
    options.lanes = made->lanes = one->lanes;
    options.work_group = made->work_group = one->work_group;
    options.work_group_rows = made->work_group_rows = one->work_group_rows;
    options.compute_units = made->compute_units = one->compute_units;
    made->volume_count = scene->volume_count;
    memcpy(made->volumes, scene->volumes, bytes);
    made->renderer = pel_renderer_create(&options);
    if (!made->renderer) {
        free(made);
        return NULL;
    }
    made->next = bench->engines;
    bench->engines = made;
    return made->renderer;
}

static void release_engines(struct bench *bench) {
    while (bench->engines) {
        struct bench_engine *next = bench->engines->next;
        pel_renderer_destroy(bench->engines->renderer);
        free(bench->engines);
        bench->engines = next;
    }
}

// Renders one frame of a case; the time is that of the whole call, which a viewer would wait for.
static bool render(struct bench *bench, struct bench_case *one, double *ms) {
    struct pel_renderer *renderer = find_renderer(bench, one);
    if (!renderer)
        return false;
    one->scene->render.width = one->width;
    one->scene->render.height = one->height;
    if (one->sets_skip) {
        one->scene->render.skip = one->skip;
        one->scene->render.bricks = one->bricks;
    }
    double begin_ms = pel_clock_ms();
    struct pel_image *image = pel_renderer_render(renderer, one->scene, NULL, &one->statistics);
    *ms = pel_clock_ms() - begin_ms;
    pel_image_destroy(image);
    return image != NULL;
}

// The frame before all turns.
static int warm_up(struct bench *bench, struct bench_case *one) {
    double ms;
    if (one->change)
        one->change(one->scene, 1);
    if (one->kind != BENCH_FRAME || render(bench, one, &ms))
        return PEL_OK;
    if (!one->optional)
        return cli_fail(pel_error_code(), "%s: %s: %s", one->suite, one->name, pel_error_message());
    snprintf(one->problem, sizeof one->problem, "%s", pel_error_message());
    fprintf(stderr, "pellucid: %s: '%s' is left out: %s\n", one->suite, one->name, one->problem);
    return PEL_OK;
}

// A cold start empties the cache first, a warm one does not.
static int take_start(struct bench *bench, struct bench_case *one, char cache[256], double *ms) {
    if (one->kind == BENCH_COLD_START || cache[0] == '\0') {
        if (cache[0])
            bench_folder_remove(cache);
        if (!bench_folder_create(cache))
            return (int)PEL_ERROR_FILE;
    }
    char problem[256];
    if (bench_start_run(bench, one, cache, ms, problem))
        return PEL_OK;
    return cli_fail(PEL_ERROR_DEVICE, "start: %s: %s", one->name, problem);
}

static const double awake_ms = 40; // until a run of frames has settled

static int take_frame(struct bench *bench, struct bench_case *one, double *ms) {
    double begin_ms = pel_clock_ms();
    // In the first frame the device forgets the case before, unless that skips alike.
    bool good = render(bench, one, ms);
    double derive_ms = one->statistics.skip_ms;
    while (good && pel_clock_ms() - begin_ms < awake_ms)
        good = render(bench, one, ms);
    if (good && one->change)
        one->change(one->scene, one->frame.count);
    good = good && render(bench, one, ms);
    if (!good)
        return cli_fail(pel_error_code(), "%s: %s: %s", one->suite, one->name, pel_error_message());
    if (one->detail == BENCH_CHANGING)
        derive_ms = one->statistics.skip_ms;
    return bench_time_add(bench, &one->kernel, one->statistics.render_ms) &&
                   bench_time_add(bench, &one->derive, derive_ms)
               ? PEL_OK
               : (int)PEL_ERROR_MEMORY;
}

static int take_sequential(struct bench_case *one, double *ms) {
    return bench_sequential_run(one, ms, &one->statistics.samples) ? PEL_OK : (int)PEL_ERROR_MEMORY;
}

static bool take_peers(struct bench *bench, struct bench_case *one, double frame_ms) {
    bool good = true;
    for (int p = 0; good && one->with_peers && p < bench->options.peer_count; p++) {
        double ms;
        char *problem = one->peer_problems[p];
        if (problem[0] || (one->shaded && !bench_peer_shades(&bench->options.peers[p])))
            continue;
        if (bench_peer_run(bench, one, p, &ms, problem))
            good = bench_time_add(bench, &one->peers[p], ms) &&
                   bench_time_add(bench, &one->ratios[p], frame_ms / ms);
        else
            fprintf(stderr, "pellucid: %s: peer '%s' is left out for %s, %d volume%s, %dx%d: %s\n",
                    one->suite, bench->options.peers[p].name, one->transfer, one->volumes,
                    one->volumes > 1 ? "s" : "", one->width, one->height, problem);
    }
    return good;
}

// One turn of one case.
static int take_turn(struct bench *bench, struct bench_case *one, char cache[256]) {
    double ms;
    if (one->problem[0])
        return PEL_OK;
    int status = one->kind == BENCH_FRAME        ? take_frame(bench, one, &ms)
                 : one->kind == BENCH_SEQUENTIAL ? take_sequential(one, &ms)
                                                 : take_start(bench, one, cache, &ms);
    if (status)
        return status;
    bool good = bench_time_add(bench, &one->frame, ms);
    if (good && one->baseline >= 0) {
        // Baselines stand before the cases that are compared with them.
        const struct bench_times *base = &bench->cases[one->baseline].frame;
        if (base->count > 0)
            good = bench_time_add(bench, &one->baseline_ratio, ms / base->ms[base->count - 1]);
    }
    return good && take_peers(bench, one, ms) ? PEL_OK : (int)PEL_ERROR_MEMORY;
}

int bench_run(struct bench *bench) {
    int status = PEL_OK, done = 0;
    int total = bench->case_count * (bench->options.frames + 1);
    char cache[256] = "";
    struct progress progress;
    progress_begin(&progress, false);
    for (int i = 0; !status && i < bench->case_count; i++) {
        status = warm_up(bench, &bench->cases[i]);
        progress_update((double)++done / total, &progress);
    }
    for (int turn = 0; !status && turn < bench->options.frames; turn++)
        for (int i = 0; !status && i < bench->case_count; i++) {
            status = take_turn(bench, &bench->cases[i], cache);
            progress_update((double)++done / total, &progress);
        }
    progress_end(&progress);
    if (cache[0])
        bench_folder_remove(cache);
    release_engines(bench);
    return status;
}
