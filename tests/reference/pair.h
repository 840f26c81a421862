// pair.h - docs/picture.md, "Pre-integration".
#ifndef PEL_TEST_REFERENCE_PAIR_H
#define PEL_TEST_REFERENCE_PAIR_H

#include "reference/path.h"

// Room for a body's pairs, none of which is known yet; free().
double (*reference_pairs_create(void))[4];

bool reference_is_preintegrated(const struct pel_scene *scene, const struct pel_instance *instance);

// What a step shows whose value goes evenly from `front` to `back`.
struct reference_medium reference_pair(const struct reference_body *body, double front, double back,
                                       double step_mm);

#endif
