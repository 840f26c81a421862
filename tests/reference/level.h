// level.h - docs/picture.md, "Level of detail".
#ifndef PEL_TEST_REFERENCE_LEVEL_H
#define PEL_TEST_REFERENCE_LEVEL_H

#include "pellucid.h"

// The volume at a level; pel_volume_destroy.
struct pel_volume *reference_level(const struct pel_volume *volume, int level);

// The level at which the scene shows an instance.
int reference_level_of(const struct pel_scene *scene, int instance);

// A copy of the scene that shows levels in the places of its volumes, and owns only those; NULL
// where it shows all volumes as they are.
struct pel_scene *reference_coarsen(const struct pel_scene *scene);
void reference_coarsen_finish(struct pel_scene *coarse);

#endif
