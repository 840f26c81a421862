// region.h - a part of a picture: as if the whole had been rendered and cut, but for the work.
#ifndef PEL_RENDER_REGION_H
#define PEL_RENDER_REGION_H

#include "pellucid.h"

// False (ARGUMENT) when the region does not lie in the picture.
bool pel_region_check(const struct pel_render_settings *settings);

// Makes the region as much larger as its pixels look at their neighbours.
void pel_region_widen(struct pel_render_settings *settings);

// Takes a picture, or several above each other, of the widened region and returns that of the
// region alone. NULL: MEMORY, or for NULL.
struct pel_image *pel_region_cut(struct pel_image *image, const struct pel_render_settings *widened,
                                 const struct pel_render_settings *settings);

#endif
