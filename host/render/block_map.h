// block_map.h - the blocks of all parts on the device (shared/block.h), and which of their
// sub-blocks can be seen.
#ifndef PEL_RENDER_BLOCK_MAP_H
#define PEL_RENDER_BLOCK_MAP_H

#include "device/device.h"
#include "shared/block.h"
#include "world/world.h"

struct pel_occupancy;

// Zero-initialise.
struct pel_block_map {
    struct pel_buffer *buffer;
    struct block_grid grids[WORLD_PART_MAX]; // as they are on the device
    bool whole; // sub-blocks that the value around a part's first corner fills are stored, too
    struct pel_brick_statistics statistics; // of sub-blocks, and of blocks as their clusters
};

// Brings the blocks of `occupancy` up to date once its scratch cells tell what is empty. With
// `same`, nothing but tables has changed since the last time, and what is stored stays, unless what
// was left out of it can be seen now. False: DEVICE, MEMORY.
bool pel_block_map_update(struct pel_occupancy *occupancy, struct pel_device *device,
                          const struct pel_world *world, const struct pel_brick_settings *settings,
                          double start_ms, bool same);
void pel_block_map_finish(struct pel_block_map *map);

#endif
