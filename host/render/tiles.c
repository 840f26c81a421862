// tiles.c - a kernel's way over the tiles of a picture, in batches short enough for a frame to be
// abandoned soon.
#include "render/tiles.h"

#include <math.h>

#include "base/error.h"
#include "shared/tiles.h"

static const double batch_default_ms = 150; // of a batch of tiles, unless the caller says otherwise

static size_t round_up(size_t value, size_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

struct pel_tiling pel_tiles_plan(const struct pel_render_settings *settings, int pictures,
                                 int lanes, size_t group) {
    size_t tiles = (size_t)TILES_ALONG(settings->width) * (size_t)TILES_ALONG(settings->height);
    size_t packets = TILE_PX * TILE_PX / (size_t)lanes;
    return (struct pel_tiling){(size_t)pictures * tiles, packets, group,
                               group > packets ? group / packets : 1};
}

// Runs the kernel over `count` tiles from `first` on and waits for it.
static bool run_batch(struct pel_device *device, struct pel_kernel *kernel,
                      const struct pel_tiling *tiling, size_t first, size_t count) {
    size_t items = round_up(count, tiling->tiles_per_group) * tiling->packets_per_tile;
    return pel_kernel_set_u32(kernel, PEL_FIRST_TILE_ARGUMENT, (uint32_t)first) &&
           pel_kernel_launch(kernel, items, tiling->group) && pel_device_finish(device);
}

bool pel_tiles_run(struct pel_pace *pace, struct pel_device *device, struct pel_kernel *kernel,
                   const struct pel_tiling *tiling, const struct pel_render_options *options,
                   struct pel_pass pass) {
    enum { FIRST_BATCH = 64 };
    double start_ms = pel_clock_ms();
    double batch_ms = options && options->batch_ms > 0 ? options->batch_ms : batch_default_ms;
    // The frame before may have had cheaper tiles, so the first batch only looks how these are.
    // Those of the border (shared/tiles.h) tell little of what is to come: as they are, batches may
    // have twice the tiles that they had of the last frame.
    double usual = pace->tiles_per_ms > 0 ? pace->tiles_per_ms * batch_ms : INFINITY;
    double batch = pace->tiles_per_ms > 0 ? usual / 4 : FIRST_BATCH;
    for (size_t tile = 0; tile < tiling->tiles;) {
        size_t left = tiling->tiles - tile;
        // A little that would be left alone keeps fewer threads busy than it needs.
        size_t count = batch < 1 ? 1 : 1.25 * batch < (double)left ? (size_t)batch : left;
        if (pace->tile_ms)
            count = 1;
        count = round_up(count, tiling->tiles_per_group);
        if (count > left)
            count = left;
        // A first launch warms up what it needs, and should not count.
        if (pace->tile_ms && tile == 0 && !run_batch(device, kernel, tiling, 0, count))
            return false;
        double begin_ms = pel_clock_ms();
        if (!run_batch(device, kernel, tiling, tile, count))
            return false;
        double took_ms = pel_clock_ms() - begin_ms;
        for (size_t i = 0; pace->tile_ms && i < count; i++)
            pace->tile_ms[tile + i] = (float)(took_ms / (double)count);
        tile += count;
        double finished = pass.number + (double)tile / (double)tiling->tiles;
        if (options && options->progress &&
            !options->progress(finished / pass.count, options->user))
            return pel_fail(PEL_ERROR_ARGUMENT, "the frame was abandoned");
        // The next batch aims at the set time, but one measurement makes it grow fourfold at most.
        batch = (double)count / fmax(took_ms, 0.05) * batch_ms;
        batch = fmin(batch, fmin(4.0 * (double)count, 2.0 * usual));
    }
    pace->tiles_per_ms = (double)tiling->tiles / fmax(pel_clock_ms() - start_ms, 0.05);
    return true;
}
