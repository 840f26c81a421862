// kernel_cache.h - inside the render module: the kernels built so far, by variant.
#ifndef PEL_RENDER_KERNEL_CACHE_H
#define PEL_RENDER_KERNEL_CACHE_H

#include "device/device.h"
#include "render/variant.h"

enum { PEL_KERNEL_CACHE = 16 };

// Zero-initialise.
struct pel_kernel_cache {
    struct {
        char definitions[PEL_VARIANT_BYTES];
        struct pel_kernel *kernel;
    } entries[PEL_KERNEL_CACHE]; // newest first
};

// The kernel of a variant, from the cache or built now, in place of the one that was not used for
// longest. Borrowed; NULL (BUILD) on failure.
struct pel_kernel *pel_kernel_cache_find(struct pel_kernel_cache *cache, struct pel_device *device,
                                         const struct pel_variant *variant);
void pel_kernel_cache_finish(struct pel_kernel_cache *cache);

#endif
