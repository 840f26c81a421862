// share.h - inside the render module: pictures that stay on the device, in a buffer of OpenGL.
#ifndef PEL_RENDER_SHARE_H
#define PEL_RENDER_SHARE_H

#include "render/target.h"

enum { PEL_SHARE_BUFFERS = 64 };

// Zero-initialise.
struct pel_share {
    struct pel_kernel *kernel;
    struct {
        uint32_t name; // OpenGL's
        struct pel_buffer *buffer;
    } buffers[PEL_SHARE_BUFFERS]; // the oldest first
    int count;
    char broken[PEL_GL_REASON_BYTES]; // why sharing failed, after which it is not tried again
};

// An image of any content for so many pictures above each other: without pixels when they can stay
// on the device for the buffer that the options name. Where that is wanted and cannot be, the
// statistics say why.
struct pel_image *pel_share_create_image(const struct pel_share *share,
                                         const struct pel_device *device,
                                         const struct pel_render_settings *settings, int pictures,
                                         const struct pel_render_options *options,
                                         struct pel_render_statistics *statistics);

// Brings the picture that kernels left in the target into that buffer: of what was made (`widened`)
// the part that was asked for. `image` is without pixels and takes that size; when sharing fails,
// it gets its pixels after all. False: MEMORY, DEVICE.
bool pel_share_put(struct pel_share *share, struct pel_device *device, struct pel_target *target,
                   struct pel_image *image, const struct pel_render_settings *widened,
                   const struct pel_render_settings *asked,
                   const struct pel_render_options *options,
                   struct pel_render_statistics *statistics);

// Lets go of one buffer, or of all.
void pel_share_forget(struct pel_share *share, uint32_t name);
void pel_share_finish(struct pel_share *share);

#endif
