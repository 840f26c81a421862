// bench_skip.c - the suite `skip`: every way to skip empty space, for three volumes and three
// transfer functions each.
//
// The volumes are two thirds empty and noisy (the task's), thin shells in much empty space, and
// full; of each the functions show a haze nearly everywhere, the inner parts nearly as a surface,
// and little. Then come the tables of the papers, with the task's volume: brick sizes and
// clustering (Ganter & Manzke 2019, table 1), walking and culling (Derin et al. 2021, table 1); the
// rays a second of grid and octree are what Voetter 2019 compares.
#include <stdio.h>

#include "cli/bench.h"
#include "cli/options.h"
#include "cli/report.h"

enum { VOLUMES = 3, TRANSFERS = 3, MOST = 256, USUAL_WIDTH = 640, USUAL_HEIGHT = 480 };

// What the functions show, T1 to T3, of values from 0 to 255.
static struct pel_transfer *make_transfer(int volume, int t) {
    struct pel_transfer *transfer = bench_task_transfer(t);
    // The full volume has values everywhere, so the haze is everywhere, too.
    if (transfer && volume == 2 && t == 0)
        for (int i = 0; i < transfer->opacity_count; i++)
            transfer->opacities[i].value -= 12;
    return transfer;
}

// Values from 20 to 200: there is no voxel without anything.
static struct pel_volume *make_full(int size) {
    struct pel_volume *volume = pel_volume_create("full", (int[3]){size, size, size}, PEL_VOXEL_U8);
    if (!volume) {
        cli_fail_library();
        return NULL;
    }
    unsigned char *voxels = volume->voxels;
    size_t row = (size_t)size, count = row * row * row;
    for (size_t i = 0; i < count; i++) {
        size_t x = i % row, y = i / row % row, z = i / row / row;
        voxels[i] = (unsigned char)(20 + (x * x + y * y * 3 + z * z * 2) * 180 / (6 * row * row));
    }
    return volume;
}

static struct pel_volume *make_volume(struct bench *bench, int n, int size) {
    struct pel_volume *volume =
        n == 0   ? bench_task_volume(size)
        : n == 1 ? pel_volume_generate("c60", &(struct pel_generate_options){.size = size})
                 : make_full(size);
    if (!volume) {
        if (n == 1)
            cli_fail_library();
        return NULL;
    }
    // A millimetre a voxel, so that one function is as dense in all.
    static const double identity[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            volume->world_from_voxel.m[row][column] = identity[row][column];
    volume->slope = 1;
    volume->intercept = 0;
    return bench_keep_volume(bench, volume) ? volume : NULL;
}

// A case of the suite; its size is the run's or the usual one.
static struct bench_case *add_case(struct bench *bench, const char *name, struct pel_scene *scene,
                                   int t, enum pel_skip skip) {
    struct bench_case *added = bench_add(bench, "skip", name);
    if (!added)
        return NULL;
    added->scene = scene;
    snprintf(added->transfer, sizeof added->transfer, "T%d", t + 1);
    added->width = bench->options.width ? bench->options.width : USUAL_WIDTH;
    added->height = bench->options.width ? bench->options.height : USUAL_HEIGHT;
    bench_set_skip(added, skip);
    return added;
}

static struct pel_scene *make_scene(struct bench *bench, struct pel_volume *volume, int n, int t) {
    struct pel_scene *scene = bench_scene(bench, &volume, 1);
    struct pel_bounds bounds;
    if (!scene || !(scene->instances[0].transfer = make_transfer(n, t)))
        return NULL;
    scene->render.width = USUAL_WIDTH;
    scene->render.height = USUAL_HEIGHT;
    // What rules may want to know.
    pel_volume_measure(volume, &scene->statistics[0]);
    if (pel_scene_bounds(scene, &bounds) &&
        pel_camera_fit(&scene->camera, "oblique", &bounds, (double)USUAL_WIDTH / USUAL_HEIGHT))
        return scene;
    cli_fail_library();
    return NULL;
}

static bool add_ways(struct bench *bench, struct pel_scene *scene, const char *volume, int t) {
    int first = bench->case_count;
    for (int n = 0; n < BENCH_WAYS; n++) {
        enum pel_skip skip = bench_way(n);
        if (!bench_wants_skip(bench, skip, BENCH_ALL_WAYS | 1))
            continue;
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "%s T%d, %s", volume, t + 1, report_skip(skip));
        struct bench_case *added = add_case(bench, name, scene, t, skip);
        if (!added)
            return false;
        added->baseline = bench->case_count - 1 > first ? first : -1;
    }
    return true;
}

// Brick sizes, each clustered and not.
static bool add_bricks(struct bench *bench, struct pel_scene *scene, int t) {
    struct pel_brick_report reports[PEL_BRICK_SIZES];
    if (!bench_wants_skip(bench, PEL_SKIP_BVH, BENCH_ALL_WAYS))
        return true;
    if (!pel_scene_measure_bricks(scene, 0, reports)) {
        cli_fail_library();
        return false;
    }
    int first = bench->case_count;
    for (int n = 0; n < 2 * PEL_BRICK_SIZES; n++) {
        const struct pel_brick_report *report = &reports[n / 2];
        bool apart = n % 2;
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "task T%d, bvh %d%s", t + 1, report->bricks.size,
                 apart ? " apart" : "");
        struct bench_case *added = add_case(bench, name, scene, t, PEL_SKIP_BVH);
        if (!added)
            return false;
        added->bricks.size = report->bricks.size;
        added->bricks.apart = apart;
        added->depth[0] = report->depth;
        added->depth[1] = report->depth_apart;
        added->baseline = n > 0 ? first : -1;
    }
    return true;
}

// Blocks that are searched for each time, culled, walked, and both.
static bool add_blocks(struct bench *bench, struct pel_scene *scene, int t) {
    static const char *const names[] = {"searched", "searched, culled", "walked", "walked, culled"};
    if (!bench_wants_skip(bench, PEL_SKIP_BLOCKS, BENCH_ALL_WAYS))
        return true;
    int first = bench->case_count;
    for (int n = 0; n < 4; n++) {
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "task T%d, blocks %s", t + 1, names[n]);
        struct bench_case *added = add_case(bench, name, scene, t, PEL_SKIP_BLOCKS);
        if (!added)
            return false;
        added->bricks.stay = n < 2;
        added->bricks.keep = n % 2 == 0;
        added->baseline = n > 0 ? first : -1;
    }
    return true;
}

int bench_add_skip(struct bench *bench) {
    static const char *const names[VOLUMES] = {"task", "shells", "full"};
    int size = bench->options.largest < MOST ? bench->options.largest : MOST;
    struct pel_scene *task[TRANSFERS] = {NULL};
    bool good = true;
    for (int n = 0; good && n < VOLUMES; n++) {
        struct pel_volume *volume = make_volume(bench, n, size);
        good = volume != NULL;
        for (int t = 0; good && t < TRANSFERS; t++) {
            struct pel_scene *scene = make_scene(bench, volume, n, t);
            good = scene && add_ways(bench, scene, names[n], t);
            if (n == 0)
                task[t] = scene;
        }
    }
    for (int t = 0; good && t < TRANSFERS; t++)
        good = add_bricks(bench, task[t], t) && add_blocks(bench, task[t], t);
    return good ? PEL_OK : (int)PEL_ERROR_MEMORY;
}
