// memory.h - allocation that fails with a sentence, and sizes that cannot overflow.
#ifndef PEL_BASE_MEMORY_H
#define PEL_BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

// `*bytes` = product of `count` factors; false (MEMORY) when it does not fit size_t or PTRDIFF_MAX.
bool pel_size_multiply(size_t *bytes, int count, const size_t factors[]);

// Zeroed memory for `count` elements of `element_bytes` each, or NULL (MEMORY) with the size in the
// sentence. At least one byte is allocated. Give it back to free().
void *pel_allocate(size_t count, size_t element_bytes);

// The same without zeroing, aligned to 64 bytes. Give it back to free().
void *pel_allocate_voxels(size_t bytes);

// A copy of `text`, or NULL (MEMORY).
char *pel_copy_text(const char *text);

#endif
