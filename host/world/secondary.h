// secondary.h - shadows and ambient occlusion as kernels read them.
#ifndef PEL_WORLD_SECONDARY_H
#define PEL_WORLD_SECONDARY_H

#include "world/world.h"

// Writes what the scene's secondary rays are like, and their directions behind the world's cuts, of
// which there must come no more. Parts, bounds and step have to be there. Fails (ARGUMENT) on
// settings that cannot be.
bool pel_secondary_fill(struct pel_world *world, const struct pel_scene *scene);

#endif
