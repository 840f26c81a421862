// tiles.h - inside the render module: a kernel's way over the tiles of a picture.
#ifndef PEL_RENDER_TILES_H
#define PEL_RENDER_TILES_H

#include "device/device.h"

// Where the kernel finds what changes from launch to launch.
enum { PEL_LIGHT_ARGUMENT = 2, PEL_FIRST_TILE_ARGUMENT = 4, PEL_RAY_ARGUMENT = 6 };

// How a picture's tiles are handed out. A work-group may span several tiles, so launches are
// rounded up to whole groups; the tiles beyond the picture's end do nothing.
struct pel_tiling {
    size_t tiles, packets_per_tile, group, tiles_per_group;
};

// How long tiles take. Zero-initialise.
struct pel_pace {
    double tiles_per_ms; // as the last frame ran; 0 = unknown
    float *tile_ms;      // what each tile takes, while a debug view asks for it
};

// Which of how many times the kernel runs over the tiles.
struct pel_pass {
    int number, count;
};

// The tiles of `pictures` pictures.
struct pel_tiling pel_tiles_plan(const struct pel_render_settings *settings, int pictures,
                                 int lanes, size_t group);

// Runs the kernel over all tiles, in batches, and waits for it. False: DEVICE, or ARGUMENT when
// the caller abandons the frame.
bool pel_tiles_run(struct pel_pace *pace, struct pel_device *device, struct pel_kernel *kernel,
                   const struct pel_tiling *tiling, const struct pel_render_options *options,
                   struct pel_pass pass);

#endif
