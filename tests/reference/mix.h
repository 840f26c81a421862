// mix.h - several media at one sample, and one layer behind another.
#ifndef PEL_TEST_REFERENCE_MIX_H
#define PEL_TEST_REFERENCE_MIX_H

#include "reference/classify.h"

// The colour (premultiplied) and opacity of one medium over the length of its sample.
void reference_layer(double layer[4], const struct reference_medium *medium);

// The same of all media at a place together, given in the order of the scene's list, which has
// `total` visible instances.
void reference_mix(double layer[4], enum pel_mixing mixing, const struct reference_medium *media,
                   int count, int total);

// Puts `back` behind `front`; either may be `result`. Both are premultiplied.
void reference_compose(double result[4], const double front[4], const double back[4]);

#endif
