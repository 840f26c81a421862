// renderer.c - the frame loop.
//
// A frame is: plan where voxels lie, make the world's bytes, send what changed, choose the kernel,
// and run it over the tiles in short batches. What is on the device stays for the next frame.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "device/device.h"
#include "render/bakery.h"
#include "render/debug.h"
#include "render/detail.h"
#include "render/frame.h"
#include "render/kernel_cache.h"
#include "render/mirror.h"
#include "render/occupancy.h"
#include "render/probe.h"
#include "render/region.h"
#include "render/residency.h"
#include "render/resolve.h"
#include "render/target.h"
#include "render/settings.h"
#include "render/variant.h"
#include "shared/pattern.h"
#include "world/skip.h"

static const double batch_default_ms = 150; // of a batch of tiles, unless the caller says otherwise

struct pel_renderer {
    struct pel_device *device;
    struct pel_renderer_options options;
    struct pel_residency residency;
    struct pel_kernel_cache kernels;
    struct pel_mirror world, tables;
    struct pel_occupancy occupancy;
    struct pel_resolve resolve;
    struct pel_bakery bakery;
    struct pel_detail detail;
    struct pel_target target;
    struct pel_buffer *sample_counts;
    size_t sample_counts_bytes;
    double tiles_per_ms; // as the last frame ran; 0 = unknown
    float *tile_ms;      // what each tile takes, while a debug view asks for it
};

// Time since *mark, which moves to now.
static double lap_ms(double *mark) {
    double now = pel_clock_ms(), elapsed = now - *mark;
    *mark = now;
    return elapsed;
}

// ---- What is on the device ---------------------------------------------------------------------

// A buffer of at least `bytes`, made anew when it is too small.
static bool grow_buffer(struct pel_buffer **buffer, size_t *have, size_t bytes,
                        struct pel_device *device, const char *purpose) {
    if (bytes <= *have)
        return true;
    pel_buffer_destroy(*buffer);
    *buffer = pel_buffer_create(device, bytes, purpose);
    *have = *buffer ? bytes : 0;
    return *buffer != NULL;
}

// ---- One frame ---------------------------------------------------------------------------------

// How a picture's tiles are handed out. A work-group may span several tiles, so launches are
// rounded up to whole groups; the tiles beyond the picture's end do nothing.
struct extent {
    size_t tiles, packets_per_tile, group, tiles_per_group;
};

static struct extent picture_extent(const struct pel_render_settings *settings, int lanes,
                                    size_t group) {
    size_t tiles_x = ((size_t)settings->width + TILE_PX - 1) / TILE_PX;
    size_t tiles_y = ((size_t)settings->height + TILE_PX - 1) / TILE_PX;
    size_t packets = TILE_PX * TILE_PX / (size_t)lanes;
    return (struct extent){tiles_x * tiles_y, packets, group,
                           group > packets ? group / packets : 1};
}

static size_t round_up(size_t value, size_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

// Where the kernel finds what changes from launch to launch.
enum { LIGHT_ARGUMENT = 2, FIRST_TILE_ARGUMENT = 4, RAY_ARGUMENT = 6 };

// Binds everything but where light goes, the first tile, and the ray's number, in the order of the
// kernel's parameters. A kernel has an atlas for each class in `voxels` only.
static bool set_arguments(struct pel_renderer *renderer, struct pel_kernel *kernel,
                          const struct pel_variant *variant) {
    int index = 0;
    bool good = pel_kernel_set_buffer(kernel, index++, renderer->world.buffer) &&
                pel_kernel_set_buffer(kernel, index++, renderer->tables.buffer) &&
                pel_kernel_set_buffer(kernel, LIGHT_ARGUMENT + 1, renderer->sample_counts);
    index = FIRST_TILE_ARGUMENT + 1; // what is between is set for each frame and each batch
    good = good && pel_kernel_set_buffer(kernel, index++, pel_occupancy_map(&renderer->occupancy));
    if (variant->supersampling) {
        index++; // the ray's number is set for each pass
        good = good && pel_kernel_set_buffer(kernel, index++, renderer->resolve.refined);
    }
    return good && pel_residency_bind(&renderer->residency, kernel, index, variant->voxels);
}

// Runs the kernel over `count` tiles from `first` on and waits for it.
static bool run_batch(struct pel_renderer *renderer, struct pel_kernel *kernel,
                      const struct extent *extent, size_t first, size_t count) {
    size_t items = round_up(count, extent->tiles_per_group) * extent->packets_per_tile;
    return pel_kernel_set_u32(kernel, FIRST_TILE_ARGUMENT, (uint32_t)first) &&
           pel_kernel_launch(kernel, items, extent->group) && pel_device_finish(renderer->device);
}

// Which of how many times the kernel runs over the tiles.
struct pass {
    int number, count;
};

// Runs the kernel over all tiles, in batches.
static bool run_tiles(struct pel_renderer *renderer, struct pel_kernel *kernel,
                      const struct extent *extent, const struct pel_render_options *options,
                      struct pass pass) {
    enum { FIRST_BATCH = 64 };
    double start = pel_clock_ms(), mark = start;
    double batch_ms = options && options->batch_ms > 0 ? options->batch_ms : batch_default_ms;
    // The frame before may have had cheaper tiles, so the first batch only looks how these are.
    double batch = renderer->tiles_per_ms > 0 ? renderer->tiles_per_ms * batch_ms / 4 : FIRST_BATCH;
    for (size_t tile = 0; tile < extent->tiles;) {
        size_t left = extent->tiles - tile;
        size_t count = batch < 1 ? 1 : batch < (double)left ? (size_t)batch : left;
        if (renderer->tile_ms)
            count = 1;
        count = round_up(count, extent->tiles_per_group);
        if (count > left)
            count = left;
        // A first launch warms up what it needs, and should not count.
        if (renderer->tile_ms && tile == 0 && !run_batch(renderer, kernel, extent, 0, count))
            return false;
        double begin_ms = pel_clock_ms();
        if (!run_batch(renderer, kernel, extent, tile, count))
            return false;
        for (size_t i = 0; renderer->tile_ms && i < count; i++)
            renderer->tile_ms[tile + i] = (float)((pel_clock_ms() - begin_ms) / (double)count);
        tile += count;
        double finished = pass.number + (double)tile / (double)extent->tiles;
        if (options && options->progress &&
            !options->progress(finished / pass.count, options->user))
            return pel_fail(PEL_ERROR_ARGUMENT, "the frame was abandoned");
        // The next batch aims at the set time, but one measurement makes it grow fourfold at most.
        double per_ms = (double)count / fmax(lap_ms(&mark), 0.05);
        batch = fmin(per_ms * batch_ms, 4.0 * (double)count);
    }
    renderer->tiles_per_ms = (double)extent->tiles / fmax(pel_clock_ms() - start, 0.05);
    return true;
}

// Runs the kernel for one ray of each pixel after the other, and adds them up.
static bool run_rays(struct pel_renderer *renderer, struct pel_kernel *kernel,
                     const struct pel_scene *scene, const struct extent *extent,
                     const struct pel_render_options *options,
                     struct pel_render_statistics *statistics) {
    const struct pel_supersampling *supersampling = &scene->render.supersampling;
    size_t pixels = (size_t)scene->render.width * (size_t)scene->render.height;
    bool adaptive = (float)supersampling->adaptive > 0; // as the kernels read it
    int n = supersampling->n > 1 ? supersampling->n : 1;
    struct pass pass = {0, n * n + adaptive};
    double slowest = INFINITY; // tiles per millisecond
    statistics->rays = pixels * (uint64_t)(n * n);
    if (adaptive) {
        uint64_t refined;
        if (!pel_kernel_set_u32(kernel, RAY_ARGUMENT, RAY_CENTRE) ||
            !run_tiles(renderer, kernel, extent, options, pass) ||
            !pel_resolve_refine(&renderer->resolve, renderer->world.buffer, pixels, &refined))
            return false;
        statistics->rays = pixels + refined * (uint64_t)(n * n);
        statistics->refined = (double)refined / (double)pixels;
        slowest = renderer->tiles_per_ms;
        pass.number++;
    }
    for (int ray = 0; ray < n * n; ray++, pass.number++) {
        if (!pel_kernel_set_u32(kernel, RAY_ARGUMENT, (uint32_t)ray) ||
            !run_tiles(renderer, kernel, extent, options, pass) ||
            !pel_resolve_add(&renderer->resolve, renderer->world.buffer, renderer->target.buffer,
                             pixels, ray))
            return false;
        slowest = fmin(slowest, renderer->tiles_per_ms);
    }
    // The next frame may begin with all pixels where this one ended with few.
    renderer->tiles_per_ms = slowest;
    return pel_device_finish(renderer->device);
}

// Adds up what the packets have counted.
static void count_samples(struct pel_renderer *renderer, size_t packets,
                          struct pel_render_statistics *statistics) {
    uint32_t(*counts)[SAMPLE_COUNTS] = pel_allocate(packets, sizeof *counts);
    uint64_t possible = 0;
    if (counts && pel_buffer_read(renderer->sample_counts, 0, packets * sizeof *counts, counts)) {
        for (size_t i = 0; i < packets; i++) {
            statistics->samples += counts[i][SAMPLES_TAKEN];
            statistics->samples_terminated += counts[i][SAMPLES_BEHIND];
            possible += counts[i][SAMPLES_POSSIBLE];
        }
        statistics->samples_skipped =
            possible - statistics->samples - statistics->samples_terminated;
    }
    free(counts);
}

// The work-group that the user, the device or the kernel allows: a power of two.
static size_t choose_group(const struct pel_renderer *renderer, const struct pel_kernel *kernel) {
    int wanted = renderer->options.work_group;
    if (!wanted)
        wanted = pel_device_describe(renderer->device)->work_group;
    size_t most = pel_kernel_max_group(kernel);
    size_t group = 1;
    while (group * 2 <= (size_t)wanted && group * 2 <= most)
        group *= 2;
    return group;
}

// Sends what changed and gives back the kernel, ready to run; NULL on failure.
static struct pel_kernel *prepare(struct pel_renderer *renderer, const struct pel_scene *scene,
                                  const struct pel_layout *layout, const struct pel_world *world,
                                  struct extent *extent, struct pel_render_statistics *statistics) {
    double mark = pel_clock_ms();
    struct pel_device *device = renderer->device;
    int lanes = statistics->lanes;
    struct pel_variant variant =
        pel_variant_choose(world, layout->reader, statistics->skip, lanes,
                           pel_device_describe(device)->max_constant_bytes);
    if (renderer->options.work_group_rows)
        variant.group_rows = renderer->options.work_group_rows;
    struct pel_kernel *kernel = pel_kernel_cache_find(&renderer->kernels, device, &variant);
    if (!kernel)
        return NULL;
    statistics->build_ms = lap_ms(&mark);

    *extent = picture_extent(&scene->render, lanes, choose_group(renderer, kernel));
    size_t pixels = (size_t)scene->render.width * (size_t)scene->render.height;
    size_t packets = (extent->tiles + extent->tiles_per_group) * extent->packets_per_tile;
    if (!pel_residency_update(&renderer->residency, scene, layout, world) ||
        !pel_mirror_update(&renderer->world, device, &world->bytes, pel_world_bytes(world),
                           sizeof world->bytes.camera, "the scene", NULL) ||
        !pel_mirror_update(&renderer->tables, device, world->tables,
                           world->table_words * sizeof *world->tables, 0, "transfer functions",
                           NULL) ||
        (world->supersampling &&
         !pel_resolve_prepare(&renderer->resolve, device, kernel, pixels)) ||
        !grow_buffer(&renderer->sample_counts, &renderer->sample_counts_bytes,
                     packets * SAMPLE_COUNTS * sizeof(u32), device, "sample counts"))
        return NULL;
    statistics->upload_ms = lap_ms(&mark);
    struct pel_layout_limits limits =
        pel_residency_limits(device, renderer->options.max_allocation_bytes);
    if (!pel_occupancy_update(&renderer->occupancy, device, world, renderer->world.buffer,
                              &renderer->residency, scene, &limits, kernel, statistics->skip) ||
        !set_arguments(renderer, kernel, &variant))
        return NULL;
    statistics->skip_ms = lap_ms(&mark);
    if (statistics->skip != PEL_SKIP_NONE || world->pool) {
        statistics->skip_bytes = pel_occupancy_bytes(&renderer->occupancy) +
                                 pel_buffer_bytes(renderer->residency.ranges);
        statistics->bricks = pel_occupancy_bricks(&renderer->occupancy);
    }
    statistics->work_group = (int)extent->group;
    statistics->kernel = pel_kernel_describe(kernel);
    return kernel;
}

// Runs the kernel as often as a picture needs.
static bool run_passes(struct pel_renderer *renderer, struct pel_kernel *kernel,
                       const struct pel_scene *scene, const struct extent *extent,
                       bool supersampling, const struct pel_render_options *options,
                       struct pel_render_statistics *statistics) {
    statistics->rays = (uint64_t)scene->render.width * (uint64_t)scene->render.height;
    statistics->refined = 1;
    if (supersampling)
        return run_rays(renderer, kernel, scene, extent, options, statistics);
    if (scene->render.debug == PEL_DEBUG_TIME) {
        renderer->tile_ms = pel_allocate(extent->tiles, sizeof *renderer->tile_ms);
        if (!renderer->tile_ms)
            return false;
    }
    return run_tiles(renderer, kernel, extent, options, (struct pass){0, 1});
}

// Makes a debug view's picture of what came from the device.
static bool paint(struct pel_image *image, const struct pel_renderer *renderer, enum pel_debug view,
                  const struct pel_render_options *options,
                  struct pel_render_statistics *statistics) {
    size_t tiles_x = ((size_t)image->width + TILE_PX - 1) / TILE_PX;
    for (int y = 0; renderer->tile_ms && y < image->height; y++)
        for (int x = 0; x < image->width; x++)
            image->rgba[4 * ((size_t)y * (size_t)image->width + (size_t)x)] =
                renderer->tile_ms[(size_t)(y / TILE_PX) * tiles_x + (size_t)(x / TILE_PX)];
    return pel_debug_paint(image, view, options ? options->numbers : NULL, &statistics->debug);
}

// Runs the kernel and brings the picture here. The caller owns it.
static struct pel_image *run(struct pel_renderer *renderer, struct pel_kernel *kernel,
                             const struct pel_scene *scene, const struct extent *extent,
                             bool supersampling, const struct pel_render_options *options,
                             struct pel_render_statistics *statistics) {
    double mark = pel_clock_ms();
    struct pel_image *image = pel_image_create(scene->render.width, scene->render.height);
    if (!image || !pel_target_begin(&renderer->target, renderer->device, image)) {
        pel_image_destroy(image);
        return NULL;
    }
    struct pel_buffer *light = supersampling ? renderer->resolve.light : renderer->target.buffer;
    bool good = pel_kernel_set_buffer(kernel, LIGHT_ARGUMENT, light) &&
                run_passes(renderer, kernel, scene, extent, supersampling, options, statistics);
    statistics->render_ms = lap_ms(&mark);
    good = pel_target_end(&renderer->target, image, good) &&
           (scene->render.debug == PEL_DEBUG_NONE ||
            paint(image, renderer, scene->render.debug, options, statistics));
    free(renderer->tile_ms);
    renderer->tile_ms = NULL;
    if (!good) {
        pel_image_destroy(image);
        return NULL;
    }
    count_samples(renderer, extent->tiles * extent->packets_per_tile, statistics);
    statistics->download_ms = lap_ms(&mark);
    return image;
}

// The picture of nothing: the background.
static struct pel_image *render_background(const struct pel_world *world) {
    struct pel_image *image = pel_image_create(world->bytes.width, world->bytes.height);
    if (!image)
        return NULL;
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++)
        memcpy(&image->rgba[4 * i], &world->bytes.background, sizeof world->bytes.background);
    return image;
}

// Plans where the voxels lie and makes the world's bytes, which go by that. Zeroes the statistics.
static bool plan(struct pel_renderer *renderer, const struct pel_scene *scene,
                 struct pel_layout *layout, struct pel_world *world,
                 struct pel_render_statistics *statistics) {
    double mark = pel_clock_ms();
    const struct pel_device_info *info = pel_device_describe(renderer->device);
    *statistics = (struct pel_render_statistics){0};
    if (!pel_settings_check(scene))
        return false;
    struct pel_layout_limits limits =
        pel_residency_limits(renderer->device, renderer->options.max_allocation_bytes);
    if (!pel_layout_plan(layout, scene, &limits, renderer->options.reader, info->reader) ||
        !pel_world_build(world, scene, layout))
        return false;
    size_t pixels = (size_t)world->bytes.width * (size_t)world->bytes.height;
    size_t pixel_bytes = sizeof(float4) + (world->supersampling ? PEL_RESOLVE_BYTES : 0);
    if (!pel_residency_check(layout, &limits, pixels * pixel_bytes)) {
        pel_world_finish(world);
        return false;
    }
    statistics->lanes = renderer->options.lanes ? renderer->options.lanes : info->lanes;
    statistics->reader = layout->reader;
    statistics->skip = scene->render.skip;
    struct pel_skip_facts facts;
    pel_skip_find_facts(&facts, scene, world, layout->reader);
    if (scene->render.skip == PEL_SKIP_AUTO)
        statistics->skip = pel_skip_choose(&facts, statistics->skip_reason);
    else if (facts.nothing)
        statistics->skip = PEL_SKIP_NONE;
    statistics->prepare_ms = lap_ms(&mark);
    return true;
}

struct pel_image *pel_frame_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                                   const struct pel_render_options *options,
                                   struct pel_render_statistics *statistics) {
    struct pel_render_statistics unwanted;
    if (!statistics)
        statistics = &unwanted;
    uint64_t uploaded_before = pel_device_uploaded_bytes(renderer->device);
    struct pel_layout layout;
    struct pel_world world;
    struct pel_scene shown;
    if (!pel_region_check(&scene->render) ||
        !pel_bakery_show(&renderer->bakery, renderer->device, scene, &shown) ||
        !pel_detail_show(&renderer->detail, &shown))
        return NULL;
    pel_region_widen(&shown.render);
    if (!plan(renderer, &shown, &layout, &world, statistics))
        return NULL;
    // What follows knows only the part of the picture that is made.
    shown.render.width = world.bytes.width;
    shown.render.height = world.bytes.height;
    struct pel_image *image = NULL;
    if (world.bytes.part_count == 0) {
        image = render_background(&world);
    } else {
        struct extent extent;
        struct pel_kernel *kernel = prepare(renderer, &shown, &layout, &world, &extent, statistics);
        if (kernel)
            image =
                run(renderer, kernel, &shown, &extent, world.supersampling, options, statistics);
    }
    pel_world_finish(&world);
    const struct pel_device_info *info = pel_device_describe(renderer->device);
    memcpy(statistics->device, info->name, sizeof statistics->device);
    memcpy(statistics->driver, info->driver, sizeof statistics->driver);
    statistics->lod = renderer->detail.statistics;
    statistics->device_bytes = pel_device_allocated_bytes(renderer->device);
    statistics->uploaded_bytes = pel_device_uploaded_bytes(renderer->device) - uploaded_before;
    return pel_region_cut(image, &shown.render, &scene->render);
}

bool pel_renderer_probe(struct pel_renderer *renderer, const struct pel_scene *scene, int x, int y,
                        struct pel_probe *probe) {
    *probe = (struct pel_probe){0};
    if (x < 0 || y < 0 || x >= scene->render.width || y >= scene->render.height)
        return pel_fail(PEL_ERROR_ARGUMENT, "pixel %d,%d is outside the picture of %d x %d", x, y,
                        scene->render.width, scene->render.height);
    struct pel_scene seen;
    if (!pel_bakery_show(&renderer->bakery, renderer->device, scene, &seen) ||
        !pel_detail_show(&renderer->detail, &seen))
        return false;
    memset(seen.render.region, 0, sizeof seen.render.region);
    seen.render.debug = PEL_DEBUG_NONE;
    seen.render.supersampling.n = 0;
    seen.render.supersampling.pattern = PEL_PATTERN_REGULAR;
    seen.render.supersampling.filter = PEL_RECONSTRUCTION_BOX;
    struct pel_render_statistics statistics;
    struct pel_layout layout;
    struct pel_world world;
    if (!plan(renderer, &seen, &layout, &world, &statistics))
        return false;
    statistics.lanes = 1;
    world.probe = true;
    struct extent extent;
    struct pel_kernel *kernel = NULL;
    bool good = world.bytes.part_count == 0 ||
                (kernel = prepare(renderer, &seen, &layout, &world, &extent, &statistics)) != NULL;
    const struct pel_probe_inputs inputs = {
        .device = renderer->device,
        .render = kernel,
        .residency = &renderer->residency,
        .world_buffer = renderer->world.buffer,
        .tables = renderer->tables.buffer,
        .cells = pel_occupancy_map(&renderer->occupancy),
        .scene = &seen,
        .world = &world,
    };
    good = good && pel_probe_run(&inputs, x, y, probe);
    pel_world_finish(&world);
    return good;
}

struct pel_volume *pel_renderer_bake(struct pel_renderer *renderer, const char *recipe,
                                     const struct pel_bake_options *options) {
    return pel_bake(renderer->device, &renderer->bakery.kernel, recipe, options);
}

struct pel_renderer *pel_renderer_create(const struct pel_renderer_options *options) {
    struct pel_renderer_options chosen = options ? *options : (struct pel_renderer_options){0};
    if (!pel_settings_check_options(&chosen))
        return NULL;
    struct pel_renderer *renderer = pel_allocate(1, sizeof *renderer);
    if (!renderer)
        return NULL;
    renderer->options = chosen;
    renderer->device = pel_device_open(chosen.device, chosen.compute_units);
    renderer->options.device = NULL; // it was borrowed for this call
    renderer->residency.device = renderer->device;
    if (!renderer->device) {
        pel_renderer_destroy(renderer);
        return NULL;
    }
    return renderer;
}

void pel_renderer_destroy(struct pel_renderer *renderer) {
    if (!renderer)
        return;
    pel_residency_finish(&renderer->residency);
    pel_mirror_finish(&renderer->world);
    pel_mirror_finish(&renderer->tables);
    pel_occupancy_finish(&renderer->occupancy);
    pel_resolve_finish(&renderer->resolve);
    pel_target_finish(&renderer->target);
    pel_buffer_destroy(renderer->sample_counts);
    pel_kernel_cache_finish(&renderer->kernels);
    pel_bakery_finish(&renderer->bakery);
    pel_detail_finish(&renderer->detail);
    pel_device_close(renderer->device);
    free(renderer);
}
