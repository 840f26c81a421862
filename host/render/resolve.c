// resolve.c - supersampling's passes over pixels: where more rays are needed, and how rays become a
// picture.
#include "render/resolve.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

// Launches cover so many pixels, so that none takes long.
enum { GROUP = 16, LAUNCH = 1 << 20 };

static bool find_kernels(struct pel_resolve *resolve, const struct pel_kernel *render) {
    if (!resolve->refine)
        resolve->refine = pel_kernel_sibling(render, "refine");
    if (resolve->refine && !resolve->resolve)
        resolve->resolve = pel_kernel_sibling(render, "resolve");
    return resolve->refine && resolve->resolve;
}

static void drop_buffers(struct pel_resolve *resolve) {
    pel_buffer_destroy(resolve->light);
    pel_buffer_destroy(resolve->weights);
    pel_buffer_destroy(resolve->refined);
    resolve->light = resolve->weights = resolve->refined = NULL;
    resolve->pixels = 0;
}

static bool make_room(struct pel_resolve *resolve, struct pel_device *device, size_t pixels) {
    if (pixels <= resolve->pixels)
        return true;
    drop_buffers(resolve);
    resolve->light = pel_buffer_create(device, 16 * pixels, "the light of rays");
    resolve->weights = pel_buffer_create(device, 4 * pixels, "the weights of rays");
    resolve->refined = pel_buffer_create(device, pixels, "the pixels to refine");
    resolve->pixels = pixels;
    if (resolve->light && resolve->weights && resolve->refined)
        return true;
    drop_buffers(resolve);
    return false;
}

// Runs a kernel over all pixels; the first pixel of a launch is argument `argument`.
static bool run(struct pel_kernel *kernel, int argument, size_t pixels) {
    for (size_t first = 0; first < pixels; first += LAUNCH) {
        size_t count = pixels - first < LAUNCH ? pixels - first : LAUNCH;
        if (!pel_kernel_set_u32(kernel, argument, (uint32_t)first) ||
            !pel_kernel_launch(kernel, (count + GROUP - 1) / GROUP * GROUP, GROUP))
            return false;
    }
    return true;
}

bool pel_resolve_prepare(struct pel_resolve *resolve, struct pel_device *device,
                         const struct pel_kernel *render, size_t pixels) {
    return find_kernels(resolve, render) && make_room(resolve, device, pixels);
}

bool pel_resolve_refine(struct pel_resolve *resolve, const struct pel_buffer *world, size_t pixels,
                        uint64_t *refined) {
    struct pel_kernel *kernel = resolve->refine;
    uint8_t *marks = pel_allocate(pixels, 1);
    bool good = marks && pel_kernel_set_buffer(kernel, 0, world) &&
                pel_kernel_set_buffer(kernel, 1, resolve->light) &&
                pel_kernel_set_buffer(kernel, 2, resolve->refined) && run(kernel, 3, pixels) &&
                pel_buffer_read(resolve->refined, 0, pixels, marks);
    *refined = 0;
    for (size_t i = 0; good && i < pixels; i++)
        *refined += marks[i];
    free(marks);
    return good;
}

bool pel_resolve_add(struct pel_resolve *resolve, const struct pel_buffer *world,
                     const struct pel_buffer *picture, size_t pixels, int ray) {
    struct pel_kernel *kernel = resolve->resolve;
    return pel_kernel_set_buffer(kernel, 0, world) &&
           pel_kernel_set_buffer(kernel, 1, resolve->light) &&
           pel_kernel_set_buffer(kernel, 2, picture) &&
           pel_kernel_set_buffer(kernel, 3, resolve->weights) &&
           pel_kernel_set_u32(kernel, 4, (uint32_t)ray) && run(kernel, 5, pixels);
}

void pel_resolve_finish(struct pel_resolve *resolve) {
    pel_kernel_destroy(resolve->refine);
    pel_kernel_destroy(resolve->resolve);
    drop_buffers(resolve);
    memset(resolve, 0, sizeof *resolve);
}
