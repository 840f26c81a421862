// style.h - opacity that follows the gradient, as kernels read it.
#ifndef PEL_WORLD_STYLE_H
#define PEL_WORLD_STYLE_H

#include "pellucid.h"
#include "shared/world.h"

// Writes how a part's gradient is found and what it does to opacity; `range` is that of its table,
// in the file's unit. Fails (ARGUMENT) on numbers that cannot be.
bool pel_style_fill_part(struct part *part, const struct pel_instance *instance, double range);

#endif
