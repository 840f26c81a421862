// bake.h - hypertextures into voxels.
#ifndef PEL_RENDER_BAKE_H
#define PEL_RENDER_BAKE_H

#include "device/device.h"
#include "pellucid.h"

// Does what pel_renderer_bake says. `*kernel` is NULL at first, and the caller destroys it; with it
// the next volume needs no build.
struct pel_volume *pel_bake(struct pel_device *device, struct pel_kernel **kernel,
                            const char *recipe, const struct pel_bake_options *options);

#endif
