// share.c - pictures that stay on the device, in a buffer of OpenGL.
//
// Rays leave floats in memory of our own, for as long as that takes, and only a kernel that rounds
// them to what a window shows needs OpenGL's buffer. So a frame that is abandoned never touches it,
// and what travels from OpenCL to OpenGL are the 8-bit pixels that would have travelled through the
// host. OpenCL's object for a buffer is kept from frame to frame, for making one is slow.
#include "render/share.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "output/image.h"

enum { GROUP = 16 };

struct pel_image *pel_share_create_image(const struct pel_share *share,
                                         const struct pel_device *device,
                                         const struct pel_render_settings *settings, int pictures,
                                         const struct pel_render_options *options,
                                         struct pel_render_statistics *statistics) {
    int width = settings->width, height = pictures * settings->height;
    if (!options || !options->gl_buffer)
        return pel_image_create_undefined(width, height);
    const char *reason = share->broken[0]                    ? share->broken
                         : settings->debug != PEL_DEBUG_NONE ? "a debug view is painted on the host"
                                                             : pel_device_unshared(device);
    snprintf(statistics->gl_reason, sizeof statistics->gl_reason, "%s", reason);
    if (reason[0])
        return pel_image_create_undefined(width, height);
    struct pel_image *image = pel_allocate(1, sizeof *image);
    if (image)
        *image = (struct pel_image){width, height, NULL};
    return image;
}

static void drop(struct pel_share *share, int i) {
    pel_buffer_destroy(share->buffers[i].buffer);
    share->count--;
    memmove(&share->buffers[i], &share->buffers[i + 1],
            (size_t)(share->count - i) * sizeof share->buffers[i]);
}

static struct pel_buffer *find_buffer(struct pel_share *share, struct pel_device *device,
                                      uint32_t name) {
    for (int i = 0; i < share->count; i++)
        if (share->buffers[i].name == name)
            return share->buffers[i].buffer;
    if (share->count == PEL_SHARE_BUFFERS)
        drop(share, 0);
    struct pel_buffer *buffer = pel_buffer_share(device, name);
    if (buffer) {
        share->buffers[share->count].name = name;
        share->buffers[share->count++].buffer = buffer;
    }
    return buffer;
}

// What is acquired is released, whatever happens between.
static bool run(struct pel_kernel *kernel, struct pel_buffer *buffer, size_t pixels) {
    if (!pel_buffer_acquire(buffer))
        return false;
    bool good = pel_kernel_launch(kernel, (pixels + GROUP - 1) / GROUP * GROUP, GROUP);
    return pel_buffer_release(buffer) && good;
}

static bool put(struct pel_share *share, struct pel_device *device, const struct pel_buffer *from,
                const struct pel_render_settings *widened, const int size[2],
                const uint32_t corner[2], uint32_t name) {
    size_t pixels = (size_t)size[0] * (size_t)size[1];
    uint32_t row = (uint32_t)widened->width;
    struct pel_buffer *buffer = find_buffer(share, device, name);
    if (!buffer)
        return false;
    if (pel_buffer_bytes(buffer) < 4 * pixels)
        return pel_fail(PEL_ERROR_ARGUMENT, "the buffer has %zu bytes, of %zu",
                        pel_buffer_bytes(buffer), 4 * pixels);
    if (!share->kernel)
        share->kernel = pel_kernel_build(device, "present.cl", "present", "");
    struct pel_kernel *kernel = share->kernel;
    return kernel && pel_kernel_set_buffer(kernel, 0, from) &&
           pel_kernel_set_buffer(kernel, 1, buffer) &&
           pel_kernel_set_u32(kernel, 2, (uint32_t)size[0]) &&
           pel_kernel_set_u32(kernel, 3, (uint32_t)size[1]) && pel_kernel_set_u32(kernel, 4, row) &&
           pel_kernel_set_u32(kernel, 5, corner[1] * row + corner[0]) &&
           run(kernel, buffer, pixels);
}

bool pel_share_put(struct pel_share *share, struct pel_device *device, struct pel_target *target,
                   struct pel_image *image, const struct pel_render_settings *widened,
                   const struct pel_render_settings *asked,
                   const struct pel_render_options *options,
                   struct pel_render_statistics *statistics) {
    double begin_ms = pel_clock_ms();
    bool part = asked->region[2] > 0;
    const int size[2] = {part ? asked->region[2] : image->width,
                         part ? asked->region[3] : image->height};
    const uint32_t corner[2] = {(uint32_t)(asked->region[0] - widened->region[0]),
                                (uint32_t)(asked->region[1] - widened->region[1])};
    bool good = put(share, device, target->buffer, widened, size, corner, options->gl_buffer);
    if (good) {
        image->width = size[0];
        image->height = size[1];
    } else {
        // The next frame does not try again, and this one's rays are not lost.
        snprintf(share->broken, sizeof share->broken, "%s", pel_error_message());
        memcpy(statistics->gl_reason, share->broken, sizeof share->broken);
        size_t floats = (size_t)image->width * (size_t)image->height * 4;
        image->rgba = pel_allocate(floats, sizeof *image->rgba);
        good = image->rgba &&
               pel_buffer_read(target->buffer, 0, floats * sizeof *image->rgba, image->rgba);
    }
    statistics->download_ms += pel_clock_ms() - begin_ms;
    return good;
}

void pel_share_forget(struct pel_share *share, uint32_t name) {
    for (int i = share->count - 1; i >= 0; i--)
        if (share->buffers[i].name == name)
            drop(share, i);
}

void pel_share_finish(struct pel_share *share) {
    while (share->count > 0)
        drop(share, share->count - 1);
    pel_kernel_destroy(share->kernel);
    share->kernel = NULL;
}
