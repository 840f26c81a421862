// recipe.h - hypertexture recipes: from JSON expression trees to programs that a kernel runs.
//
// docs/hypertexture.md defines the language.
#ifndef PEL_WORLD_RECIPE_H
#define PEL_WORLD_RECIPE_H

#include "pellucid.h"
#include "shared/recipe.h"

// Compiles a recipe: the text itself when it begins with '{', a file when the name has a '/' or
// ends in .json, else a preset. Sets code and length, and leaves the rest of `program` alone. Fails
// (ARGUMENT, FILE, FORMAT) with FILE:LINE:COLUMN: KEY before the sentence.
bool pel_recipe_compile(struct recipe *program, const char *recipe);

// True when the program reads the volume that a recipe may grow on.
bool pel_recipe_needs_object(const struct recipe *program);

// Fills the lattice's tables and the seed. Seed 0 takes the permutation that Perlin published.
void pel_recipe_seed(struct recipe *program, uint32_t seed);

#endif
