// detail.h - how much detail of a volume a picture needs (docs/picture.md, "Level of detail").
#ifndef PEL_WORLD_DETAIL_H
#define PEL_WORLD_DETAIL_H

#include "pellucid.h"

// Fails (ARGUMENT) on a setting that is no such thing.
bool pel_detail_check(const struct pel_render_settings *render);

// The level at which the scene shows an instance, 0 for its volume itself: the finer one of what
// its camera and a second eye's ask for, which may be NULL.
int pel_detail_level(const struct pel_scene *scene, const struct pel_camera *second, int instance);

#endif
