// frame.h - inside the render module: one frame, seen by one eye.
#ifndef PEL_RENDER_FRAME_H
#define PEL_RENDER_FRAME_H

#include "pellucid.h"

// As pel_renderer_render, for a scene whose `stereo` is not looked at. `statistics` may be NULL.
struct pel_image *pel_frame_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                                   const struct pel_render_options *options,
                                   struct pel_render_statistics *statistics);

#endif
