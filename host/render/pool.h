// pool.h - bricks of voxels on the device, of which only those are there that may be seen.
//
// A page stands for each brick of each slab, in the order of the slabs' ranges of values. The table
// of pages says where in the buffer of its class of voxels a brick lies. A brick in which nothing
// is visible leads to a stand-in of its slab: a brick of one value that was found in such a one, so
// that a sample there is not seen either.
#ifndef PEL_RENDER_POOL_H
#define PEL_RENDER_POOL_H

#include "device/device.h"
#include "world/layout.h"

// The bricks of one class of voxels.
struct pel_shelf {
    struct pel_buffer *buffer;
    i32 *pages;      // owned; of each place: which page's brick lies there, or PEL_SHELF_*
    size_t capacity; // places
};

enum { PEL_SHELF_FREE = -1, PEL_SHELF_STAND_IN = -2 };

// Zero-initialise.
struct pel_pool {
    float (*ranges)[2]; // owned; of each page: the least and the greatest value in and around it
    i32 *places;        // owned; of each page: where its brick lies, -1 nowhere
    size_t page_count;
    struct pel_buffer *pages; // the table
    struct pel_shelf shelves[VOXEL_CLASS_COUNT];
    size_t resident; // bricks on the device, stand-ins left out
    bool filled;     // what was asked for last is there
};

// Prepares for the volumes of a layout and finds the ranges of their bricks. False: DEVICE, MEMORY.
bool pel_pool_init(struct pel_pool *pool, struct pel_device *device, const struct pel_scene *scene,
                   const struct pel_layout *layout);
void pel_pool_finish(struct pel_pool *pool);

// Brings the bricks whose page in `active` is not 0 to the device. Those of before stay as long as
// there is room. False (DEVICE, with needed and available bytes; MEMORY): then nothing is there.
bool pel_pool_fill(struct pel_pool *pool, struct pel_device *device, const struct pel_scene *scene,
                   const struct pel_layout *layout, const struct pel_layout_limits *limits,
                   const uint8_t *active);

#endif
