// mirror.h - a buffer on the device with a copy of what was last sent there, so that only changes
// travel.
#ifndef PEL_RENDER_MIRROR_H
#define PEL_RENDER_MIRROR_H

#include "device/device.h"
#include "world/memo.h"

// Zero-initialise.
struct pel_mirror {
    struct pel_buffer *buffer; // NULL until the first update
    void *copy;
    size_t bytes;
    uint64_t version; // of the words that are there
};

// Makes the buffer hold `data`. The first `head` bytes travel by themselves, the rest in blocks,
// and only those that differ from what is there; *changed (unless NULL) is set to true when any
// did. False: DEVICE, MEMORY.
bool pel_mirror_update(struct pel_mirror *mirror, struct pel_device *device, const void *data,
                       size_t bytes, size_t head, const char *purpose, bool *changed);

// The same for words that stay from frame to frame, which are not even looked at where they are of
// the version that was sent last.
bool pel_mirror_update_words(struct pel_mirror *mirror, struct pel_device *device,
                             const struct pel_memo_words *words, const char *purpose,
                             bool *changed);
void pel_mirror_finish(struct pel_mirror *mirror);

#endif
