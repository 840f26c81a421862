// bench_changes.c - the suite `changes`: what is sent and derived when somebody works with a scene.
//
// In each turn a frame is rendered, something changes, and the frame that shows it counts: the
// camera moves, a colour, an opacity or what can be seen at all is edited, a volume turns, or is
// cut. The volume is the task's with T2, each way to skip with the same changes.
#include <stdio.h>

#include "cli/bench.h"
#include "cli/options.h"
#include "cli/report.h"

enum { USUAL_WIDTH = 640, USUAL_HEIGHT = 480 };

// Turn by turn back and forth, so that no two frames in a row are of the same scene.
static double swing(int turn, double size) {
    return turn % 2 ? size : -size;
}

static void move_camera(struct pel_scene *scene, int turn) {
    scene->camera.eye[0] += swing(turn, 7);
}

static void edit_colour(struct pel_scene *scene, int turn) {
    scene->instances[0].transfer->colours[1].rgb[0] = turn % 2 ? 0.8 : 0.3;
}

static void edit_opacity(struct pel_scene *scene, int turn) {
    scene->instances[0].transfer->opacities[1].opacity = turn % 2 ? 0.9 : 0.7;
}

// The first point is where anything begins to show.
static void edit_threshold(struct pel_scene *scene, int turn) {
    scene->instances[0].transfer->opacities[0].value = turn % 2 ? 89 : 70;
}

static void turn_volume(struct pel_scene *scene, int turn) {
    scene->instances[0].transform = bench_rotation(turn % 2 ? 11 : 23, (double[3]){0, 0, 0});
}

static void cut_volume(struct pel_scene *scene, int turn) {
    scene->instances[0].clip_count = 1;
    scene->instances[0].clips[0] =
        (struct pel_clip){.normal = {1, 0, 0}, .point = {turn % 2 ? 20 : 30, 0, 0}};
}

static const struct {
    const char *name;
    void (*change)(struct pel_scene *scene, int turn);
} changes[] = {
    {"nothing", NULL},
    {"camera", move_camera},
    {"colour", edit_colour},
    {"opacity", edit_opacity},
    {"what is visible", edit_threshold},
    {"pose", turn_volume},
    {"clip", cut_volume},
};

static bool add_changes(struct bench *bench, struct pel_volume *volume, enum pel_skip skip) {
    int first = bench->case_count;
    for (size_t n = 0; n < sizeof changes / sizeof *changes; n++) {
        char name[BENCH_NAME_BYTES];
        snprintf(name, sizeof name, "%s, %s", report_skip(skip), changes[n].name);
        struct bench_case *added = bench_add(bench, "changes", name);
        struct pel_scene *scene = added ? bench_scene(bench, &volume, 1) : NULL;
        if (!scene || !(scene->instances[0].transfer = bench_task_transfer(1)))
            return false;
        pel_volume_measure(volume, &scene->statistics[0]);
        added->scene = scene;
        added->width = bench->options.width ? bench->options.width : USUAL_WIDTH;
        added->height = bench->options.width ? bench->options.height : USUAL_HEIGHT;
        if (!bench_fit_camera(scene, added->width, added->height))
            return false;
        snprintf(added->transfer, sizeof added->transfer, "T2");
        bench_set_skip(added, skip);
        added->detail = BENCH_CHANGING;
        added->change = changes[n].change;
        added->baseline = n > 0 ? first : -1;
    }
    return true;
}

int bench_add_changes(struct bench *bench) {
    static const unsigned own = 1U << PEL_SKIP_DISTANCE | 1U << PEL_SKIP_OCTREE |
                                1U << PEL_SKIP_BVH | 1U << PEL_SKIP_BLOCKS;
    struct pel_volume *volume = bench_task_volume(bench->options.largest);
    bool good = volume && bench_keep_volume(bench, volume);
    for (int n = 0; good && n < BENCH_WAYS; n++)
        if (bench_wants_skip(bench, bench_way(n), own))
            good = add_changes(bench, volume, bench_way(n));
    return good ? PEL_OK : (int)PEL_ERROR_MEMORY;
}
