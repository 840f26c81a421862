// describe_bricks.c - what `pellucid info --bricks` says about one volume: how many bricks of each
// size there are, how many are active, and to how few clusters they join (Ganter & Manzke 2019).
#include "cli/describe.h"

#include <stdio.h>

#include "cli/options.h"
#include "cli/report.h"

static double share(uint64_t part, uint64_t whole) {
    return whole > 0 ? 100.0 * (double)part / (double)whole : 0;
}

int describe_bricks(const struct pel_scene *scene, int instance, int indent) {
    struct pel_brick_report reports[PEL_BRICK_SIZES];
    if (!pel_scene_measure_bricks(scene, instance, reports))
        return cli_fail_library();
    printf("%*s%-12s %4s %10s %10s %7s %9s %9s %7s %9s %8s %7s %7s\n", indent, "", "bricks", "size",
           "total", "active", "%", "ms", "clusters", "%", "ms", "tree ms", "depth", "apart");
    for (int i = 0; i < PEL_BRICK_SIZES; i++) {
        const struct pel_brick_statistics *bricks = &reports[i].bricks;
        printf("%*s%-12s %4d %10llu %10llu %7.2f %9.2f %9llu %7.2f %9.2f %8.2f %7.2f %7.2f\n",
               indent, "", "", bricks->size, (unsigned long long)bricks->total,
               (unsigned long long)bricks->active, share(bricks->active, bricks->total),
               bricks->activity_ms, (unsigned long long)bricks->clusters,
               share(bricks->clusters, bricks->active), bricks->cluster_ms, bricks->tree_ms,
               reports[i].depth, reports[i].depth_apart);
    }
    return PEL_OK;
}

json_t *describe_bricks_json(const struct pel_scene *scene, int instance) {
    struct pel_brick_report reports[PEL_BRICK_SIZES];
    if (!pel_scene_measure_bricks(scene, instance, reports))
        return NULL;
    json_t *array = json_array();
    for (int i = 0; i < PEL_BRICK_SIZES; i++) {
        const struct pel_brick_statistics *bricks = &reports[i].bricks;
        json_t *object = json_object();
        json_object_set_new(object, "size", json_integer(bricks->size));
        json_object_set_new(object, "total", json_integer((json_int_t)bricks->total));
        json_object_set_new(object, "active", json_integer((json_int_t)bricks->active));
        json_object_set_new(object, "clusters", json_integer((json_int_t)bricks->clusters));
        json_object_set_new(object, "activity_ms", report_number(bricks->activity_ms));
        json_object_set_new(object, "cluster_ms", report_number(bricks->cluster_ms));
        json_object_set_new(object, "tree_ms", report_number(bricks->tree_ms));
        json_object_set_new(object, "depth", report_number(reports[i].depth));
        json_object_set_new(object, "depth_apart", report_number(reports[i].depth_apart));
        json_array_append_new(array, object);
    }
    return array;
}
