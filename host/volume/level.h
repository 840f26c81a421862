// level.h - coarser versions of a volume.
#ifndef PEL_VOLUME_LEVEL_H
#define PEL_VOLUME_LEVEL_H

#include "pellucid.h"

// How often each axis of a volume is halved at a level: so that no voxel is longer than 2^level
// times the shortest side of the volume's own.
void pel_volume_level_halvings(const struct pel_volume *volume, int level, int halvings[3]);

// The volume at a level, at least 0: over the same cells' extent, ceil(dims / 2^halvings) voxels,
// each the mean of what is present in it. NULL: MEMORY.
struct pel_volume *pel_volume_level(const struct pel_volume *source, int level);

#endif
