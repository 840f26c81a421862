// bench_suite.c - the suite `volumes`, and scenes of the user's own.
//
// `volumes` is the question Romero 2009 asked of his renderer: what do 1 to 32 buckyballs cost, in
// one place, each turned a little further, and side by side? His rays paid for every volume that
// was loaded. Here they should pay for those they meet: `overlapping` grows with the samples,
// `side by side` must not grow with the volumes.
#include <math.h>
#include <stdio.h>

#include "cli/bench.h"
#include "cli/options.h"
#include "cli/report.h"

enum { BALL_SIZE = 64, USUAL_WIDTH = 640, USUAL_HEIGHT = 480 };

bool bench_fit_camera(struct pel_scene *scene, int width, int height) {
    struct pel_bounds bounds;
    if (pel_scene_bounds(scene, &bounds) &&
        pel_camera_fit(&scene->camera, "anterior", &bounds, (double)width / height))
        return true;
    cli_fail_library();
    return false;
}

// Places instance k of `count` in a grid, as wide as it is high or twice that.
static void place_in_grid(struct pel_scene *scene, int k, int count, double pitch_mm) {
    int columns = 1;
    while (columns * columns < count)
        columns *= 2;
    scene->instances[k].transform.m[0][3] += pitch_mm * (k % columns);
    scene->instances[k].transform.m[2][3] += pitch_mm * (k / columns);
}

struct pel_scene *bench_ball_scene(struct bench *bench, struct pel_volume *const *balls, int count,
                                   bool side_by_side) {
    static const double degrees = 11;
    struct pel_scene *scene = bench_scene(bench, balls, count);
    if (!scene)
        return NULL;
    // The ball's centre, and how far apart two can turn without touching.
    struct pel_bounds bounds;
    pel_instance_bounds(scene, 0, &bounds);
    double centre[3], pitch_mm = 0;
    for (int axis = 0; axis < 3; axis++) {
        centre[axis] = (bounds.low[axis] + bounds.high[axis]) / 2;
        pitch_mm = fmax(pitch_mm, (bounds.high[axis] - bounds.low[axis]) * sqrt(2));
    }
    struct pel_statistics statistics;
    pel_volume_measure(balls[0], &statistics);
    for (int k = 0; k < count; k++) {
        scene->instances[k].transform = bench_rotation(degrees * k, centre);
        if (side_by_side)
            place_in_grid(scene, k, count, pitch_mm);
        struct pel_transfer *transfer = pel_transfer_preset("hot");
        if (!transfer) {
            cli_fail_library();
            return NULL;
        }
        pel_transfer_resolve(transfer, &statistics);
        // Thin enough for rays to meet many volumes before they end.
        transfer->opacity_unit_mm = (bounds.high[0] - bounds.low[0]) / 2;
        scene->instances[k].transfer = transfer;
    }
    scene->render.mixing = PEL_MIX_SUM;
    return scene;
}

// Makes the first volume an opaque block, so large that the others turn within it.
static void make_opaque(struct pel_scene *scene) {
    static const double growth = 1.5;
    struct pel_instance *first = &scene->instances[0];
    struct pel_bounds bounds;
    pel_instance_bounds(scene, 0, &bounds);
    for (int axis = 0; axis < 3; axis++) {
        double centre = (bounds.low[axis] + bounds.high[axis]) / 2;
        first->transform.m[axis][axis] = growth;
        first->transform.m[axis][3] = (1 - growth) * centre;
    }
    for (int i = 0; i < first->transfer->opacity_count; i++)
        first->transfer->opacities[i].opacity = 1;
}

static bool add_balls(struct bench *bench, struct pel_volume *const *balls, int count,
                      bool side_by_side, bool opaque, int baseline) {
    struct bench_case *added = bench_add(bench, "volumes",
                                         opaque         ? "behind an opaque one"
                                         : side_by_side ? "side by side"
                                                        : "overlapping");
    if (!added)
        return false;
    added->width = bench->options.width ? bench->options.width : USUAL_WIDTH;
    added->height = bench->options.width ? bench->options.height : USUAL_HEIGHT;
    added->volumes = count;
    added->baseline = count > 1 ? baseline : -1;
    added->scene = bench_ball_scene(bench, balls, count, side_by_side);
    if (opaque && added->scene)
        make_opaque(added->scene);
    return added->scene && bench_fit_camera(added->scene, added->width, added->height);
}

int bench_add_volumes(struct bench *bench) {
    struct pel_volume *balls[PEL_VOLUME_MAX];
    balls[0] = pel_volume_generate("c60", &(struct pel_generate_options){.size = BALL_SIZE});
    if (!balls[0])
        return cli_fail_library();
    bool good = bench_keep_volume(bench, balls[0]);
    for (int k = 1; good && k < PEL_VOLUME_MAX; k++)
        good = (balls[k] = bench_copy_volume(bench, balls[0])) != NULL;
    int first = bench->case_count;
    for (int count = 1; good && count <= PEL_VOLUME_MAX; count *= 2)
        good = add_balls(bench, balls, count, false, false, first);
    for (int count = 2; good && count <= PEL_VOLUME_MAX; count *= 2)
        good = add_balls(bench, balls, count, true, false, first);
    for (int count = 1; good && count <= PEL_VOLUME_MAX; count *= 2)
        good = add_balls(bench, balls, count, false, true, first + 11);
    return good ? PEL_OK : (int)PEL_ERROR_MEMORY;
}

// A case of a scene, as it is or skipping in one way.
static bool add_scene(struct bench *bench, const char *path, struct pel_scene *scene,
                      enum pel_skip skip, int first) {
    struct bench_case *added = bench_add(bench, "scene", path);
    if (!added)
        return false;
    added->scene = scene;
    added->width = bench->options.width ? bench->options.width : scene->render.width;
    added->height = bench->options.width ? bench->options.height : scene->render.height;
    added->volumes = scene->instance_count;
    if (bench->options.skips == 0)
        return true;
    bench_set_skip(added, skip);
    snprintf(added->name, sizeof added->name, "%s, %s", path, report_skip(skip));
    added->baseline = bench->case_count - 1 > first ? first : -1;
    return true;
}

int bench_add_scene_file(struct bench *bench, const char *path) {
    struct pel_scene *scene = cli_is_scene(path) ? pel_scene_load(path, NULL, 0)
                                                 : pel_scene_from_files(&path, 1, NULL, 0);
    if (!scene)
        return cli_fail_library();
    if (!bench_keep_scene(bench, scene))
        return (int)PEL_ERROR_MEMORY;
    int first = bench->case_count;
    for (int n = 0; n < BENCH_WAYS; n++) {
        enum pel_skip skip = bench_way(n);
        bool wanted = bench->options.skips ? bench_wants_skip(bench, skip, 0) : n == 0;
        if (wanted && !add_scene(bench, path, scene, skip, first))
            return (int)PEL_ERROR_MEMORY;
    }
    return PEL_OK;
}
