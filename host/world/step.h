// step.h - how far apart samples lie (docs/picture.md, "Samples").
#ifndef PEL_WORLD_STEP_H
#define PEL_WORLD_STEP_H

#include "pellucid.h"

// The distance in millimetres that an instance asks for, in its own voxels or the scene's terms.
double pel_step_of_instance(const struct pel_scene *scene, const struct pel_instance *instance);

// The distance where all instances share one grid of samples: the least that any visible one asks
// for.
double pel_step_of_scene(const struct pel_scene *scene);

// Fails (ARGUMENT) where a step is no such thing.
bool pel_step_check(const struct pel_scene *scene);

#endif
