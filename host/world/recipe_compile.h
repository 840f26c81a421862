// recipe_compile.h - inside the world module: the compiler of recipes.
#ifndef PEL_WORLD_RECIPE_COMPILE_H
#define PEL_WORLD_RECIPE_COMPILE_H

#include <jansson.h>

#include "world/recipe.h"

enum { PEL_RECIPE_KEY_BYTES = 256 };

// Compiles a recipe's JSON. When that fails (FORMAT) `key` says where, as "value.2.1".
bool pel_recipe_compile_json(struct recipe *program, const json_t *json,
                             char key[PEL_RECIPE_KEY_BYTES]);

#endif
