// recipe_table.h - the ready-made recipes, scenes/recipes/NAME.json as they were when the library
// was built.
#ifndef PEL_WORLD_RECIPE_TABLE_H
#define PEL_WORLD_RECIPE_TABLE_H

struct pel_recipe_file {
    const char *name; // "NAME.json"
    const char *text;
};

// In the order of their names; ends with a row of NULLs.
extern const struct pel_recipe_file pel_recipe_table[];

#endif
