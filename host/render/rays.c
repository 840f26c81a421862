// rays.c - one ray for each pixel in one pass over the tiles, or with supersampling one pass for
// each ray of a pixel, added up as they come (kernels/resolve.cl).
#include "render/rays.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "shared/pattern.h"
#include "shared/variant.h"

static bool run_pass(const struct pel_rays *rays, struct pel_pass pass) {
    return pel_tiles_run(rays->pace, rays->device, rays->kernel, rays->tiling, rays->options, pass);
}

// Runs the kernel for one ray of each pixel after the other, and adds them up.
static bool cast_all(const struct pel_rays *rays, struct pel_render_statistics *statistics) {
    const struct pel_supersampling *supersampling = &rays->scene->render.supersampling;
    size_t pixels = pel_world_pixels(rays->world);
    bool adaptive = (float)supersampling->adaptive > 0; // as the kernels read it
    int n = supersampling->n > 1 ? supersampling->n : 1;
    struct pel_pass pass = {0, n * n + adaptive};
    double slowest = INFINITY; // tiles per millisecond
    statistics->rays = pixels * (uint64_t)(n * n);
    if (adaptive) {
        uint64_t refined;
        if (!pel_kernel_set_u32(rays->kernel, PEL_RAY_ARGUMENT, RAY_CENTRE) ||
            !run_pass(rays, pass) ||
            !pel_resolve_refine(rays->resolve, rays->world_buffer, pixels, &refined))
            return false;
        statistics->rays = pixels + refined * (uint64_t)(n * n);
        statistics->refined = (double)refined / (double)pixels;
        slowest = rays->pace->tiles_per_ms;
        pass.number++;
    }
    for (int ray = 0; ray < n * n; ray++, pass.number++) {
        if (!pel_kernel_set_u32(rays->kernel, PEL_RAY_ARGUMENT, (uint32_t)ray) ||
            !run_pass(rays, pass) ||
            !pel_resolve_add(rays->resolve, rays->world_buffer, rays->picture, pixels, ray))
            return false;
        slowest = fmin(slowest, rays->pace->tiles_per_ms);
    }
    // The next frame may begin with all pixels where this one ended with few.
    rays->pace->tiles_per_ms = slowest;
    return pel_device_finish(rays->device);
}

// Runs the kernel for one ray of each of some pixels.
static bool cast_only(const struct pel_rays *rays, struct pel_render_statistics *statistics) {
    size_t pixels = pel_world_pixels(rays->world),
           packets = rays->tiling->tiles * rays->tiling->packets_per_tile;
    // The kernel takes this for a later ray of each pixel, and goes on counting.
    uint32_t *zeros = pel_allocate(packets * SAMPLE_COUNTS, sizeof *zeros);
    bool good =
        zeros &&
        pel_buffer_write(rays->sample_counts, 0, packets * SAMPLE_COUNTS * sizeof *zeros, zeros) &&
        pel_buffer_write(rays->resolve->refined, 0, pixels, rays->only) &&
        pel_kernel_set_u32(rays->kernel, PEL_RAY_ARGUMENT, 0) &&
        run_pass(rays, (struct pel_pass){0, 1});
    free(zeros);
    statistics->rays = 0;
    for (size_t i = 0; i < pixels; i++)
        statistics->rays += rays->only[i] != 0;
    return good;
}

bool pel_rays_cast(const struct pel_rays *rays, struct pel_render_statistics *statistics) {
    const struct pel_world *world = rays->world;
    statistics->rays = (uint64_t)world->bytes.width * (uint64_t)world->bytes.height *
                       (uint64_t)pel_world_eyes(world);
    statistics->refined = 1;
    if (rays->only)
        return cast_only(rays, statistics);
    if (world->supersampling)
        return cast_all(rays, statistics);
    if (rays->scene->render.debug == PEL_DEBUG_TIME) {
        rays->pace->tile_ms = pel_allocate(rays->tiling->tiles, sizeof *rays->pace->tile_ms);
        if (!rays->pace->tile_ms)
            return false;
    }
    return run_pass(rays, (struct pel_pass){0, 1});
}
