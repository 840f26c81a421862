// live.h - recipes of volumes without voxels, and the volumes they grow on, on the device.
#ifndef PEL_RENDER_LIVE_H
#define PEL_RENDER_LIVE_H

#include "render/mirror.h"
#include "world/world.h"

// Zero-initialise.
struct pel_live {
    struct pel_mirror recipes;  // an array of struct recipe
    struct pel_buffer *objects; // the values of all objects, 0..1, one after the other
    uint64_t serials[RECIPE_LIVE_MAX];
};

// Sends the recipes of the world's live volumes, or what changed of them, and the volumes they grow
// on unless they are there. Nothing is done for a world without any. False: DEVICE, MEMORY.
bool pel_live_update(struct pel_live *live, struct pel_device *device,
                     const struct pel_scene *scene, const struct pel_world *world);
void pel_live_finish(struct pel_live *live);

#endif
