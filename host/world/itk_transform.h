// itk_transform.h - ITK's text files of transforms (.tfm, .txt).
#ifndef PEL_WORLD_ITK_TRANSFORM_H
#define PEL_WORLD_ITK_TRANSFORM_H

#include "pellucid.h"

// True for text that begins as ITK's files do.
bool pel_itk_transform_recognise(const char *text);

// The matrix the text describes: it maps points of the fixed image to the moving one, in LPS
// millimetres. It need not be rigid. Fails (FORMAT, UNSUPPORTED) with the line in the sentence.
bool pel_itk_transform_parse(struct pel_matrix *moving_from_fixed, const char *text);

// The three angles of ITK's Euler3DTransform, in radians: rotation = Rz Rx Ry.
void pel_itk_transform_angles(const struct pel_matrix *rotation, double angles[3]);

#endif
