// remark.h - what a scene asks for in vain.
#ifndef PEL_WORLD_REMARK_H
#define PEL_WORLD_REMARK_H

#include "pellucid.h"

// Warns of settings that cannot change the picture of this scene, such as shadows where nothing is
// shaded, and of surfaces and masks at values that no voxel has: the picture is right, but hardly
// the one that was meant.
void pel_scene_remark(const struct pel_scene *scene);

#endif
