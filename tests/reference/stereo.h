// stereo.h - the right anaglyph of two pixels: docs/stereo.md in double precision, its matrices
// written out.
#ifndef PEL_REFERENCE_STEREO_H
#define PEL_REFERENCE_STEREO_H

#include "pellucid.h"

// The pixel of an anaglyph from the left and the right eye's, all premultiplied.
void reference_anaglyph(double rgba[4], const struct pel_stereo *stereo, const double left[4],
                        const double right[4]);

#endif
