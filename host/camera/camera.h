// camera.h - inside the library: where a camera looks.
#ifndef PEL_CAMERA_CAMERA_H
#define PEL_CAMERA_CAMERA_H

#include "pellucid.h"

#define PEL_CAMERA_FOV_DEFAULT_DEG 30.0

// The camera's unit vectors, as docs/picture.md, "Rays", has them: forward F, right R = F x up and
// up U = R x F. Fails (ARGUMENT) when the eye is at the target or `up` is zero or along the view.
bool pel_camera_basis(const struct pel_camera *camera, double forward[3], double right[3],
                      double up[3]);

// As pel_camera_fit, for `count` points in world millimetres, at least one. The camera's target
// becomes their middle.
bool pel_camera_fit_points(struct pel_camera *camera, const char *view, size_t count,
                           const double (*points)[3], double aspect);

#endif
