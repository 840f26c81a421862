// debug.h - inside the render module: the numbers of a debug view, painted.
#ifndef PEL_RENDER_DEBUG_H
#define PEL_RENDER_DEBUG_H

#include "pellucid.h"

// Replaces an image whose red channel holds a number for each pixel by a picture of the numbers: a
// heat map from 0 to the greatest, with 0 in black; or, for views of what made a pixel, a colour
// for each number. Writes the numbers to `numbers`, one a pixel, unless that is NULL, and their
// least, greatest and mean to `range`. False: MEMORY.
bool pel_debug_paint(struct pel_image *image, enum pel_debug view, float *numbers,
                     struct pel_debug_range *range);

#endif
