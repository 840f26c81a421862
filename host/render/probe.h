// probe.h - inside the render module: one ray that tells what it meets.
#ifndef PEL_RENDER_PROBE_H
#define PEL_RENDER_PROBE_H

#include "device/device.h"
#include "render/residency.h"
#include "world/world.h"

// A frame that is ready to run, in the variant for probes; `render` is NULL when nothing is
// visible.
struct pel_probe_inputs {
    struct pel_device *device;
    const struct pel_kernel *render;
    const struct pel_residency *residency;
    const struct pel_buffer *world_buffer, *tables, *cells, *strides; // NULL: none
    const struct pel_scene *scene;
    const struct pel_world *world;
};

// Fails for a pixel outside the picture (ARGUMENT), and where no samples are taken (UNSUPPORTED).
bool pel_probe_check(const struct pel_scene *scene, int x, int y);

// Follows the ray through the centre of pixel (x, y). False (DEVICE, MEMORY, BUILD), and nothing in
// `probe`, on failure.
bool pel_probe_run(const struct pel_probe_inputs *inputs, int x, int y, struct pel_probe *probe);

#endif
