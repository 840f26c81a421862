// lighting.h - a scene's lights and materials as kernels read them.
#ifndef PEL_WORLD_LIGHTING_H
#define PEL_WORLD_LIGHTING_H

#include "pellucid.h"
#include "shared/world.h"

// Writes the scene's lights, in world coordinates relative to `centre`. Fails (ARGUMENT) on lights
// that cannot be: too many, or without direction.
bool pel_lighting_fill_lamps(struct world *world, const struct pel_scene *scene,
                             const double centre[3]);

// Writes how a part shades; its table's address must be there already. Fails (ARGUMENT) on a
// material that cannot be.
bool pel_lighting_fill_part(struct part *part, const struct pel_instance *instance,
                            const struct pel_volume *volume);

#endif
