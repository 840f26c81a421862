// residency.h - a scene's voxels on the device, kept from frame to frame.
#ifndef PEL_RENDER_RESIDENCY_H
#define PEL_RENDER_RESIDENCY_H

#include "device/device.h"
#include "render/live.h"
#include "render/pool.h"
#include "world/layout.h"

struct pel_residency {
    struct pel_device *device; // borrowed
    struct pel_layout layout;
    struct pel_buffer *buffers[VOXEL_BUFFERS];
    struct pel_texture *atlases[VOXEL_CLASS_COUNT];
    struct pel_live live;
    bool has_live;             // this frame
    struct pel_buffer *ranges; // two floats for each cell of each slab
    struct pel_pool pool;      // with a pool, which then has the voxels
};

// What the device can hold; `max_allocation_bytes` lowers its own limit unless 0.
struct pel_layout_limits pel_residency_limits(const struct pel_device *device,
                                              uint64_t max_allocation_bytes);

// Refuses (DEVICE) a frame whose voxels and picture together do not fit, before anything is
// allocated. `frame_bytes` are those of the picture.
bool pel_residency_check(const struct pel_layout *layout, const struct pel_layout_limits *limits,
                         uint64_t frame_bytes);

// Brings the scene's volumes to where `layout` puts them, and recipes that are worked out at every
// sample beside them. Nothing is sent when they lie there already. On failure (DEVICE, MEMORY)
// nothing stays on the device.
bool pel_residency_update(struct pel_residency *residency, const struct pel_scene *scene,
                          const struct pel_layout *layout, const struct pel_world *world);

// Gives a kernel its MEMORY_PARAMETERS from parameter `index` on. `voxels` are the classes
// (VOXELS_*) it was built for.
bool pel_residency_bind(const struct pel_residency *residency, struct pel_kernel *kernel, int index,
                        int voxels);

// With a pool: brings the bricks that are not 0 in `active`, a byte for each of the layout's
// ranges, to the device. False: DEVICE, MEMORY.
bool pel_residency_fill(struct pel_residency *residency, const struct pel_scene *scene,
                        const struct pel_layout_limits *limits, const uint8_t *active);

// Frees everything on the device.
void pel_residency_finish(struct pel_residency *residency);

#endif
