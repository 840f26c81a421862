// bricks.c - bricks of a volume, and the hierarchy over their clusters.
#include "world/bricks.h"

#include <stdlib.h>

#include "base/error.h"
#include "base/memory.h"

struct pel_brick_settings pel_bricks_resolve(const struct pel_brick_settings *settings,
                                             enum pel_skip skip) {
    struct pel_brick_settings resolved = *settings;
    if (resolved.size == 0)
        resolved.size = skip == PEL_SKIP_BLOCKS ? PEL_SUB_BLOCK_SIZE : PEL_BRICK_SIZE;
    return resolved;
}

bool pel_bricks_check(const struct pel_brick_settings *settings) {
    int size = settings->size;
    if (size == 0 || (size >= 8 && size <= 128 && (size & (size - 1)) == 0))
        return true;
    return pel_fail(PEL_ERROR_ARGUMENT, "bricks of %d voxels, must be 8, 16, 32, 64 or 128", size);
}

bool pel_bricks_build(struct bvh_node *nodes, const struct pel_clusters *clusters, int brick_size) {
    struct pel_box *boxes = pel_allocate(clusters->count, sizeof *boxes);
    if (!boxes)
        return false;
    for (size_t n = 0; n < clusters->count; n++) {
        const struct pel_cluster *cluster = &clusters->list[n];
        for (int c = 0; c < 3; c++) {
            size_t low = (size_t)cluster->low[c] * (size_t)brick_size;
            boxes[n].low[c] = (float)low;
            boxes[n].high[c] = (float)(low + (size_t)cluster->size * (size_t)brick_size);
        }
    }
    bool good = pel_bvh_build(nodes, boxes, clusters->count);
    free(boxes);
    return good;
}
