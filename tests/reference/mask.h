// mask.h - where another volume's values leave a volume.
#ifndef PEL_TEST_REFERENCE_MASK_H
#define PEL_TEST_REFERENCE_MASK_H

#include "pellucid.h"

// True when the mask of an instance, if it has one, keeps it at a place in the world. `*margin_mm`
// is a distance, at least, to where it would not be so; it may be NULL.
bool reference_mask_keeps(const struct pel_scene *scene, const struct pel_instance *instance,
                          const double p_world[3], double *margin_mm);

#endif
