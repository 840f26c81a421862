// clip.h - clip planes and boxes as kernels read them (docs/mixing.md, "Clipping").
#ifndef PEL_WORLD_CLIP_H
#define PEL_WORLD_CLIP_H

#include "world/world.h"

// Fails (ARGUMENT) when a plane or box is no such thing.
bool pel_clip_check(const struct pel_scene *scene);

// Appends the scene's and the instance's clips to the world's cuts and lets `part` refer to them.
// `centre` is what the world's coordinates are relative to.
void pel_clip_fill_part(struct pel_world *world, struct part *part, const struct pel_scene *scene,
                        const struct pel_instance *instance, const double centre[3]);

#endif
