// memory.c - every allocation of the library goes through here.
#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

bool pel_size_multiply(size_t *bytes, int count, const size_t factors[]) {
    size_t product = 1;
    for (int i = 0; i < count; i++) {
        if (__builtin_mul_overflow(product, factors[i], &product) || product > PTRDIFF_MAX)
            return pel_fail(PEL_ERROR_MEMORY, "size is beyond what can be addressed");
    }
    *bytes = product;
    return true;
}

void *pel_allocate(size_t count, size_t element_bytes) {
    void *memory = calloc(count ? count : 1, element_bytes ? element_bytes : 1);
    if (!memory)
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu x %zu bytes", count, element_bytes);
    return memory;
}

void *pel_allocate_voxels(size_t bytes) {
    void *memory = NULL;
    if (posix_memalign(&memory, 64, bytes ? bytes : 1) != 0) {
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu bytes for voxels", bytes);
        return NULL;
    }
    return memory;
}

char *pel_copy_text(const char *text) {
    size_t bytes = strlen(text) + 1;
    char *copy = pel_allocate(bytes, 1);
    return copy ? memcpy(copy, text, bytes) : NULL;
}
