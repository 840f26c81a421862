// supersample.h - pictures with several rays a pixel, or with jitter.
#ifndef PEL_TEST_REFERENCE_SUPERSAMPLE_H
#define PEL_TEST_REFERENCE_SUPERSAMPLE_H

#include "pellucid.h"

// One ray through the centre of each pixel, with the scene's phase.
bool reference_is_simple(const struct pel_scene *scene);

// The picture of any other scene; the caller's.
struct pel_image *reference_supersample(const struct pel_scene *scene);

#endif
