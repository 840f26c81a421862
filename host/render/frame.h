// frame.h - inside the render module: one frame, seen by one eye or two.
#ifndef PEL_RENDER_FRAME_H
#define PEL_RENDER_FRAME_H

#include "pellucid.h"
#include "shared/variant.h"

// Whose eyes see a frame. Zero-initialise: one, that of the scene's camera.
struct pel_frame_eyes {
    int eyes;                        // EYES_*, or 0
    const struct pel_camera *second; // the first one's is the scene's
    int weave[2]; // EYES_WOVEN: pixels where weave[0] x + weave[1] y is odd are the second eye's
    const uint8_t *only; // the pixels that are rendered, not 0; the others are left undefined. For
                         // one eye, one ray through each pixel's centre
};

// As pel_renderer_render, for a scene whose `stereo` is not looked at. With EYES_BOTH the picture
// is twice as high, the second eye's below the first one's; with EYES_DEPTH too, with millimetres
// along the rays below it (kernels/depth.cl). `statistics` may be NULL.
struct pel_image *pel_frame_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                                   const struct pel_frame_eyes *eyes,
                                   const struct pel_render_options *options,
                                   struct pel_render_statistics *statistics);

#endif
