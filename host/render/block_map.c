// block_map.c - the blocks of all parts on the device, and which of their sub-blocks can be seen.
//
// What is stored follows the values, and what can be seen of it the transfer function. So blocks
// are built once: the device finds the bins of values that each sub-block touches, they come here,
// a byte each, and blocks with their neighbours and a hierarchy over them go back. After that an
// edit sends the visible bins, a byte for each part, and the device looks at the cells of the
// stored sub-blocks.
#include "render/block_map.h"

#include <stdlib.h>
#include <string.h>

#include "accel/blocks.h"
#include "base/error.h"
#include "base/memory.h"
#include "render/passes.h"
#include "shared/grid.h"

// ---- From bins to blocks -----------------------------------------------------------------------

// All parts' blocks, and their place in the buffer.
struct content {
    struct pel_blocks parts[WORLD_PART_MAX]; // owned
    size_t bytes;
};

// A place for `bytes` behind what is there already.
static u32 append(struct content *content, size_t bytes) {
    size_t at = content->bytes;
    content->bytes = (at + bytes + sizeof(struct block_grid) - 1) / sizeof(struct block_grid) *
                     sizeof(struct block_grid);
    return (u32)at;
}

static bool build_part(struct pel_block_map *map, struct content *content,
                       const struct pel_world *world, const uint8_t *bins, int p,
                       const struct pel_brick_settings *settings) {
    struct pel_blocks *blocks = &content->parts[p];
    struct pel_brick_statistics *statistics = &map->statistics;
    size_t dims[3];
    double start = pel_clock_ms();
    statistics->total += pel_hierarchy_bricks(world, p, settings->size, dims);
    if (!pel_blocks_build(blocks, bins + world->bytes.parts[p].cells, dims, settings->size,
                          !settings->stay))
        return false;
    statistics->active += blocks->stored;
    statistics->clusters += blocks->count;
    statistics->tree_ms += pel_clock_ms() - start;
    struct block_grid *grid = &map->grids[p];
    *grid = (struct block_grid){.stored = (u32)blocks->stored};
    while (1 << grid->bits < settings->size)
        grid->bits++;
    if (blocks->count == 0)
        return true;
    grid->nodes = append(content, (2 * blocks->count - 1) * sizeof *blocks->nodes);
    grid->blocks = append(content, blocks->count * sizeof *blocks->list);
    grid->places = append(content, blocks->stored * sizeof *blocks->places);
    grid->seen = append(content, 2 * blocks->stored);
    if (content->bytes > UINT32_MAX)
        return pel_fail(PEL_ERROR_DEVICE, "blocks need %zu bytes, at most %u can be addressed",
                        content->bytes, UINT32_MAX);
    return true;
}

static bool send_part(const struct pel_block_map *map, const struct pel_blocks *blocks, int p) {
    const struct block_grid *grid = &map->grids[p];
    struct pel_buffer *buffer = map->buffer;
    return blocks->count == 0 ||
           (pel_buffer_write(buffer, grid->nodes, (2 * blocks->count - 1) * sizeof *blocks->nodes,
                             blocks->nodes) &&
            pel_buffer_write(buffer, grid->blocks, blocks->count * sizeof *blocks->list,
                             blocks->list) &&
            pel_buffer_write(buffer, grid->places, blocks->stored * sizeof *blocks->places,
                             blocks->places) &&
            pel_buffer_write(buffer, grid->seen, blocks->stored, blocks->bins) &&
            pel_buffer_write(buffer, grid->seen + blocks->stored, blocks->stored, blocks->bins));
}

// Makes the blocks of all parts anew. The bins of part p's sub-blocks begin at bins[its cells].
static bool build(struct pel_block_map *map, struct pel_device *device,
                  const struct pel_world *world, const uint8_t *bins,
                  const struct pel_brick_settings *settings) {
    struct content *content = pel_allocate(1, sizeof *content);
    bool good = content != NULL;
    int count = world->bytes.part_count;
    if (good)
        content->bytes = sizeof map->grids;
    for (int p = 0; good && p < count; p++)
        good = build_part(map, content, world, bins, p, settings);
    if (good) {
        map->buffer = pel_buffer_create(device, content->bytes, "blocks");
        good = map->buffer != NULL;
    }
    for (int p = 0; good && p < count; p++)
        good = send_part(map, &content->parts[p], p);
    for (int p = 0; content && p < count; p++)
        pel_blocks_finish(&content->parts[p]);
    free(content);
    return good;
}

// ---- Passes ------------------------------------------------------------------------------------

// What one work-item of a pass says of each part.
static bool ask_parts(struct pel_occupancy *occupancy, const struct pel_world *world, uint32_t pass,
                      uint8_t answers[WORLD_PART_MAX]) {
    bool good = true;
    for (int p = 0; good && p < world->bytes.part_count; p++) {
        size_t cells[3], count;
        good = pel_pass_set_part(occupancy, world, p, cells, &count) &&
               pel_pass_run(occupancy, occupancy->cells, occupancy->cells, 1, pass) &&
               pel_buffer_read(occupancy->cells, world->bytes.parts[p].cells, 1, &answers[p]);
    }
    return good;
}

// Finds the bins of all sub-blocks, and makes blocks of them.
static bool rebuild(struct pel_occupancy *occupancy, struct pel_device *device,
                    const struct pel_world *world, const struct pel_brick_settings *settings,
                    double start_ms, bool whole) {
    struct pel_block_map *map = &occupancy->blocks;
    pel_block_map_finish(map);
    map->whole = whole;
    map->statistics.size = settings->size;
    uint8_t *bins = pel_allocate(world->cell_count, 1);
    bool good = bins && pel_kernel_set_u32(occupancy->kernel, 9, whole);
    for (int p = 0; good && p < world->bytes.part_count; p++) {
        size_t cells[3], count, dims[3];
        size_t sub_blocks = pel_hierarchy_bricks(world, p, settings->size, dims);
        good = pel_pass_set_part(occupancy, world, p, cells, &count) &&
               pel_pass_run(occupancy, occupancy->cells, occupancy->cells, sub_blocks,
                            PASS_BINS + pel_pass_bits(world, settings->size));
    }
    good = good && pel_pass_read_bricks(occupancy, world, settings->size, bins);
    map->statistics.activity_ms = pel_clock_ms() - start_ms;
    good = good && build(map, device, world, bins, settings);
    free(bins);
    if (!good)
        pel_block_map_finish(map);
    return good;
}

// Tells the device which bins, and which stored sub-blocks, can be seen.
static bool cull(struct pel_occupancy *occupancy, struct pel_device *device,
                 const struct pel_world *world, const struct pel_brick_settings *settings,
                 const uint8_t visible[WORLD_PART_MAX]) {
    struct pel_block_map *map = &occupancy->blocks;
    for (int p = 0; p < world->bytes.part_count; p++)
        map->grids[p].visible = settings->keep ? BLOCK_BINS_ALL : visible[p];
    size_t bytes = (size_t)world->bytes.part_count * sizeof *map->grids;
    bool good = pel_buffer_write(map->buffer, 0, bytes, map->grids) &&
                pel_kernel_set_u32(occupancy->kernel, 9, pel_pass_bits(world, settings->size));
    for (int p = 0; good && !settings->keep && p < world->bytes.part_count; p++) {
        size_t cells[3], count;
        good =
            pel_pass_set_part(occupancy, world, p, cells, &count) &&
            (map->grids[p].stored == 0 || pel_pass_run(occupancy, occupancy->scratch, map->buffer,
                                                       map->grids[p].stored, PASS_SEEN));
    }
    return good && pel_device_finish(device);
}

bool pel_block_map_update(struct pel_occupancy *occupancy, struct pel_device *device,
                          const struct pel_world *world, const struct pel_brick_settings *settings,
                          double start_ms, bool same) {
    struct pel_block_map *map = &occupancy->blocks;
    uint8_t visible[WORLD_PART_MAX] = {0}, corners[WORLD_PART_MAX] = {0};
    if (!ask_parts(occupancy, world, PASS_VISIBLE, visible) ||
        !ask_parts(occupancy, world, PASS_CORNER, corners))
        return false;
    bool whole = false;
    for (int p = 0; p < world->bytes.part_count; p++)
        whole = whole || corners[p];
    bool stays = same && map->buffer && (map->whole || !whole);
    return (stays || rebuild(occupancy, device, world, settings, start_ms, whole)) &&
           cull(occupancy, device, world, settings, visible);
}

void pel_block_map_finish(struct pel_block_map *map) {
    pel_buffer_destroy(map->buffer);
    memset(map, 0, sizeof *map);
}
