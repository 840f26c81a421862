// hierarchy.h - from the active bricks of each part to the clusters and the hierarchy that
// kernels/traverse/bvh.cl reads.
#ifndef PEL_RENDER_HIERARCHY_H
#define PEL_RENDER_HIERARCHY_H

#include "device/device.h"
#include "world/world.h"

// Zero-initialise.
struct pel_hierarchy {
    struct pel_buffer *nodes; // where each part's nodes begin, and the nodes
    struct pel_brick_statistics statistics;
};

// Bricks along x, y and z over the cells of a part, for bricks of `size` voxels, and how many.
size_t pel_hierarchy_bricks(const struct pel_world *world, int p, int size, size_t dims[3]);

// Makes the hierarchy of each part anew and sends it. The bricks of part p begin at
// active[parts[p].cells]; those that are active are not 0. False: DEVICE, MEMORY.
bool pel_hierarchy_build(struct pel_hierarchy *hierarchy, struct pel_device *device,
                         const struct pel_world *world, const uint8_t *active,
                         const struct pel_brick_settings *settings);
void pel_hierarchy_finish(struct pel_hierarchy *hierarchy);

#endif
