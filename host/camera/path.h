// path.h - cameras on their way between others.
#ifndef PEL_CAMERA_PATH_H
#define PEL_CAMERA_PATH_H

#include "pellucid.h"

// The camera at `share` (0..1) of the way from `a` to `b`: its axes turn by slerp, its target and
// its distance from it change linearly, so that it moves on an arc about what it looks at; likewise
// field of view, height and shift. The projection is that of `a`. False (ARGUMENT) when one of them
// has no axes.
bool pel_camera_between(struct pel_camera *camera, const struct pel_camera *a,
                        const struct pel_camera *b, double share);

// Turns a camera about an axis through its target.
void pel_camera_orbit(struct pel_camera *camera, const double axis[3], double radians);

#endif
