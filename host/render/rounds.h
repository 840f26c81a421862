// rounds.h - how often a work-item may go round its loops, on a device that does not let it.
#ifndef PEL_RENDER_ROUNDS_H
#define PEL_RENDER_ROUNDS_H

#include "world/world.h"

// The most rounds that all loops of one work-item take together while a frame is rendered: of each
// eye's ray, its samples in every part, and the secondary rays that those send out. Neither early
// termination nor what is skipped is counted on.
double pel_rounds_most(const struct pel_world *world, enum pel_skip skip);

// Warns when that is more than the device allows. `warned` is of the frame before: the same is not
// said twice.
void pel_rounds_check(bool *warned, const struct pel_device_info *device,
                      const struct pel_world *world, enum pel_skip skip);

#endif
