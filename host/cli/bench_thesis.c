// bench_thesis.c - the suite `thesis`: what tables 6.1 to 6.11 of Romero 2009 measured, on this
// device.
//
// Each case stands for a row of his tables, with the frames per second that he reports of a GeForce
// GTX 260 beside ours. As there: 640 x 480, back to front without termination, linear, one ray a
// pixel, unless the table says otherwise, and nothing is skipped. His six volumes are not all to be
// had, so hypertextures and buckyballs made here stand in. Table 6.2 limits registers, for which
// OpenCL has no means; the suite `workgroup` shows what the device says of each kernel.
#include <stdio.h>

#include "cli/bench.h"
#include "cli/options.h"

enum { USUAL_WIDTH = 640, USUAL_HEIGHT = 480, BALL_SIZE = 32, SMALLEST = 16 };

struct thesis {
    struct bench *bench;
    struct pel_renderer *baker;
    struct pel_volume *balls[PEL_VOLUME_MAX], *sphere;
    int first; // case of the present table
};

// ---- Volumes -----------------------------------------------------------------------------------

static struct pel_volume *generate(struct thesis *thesis, const char *kind, int size) {
    struct pel_volume *volume =
        pel_volume_generate(kind, &(struct pel_generate_options){.size = size});
    if (!volume)
        cli_fail_library();
    return volume && bench_keep_volume(thesis->bench, volume) ? volume : NULL;
}

static struct pel_volume *bake(struct thesis *thesis, int size) {
    const struct pel_bake_options options = {.size = size};
    struct pel_volume *volume = pel_renderer_bake(thesis->baker, "noisy-sphere", &options);
    if (!volume)
        cli_fail_library();
    return volume && bench_keep_volume(thesis->bench, volume) ? volume : NULL;
}

static bool make_volumes(struct thesis *thesis) {
    thesis->balls[0] = generate(thesis, "c60", BALL_SIZE);
    thesis->sphere = generate(thesis, "sphere", 2 * BALL_SIZE);
    if (!thesis->balls[0] || !thesis->sphere)
        return false;
    for (int k = 1; k < PEL_VOLUME_MAX; k++) {
        thesis->balls[k] = bench_copy_volume(thesis->bench, thesis->balls[0]);
        if (!thesis->balls[k])
            return false;
    }
    return true;
}

// ---- Cases -------------------------------------------------------------------------------------

static struct pel_scene *scene_of(struct thesis *thesis, struct pel_volume *const *volumes,
                                  int count, bool side_by_side) {
    struct pel_scene *scene = bench_ball_scene(thesis->bench, volumes, count, side_by_side);
    if (!scene)
        return NULL;
    scene->render.order = PEL_ORDER_BACK_TO_FRONT;
    scene->render.termination = 1;
    return scene;
}

// A row of a table, which the caller may still change; NULL after a message. The first row of a
// table is what the others are compared with.
static struct bench_case *add_row(struct thesis *thesis, const char *name, double published_fps,
                                  struct pel_scene *scene) {
    struct bench *bench = thesis->bench;
    struct bench_case *added = scene ? bench_add(bench, "thesis", name) : NULL;
    if (!added)
        return NULL;
    added->scene = scene;
    added->width = bench->options.width ? bench->options.width : USUAL_WIDTH;
    added->height = bench->options.width ? bench->options.height : USUAL_HEIGHT;
    added->volumes = scene->instance_count;
    added->published_fps = published_fps;
    int index = bench->case_count - 1;
    added->baseline = index > thesis->first ? thesis->first : -1;
    return bench_fit_camera(scene, added->width, added->height) ? added : NULL;
}

static void begin_table(struct thesis *thesis) {
    thesis->first = thesis->bench->case_count;
}

static bool add_sequential(struct thesis *thesis) {
    begin_table(thesis);
    struct pel_scene *scene = scene_of(thesis, thesis->balls, 1, false);
    struct bench_case *one = add_row(thesis, "6.1 sequential", 1.5, scene);
    if (!one)
        return false;
    one->kind = BENCH_SEQUENTIAL;
    return add_row(thesis, "6.1 kernels", 59.3, scene) != NULL;
}

static bool add_groups(struct thesis *thesis) {
    static const struct {
        int group;
        double fps;
    } rows[] = {{32, 51.2}, {64, 59.8}, {128, 59.9}};
    begin_table(thesis);
    struct pel_scene *scene = scene_of(thesis, thesis->balls, 1, false);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "6.3 %d threads a block", rows[i].group);
        struct bench_case *one = add_row(thesis, name, rows[i].fps, scene);
        if (!one)
            return false;
        one->work_group = rows[i].group;
    }
    return true;
}

static bool add_filters(struct thesis *thesis) {
    begin_table(thesis);
    struct pel_scene *point = scene_of(thesis, thesis->balls, 1, false);
    if (point)
        point->instances[0].filter = PEL_FILTER_NEAREST;
    return add_row(thesis, "6.4 point", 59.7, point) &&
           add_row(thesis, "6.4 linear", 59.8, scene_of(thesis, thesis->balls, 1, false));
}

// His sphere is dense, his buckyball is not.
static bool add_termination(struct thesis *thesis, bool dense) {
    static const struct {
        const char *name;
        enum pel_order order;
        double threshold, fps[2];
    } rows[] = {
        {"back to front", PEL_ORDER_BACK_TO_FRONT, 1, {59.9, 54.6}},
        {"front to back", PEL_ORDER_FRONT_TO_BACK, 1, {59.9, 59.9}},
        {"front to back, 0.95", PEL_ORDER_FRONT_TO_BACK, 0.95, {60.1, 61.3}},
        {"front to back, 0.9", PEL_ORDER_FRONT_TO_BACK, 0.9, {60.4, 60.8}},
        {"front to back, 0.85", PEL_ORDER_FRONT_TO_BACK, 0.85, {61.2, 61.7}},
        {"front to back, 0.8", PEL_ORDER_FRONT_TO_BACK, 0.8, {60.1, 60.6}},
    };
    begin_table(thesis);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct pel_scene *scene =
            scene_of(thesis, dense ? &thesis->sphere : thesis->balls, 1, false);
        if (!scene)
            return false;
        scene->render.order = rows[i].order;
        scene->render.termination = rows[i].threshold;
        scene->instances[0].density = dense ? 50 : 1;
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "6.%d %s", dense ? 6 : 5, rows[i].name);
        if (!add_row(thesis, name, rows[i].fps[dense], scene))
            return false;
    }
    return true;
}

static bool add_supersampling(struct thesis *thesis) {
    static const double fps[] = {59.9, 28.1, 9.5};
    begin_table(thesis);
    for (int n = 1, i = 0; n <= 4; n *= 2, i++) {
        struct pel_scene *scene = scene_of(thesis, thesis->balls, 1, false);
        if (!scene)
            return false;
        scene->render.supersampling.n = n;
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "6.7 supersampling %dx", n * n);
        if (!add_row(thesis, name, fps[i], scene))
            return false;
    }
    return true;
}

static bool add_sizes(struct thesis *thesis) {
    static const double fps[] = {59.9, 58.1, 55.6, 48.5, 46.5, 36.4};
    begin_table(thesis);
    int size = SMALLEST;
    for (size_t i = 0; i < sizeof fps / sizeof *fps && size <= thesis->bench->options.largest;
         i++, size *= 2) {
        struct pel_volume *volume = bake(thesis, size);
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "6.8 %dx%dx%d voxels", size, size, size);
        if (!volume || !add_row(thesis, name, fps[i], scene_of(thesis, &volume, 1, false)))
            return false;
    }
    return true;
}

static bool add_numbers(struct thesis *thesis, bool side_by_side) {
    static const double fps[2][6] = {{59.9, 43.3, 29.4, 16.4, 7.7, 3.4},
                                     {61.5, 61.3, 61.0, 60.2, 47.8, 30.2}};
    begin_table(thesis);
    for (int count = 1, i = 0; count <= PEL_VOLUME_MAX; count *= 2, i++) {
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "6.%d %d %s", side_by_side ? 10 : 9, count,
                 side_by_side ? "side by side" : "overlapping");
        if (!add_row(thesis, name, fps[side_by_side][i],
                     scene_of(thesis, thesis->balls, count, side_by_side)))
            return false;
    }
    return true;
}

static bool add_anaglyph(struct thesis *thesis) {
    begin_table(thesis);
    struct pel_scene *scene = scene_of(thesis, &thesis->sphere, 1, false);
    struct pel_scene *both = scene_of(thesis, &thesis->sphere, 1, false);
    if (both)
        both->stereo.kind = PEL_STEREO_THESIS;
    return add_row(thesis, "6.11 normal", 41.5, scene) &&
           add_row(thesis, "6.11 anaglyph", 30.2, both);
}

int bench_add_thesis(struct bench *bench) {
    struct thesis thesis = {.bench = bench, .baker = pel_renderer_create(&bench->options.renderer)};
    if (!thesis.baker)
        return cli_fail_library();
    bool good = make_volumes(&thesis) && add_sequential(&thesis) && add_groups(&thesis) &&
                add_filters(&thesis) && add_termination(&thesis, false) &&
                add_termination(&thesis, true) && add_supersampling(&thesis) &&
                add_sizes(&thesis) && add_numbers(&thesis, false) && add_numbers(&thesis, true) &&
                add_anaglyph(&thesis);
    pel_renderer_destroy(thesis.baker);
    return good ? PEL_OK : (int)PEL_ERROR_MEMORY;
}
