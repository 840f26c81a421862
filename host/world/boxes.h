// boxes.h - a hierarchy over the boxes of all parts, by which rays find those that they cross.
#ifndef PEL_WORLD_BOXES_H
#define PEL_WORLD_BOXES_H

#include "world/world.h"

// Finds what a part, one of the world's, fills along the world's axes, and how long a way through
// it may be.
void pel_boxes_bound(struct pel_world *world, const struct part *part,
                     const struct pel_matrix *world_from_voxel);

// Joins the boxes of the parts that are shown, if there are several.
void pel_boxes_join(struct pel_world *world);

#endif
