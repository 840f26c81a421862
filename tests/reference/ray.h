// ray.h - the ray of a pixel, and where it is inside a box.
#ifndef PEL_TEST_REFERENCE_RAY_H
#define PEL_TEST_REFERENCE_RAY_H

#include "pellucid.h"

// Points of the ray are origin + t * direction. In world space the direction is a unit vector and t
// counts millimetres; in voxel space it is not, so that t stays the same.
struct reference_ray {
    double origin[3], direction[3];
};

// t_in <= t < t_out; empty when t_in >= t_out.
struct reference_span {
    double t_in, t_out;
};

struct reference_ray reference_camera_ray(const struct pel_camera *camera, int width, int height,
                                          double x_px, double y_px);

// The same ray in the space that `matrix` maps world points to.
struct reference_ray reference_map_ray(const struct pel_matrix *matrix,
                                       const struct reference_ray *ray);

// Where the ray is inside the box and not behind its origin.
struct reference_span reference_clip(const struct reference_ray *ray, const double low[3],
                                     const double high[3]);

void reference_point_at(double point[3], const struct reference_ray *ray, double t);

#endif
