// style.h - what the gradient does to a medium: its light, and an opacity that follows it.
#ifndef PEL_TEST_REFERENCE_STYLE_H
#define PEL_TEST_REFERENCE_STYLE_H

#include "reference/path.h"

// By how much the extinction of a body is multiplied at a place where the value is `value`, on a
// world ray; 1 where opacity does not follow the gradient. `*change`, unless NULL, is how much that
// may be off when each sample of the gradient is off by `error`.
double reference_style_factor(const struct reference_body *body, const struct reference_ray *ray,
                              const double p_voxel[3], double value, double error, double *change);

// Scales the extinction of what is at t along a world ray, and shades its colour.
void reference_style(struct reference_medium *medium, const struct reference *reference,
                     const struct reference_body *body, const struct reference_ray *ray, double t,
                     const double p_voxel[3], double value);

#endif
