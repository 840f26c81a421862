// stride.h - which parts may be sampled in longer strides (docs/picture.md, "Adaptive steps").
#ifndef PEL_WORLD_STRIDE_H
#define PEL_WORLD_STRIDE_H

#include "world/world.h"

// Fails (ARGUMENT) when the depth is none, or the picture's samples do not follow each other as
// strides need it.
bool pel_stride_check(const struct pel_scene *scene);

// Whether some sample may stand for others.
bool pel_stride_is_on(const struct pel_scene *scene);

// Fills in how the part of an instance with that table may be strided over, and appends the
// variations of the table to the world's counts of visible entries. Comes after clips and shading.
// False: MEMORY.
bool pel_stride_fill_part(struct pel_world *world, struct part *part, const struct pel_scene *scene,
                          const struct pel_instance *instance, const struct pel_memo_table *memo);

#endif
