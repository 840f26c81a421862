// secondary.h - how much light gets to a place through all that is around it.
#ifndef PEL_TEST_REFERENCE_SECONDARY_H
#define PEL_TEST_REFERENCE_SECONDARY_H

#include "reference/path.h"
#include "reference/reference.h"

// The shares that are left of each light, and of all that is not shiny.
struct reference_dimming {
    double lights[PEL_LIGHT_MAX];
    double around;
};

// The share of light that comes through along a world ray, up to `end`. Every value is taken to be
// off by what `errors` allow, times `sign`; NULL: by nothing.
double reference_light_through(const struct reference *reference, const struct reference_ray *ray,
                               double end, double step_mm, const struct reference_errors *errors,
                               double sign);

// Direction k of ambient occlusion, of `count`, before it is turned to any side.
void reference_direction(double direction[3], uint32_t seed, int k, int count);

// What is left at t along a world ray, where the normal is known; `towards` are the unit vectors to
// the scene's lights, one if it has none.
struct reference_dimming reference_dimming(const struct reference *reference,
                                           const struct reference_body *body,
                                           const struct reference_ray *ray, double t,
                                           const double normal[3], const double (*towards)[3],
                                           const struct reference_errors *errors, double sign);

#endif
