// clip.h - what clip planes, boxes and masks leave of a volume.
#ifndef PEL_TEST_REFERENCE_CLIP_H
#define PEL_TEST_REFERENCE_CLIP_H

#include "reference/path.h"

// True when the body is shown at t along the ray. `*margin_mm` is how far that place is from where
// it would be otherwise; it may be NULL.
bool reference_is_kept(const struct reference *reference, const struct reference_path *path,
                       const struct reference_body *body, double t, double *margin_mm);

#define REFERENCE_CLIP_PLACES (16 * 6)

// Where the ray crosses the planes of all clips that the body has, in no order; returns how often.
int reference_clip_places(double places[REFERENCE_CLIP_PLACES], const struct reference *reference,
                          const struct reference_path *path, const struct reference_body *body);

#endif
