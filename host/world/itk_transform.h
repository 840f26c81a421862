// itk_transform.h - ITK's files of transforms: text (.tfm, .txt), and binary (.mat) as ANTs writes.
#ifndef PEL_WORLD_ITK_TRANSFORM_H
#define PEL_WORLD_ITK_TRANSFORM_H

#include "pellucid.h"

// True for a file that begins as ITK's do. `data` has a zero byte behind it.
bool pel_itk_transform_recognise(const char *data, size_t bytes);

// The matrix the file describes: it maps points of the fixed image to the moving one, in LPS
// millimetres. It need not be rigid. Fails (FORMAT, UNSUPPORTED) with the line in the sentence.
bool pel_itk_transform_parse(struct pel_matrix *moving_from_fixed, const char *data, size_t bytes);

// The three angles of ITK's Euler3DTransform, in radians: rotation = Rz Rx Ry.
void pel_itk_transform_angles(const struct pel_matrix *rotation, double angles[3]);

#endif
