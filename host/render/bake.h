// bake.h - hypertextures into voxels.
#ifndef PEL_RENDER_BAKE_H
#define PEL_RENDER_BAKE_H

#include "device/device.h"
#include "pellucid.h"
#include "shared/recipe.h"

// Does what pel_renderer_bake says. `*kernel` is NULL at first, and the caller destroys it; with it
// the next volume needs no build. `options` may be NULL.
struct pel_volume *pel_bake(struct pel_device *device, struct pel_kernel **kernel,
                            const char *recipe, const struct pel_bake_options *options);

// Sends the values of the volume that a recipe grows on to a buffer of floats, from number `offset`
// on: as shares of their range, which `program` knows, and 0 where they are absent.
bool pel_bake_send_object(struct pel_buffer *buffer, size_t offset, const struct pel_volume *object,
                          const struct recipe *program);

#endif
