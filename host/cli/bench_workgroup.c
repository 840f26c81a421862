// bench_workgroup.c - the suite `workgroup`: how a picture is best handed out.
//
// Romero 2009 (sections 5.2, 5.3, 6.2, 6.3) swept the threads of a block and the registers of a
// thread. Here a work-item follows 1, 4, 8 or 16 rays, and a work-group is 1 to 64 work-items, side
// by side or in 2 or 4 rows. What the device says of each kernel (work-items that it bears and
// likes, private memory) stands beside the times; OpenCL has no way to limit registers.
#include <stdio.h>

#include "cli/bench.h"
#include "cli/options.h"

enum { SIZE = 128, USUAL_WIDTH = 640, USUAL_HEIGHT = 480 };

static const int all_lanes[] = {16, 8, 4, 1};
static const int groups[] = {1, 2, 4, 8, 16, 32, 64};
static const int rows[] = {1, 2, 4};

static struct pel_scene *make_scene(struct bench *bench) {
    struct pel_volume *ball =
        pel_volume_generate("c60", &(struct pel_generate_options){.size = SIZE});
    if (!ball) {
        cli_fail_library();
        return NULL;
    }
    struct pel_scene *scene = bench_keep_volume(bench, ball) ? bench_scene(bench, &ball, 1) : NULL;
    if (!scene)
        return NULL;
    struct pel_statistics statistics;
    pel_volume_measure(ball, &statistics);
    struct pel_transfer *transfer = pel_transfer_preset("rainbow");
    struct pel_bounds bounds;
    if (!transfer || !pel_scene_bounds(scene, &bounds) ||
        !pel_camera_fit(&scene->camera, "oblique", &bounds, (double)USUAL_WIDTH / USUAL_HEIGHT)) {
        pel_transfer_destroy(transfer);
        cli_fail_library();
        return NULL;
    }
    pel_transfer_resolve(transfer, &statistics);
    transfer->opacity_unit_mm = (bounds.high[0] - bounds.low[0]) / 4;
    scene->instances[0].transfer = transfer;
    return scene;
}

// --lanes and --work-group narrow the sweep.
static bool is_wanted(int chosen, int value) {
    return chosen == 0 || chosen == value;
}

int bench_add_workgroup(struct bench *bench) {
    const struct pel_renderer_options *chosen = &bench->options.renderer;
    struct pel_scene *scene = make_scene(bench);
    int first = bench->case_count;
    for (size_t l = 0; scene && l < sizeof all_lanes / sizeof *all_lanes; l++)
        for (size_t g = 0; g < sizeof groups / sizeof *groups; g++)
            for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
                // A group has whole columns.
                if (groups[g] < rows[r] || !is_wanted(chosen->lanes, all_lanes[l]) ||
                    !is_wanted(chosen->work_group, groups[g]))
                    continue;
                char name[BENCH_NAME_BYTES];
                snprintf(name, sizeof name, "%d work-items in %d row%s", groups[g], rows[r],
                         rows[r] > 1 ? "s" : "");
                struct bench_case *added = bench_add(bench, "workgroup", name);
                if (!added)
                    return (int)PEL_ERROR_MEMORY;
                added->scene = scene;
                added->width = bench->options.width ? bench->options.width : USUAL_WIDTH;
                added->height = bench->options.width ? bench->options.height : USUAL_HEIGHT;
                added->lanes = all_lanes[l];
                added->work_group = groups[g];
                added->work_group_rows = rows[r];
                added->baseline = bench->case_count - 1 > first ? first : -1;
            }
    return scene ? PEL_OK : (int)PEL_ERROR_MEMORY;
}
