// scene.h - inside the world module: what a new scene is before anything is read into it.
#ifndef PEL_WORLD_SCENE_H
#define PEL_WORLD_SCENE_H

#include "pellucid.h"

// An empty scene (NULL: MEMORY), and an instance of volume 0 that owns nothing, with every default.
struct pel_scene *pel_scene_create(void);
struct pel_instance pel_instance_default(void);

#endif
