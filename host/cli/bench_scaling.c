// bench_scaling.c - the suite `scaling`: how time grows with what there is to do, and falls with
// who does it.
//
// One measure changes at a time: compute units of the device, as a part of it; pixels; voxels; and
// volumes, in one place and side by side. Empty space is skipped as `auto` would.
#include <stdio.h>
#include <unistd.h>

#include "cli/bench.h"
#include "cli/options.h"

enum { BALL_SIZE = 64, SMALLEST = 64, MIDDLE = 128, USUAL_WIDTH = 640, USUAL_HEIGHT = 480 };

// What all cases of one measure have in common.
struct scaling {
    struct bench *bench;
    int width, height;
    int first; // case of the present measure
};

static struct bench_case *add_case(struct scaling *scaling, const char *name,
                                   struct pel_scene *scene) {
    struct bench *bench = scaling->bench;
    struct bench_case *added = scene ? bench_add(bench, "scaling", name) : NULL;
    if (!added)
        return NULL;
    int index = bench->case_count - 1;
    added->scene = scene;
    added->volumes = scene->instance_count;
    added->width = scaling->width;
    added->height = scaling->height;
    bench_set_skip(added, PEL_SKIP_AUTO);
    added->baseline = index > scaling->first ? scaling->first : -1;
    return bench_fit_camera(scene, added->width, added->height) ? added : NULL;
}

static struct pel_scene *scene_of(struct scaling *scaling, struct pel_volume *const *volumes,
                                  int count, bool side_by_side) {
    struct pel_scene *scene = bench_ball_scene(scaling->bench, volumes, count, side_by_side);
    for (int k = 0; scene && k < count; k++)
        pel_volume_measure(volumes[k], &scene->statistics[k]);
    return scene;
}

static struct pel_volume *make_ball(struct scaling *scaling, int size) {
    struct pel_volume *ball =
        pel_volume_generate("c60", &(struct pel_generate_options){.size = size});
    if (!ball) {
        cli_fail_library();
        return NULL;
    }
    return bench_keep_volume(scaling->bench, ball) ? ball : NULL;
}

// From one to all compute units; a device that cannot be divided leaves all but the last out.
static bool add_threads(struct scaling *scaling, struct pel_volume *ball) {
    int chosen = scaling->bench->options.renderer.compute_units;
    int all = chosen ? chosen : (int)sysconf(_SC_NPROCESSORS_ONLN);
    scaling->first = scaling->bench->case_count;
    for (int units = 1; units <= all; units = units < all && 2 * units > all ? all : 2 * units) {
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "%d compute unit%s", units, units > 1 ? "s" : "");
        struct bench_case *added = add_case(scaling, name, scene_of(scaling, &ball, 1, false));
        if (!added)
            return false;
        added->compute_units = units;
        added->optional = true;
    }
    return true;
}

// A quarter of the picture's sides to double.
static bool add_pixels(struct scaling *scaling, struct pel_volume *ball) {
    scaling->first = scaling->bench->case_count;
    for (int eighths = 2; eighths <= 16; eighths *= 2) {
        char name[BENCH_NAME_BYTES];
        int width = scaling->width * eighths / 8, height = scaling->height * eighths / 8;
        snprintf(name, sizeof name, "%dx%d pixels", width, height);
        struct bench_case *added = add_case(scaling, name, scene_of(scaling, &ball, 1, false));
        if (!added)
            return false;
        added->width = width > 0 ? width : 1;
        added->height = height > 0 ? height : 1;
    }
    return true;
}

// As many voxels as --largest and the device take.
static bool add_voxels(struct scaling *scaling) {
    scaling->first = scaling->bench->case_count;
    for (int size = SMALLEST; size <= scaling->bench->options.largest || size == SMALLEST;
         size *= 2) {
        char name[BENCH_NAME_BYTES];
        int side = size < scaling->bench->options.largest ? size : scaling->bench->options.largest;
        snprintf(name, sizeof name, "%d^3 voxels", side);
        struct pel_volume *ball = make_ball(scaling, side);
        struct bench_case *added =
            ball ? add_case(scaling, name, scene_of(scaling, &ball, 1, false)) : NULL;
        if (!added)
            return false;
        added->optional = true;
    }
    return true;
}

static bool add_volumes(struct scaling *scaling, struct pel_volume *const *balls,
                        bool side_by_side) {
    scaling->first = scaling->bench->case_count;
    for (int count = 1; count <= PEL_VOLUME_MAX; count *= 2)
        if (!add_case(scaling, side_by_side ? "apart" : "overlapping",
                      scene_of(scaling, balls, count, side_by_side)))
            return false;
    return true;
}

int bench_add_scaling(struct bench *bench) {
    int largest = bench->options.largest;
    struct scaling scaling = {.bench = bench,
                              .width = bench->options.width ? bench->options.width : USUAL_WIDTH,
                              .height =
                                  bench->options.width ? bench->options.height : USUAL_HEIGHT};
    struct pel_volume *balls[PEL_VOLUME_MAX];
    struct pel_volume *middle = make_ball(&scaling, largest < MIDDLE ? largest : MIDDLE);
    balls[0] = make_ball(&scaling, largest < BALL_SIZE ? largest : BALL_SIZE);
    bool good = middle && balls[0];
    for (int k = 1; good && k < PEL_VOLUME_MAX; k++)
        good = (balls[k] = bench_copy_volume(bench, balls[0])) != NULL;
    good = good && add_threads(&scaling, middle) && add_pixels(&scaling, middle) &&
           add_voxels(&scaling) && add_volumes(&scaling, balls, false) &&
           add_volumes(&scaling, balls, true);
    return good ? PEL_OK : (int)PEL_ERROR_MEMORY;
}
