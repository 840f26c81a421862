// style.h - opacity that follows the gradient, as kernels read it.
#ifndef PEL_WORLD_STYLE_H
#define PEL_WORLD_STYLE_H

#include "pellucid.h"
#include "shared/world.h"

// True when the opacity of an instance follows its gradient.
bool pel_style_is_on(const struct pel_instance *instance);

// True when samples of an instance need gradients, for light or for opacity. A hidden one is asked
// as if it were shown.
bool pel_style_needs_gradients(const struct pel_instance *instance);

// Writes how a part's gradient is found and what it does to opacity; `range` is that of its table,
// in the file's unit. Fails (ARGUMENT) on numbers that cannot be.
bool pel_style_fill_part(struct part *part, const struct pel_instance *instance, double range);

#endif
