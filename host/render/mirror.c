// mirror.c - a buffer on the device with a copy of what was last sent there.
#include "render/mirror.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { BLOCK_BYTES = 4096 };

void pel_mirror_finish(struct pel_mirror *mirror) {
    pel_buffer_destroy(mirror->buffer);
    free(mirror->copy);
    *mirror = (struct pel_mirror){0};
}

static bool make_room(struct pel_mirror *mirror, struct pel_device *device, size_t bytes,
                      const char *purpose) {
    pel_mirror_finish(mirror);
    mirror->buffer = pel_buffer_create(device, bytes, purpose);
    mirror->copy = pel_allocate(bytes, 1);
    mirror->bytes = bytes;
    if (mirror->buffer && mirror->copy)
        return true;
    pel_mirror_finish(mirror);
    return false;
}

bool pel_mirror_update(struct pel_mirror *mirror, struct pel_device *device, const void *data,
                       size_t bytes, size_t head, const char *purpose, bool *changed) {
    bool fresh = !mirror->buffer || bytes != mirror->bytes;
    if (fresh && !make_room(mirror, device, bytes, purpose))
        return false;
    size_t end;
    for (size_t start = 0; start < bytes; start = end) {
        end = start == 0 && head > 0 ? head : start + BLOCK_BYTES;
        if (end > bytes)
            end = bytes;
        const char *block = (const char *)data + start;
        char *copy = (char *)mirror->copy + start;
        if (!fresh && memcmp(block, copy, end - start) == 0)
            continue;
        if (!pel_buffer_write(mirror->buffer, start, end - start, block)) {
            // What is there now, nobody knows.
            pel_mirror_finish(mirror);
            return false;
        }
        memcpy(copy, block, end - start);
        if (changed)
            *changed = true;
    }
    return true;
}

bool pel_mirror_update_words(struct pel_mirror *mirror, struct pel_device *device,
                             const struct pel_memo_words *words, const char *purpose,
                             bool *changed) {
    size_t bytes = words->count * sizeof *words->words;
    if (mirror->buffer && mirror->bytes == bytes && mirror->version == words->version)
        return true;
    mirror->version = 0;
    if (!pel_mirror_update(mirror, device, words->words, bytes, 0, purpose, changed))
        return false;
    mirror->version = words->version;
    return true;
}
