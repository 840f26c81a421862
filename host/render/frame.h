// frame.h - inside the render module: one frame, seen by one eye or two.
#ifndef PEL_RENDER_FRAME_H
#define PEL_RENDER_FRAME_H

#include "pellucid.h"
#include "shared/variant.h"

// What makes one colour of both eyes': the matrix of output/stereo.h, and the colour of two
// backgrounds.
struct pel_glasses {
    double matrix[3][6];
    bool linear;
    float background[4];
};

// Whose eyes see a frame. Zero-initialise: one, that of the scene's camera.
struct pel_frame_eyes {
    int eyes;                        // EYES_*, or 0
    const struct pel_camera *second; // the first one's is the scene's. Levels of detail suit both,
                                     // also where the frame is one eye's
    int weave[2]; // EYES_WOVEN: pixels where weave[0] x + weave[1] y is odd are the second eye's
    bool beside;  // EYES_BOTH, one ray a pixel: the second picture lies right of the first one
    const struct pel_glasses *glasses; // EYES_MERGED
    const uint8_t *only; // the pixels that are rendered, not 0; the others are left undefined. For
                         // one eye, one ray through each pixel's centre
};

// As pel_renderer_render, for a scene whose `stereo` is not looked at. With EYES_BOTH the picture
// is twice as high, the second eye's below the first one's, or twice as wide (`beside`); with
// EYES_DEPTH too, with millimetres along the rays below it (kernels/depth.cl). `statistics` may be
// NULL.
struct pel_image *pel_frame_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                                   const struct pel_frame_eyes *eyes,
                                   const struct pel_render_options *options,
                                   struct pel_render_statistics *statistics);

#endif
