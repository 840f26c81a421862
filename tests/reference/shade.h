// shade.h - what light does to a sample's colour.
#ifndef PEL_TEST_REFERENCE_SHADE_H
#define PEL_TEST_REFERENCE_SHADE_H

#include "reference/path.h"
#include "reference/reference.h"

// c' = c * matt + gloss, per channel.
struct reference_shade {
    double matt[3], gloss[3];
};

// The normal at a place in voxel coordinates where the value is `value`: a world direction of
// length below 1, all zero where there is no gradient. `*spread`, unless NULL, is the greatest one
// of the samples it came from (struct reference_sample).
void reference_normal(double normal[3], const struct reference_body *body, const double p_voxel[3],
                      double value, double *spread);

// The shade of a place with that normal, at t along a world ray; all ones and zeros for a body that
// is not shaded.
struct reference_shade reference_shade(const struct reference *reference,
                                       const struct reference_body *body,
                                       const struct reference_ray *ray, double t,
                                       const double normal[3]);

void reference_shade_apply(struct reference_medium *medium, const struct reference_shade *shade);

// How much the shade may change, in any channel, when each sample of the gradient is off by
// `error`; and the brightest that a white sample can be.
double reference_shade_change(const struct reference *reference, const struct reference_body *body,
                              const double normal[3], double error);
// The same by shadows and ambient occlusion when the values around are off.
double reference_dimming_change(const struct reference *reference,
                                const struct reference_body *body, const struct reference_ray *ray,
                                double t, const double normal[3],
                                const struct reference_errors *errors);
double reference_shade_greatest(const struct reference *reference,
                                const struct reference_body *body);

#endif
