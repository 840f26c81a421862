// renderer.c - the frame loop.
//
// A frame is: plan where voxels lie, make the world's bytes, send what changed, choose the kernel,
// and run it over the tiles in short batches. What is on the device stays for the next frame.
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "device/device.h"
#include "output/image.h"
#include "render/bakery.h"
#include "render/counts.h"
#include "render/debug.h"
#include "render/detail.h"
#include "render/frame.h"
#include "render/kernel_cache.h"
#include "render/mirror.h"
#include "render/occupancy.h"
#include "render/probe.h"
#include "render/rays.h"
#include "render/region.h"
#include "render/residency.h"
#include "render/resolve.h"
#include "render/rounds.h"
#include "render/settings.h"
#include "render/share.h"
#include "render/target.h"
#include "render/tiles.h"
#include "render/variant.h"
#include "shared/tiles.h"
#include "world/skip.h"

struct pel_renderer {
    struct pel_device *device;
    struct pel_renderer_options options;
    struct pel_residency residency;
    struct pel_kernel_cache kernels;
    struct pel_memo memo;
    struct pel_mirror world, tables;
    struct pel_occupancy occupancy;
    struct pel_resolve resolve;
    struct pel_bakery bakery;
    struct pel_detail detail;
    struct pel_target target;
    struct pel_share share;
    struct pel_buffer *sample_counts;
    size_t sample_counts_bytes;
    struct pel_pace pace;
    bool warned; // of loops that the device would leave
};

// Time since *mark, which moves to now.
static double lap_ms(double *mark) {
    double now = pel_clock_ms(), elapsed = now - *mark;
    *mark = now;
    return elapsed;
}

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

// Binds everything but where light goes, the first tile, and the ray's number, in the order of the
// kernel's parameters. A kernel has an atlas for each class in `voxels` only.
static bool set_arguments(struct pel_renderer *renderer, struct pel_kernel *kernel,
                          const struct pel_variant *variant) {
    int index = 0;
    bool good = pel_kernel_set_buffer(kernel, index++, renderer->world.buffer) &&
                pel_kernel_set_buffer(kernel, index++, renderer->tables.buffer) &&
                pel_kernel_set_buffer(kernel, PEL_LIGHT_ARGUMENT + 1, renderer->sample_counts);
    index = PEL_FIRST_TILE_ARGUMENT + 1; // what is between is set for each frame and each batch
    good = good && pel_kernel_set_buffer(kernel, index++, pel_occupancy_map(&renderer->occupancy));
    if (variant->supersampling) {
        index++; // the ray's number is set for each pass
        good = good && pel_kernel_set_buffer(kernel, index++, renderer->resolve.refined);
    }
    if (variant->adaptive && good)
        good = pel_kernel_set_buffer(kernel, index++, renderer->occupancy.strides);
    return good && pel_residency_bind(&renderer->residency, kernel, index, variant->voxels);
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
                                  struct pel_tiling *tiling,
                                  struct pel_render_statistics *statistics) {
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

    *tiling = pel_tiles_plan(&scene->render, pel_world_pictures(world), lanes,
                             choose_group(renderer, kernel));
    size_t packets = (tiling->tiles + tiling->tiles_per_group) * tiling->packets_per_tile *
                     (size_t)pel_world_eyes(world);
    if (!pel_residency_update(&renderer->residency, scene, layout, world) ||
        !pel_mirror_update(&renderer->world, device, &world->bytes, pel_world_bytes(world),
                           (world->eyes == EYES_ONE ? 1 : 2) * sizeof world->bytes.camera,
                           "the scene", NULL) ||
        !pel_mirror_update_words(&renderer->tables, device, world->tables, "transfer functions",
                                 NULL) ||
        (world->supersampling &&
         !pel_resolve_prepare(&renderer->resolve, device, kernel, pel_world_pixels(world))) ||
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
    statistics->work_group = (int)tiling->group;
    statistics->kernel = pel_kernel_describe(kernel);
    return kernel;
}

// Gives each pixel the time of its tile.
static void show_times(struct pel_image *image, const float *tile_ms) {
    int columns = TILES_ALONG(image->width), rows = TILES_ALONG(image->height);
    for (int n = 0; n < columns * rows; n++) {
        struct tile_place tile = tile_at((uint32_t)n, columns, rows);
        int left = tile.x * TILE_PX, top = tile.y * TILE_PX;
        for (int y = top; y < top + TILE_PX && y < image->height; y++)
            for (int x = left; x < left + TILE_PX && x < image->width; x++)
                image->rgba[4 * ((size_t)y * (size_t)image->width + (size_t)x)] = tile_ms[n];
    }
}

// Makes a debug view's picture of what came from the device.
static bool paint(struct pel_image *image, const struct pel_renderer *renderer, enum pel_debug view,
                  const struct pel_render_options *options,
                  struct pel_render_statistics *statistics) {
    if (renderer->pace.tile_ms)
        show_times(image, renderer->pace.tile_ms);
    return pel_debug_paint(image, view, options ? options->numbers : NULL, &statistics->debug);
}

// Runs the kernel and brings the picture here, unless it can stay for OpenGL: then it is in the
// target. The caller owns the image.
static struct pel_image *run(struct pel_renderer *renderer, struct pel_kernel *kernel,
                             const struct pel_scene *scene, const struct pel_world *world,
                             const struct pel_frame_eyes *eyes, const struct pel_tiling *tiling,
                             const struct pel_render_options *options,
                             struct pel_render_statistics *statistics) {
    double mark = pel_clock_ms();
    int across = pel_world_across(world), planes = pel_world_planes(world);
    struct pel_image *image =
        across > 1 ? pel_image_create_undefined(across * scene->render.width,
                                                planes * scene->render.height)
                   : pel_share_create_image(&renderer->share, renderer->device, &scene->render,
                                            planes, options, statistics);
    if (!image || !pel_target_begin(&renderer->target, renderer->device, image)) {
        pel_image_destroy(image);
        return NULL;
    }
    const struct pel_rays rays = {
        .device = renderer->device,
        .kernel = kernel,
        .tiling = tiling,
        .pace = &renderer->pace,
        .resolve = &renderer->resolve,
        .world_buffer = renderer->world.buffer,
        .picture = renderer->target.buffer,
        .sample_counts = renderer->sample_counts,
        .scene = scene,
        .world = world,
        .only = eyes->only,
        .options = options,
    };
    bool adds_up = world->supersampling && !eyes->only;
    struct pel_buffer *light = adds_up ? renderer->resolve.light : renderer->target.buffer;
    bool good = pel_kernel_set_buffer(kernel, PEL_LIGHT_ARGUMENT, light) &&
                pel_rays_cast(&rays, statistics);
    statistics->render_ms = lap_ms(&mark);
    good = pel_target_end(&renderer->target, image, good) &&
           (scene->render.debug == PEL_DEBUG_NONE ||
            paint(image, renderer, scene->render.debug, options, statistics));
    free(renderer->pace.tile_ms);
    renderer->pace.tile_ms = NULL;
    if (!good || !pel_counts_add(renderer->sample_counts, tiling, pel_world_eyes(world),
                                 pel_world_pictures(world), statistics)) {
        pel_image_destroy(image);
        return NULL;
    }
    statistics->download_ms = lap_ms(&mark);
    return image;
}

// The picture of nothing: the background.
static struct pel_image *render_background(const struct pel_world *world) {
    struct pel_image *image =
        pel_image_create_undefined(pel_world_across(world) * world->bytes.width,
                                   pel_world_planes(world) * world->bytes.height);
    if (!image)
        return NULL;
    const struct world *bytes = &world->bytes;
    const float4 *colour =
        world->eyes == EYES_MERGED ? &bytes->merged_background : &bytes->background;
    size_t pixels = pel_world_pixels(world);
    for (size_t i = 0; i < pixels; i++)
        memcpy(&image->rgba[4 * i], colour, sizeof *colour);
    for (size_t i = pixels; i < (size_t)image->width * (size_t)image->height; i++)
        memcpy(&image->rgba[4 * i], (float[]){FLT_MAX, 0, 0, 0}, sizeof *colour);
    return image;
}

static bool add_second(struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_frame_eyes *eyes) {
    if (eyes->eyes != EYES_BOTH && eyes->eyes != EYES_MERGED && eyes->eyes != EYES_WOVEN)
        return true;
    if (!pel_world_add_eye(world, scene, eyes->second, eyes->eyes, eyes->weave))
        return false;
    if (eyes->eyes == EYES_MERGED)
        pel_world_merge_eyes(world, eyes->glasses->matrix, eyes->glasses->linear,
                             eyes->glasses->background);
    if (eyes->beside)
        pel_world_lay_beside(world);
    return true;
}

// Plans where the voxels lie and makes the world's bytes, which go by that. Zeroes the statistics.
static bool plan(struct pel_renderer *renderer, const struct pel_scene *scene,
                 const struct pel_frame_eyes *eyes, struct pel_layout *layout,
                 struct pel_world *world, struct pel_render_statistics *statistics) {
    double mark = pel_clock_ms();
    const struct pel_device_info *info = pel_device_describe(renderer->device);
    *statistics = (struct pel_render_statistics){0};
    if (!pel_settings_check(scene))
        return false;
    struct pel_layout_limits limits =
        pel_residency_limits(renderer->device, renderer->options.max_allocation_bytes);
    if (!pel_layout_plan(layout, scene, &limits, renderer->options.reader, info->reader) ||
        !pel_world_build(world, scene, layout, &renderer->memo))
        return false;
    if (eyes->eyes == EYES_DEPTH)
        world->eyes = EYES_DEPTH;
    if (eyes->only) { // pixels with contrast, of which there are no others
        world->supersampling = true;
        world->bytes.contrast = 1;
    }
    size_t pixel_bytes = (size_t)pel_world_planes(world) * sizeof(float4) +
                         (world->supersampling ? PEL_RESOLVE_BYTES : 0);
    if (!add_second(world, scene, eyes) ||
        !pel_residency_check(layout, &limits, pel_world_pixels(world) * pixel_bytes))
        return false;
    statistics->lanes = renderer->options.lanes ? renderer->options.lanes : info->lanes;
    statistics->reader = layout->reader;
    statistics->skip = scene->render.skip;
    struct pel_skip_facts facts;
    pel_skip_find_facts(&facts, scene, world, &renderer->memo, layout->reader);
    if (scene->render.skip == PEL_SKIP_AUTO)
        statistics->skip = pel_skip_choose(&facts, statistics->skip_reason);
    else if (facts.nothing)
        statistics->skip = PEL_SKIP_NONE;
    statistics->prepare_ms = lap_ms(&mark);
    return true;
}

struct pel_image *pel_frame_render(struct pel_renderer *renderer, const struct pel_scene *scene,
                                   const struct pel_frame_eyes *eyes,
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
        !pel_detail_show(&renderer->detail, &shown, eyes->second))
        return NULL;
    pel_region_widen(&shown.render);
    if (!plan(renderer, &shown, eyes, &layout, &world, statistics))
        return NULL;
    // What follows knows only the part of the picture that is made.
    shown.render.width = world.bytes.width;
    shown.render.height = world.bytes.height;
    struct pel_image *image = NULL;
    if (world.bytes.part_count == 0) {
        image = render_background(&world);
        if (options && options->gl_buffer)
            snprintf(statistics->gl_reason, sizeof statistics->gl_reason,
                     "there is nothing to render");
    } else {
        struct pel_tiling tiling;
        struct pel_kernel *kernel = prepare(renderer, &shown, &layout, &world, &tiling, statistics);
        pel_rounds_check(&renderer->warned, pel_device_describe(renderer->device), &world,
                         statistics->skip);
        if (kernel)
            image = run(renderer, kernel, &shown, &world, eyes, &tiling, options, statistics);
    }
    if (image && !image->rgba &&
        !pel_share_put(&renderer->share, renderer->device, &renderer->target, image, &shown.render,
                       &scene->render, options, statistics)) {
        pel_image_destroy(image);
        image = NULL;
    }
    const struct pel_device_info *info = pel_device_describe(renderer->device);
    memcpy(statistics->device, info->name, sizeof statistics->device);
    memcpy(statistics->driver, info->driver, sizeof statistics->driver);
    statistics->lod = renderer->detail.statistics;
    statistics->device_bytes = pel_device_allocated_bytes(renderer->device);
    statistics->uploaded_bytes = pel_device_uploaded_bytes(renderer->device) - uploaded_before;
    return pel_region_cut(image, &shown.render, &scene->render);
}

void pel_renderer_forget_gl(struct pel_renderer *renderer, uint32_t gl_buffer) {
    pel_share_forget(&renderer->share, gl_buffer);
}

bool pel_renderer_probe(struct pel_renderer *renderer, const struct pel_scene *scene, int x, int y,
                        struct pel_probe *probe) {
    *probe = (struct pel_probe){0};
    if (!pel_probe_check(scene, x, y))
        return false;
    struct pel_scene seen;
    if (!pel_bakery_show(&renderer->bakery, renderer->device, scene, &seen) ||
        !pel_detail_show(&renderer->detail, &seen, NULL))
        return false;
    memset(seen.render.region, 0, sizeof seen.render.region);
    seen.render.debug = PEL_DEBUG_NONE;
    seen.render.supersampling.n = 0;
    seen.render.supersampling.pattern = PEL_PATTERN_REGULAR;
    seen.render.supersampling.filter = PEL_RECONSTRUCTION_BOX;
    struct pel_render_statistics statistics;
    struct pel_layout layout;
    struct pel_world world;
    if (!plan(renderer, &seen, &(struct pel_frame_eyes){0}, &layout, &world, &statistics))
        return false;
    statistics.lanes = 1;
    world.probe = true;
    struct pel_tiling tiling;
    struct pel_kernel *kernel = NULL;
    bool good = world.bytes.part_count == 0 ||
                (kernel = prepare(renderer, &seen, &layout, &world, &tiling, &statistics)) != NULL;
    const struct pel_probe_inputs inputs = {
        .device = renderer->device,
        .render = kernel,
        .residency = &renderer->residency,
        .world_buffer = renderer->world.buffer,
        .tables = renderer->tables.buffer,
        .cells = pel_occupancy_map(&renderer->occupancy),
        .strides = renderer->occupancy.strides,
        .scene = &seen,
        .world = &world,
    };
    good = good && pel_probe_run(&inputs, x, y, probe);
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
    renderer->device = pel_device_open(chosen.device, chosen.compute_units, &chosen.gl);
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
    pel_memo_finish(&renderer->memo);
    pel_mirror_finish(&renderer->world);
    pel_mirror_finish(&renderer->tables);
    pel_occupancy_finish(&renderer->occupancy);
    pel_resolve_finish(&renderer->resolve);
    pel_target_finish(&renderer->target);
    pel_share_finish(&renderer->share);
    pel_buffer_destroy(renderer->sample_counts);
    pel_kernel_cache_finish(&renderer->kernels);
    pel_bakery_finish(&renderer->bakery);
    pel_detail_finish(&renderer->detail);
    pel_device_close(renderer->device);
    free(renderer);
}
