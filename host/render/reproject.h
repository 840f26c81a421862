// reproject.h - inside the render module: what a second eye sees, from the first one's picture.
#ifndef PEL_RENDER_REPROJECT_H
#define PEL_RENDER_REPROJECT_H

#include "pellucid.h"

// How a pixel moves along its row from one eye's picture to the other's. In perspective what is at
// depth z along the view goes `shift - reach / z` pixels to the right, and the greater 1 / z is
// seen. In an orthographic view what is at place x comes to `scale x + shift + slope z`, and the
// lesser `lean x + fall z` is seen; there an empty pixel counts as `empty` away, and behind
// everything.
struct pel_parallax {
    double shift_px, reach_mm_px;
    bool orthographic;
    double scale, slope_px_mm, lean_mm_px, fall, empty_mm;
};

// That of two parallel cameras of perspective, or of two orthographic ones turned around their
// common upward direction, for a picture or its region.
struct pel_parallax pel_parallax_between(const struct pel_camera cameras[2],
                                         const struct pel_render_settings *settings);

// Moves a picture's colours to the second eye's picture. `depth` holds the depth along the view of
// each pixel in millimetres, INFINITY where there is nothing, 0 where it is not known. `holes`
// receives 1 for each pixel that has to be rendered, and 0 for those of `second` that were set.
// False: MEMORY.
bool pel_reproject(struct pel_image *second, uint8_t *holes, const struct pel_image *first,
                   const float *depth, const struct pel_parallax *parallax);

// The depths along the view of a camera, in place, from distances along the rays of a
// picture, or of its region; 0 stays 0, and FLT_MAX becomes INFINITY.
void pel_depth_from_distance(float *depth, const struct pel_camera *camera,
                             const struct pel_render_settings *settings);

#endif
