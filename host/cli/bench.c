// bench.c - the cases of a benchmark, the scenes they share, and medians.
#include "cli/bench.h"

#include <fnmatch.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

// Something the cases borrow: a volume, a scene made here of such volumes, or a loaded scene with
// volumes of its own.
struct bench_kept {
    struct bench_kept *next;
    struct pel_volume *volume;
    struct pel_scene *made, *loaded;
};

static bool out_of_memory(void) {
    cli_fail(PEL_ERROR_MEMORY, "cannot allocate the cases of the benchmark");
    return false;
}

static struct bench_kept *keep(struct bench *bench) {
    struct bench_kept *kept = calloc(1, sizeof *kept);
    if (!kept) {
        out_of_memory();
        return NULL;
    }
    kept->next = bench->kept;
    bench->kept = kept;
    return kept;
}

bool bench_keep_volume(struct bench *bench, struct pel_volume *volume) {
    struct bench_kept *kept = keep(bench);
    if (kept)
        kept->volume = volume;
    else
        pel_volume_destroy(volume);
    return kept != NULL;
}

bool bench_keep_scene(struct bench *bench, struct pel_scene *scene) {
    struct bench_kept *kept = keep(bench);
    if (kept)
        kept->loaded = scene;
    else
        pel_scene_destroy(scene);
    return kept != NULL;
}

struct pel_volume *bench_copy_volume(struct bench *bench, const struct pel_volume *volume) {
    struct pel_volume *copy = pel_volume_create(volume->name, volume->dims, volume->type);
    if (!copy) {
        cli_fail_library();
        return NULL;
    }
    copy->world_from_voxel = volume->world_from_voxel;
    copy->slope = volume->slope;
    copy->intercept = volume->intercept;
    memcpy(copy->voxels, volume->voxels, pel_volume_bytes(volume));
    return bench_keep_volume(bench, copy) ? copy : NULL;
}

struct pel_matrix bench_rotation(double degrees, const double centre[3]) {
    double angle = degrees * 3.14159265358979323846 / 180, c = cos(angle), s = sin(angle);
    struct pel_matrix rotation = {{{c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0}, {0, 0, 0, 1}}};
    for (int row = 0; row < 3; row++) {
        rotation.m[row][3] = centre[row];
        for (int column = 0; column < 3; column++)
            rotation.m[row][3] -= rotation.m[row][column] * centre[column];
    }
    return rotation;
}

struct pel_scene *bench_scene(struct bench *bench, struct pel_volume *const *volumes, int count) {
    struct bench_kept *kept = keep(bench);
    struct pel_scene *scene = kept ? calloc(1, sizeof *scene) : NULL;
    if (!scene) {
        out_of_memory();
        return NULL;
    }
    kept->made = scene;
    scene->volume_count = scene->instance_count = count;
    for (int k = 0; k < count; k++) {
        struct pel_instance *instance = &scene->instances[k];
        scene->volumes[k] = volumes[k];
        instance->volume = k;
        snprintf(instance->name, sizeof instance->name, "copy %d", k);
        instance->transform = bench_rotation(0, (double[3]){0, 0, 0});
        instance->density = 1;
        instance->extent = PEL_EXTENT_POINT;
    }
    scene->background[3] = 1;
    scene->render = (struct pel_render_settings){.mixing = PEL_MIX_OVER,
                                                 .step = 0.5,
                                                 .phase = 0.5,
                                                 .termination = 0.95,
                                                 .origin = PEL_ORIGIN_VOLUMES,
                                                 .skip = PEL_SKIP_NONE};
    return scene;
}

struct bench_case *bench_add(struct bench *bench, const char *suite, const char *name) {
    struct bench_case *cases =
        realloc(bench->cases, ((size_t)bench->case_count + 1) * sizeof *cases);
    if (!cases) {
        out_of_memory();
        return NULL;
    }
    bench->cases = cases;
    struct bench_case *added = &cases[bench->case_count++];
    *added = (struct bench_case){.kind = BENCH_FRAME,
                                 .baseline = -1,
                                 .volumes = 1,
                                 .reader = bench->options.renderer.reader,
                                 .lanes = bench->options.renderer.lanes,
                                 .work_group = bench->options.renderer.work_group,
                                 .compute_units = bench->options.renderer.compute_units};
    snprintf(added->suite, sizeof added->suite, "%s", suite);
    snprintf(added->name, sizeof added->name, "%s", name);
    return added;
}

static bool is_wanted(const struct bench_case *one, const char *only) {
    char label[128], pattern[128];
    snprintf(label, sizeof label, "%s %s x%d %dx%d", one->suite, one->name, one->volumes,
             one->width, one->height);
    snprintf(pattern, sizeof pattern, "*%s*", only);
    return fnmatch(pattern, label, 0) == 0;
}

bool bench_keep_only(struct bench *bench) {
    int total = bench->case_count, kept = 0;
    int *place = calloc((size_t)total + 1, sizeof *place);
    if (!place)
        return out_of_memory();
    // Baselines stand before the cases that are compared with them.
    for (int i = total - 1; i >= 0; i--) {
        const struct bench_case *one = &bench->cases[i];
        if (place[i] || is_wanted(one, bench->options.only)) {
            place[i] = 1;
            if (one->baseline >= 0)
                place[one->baseline] = 1;
        }
    }
    for (int i = 0; i < total; i++) {
        if (!place[i])
            continue;
        struct bench_case one = bench->cases[i];
        if (one.baseline >= 0)
            one.baseline = place[one.baseline];
        place[i] = kept;
        bench->cases[kept++] = one;
    }
    free(place);
    bench->case_count = kept;
    if (kept == 0)
        cli_fail(PEL_ERROR_ARGUMENT, "--only: no case of %d is like '%s'", total,
                 bench->options.only);
    return kept > 0;
}

bool bench_time_add(struct bench *bench, struct bench_times *times, double ms) {
    if (!times->ms)
        times->ms = calloc((size_t)bench->options.frames, sizeof *times->ms);
    if (!times->ms)
        return out_of_memory();
    times->ms[times->count++] = ms;
    return true;
}

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(const struct bench_times *times) {
    int n = times->count;
    double sorted[BENCH_FRAMES_MOST];
    if (n == 0)
        return NAN;
    memcpy(sorted, times->ms, (size_t)n * sizeof *sorted);
    qsort(sorted, (size_t)n, sizeof *sorted, compare);
    return (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
}

double bench_least(const struct bench_times *times) {
    double least = NAN;
    for (int i = 0; i < times->count; i++)
        least = fmin(least, times->ms[i]);
    return least;
}

double bench_greatest(const struct bench_times *times) {
    double greatest = NAN;
    for (int i = 0; i < times->count; i++)
        greatest = fmax(greatest, times->ms[i]);
    return greatest;
}

void bench_init(struct bench *bench) {
    *bench = (struct bench){.options.frames = 7, .options.largest = 512};
}

static void release_kept(struct bench_kept *kept) {
    while (kept) {
        struct bench_kept *next = kept->next;
        for (int k = 0; kept->made && k < kept->made->instance_count; k++)
            pel_transfer_destroy(kept->made->instances[k].transfer);
        free(kept->made);
        pel_scene_destroy(kept->loaded);
        pel_volume_destroy(kept->volume);
        free(kept);
        kept = next;
    }
}

void bench_finish(struct bench *bench) {
    for (int i = 0; i < bench->case_count; i++) {
        struct bench_case *one = &bench->cases[i];
        free(one->frame.ms);
        free(one->kernel.ms);
        free(one->derive.ms);
        free(one->baseline_ratio.ms);
        for (int p = 0; p < BENCH_PEERS; p++) {
            free(one->peers[p].ms);
            free(one->ratios[p].ms);
        }
    }
    free(bench->cases);
    release_kept(bench->kept);
    *bench = (struct bench){0};
}
