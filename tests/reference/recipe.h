// recipe.h - hypertextures in double precision, at any position.
#ifndef PEL_TEST_REFERENCE_RECIPE_H
#define PEL_TEST_REFERENCE_RECIPE_H

#include "pellucid.h"

// The density of a volume without voxels at a position in voxel coordinates.
double reference_hypertexture(const struct pel_volume *volume, const double p_voxel[3]);

#endif
