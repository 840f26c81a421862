// kernel_cache.c - the kernels built so far, by variant.
#include "render/kernel_cache.h"

#include <string.h>

struct pel_kernel *pel_kernel_cache_find(struct pel_kernel_cache *cache, struct pel_device *device,
                                         const struct pel_variant *variant) {
    char definitions[PEL_VARIANT_BYTES];
    pel_variant_write(variant, definitions);
    int place = 0;
    for (; place < PEL_KERNEL_CACHE - 1 && cache->entries[place].kernel; place++)
        if (strcmp(cache->entries[place].definitions, definitions) == 0)
            break;
    struct pel_kernel *kernel = cache->entries[place].kernel;
    if (!kernel || strcmp(cache->entries[place].definitions, definitions) != 0) {
        struct pel_kernel *built = pel_kernel_build(device, "render.cl", "render", definitions);
        if (!built)
            return NULL;
        pel_kernel_destroy(kernel);
        kernel = built;
    }
    memmove(&cache->entries[1], &cache->entries[0], (size_t)place * sizeof cache->entries[0]);
    memcpy(cache->entries[0].definitions, definitions, sizeof definitions);
    cache->entries[0].kernel = kernel;
    return kernel;
}

void pel_kernel_cache_finish(struct pel_kernel_cache *cache) {
    for (int i = 0; i < PEL_KERNEL_CACHE; i++) {
        pel_kernel_destroy(cache->entries[i].kernel);
        cache->entries[i].kernel = NULL;
    }
}
