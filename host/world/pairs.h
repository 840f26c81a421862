// pairs.h - a transfer function as a table of pairs of values (docs/picture.md, "Pre-integration").
#ifndef PEL_WORLD_PAIRS_H
#define PEL_WORLD_PAIRS_H

#include "shared/variant.h"
#include "world/strength.h"

// Writes PAIR_ENTRIES^2 entries of two words, optical depth and colour, for a step whose value goes
// evenly from the value of row f to that of column b; value j is j / (PAIR_ENTRIES - 1) of the way
// along `range`. Entry j of `along`, likewise of two words, is visible where anything is at or
// beside value j.
void pel_pairs_write(u32 *words, u32 along[][PEL_STRENGTH_WORDS], const struct pel_table *table,
                     const double range[2], const struct pel_strength_rule *rule);

#endif
