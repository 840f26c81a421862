// target.h - where the kernel leaves the picture.
#ifndef PEL_RENDER_TARGET_H
#define PEL_RENDER_TARGET_H

#include "device/device.h"

// Zero-initialise.
struct pel_target {
    struct pel_buffer *buffer; // what kernels write
    size_t bytes;              // its size, 0 while it is the image's own memory
};

// Makes the target ready for a picture that ends in `image`: on a CPU the image's own memory, so
// that nothing has to be brought here, elsewhere, and for an image without pixels, a buffer. False:
// DEVICE, MEMORY.
bool pel_target_begin(struct pel_target *target, struct pel_device *device,
                      struct pel_image *image);

// Waits until the picture is in the image that the target was made ready for; unless `good`, only
// lets go of that. What has no pixels stays in the buffer. False: DEVICE, or not good.
bool pel_target_end(struct pel_target *target, struct pel_image *image, bool good);

void pel_target_finish(struct pel_target *target);

#endif
