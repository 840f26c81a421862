// render.h - pictures, and refusals, of scenes that nobody judges.
#ifndef PEL_TEST_RENDER_H
#define PEL_TEST_RENDER_H

#include "pellucid.h"

// Renders a scene; fails the test when there is no picture. `statistics` may be NULL.
struct pel_image *render_picture(struct pel_renderer *renderer, const struct pel_scene *scene,
                                 struct pel_render_statistics *statistics);

// Fails the test unless the scene is refused (ARGUMENT) in a sentence that says `why`.
void render_refused(struct pel_renderer *renderer, const struct pel_scene *scene, const char *why);

// A renderer, from buffers, whose allocations hold two bricks of 8-bit voxels each, so that a tall
// volume comes in slabs.
struct pel_renderer *render_in_slabs(int lanes);

#endif
