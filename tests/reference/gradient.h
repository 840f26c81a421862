// gradient.h - how the values around a place change along a volume's own axes.
#ifndef PEL_TEST_REFERENCE_GRADIENT_H
#define PEL_TEST_REFERENCE_GRADIENT_H

#include "reference/path.h"

// The gradient in the file's unit per voxel, at a place in voxel coordinates where the value is
// `value`. `*spread` is the greatest one of the samples it came from (struct reference_sample).
void reference_gradient(double along[3], const struct reference_body *body, const double p_voxel[3],
                        double value, double *spread);

#endif
