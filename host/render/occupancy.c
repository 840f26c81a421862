// occupancy.c - which cells of each part may show something, derived on the device, and what a way
// to skip makes of that.
//
// Nothing but what is visible of tables is sent, so editing a transfer function costs one or two
// look-ups a cell and a few passes over the cells (three for distances, and for an octree as much
// as one and a seventh) of the parts that show it, and moving the camera or a volume costs nothing
// here. For `bvh` the active bricks come back, a byte each, and are clustered here. Blocks stay as
// they are.
#include "render/occupancy.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "render/passes.h"
#include "shared/grid.h"
#include "world/bricks.h"
#include "world/mask.h"

static bool make_room(struct pel_occupancy *occupancy, struct pel_device *device, size_t cells) {
    if (occupancy->cells && occupancy->scratch && cells <= occupancy->cell_count)
        return true;
    pel_buffer_destroy(occupancy->cells);
    pel_buffer_destroy(occupancy->scratch);
    occupancy->key.part_count = 0;
    occupancy->cell_count = cells;
    occupancy->cells = pel_buffer_create(device, cells + CELL_SLACK, "cells");
    occupancy->scratch = pel_buffer_create(device, cells + CELL_SLACK, "cells");
    return occupancy->cells && occupancy->scratch;
}

// Padding is cleared, so that keys can be compared byte by byte.
static void make_key(struct pel_occupancy_key *key, const struct pel_world *world,
                     const struct pel_layout *layout, enum pel_skip skip,
                     const struct pel_brick_settings *bricks) {
    memset(key, 0, sizeof *key);
    memcpy(&key->layout, layout, sizeof *layout);
    key->part_count = world->bytes.part_count;
    key->linear = world->table_linear;
    key->skip = skip;
    if (skip == PEL_SKIP_BVH || skip == PEL_SKIP_BLOCKS) {
        key->bricks.size = bricks->size;
        key->bricks.apart = bricks->apart;
        key->bricks.stay = bricks->stay;
        key->bricks.keep = bricks->keep;
    }
    for (int p = 0; p < key->part_count; p++) {
        const struct part *part = &world->bytes.parts[p];
        struct part *copy = &key->parts[p];
        copy->filter = part->filter;
        copy->table_scale = part->table_scale;
        copy->table_bias = part->table_bias;
        copy->table_last = part->table_last;
        copy->table_nearest = part->table_nearest;
        copy->cells = part->cells;
        copy->ranges = part->ranges;
        copy->visible = part->visible;
        copy->model = part->model;
        copy->surface_count = part->surface_count;
        copy->surface_values = part->surface_values;
        copy->mask_cuts = part->mask_cuts;
        copy->mask_count = part->mask_count;
        copy->mask_part = part->mask_part;
        copy->mask_inverted = part->mask_inverted;
        copy->mask_range_count = part->mask_range_count;
        copy->variation = part->variation;
        copy->variation_scale = part->variation_scale;
        copy->stride_max = part->stride_max;
        copy->stride_nought = part->stride_nought;
    }
    key->stride_depth = world->adaptive ? world->bytes.stride_depth : 0;
    if (world->masked)
        key->masks = pel_mask_hash(world);
}

// Whether what a part shows by is on the device already.
static bool same_words(const struct pel_mirror *mirror, const struct pel_world *world, u32 first,
                       size_t count) {
    size_t start = first * sizeof(u32), bytes = count * sizeof(u32);
    return mirror->copy && start + bytes <= mirror->bytes &&
           memcmp((const char *)mirror->copy + start, world->visible->words + first, bytes) == 0;
}

// Finds the parts whose cells must be derived anew; true when there are any.
static bool find_dirty(struct pel_occupancy *occupancy, const struct pel_occupancy_key *key,
                       const struct pel_world *world) {
    const struct pel_occupancy_key *old = &occupancy->key;
    bool all = memcmp(key, old, offsetof(struct pel_occupancy_key, parts)) != 0, any = false;
    for (int p = 0; p < key->part_count; p++) {
        const struct part *part = &world->bytes.parts[p];
        size_t entries = (size_t)part->table_last + 1;
        size_t variations = (size_t)(part->table_last * part->variation_scale + 1.5F);
        occupancy->dirty[p] =
            all || memcmp(&key->parts[p], &old->parts[p], sizeof *key->parts) != 0 ||
            !same_words(&occupancy->visible, world, part->visible, entries + 1) ||
            (world->adaptive && part->stride_max > 1 &&
             !same_words(&occupancy->visible, world, part->variation, 2 * variations));
        any = any || occupancy->dirty[p];
    }
    return any;
}

static size_t chunks(size_t cells) {
    return (cells + CELL_CHUNK - 1) / CELL_CHUNK;
}

// The passes after the first: from `scratch`, which holds what is empty, to `cells`.
static bool spread_distances(struct pel_occupancy *occupancy, const size_t cells[3]) {
    const struct pel_buffer *to = occupancy->cells, *from = occupancy->scratch;
    size_t rows = cells[1] * cells[2];
    return pel_pass_run(occupancy, from, to, rows, PASS_ROW) &&
           pel_pass_run(occupancy, to, from, rows, PASS_COLUMN) &&
           pel_pass_run(occupancy, from, to, rows, PASS_SLICE);
}

// Joins empty nodes level by level up to the root, and tells every cell.
static bool grow_octree(struct pel_occupancy *occupancy, const size_t cells[3]) {
    size_t dims[3] = {cells[0], cells[1], cells[2]};
    bool good = true;
    for (uint32_t level = 1; good && (dims[0] > 1 || dims[1] > 1 || dims[2] > 1); level++) {
        for (int i = 0; i < 3; i++)
            dims[i] = (dims[i] + 1) / 2;
        good = pel_pass_run(occupancy, occupancy->scratch, occupancy->scratch, dims[1] * dims[2],
                            PASS_MERGE + level);
    }
    return good && pel_pass_run(occupancy, occupancy->scratch, occupancy->cells,
                                cells[1] * cells[2], PASS_NAME);
}

// Reduces the cells of part p to bricks, at the beginning of the part's cells.
static bool find_bricks(struct pel_occupancy *occupancy, const struct pel_world *world, int p,
                        int size) {
    size_t dims[3];
    size_t bricks = pel_hierarchy_bricks(world, p, size, dims);
    return pel_pass_run(occupancy, occupancy->scratch, occupancy->cells, bricks,
                        PASS_BRICK + pel_pass_bits(world, size));
}

// Finds the empty cells of the dirty parts: in `scratch`.
static bool occupy(struct pel_occupancy *occupancy, const struct pel_world *world,
                   const struct pel_buffer *world_buffer, const struct pel_residency *residency) {
    struct pel_kernel *kernel = occupancy->kernel;
    bool tree = occupancy->key.skip == PEL_SKIP_OCTREE;
    bool good = pel_kernel_set_buffer(kernel, 0, world_buffer) &&
                pel_kernel_set_buffer(kernel, 1, residency->ranges) &&
                pel_kernel_set_buffer(kernel, 2, occupancy->visible.buffer) &&
                pel_kernel_set_u32(kernel, 7, world->table_linear) &&
                pel_kernel_set_u32(kernel, 9, tree ? 1 : CELL_DISTANCE_MAX);
    for (int p = 0; good && p < world->bytes.part_count; p++) {
        size_t cells[3], count;
        if (occupancy->dirty[p])
            good = pel_pass_set_part(occupancy, world, p, cells, &count) &&
                   pel_pass_run(occupancy, occupancy->cells, occupancy->scratch, chunks(count),
                                PASS_OCCUPY);
    }
    return good;
}

// Brings to the device the bricks in which some part shows something. Parts of one volume share
// them.
static bool fill_pool(struct pel_occupancy *occupancy, const struct pel_world *world,
                      struct pel_residency *residency, const struct pel_scene *scene,
                      const struct pel_layout_limits *limits) {
    struct pel_brick_statistics *statistics = &occupancy->hierarchy.statistics;
    size_t pages = residency->layout.range_count;
    uint8_t *empty = pel_allocate(world->cell_count, 1), *active = pel_allocate(pages, 1);
    bool good = empty && active && pel_buffer_read(occupancy->scratch, 0, world->cell_count, empty);
    for (int p = 0; good && p < world->bytes.part_count; p++) {
        const struct part *part = &world->bytes.parts[p];
        size_t cells[3];
        pel_world_cells(world, p, cells);
        for (size_t i = 0; i < cells[0] * cells[1] * cells[2]; i++)
            active[part->ranges + i] |= !empty[part->cells + i];
    }
    // Masks are read wherever samples are.
    for (int p = world->bytes.part_count; good && p < world->part_total; p++) {
        size_t cells[3];
        pel_world_cells(world, p, cells);
        memset(active + world->bytes.parts[p].ranges, 1, cells[0] * cells[1] * cells[2]);
    }
    statistics->size = world->cell_side;
    statistics->total = pages;
    for (size_t i = 0; good && i < pages; i++)
        statistics->active += active[i];
    good = good && pel_residency_fill(residency, scene, limits, active);
    statistics->resident = residency->pool.resident;
    free(empty);
    free(active);
    return good;
}

// From the empty cells of all parts to what the way to skip goes by.
static bool derive(struct pel_occupancy *occupancy, const struct pel_world *world) {
    bool good = true;
    for (int p = 0; good && p < world->bytes.part_count; p++) {
        size_t cells[3], count;
        if (!occupancy->dirty[p])
            continue;
        good = pel_pass_set_part(occupancy, world, p, cells, &count);
        if (occupancy->key.skip == PEL_SKIP_OCTREE)
            good = good && grow_octree(occupancy, cells);
        else if (occupancy->key.skip == PEL_SKIP_BVH)
            good = good && find_bricks(occupancy, world, p, occupancy->key.bricks.size);
        else if (occupancy->key.skip == PEL_SKIP_DISTANCE)
            good = good && spread_distances(occupancy, cells);
    }
    return good;
}

// Brings the active bricks here and the hierarchy over their clusters to the device.
static bool build_hierarchy(struct pel_occupancy *occupancy, struct pel_device *device,
                            const struct pel_world *world, const struct pel_brick_settings *bricks,
                            double start_ms) {
    uint8_t *active = pel_allocate(world->cell_count, 1);
    bool good = active && pel_pass_read_bricks(occupancy, world, bricks->size, active);
    double activity_ms = pel_clock_ms() - start_ms;
    good = good && pel_hierarchy_build(&occupancy->hierarchy, device, world, active, bricks);
    occupancy->hierarchy.statistics.activity_ms = activity_ms;
    free(active);
    return good;
}

// The kernel for the passes, one that knows how large cells are. One that has been compiled for
// more than is asked for is as good.
static bool find_kernel(struct pel_occupancy *occupancy, const struct pel_world *world,
                        const struct pel_kernel *render, enum pel_skip skip) {
    const struct pel_occupancy_text *has = &occupancy->text;
    struct pel_occupancy_text asked = {skip,        world->filters, world->models,
                                       world->pool, world->masked,  world->adaptive};
    if (occupancy->kernel && has->skip == asked.skip && !(asked.filters & ~has->filters) &&
        !(asked.models & ~has->models) && has->pool == asked.pool && has->masks >= asked.masks &&
        has->strides >= asked.strides)
        return true;
    pel_kernel_destroy(occupancy->kernel);
    occupancy->kernel = pel_kernel_sibling(render, "occupancy");
    occupancy->text = asked;
    return occupancy->kernel != NULL;
}

// Finds how long runs of samples may be in the cells of all parts.
static bool find_strides(struct pel_occupancy *occupancy, struct pel_device *device,
                         const struct pel_world *world) {
    if (!world->adaptive)
        return true;
    if (occupancy->stride_count < world->cell_count) {
        pel_buffer_destroy(occupancy->strides);
        occupancy->stride_count = world->cell_count;
        occupancy->strides = pel_buffer_create(device, world->cell_count, "strides");
    }
    bool good = occupancy->strides != NULL;
    for (int p = 0; good && p < world->bytes.part_count; p++) {
        size_t cells[3], count;
        if (occupancy->dirty[p])
            good =
                pel_pass_set_part(occupancy, world, p, cells, &count) &&
                pel_pass_run(occupancy, occupancy->cells, occupancy->strides, count, PASS_STRIDE);
    }
    return good;
}

// From the empty cells of all parts to what the kernel is given. `same` tells that nothing but
// tables has changed.
static bool make_map(struct pel_occupancy *occupancy, struct pel_device *device,
                     const struct pel_world *world, const struct pel_brick_settings *bricks,
                     double start_ms, bool same) {
    if (occupancy->key.skip == PEL_SKIP_BLOCKS)
        return pel_block_map_update(occupancy, device, world, bricks, start_ms, same);
    pel_block_map_finish(&occupancy->blocks);
    return derive(occupancy, world) &&
           (occupancy->key.skip == PEL_SKIP_BVH
                ? build_hierarchy(occupancy, device, world, bricks, start_ms)
                : pel_device_finish(device));
}

bool pel_occupancy_update(struct pel_occupancy *occupancy, struct pel_device *device,
                          const struct pel_world *world, const struct pel_buffer *world_buffer,
                          struct pel_residency *residency, const struct pel_scene *scene,
                          const struct pel_layout_limits *limits, const struct pel_kernel *render,
                          enum pel_skip skip) {
    if ((skip == PEL_SKIP_NONE && !world->pool && !world->adaptive) || world->bytes.part_count == 0)
        return make_room(occupancy, device, 1);
    double start_ms = pel_clock_ms();
    if (!find_kernel(occupancy, world, render, skip) ||
        !make_room(occupancy, device, world->cell_count))
        return false;
    struct pel_brick_settings bricks = pel_bricks_resolve(&scene->render.bricks, skip);
    if (bricks.size < world->cell_side)
        bricks.size = world->cell_side;
    struct pel_occupancy_key key;
    make_key(&key, world, &residency->layout, skip, &bricks);
    bool same = memcmp(&key, &occupancy->key, sizeof key) == 0;
    bool any = find_dirty(occupancy, &key, world);
    if (!pel_mirror_update_words(&occupancy->visible, device, world->visible, "visible entries",
                                 NULL)) {
        occupancy->key.part_count = 0;
        return false;
    }
    if (!any && (!world->pool || residency->pool.filled))
        return true;
    memcpy(&occupancy->key, &key, sizeof key);
    pel_hierarchy_finish(&occupancy->hierarchy);
    bool good = occupy(occupancy, world, world_buffer, residency) &&
                find_strides(occupancy, device, world) &&
                (!world->pool || fill_pool(occupancy, world, residency, scene, limits)) &&
                make_map(occupancy, device, world, &bricks, start_ms, same);
    if (!good)
        occupancy->key.part_count = 0;
    return good;
}

uint64_t pel_occupancy_bytes(const struct pel_occupancy *occupancy) {
    return pel_buffer_bytes(occupancy->cells) + pel_buffer_bytes(occupancy->scratch) +
           pel_buffer_bytes(occupancy->visible.buffer) + pel_buffer_bytes(occupancy->strides) +
           pel_buffer_bytes(occupancy->hierarchy.nodes) +
           pel_buffer_bytes(occupancy->blocks.buffer);
}

struct pel_brick_statistics pel_occupancy_bricks(const struct pel_occupancy *occupancy) {
    struct pel_brick_statistics statistics = occupancy->hierarchy.statistics;
    if (occupancy->blocks.buffer) {
        statistics = occupancy->blocks.statistics;
        statistics.resident = occupancy->hierarchy.statistics.resident;
    }
    return statistics;
}

const struct pel_buffer *pel_occupancy_map(const struct pel_occupancy *occupancy) {
    return occupancy->hierarchy.nodes             ? occupancy->hierarchy.nodes
           : occupancy->blocks.buffer             ? occupancy->blocks.buffer
           : occupancy->key.skip == PEL_SKIP_GRID ? occupancy->scratch
                                                  : occupancy->cells;
}

void pel_occupancy_finish(struct pel_occupancy *occupancy) {
    pel_kernel_destroy(occupancy->kernel);
    pel_mirror_finish(&occupancy->visible);
    pel_hierarchy_finish(&occupancy->hierarchy);
    pel_block_map_finish(&occupancy->blocks);
    pel_buffer_destroy(occupancy->cells);
    pel_buffer_destroy(occupancy->scratch);
    pel_buffer_destroy(occupancy->strides);
    memset(occupancy, 0, sizeof *occupancy);
}
