// hierarchy.c - clusters of active bricks, and a hierarchy over those of each part, on the device.
//
//     i32 starts[WORLD_PART_MAX]   number of the part's first node, -1 where nothing is active
//     struct bvh_node nodes[]      one part after the other, with links from its own first node on
#include "render/hierarchy.h"

#include <stdlib.h>
#include <string.h>

#include "accel/bvh.h"
#include "accel/cluster.h"
#include "base/error.h"
#include "base/memory.h"
#include "world/bricks.h"

// All parts' nodes so far.
struct nodes {
    struct bvh_node *list; // owned
    size_t count;
};

size_t pel_hierarchy_bricks(const struct pel_world *world, int p, int size, size_t dims[3]) {
    size_t cells[3], count = 1, across = (size_t)(size / world->cell_side);
    pel_world_cells(world, p, cells);
    for (int i = 0; i < 3; i++) {
        dims[i] = (cells[i] + across - 1) / across;
        count *= dims[i];
    }
    return count;
}

// Appends the hierarchy over the clusters of one part.
static bool add_part(struct nodes *nodes, const struct pel_clusters *clusters, int brick_size) {
    size_t room = 2 * clusters->count - 1;
    struct bvh_node *list = realloc(nodes->list, (nodes->count + room) * sizeof *list);
    if (!list)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu nodes", nodes->count + room);
    nodes->list = list;
    if (!pel_bricks_build(list + nodes->count, clusters, brick_size))
        return false;
    nodes->count += room;
    return true;
}

static bool build_parts(struct pel_hierarchy *hierarchy, const struct pel_world *world,
                        const uint8_t *active, const struct pel_brick_settings *settings,
                        i32 *starts, struct nodes *nodes) {
    struct pel_brick_statistics *statistics = &hierarchy->statistics;
    for (int p = 0; p < world->bytes.part_count; p++) {
        size_t dims[3];
        const uint8_t *bricks = active + world->bytes.parts[p].cells;
        size_t count = pel_hierarchy_bricks(world, p, settings->size, dims);
        struct pel_clusters clusters;
        double start = pel_clock_ms();
        if (!pel_clusters_find(&clusters, bricks, dims, settings->apart ? 1 : PEL_CLUSTER_LARGEST))
            return false;
        double clustered = pel_clock_ms();
        for (size_t i = 0; i < count; i++)
            statistics->active += bricks[i] != 0;
        statistics->total += count;
        statistics->clusters += clusters.count;
        starts[p] = clusters.count > 0 ? (i32)nodes->count : -1;
        bool good = clusters.count == 0 || add_part(nodes, &clusters, settings->size);
        pel_clusters_finish(&clusters);
        if (!good)
            return false;
        statistics->cluster_ms += clustered - start;
        statistics->tree_ms += pel_clock_ms() - clustered;
    }
    return true;
}

bool pel_hierarchy_build(struct pel_hierarchy *hierarchy, struct pel_device *device,
                         const struct pel_world *world, const uint8_t *active,
                         const struct pel_brick_settings *settings) {
    hierarchy->statistics = (struct pel_brick_statistics){
        .size = settings->size, .resident = hierarchy->statistics.resident};
    i32 starts[WORLD_PART_MAX] = {0};
    struct nodes nodes = {NULL, 0};
    bool good = build_parts(hierarchy, world, active, settings, starts, &nodes);
    size_t bytes = nodes.count * sizeof *nodes.list;
    if (good)
        hierarchy->nodes = pel_buffer_create(device, sizeof starts + bytes, "hierarchies");
    good = good && hierarchy->nodes &&
           pel_buffer_write(hierarchy->nodes, 0, sizeof starts, starts) &&
           pel_buffer_write(hierarchy->nodes, sizeof starts, bytes, nodes.list);
    free(nodes.list);
    if (!good)
        pel_hierarchy_finish(hierarchy);
    return good;
}

void pel_hierarchy_finish(struct pel_hierarchy *hierarchy) {
    pel_buffer_destroy(hierarchy->nodes);
    memset(hierarchy, 0, sizeof *hierarchy);
}
