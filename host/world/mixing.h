// mixing.h - what kernels are told about how volumes share a sample (docs/mixing.md).
#ifndef PEL_WORLD_MIXING_H
#define PEL_WORLD_MIXING_H

#include "pellucid.h"

// The kernels' number, MIXING_*.
int pel_mixing_find(enum pel_mixing mixing);

// The place of an instance's priority: how many visible instances have less.
int pel_mixing_rank(const struct pel_scene *scene, const struct pel_instance *instance);

#endif
