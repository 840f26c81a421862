// stereo.h - inside the output module: how pictures of two eyes become one.
#ifndef PEL_OUTPUT_STEREO_H
#define PEL_OUTPUT_STEREO_H

#include "pellucid.h"

bool pel_stereo_is_anaglyph(enum pel_stereo_kind kind);

// The matrix of an anaglyph: red, green and blue of the picture from those of the left and of the
// right eye. True when it acts on linear light, false when on values as they are stored.
bool pel_anaglyph_matrix(const struct pel_stereo *stereo, double matrix[3][6]);

// Both pictures have one size, and so has the result; the caller owns it. NULL: ARGUMENT, MEMORY.
struct pel_image *pel_anaglyph_compose(const struct pel_stereo *stereo,
                                       const struct pel_image *left, const struct pel_image *right);

#endif
