// mix.h - several media at one sample, and one layer behind another.
#ifndef PEL_TEST_REFERENCE_MIX_H
#define PEL_TEST_REFERENCE_MIX_H

#include "reference/classify.h"

// The colour (premultiplied) and opacity of one sample of the given length, all media together.
void reference_mix(double layer[4], enum pel_mixing mixing, const struct reference_medium *media,
                   int count, double step_mm);

// Puts `back` behind `front`; either may be `result`. Both are premultiplied.
void reference_compose(double result[4], const double front[4], const double back[4]);

#endif
