// pack.h - a volume's slices as the device stores them.
#ifndef PEL_WORLD_PACK_H
#define PEL_WORLD_PACK_H

#include "pellucid.h"

// Writes slice `z` of the volume, -1..dims[2] with the border repeating the edge, into `out`:
// (dims[0] + 2) x (dims[1] + 2) voxels of the volume's class (pel_voxel_class). Signed integers get
// their sign bit flipped, RGB becomes RGBA with the luminance as alpha.
void pel_pack_slice(const struct pel_volume *volume, int z, void *out);

#endif
