// hypertexture.h - inside the library: where hypertextures lie.
#ifndef PEL_WORLD_HYPERTEXTURE_H
#define PEL_WORLD_HYPERTEXTURE_H

#include "pellucid.h"
#include "world/recipe.h"

// Compiles, seeds and places a recipe, and makes the grid that `options` describe, with room for
// voxels or without (then it has one). The caller owns it; NULL as pel_renderer_bake fails.
struct pel_volume *pel_hypertexture_place(struct recipe *program, const char *recipe,
                                          const struct pel_bake_options *options, bool voxels);

// What makes densities 0..1 of baked voxels.
double pel_hypertexture_slope(enum pel_voxel_type type);

#endif
