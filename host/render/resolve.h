// resolve.h - supersampling's passes over pixels: where more rays are needed, and how rays become a
// picture.
#ifndef PEL_RENDER_RESOLVE_H
#define PEL_RENDER_RESOLVE_H

#include "device/device.h"

// What supersampling needs on the device for each pixel.
enum { PEL_RESOLVE_BYTES = 16 + 4 + 1 };

// Zero-initialise.
struct pel_resolve {
    struct pel_kernel *refine, *resolve;
    struct pel_buffer *light;   // float4: what one ray of each pixel brought
    struct pel_buffer *weights; // float: the sum of the weights so far
    struct pel_buffer *refined; // a byte: whether the pixel gets all of its rays
    size_t pixels;              // room in each
};

// Makes room for a picture. The kernels come from the program of `render`, one that supersamples.
// False: DEVICE, MEMORY.
bool pel_resolve_prepare(struct pel_resolve *resolve, struct pel_device *device,
                         const struct pel_kernel *render, size_t pixels);

// Marks the pixels that get all their rays, by the light of one ray each, and counts them.
bool pel_resolve_refine(struct pel_resolve *resolve, const struct pel_buffer *world, size_t pixels,
                        uint64_t *refined);

// Adds the light of ray number `ray` of every pixel to the picture. Ray 0 begins a picture, the
// last ray finishes it.
bool pel_resolve_add(struct pel_resolve *resolve, const struct pel_buffer *world,
                     const struct pel_buffer *picture, size_t pixels, int ray);
void pel_resolve_finish(struct pel_resolve *resolve);

#endif
