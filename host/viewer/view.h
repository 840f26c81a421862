// view.h - between the world and the pixels of a picture, for whatever reacts to the pointer.
//
// Pixels are counted as docs/picture.md, "Rays", counts them: from the left and top edge of the
// picture, so that the centre of its first pixel is at (0.5, 0.5).
#ifndef PEL_VIEWER_VIEW_H
#define PEL_VIEWER_VIEW_H

#include "pellucid.h"

// A camera and the size of its picture. The axes are unit vectors.
struct pel_view {
    struct pel_camera camera;
    double width, height; // pixels
    double forward[3], right[3], up[3];
};

// A ray of the world: origin + t * direction, t >= 0 in millimetres.
struct pel_view_ray {
    double origin[3], direction[3];
};

// The view of a camera; false when the camera has no axes or the picture no pixels.
bool pel_view_make(struct pel_view *view, const struct pel_camera *camera, int width, int height);

// The ray through a place of the picture.
struct pel_view_ray pel_view_ray(const struct pel_view *view, const double pixel[2]);

// Where a point of the world is in the picture; false when it lies behind the eye.
bool pel_view_project(const struct pel_view *view, const double point[3], double pixel[2]);

// How many millimetres a pixel covers at a point's distance, and at the target's.
double pel_view_mm_per_px(const struct pel_view *view, const double point[3]);
double pel_view_target_mm_per_px(const struct pel_view *view);

// Where a ray meets a plane; false when it runs along it or leads away from it.
bool pel_view_meet_plane(double meeting[3], const struct pel_view_ray *ray, const double point[3],
                         const double normal[3]);

// The place s along a line, point + s * axis (a unit vector), that is nearest to a ray's line;
// false when they are parallel.
bool pel_view_nearest_on_axis(double *s, const struct pel_view_ray *ray, const double point[3],
                              const double axis[3]);

#endif
