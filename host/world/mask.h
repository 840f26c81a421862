// mask.h - which values of another volume decide where a volume is shown, as kernels read them
// (docs/mixing.md, "Masks").
#ifndef PEL_WORLD_MASK_H
#define PEL_WORLD_MASK_H

#include "world/world.h"

// The instance whose values decide where this one is shown, or -1.
int pel_mask_of(const struct pel_instance *instance);

// True when following the masks from one instance on leads back to it.
bool pel_mask_leads_back(const struct pel_scene *scene, int start);

// Fails (ARGUMENT) when a mask is none or decides about itself.
bool pel_mask_check(const struct pel_scene *scene);

// Lets part p of the world go by the `count` parts of its mask from `first` on, and appends what it
// needs of them to the world's cuts. False: a singular placement.
bool pel_mask_fill_part(struct pel_world *world, int p, const struct pel_scene *scene,
                        enum pel_reader reader, int first, int count);

// A hash of what the cells of masked parts depend on besides the parts themselves.
uint64_t pel_mask_hash(const struct pel_world *world);

#endif
