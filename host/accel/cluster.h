// cluster.h - active bricks of a volume, joined to few boxes.
#ifndef PEL_ACCEL_CLUSTER_H
#define PEL_ACCEL_CLUSTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A cube of bricks: low <= brick < low + size along each axis.
struct pel_cluster {
    uint32_t low[3], size;
};

struct pel_clusters {
    struct pel_cluster *list; // owned
    size_t count;
};

// Covers the bricks that are active (not 0), x fastest, with cubes of at most `largest` bricks a
// side that do not overlap and hold no other brick. With `largest` 1 each active brick is a
// cluster. False: MEMORY.
bool pel_clusters_find(struct pel_clusters *clusters, const uint8_t *active, const size_t dims[3],
                       uint32_t largest);
void pel_clusters_finish(struct pel_clusters *clusters);

#endif
