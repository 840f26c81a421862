// world_table.h - the instances' transfer functions as the tables of a world.
#ifndef PEL_WORLD_WORLD_TABLE_H
#define PEL_WORLD_WORLD_TABLE_H

#include "world/world.h"

// Makes the table of every visible instance, so that the kernel's way of reading them can be
// decided: world->table_linear. Tables that are in `memo` from a frame before are not made anew.
// Fails (MEMORY, FORMAT).
bool pel_world_build_tables(struct pel_world *world, const struct pel_scene *scene,
                            struct pel_memo *memo);

// Appends an instance's table, which pel_world_build_tables made, to the world's, and lets `part`
// refer to it. Fails (MEMORY).
bool pel_world_add_table(struct pel_world *world, const struct pel_scene *scene,
                         const struct pel_layout *layout, const struct pel_instance *instance,
                         struct pel_memo *memo, struct part *part);

#endif
