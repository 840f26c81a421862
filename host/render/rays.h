// rays.h - inside the render module: the rays of one picture, and the passes that cast them.
#ifndef PEL_RENDER_RAYS_H
#define PEL_RENDER_RAYS_H

#include "render/resolve.h"
#include "render/tiles.h"
#include "world/world.h"

// What a picture's passes work with, all of it borrowed.
struct pel_rays {
    struct pel_device *device;
    struct pel_kernel *kernel; // with its arguments bound, but for the first tile and the ray
    const struct pel_tiling *tiling;
    struct pel_pace *pace;
    struct pel_resolve *resolve;              // prepared, where the world is supersampled
    struct pel_buffer *world_buffer;          // the world's bytes
    struct pel_buffer *picture;               // where resolved pixels go
    struct pel_buffer *sample_counts;         // of each packet
    const struct pel_scene *scene;            //
    const struct pel_world *world;            //
    const uint8_t *only;                      // as pel_frame_eyes has it; may be NULL
    const struct pel_render_options *options; // may be NULL
};

// Runs the kernel as often as the picture needs, and counts the rays. False: MEMORY, DEVICE, or
// ARGUMENT when the caller abandons the frame.
bool pel_rays_cast(const struct pel_rays *rays, struct pel_render_statistics *statistics);

#endif
