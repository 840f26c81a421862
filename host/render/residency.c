// residency.c - a scene's voxels on the device, kept from frame to frame.
#include "render/residency.h"

#include <stdlib.h>
#include <string.h>

#include "accel/grid.h"
#include "base/error.h"
#include "base/memory.h"
#include "shared/grid.h"
#include "world/brick.h"
#include "world/pack.h"

static const enum pel_texel class_texel[VOXEL_CLASS_COUNT] = {PEL_TEXEL_R8, PEL_TEXEL_R16,
                                                              PEL_TEXEL_R32F, PEL_TEXEL_RGBA8};

// Voxels travel in pieces of about this size.
static const size_t piece_bytes = (size_t)16 << 20;

struct pel_layout_limits pel_residency_limits(const struct pel_device *device,
                                              uint64_t max_allocation_bytes) {
    const struct pel_device_info *info = pel_device_describe(device);
    struct pel_layout_limits limits = {
        .memory_bytes = info->memory_bytes,
        .max_allocation_bytes = info->max_allocation_bytes,
        .max_image = {info->max_image[0], info->max_image[1], info->max_image[2]},
        .images = info->images,
    };
    if (max_allocation_bytes && max_allocation_bytes < limits.max_allocation_bytes)
        limits.max_allocation_bytes = max_allocation_bytes;
    for (int class = 0; class < VOXEL_CLASS_COUNT; class ++)
        limits.texels[class] = info->images && pel_texture_supported(device, class_texel[class]);
    return limits;
}

static bool create_memory(struct pel_residency *residency, const struct pel_layout *layout) {
    bool image = layout->reader == PEL_READER_IMAGE;
    for (int b = 0; !image && !layout->pool && b < VOXEL_BUFFERS; b++) {
        // Every buffer argument of the kernel needs a buffer, if only of a byte.
        residency->buffers[b] =
            pel_buffer_create(residency->device, layout->buffer_bytes[b], "voxels");
        if (!residency->buffers[b])
            return false;
    }
    for (int class = 0; image && class < VOXEL_CLASS_COUNT; class ++) {
        const size_t *dims = layout->atlas[class];
        if (dims[0] == 0)
            continue;
        residency->atlases[class] =
            pel_texture_create(residency->device, class_texel[class], dims, "voxels");
        if (!residency->atlases[class])
            return false;
    }
    residency->ranges = pel_buffer_create(residency->device, layout->range_count * sizeof(float[2]),
                                          "ranges of values");
    return residency->ranges != NULL;
}

// A slab on its way to the device: a piece of its slices, packed.
struct shipment {
    const struct pel_volume *volume;
    const struct pel_slab *slab;
    size_t dims[3], voxel_bytes, slice_bytes;
    int border;          // of bricks
    size_t room;         // slices in a piece
    size_t first, count; // those in it now
    char *slices;        // owned
    char *layer;         // owned; `buffer` reader: a layer of bricks
    size_t layer_bytes;
};

static void shipment_finish(struct shipment *shipment) {
    free(shipment->slices);
    free(shipment->layer);
}

// With bricks a piece is one layer of them and the slices beside it; else it is of about
// piece_bytes.
static bool shipment_init(struct shipment *shipment, const struct pel_volume *volume,
                          const struct pel_slab *slab, const struct pel_layout *layout) {
    bool bricks = layout->reader == PEL_READER_BUFFER;
    *shipment = (struct shipment){.volume = volume, .slab = slab, .border = layout->border};
    size_t *dims = shipment->dims;
    pel_slab_dims(slab, volume, dims);
    shipment->voxel_bytes = pel_voxel_class_bytes(slab->class_index);
    if (!pel_size_multiply(&shipment->slice_bytes, 3,
                           (size_t[]){dims[0], dims[1], shipment->voxel_bytes}))
        return false;
    size_t most = piece_bytes / shipment->slice_bytes;
    shipment->room = most > dims[2] ? dims[2] : most > 0 ? most : 1;
    if (bricks)
        shipment->room = (size_t)BRICK_ROW_OF(shipment->border);
    size_t bytes;
    if (!pel_size_multiply(&bytes, 2, (size_t[]){shipment->room, shipment->slice_bytes}))
        return false;
    shipment->slices = pel_allocate_voxels(bytes);
    if (bricks) {
        if (!pel_size_multiply(&shipment->layer_bytes, 4,
                               (size_t[]){pel_brick_count(dims[0]), pel_brick_count(dims[1]),
                                          BRICK_VOXELS_OF(shipment->border),
                                          pel_brick_element_bytes(shipment->voxel_bytes)})) {
            shipment_finish(shipment);
            return false;
        }
        shipment->layer = pel_allocate_voxels(shipment->layer_bytes);
    }
    if (shipment->slices && (shipment->layer || !bricks))
        return true;
    shipment_finish(shipment);
    return false;
}

// Packs the slices from the slab's border's slice `first` on, with bricks those that lie beside
// them too, and adds those that are new to the grid.
static void load_slices(struct shipment *shipment, size_t first, struct pel_grid *grid,
                        float scale) {
    const struct pel_slab *slab = shipment->slab;
    first -= first > 0 ? (size_t)shipment->border : 0;
    size_t left = shipment->dims[2] - first, bytes = shipment->slice_bytes;
    size_t packed = shipment->first + shipment->count;
    size_t kept = packed > first ? packed - first : 0;
    memmove(shipment->slices, shipment->slices + (shipment->count - kept) * bytes, kept * bytes);
    shipment->first = first;
    shipment->count = left < shipment->room ? left : shipment->room;
    for (size_t i = kept; i < shipment->count; i++) {
        char *slice = shipment->slices + i * bytes;
        pel_pack_slice(shipment->volume, slab->first - slab->border[0] + (int)(first + i), slice);
        pel_grid_add_slice(grid, first + i, slice, slab->class_index, scale);
    }
}

static bool send_slices(struct pel_residency *residency, struct shipment *shipment) {
    const struct pel_slab *slab = shipment->slab;
    size_t dims[3] = {shipment->dims[0], shipment->dims[1], shipment->count};
    if (shipment->layer) {
        size_t layer = (shipment->first + BRICK_SIDE - 1) / BRICK_SIDE;
        struct pel_brick_source source = {.slices = shipment->slices,
                                          .dims = {dims[0], dims[1], dims[2]},
                                          .first = layer * BRICK_SIDE - shipment->first,
                                          .voxel_bytes = shipment->voxel_bytes,
                                          .border = shipment->border};
        pel_brick_layer(shipment->layer, &source);
        return pel_buffer_write(residency->buffers[slab->buffer],
                                slab->offset_bytes + layer * shipment->layer_bytes,
                                shipment->layer_bytes, shipment->layer);
    }
    size_t origin[3] = {slab->origin[0], slab->origin[1], slab->origin[2] + shipment->first};
    return pel_texture_write(residency->atlases[slab->class_index], origin, dims, shipment->slices);
}

// Of a volume that is worked out at every sample nobody knows where something is visible, so each
// cell may have any value.
static bool send_endless_ranges(struct pel_residency *residency, const struct pel_volume *volume,
                                const struct pel_slab *slab) {
    struct pel_grid grid;
    size_t dims[3];
    pel_slab_dims(slab, volume, dims);
    if (!pel_grid_init(&grid, dims, CELL_VOXELS, 0))
        return false;
    size_t cells = grid.cells[0] * grid.cells[1] * grid.cells[2];
    for (size_t i = 0; i < cells; i++) {
        grid.range[i][0] = -PEL_GRID_ENDLESS;
        grid.range[i][1] = PEL_GRID_ENDLESS;
    }
    bool good = pel_buffer_write(residency->ranges, slab->ranges * sizeof *grid.range,
                                 cells * sizeof *grid.range, grid.range);
    pel_grid_finish(&grid);
    return good;
}

// Packs and sends a slab, and on the way finds the range of values in each of its cells.
static bool send_slab(struct pel_residency *residency, const struct pel_volume *volume,
                      const struct pel_slab *slab) {
    bool bricks = residency->layout.reader == PEL_READER_BUFFER;
    struct shipment shipment;
    if (volume->hypertexture)
        return send_endless_ranges(residency, volume, slab);
    if (!shipment_init(&shipment, volume, slab, &residency->layout))
        return false;
    struct pel_grid grid;
    if (!pel_grid_init(&grid, shipment.dims, CELL_VOXELS, 0)) {
        shipment_finish(&shipment);
        return false;
    }
    bool good = true;
    size_t step = bricks ? BRICK_SIDE : shipment.room;
    double scale = 1 / pel_reader_factor(residency->layout.reader, slab->class_index);
    for (size_t first = 0; good && first < shipment.dims[2]; first += step) {
        load_slices(&shipment, first, &grid, (float)scale);
        good = send_slices(residency, &shipment);
    }
    size_t cells = grid.cells[0] * grid.cells[1] * grid.cells[2];
    good = good && pel_buffer_write(residency->ranges, slab->ranges * sizeof *grid.range,
                                    cells * sizeof *grid.range, grid.range);
    shipment_finish(&shipment);
    pel_grid_finish(&grid);
    return good;
}

static bool send_voxels(struct pel_residency *residency, const struct pel_scene *scene,
                        const struct pel_layout *layout) {
    if (memcmp(&residency->layout, layout, sizeof *layout) == 0)
        return true;
    pel_residency_finish(residency);
    residency->layout = *layout;
    bool good = create_memory(residency, layout);
    if (layout->pool)
        good = good && pel_pool_init(&residency->pool, residency->device, scene, layout) &&
               pel_buffer_write(residency->ranges, 0,
                                layout->range_count * sizeof *residency->pool.ranges,
                                residency->pool.ranges);
    for (int s = 0; good && !layout->pool && s < layout->slab_count; s++) {
        const struct pel_volume *volume = scene->volumes[layout->slabs[s].volume];
        good = send_slab(residency, volume, &layout->slabs[s]);
        if (!good)
            pel_fail_in("volume '%s'", volume->name);
    }
    if (!good)
        pel_residency_finish(residency);
    return good;
}

bool pel_residency_update(struct pel_residency *residency, const struct pel_scene *scene,
                          const struct pel_layout *layout, const struct pel_world *world) {
    residency->has_live = world->live_count > 0;
    return send_voxels(residency, scene, layout) &&
           pel_live_update(&residency->live, residency->device, scene, world);
}

bool pel_residency_fill(struct pel_residency *residency, const struct pel_scene *scene,
                        const struct pel_layout_limits *limits, const uint8_t *active) {
    return pel_pool_fill(&residency->pool, residency->device, scene, &residency->layout, limits,
                         active);
}

bool pel_residency_bind(const struct pel_residency *residency, struct pel_kernel *kernel, int index,
                        int voxels) {
    bool good = true;
    if (residency->layout.reader == PEL_READER_BUFFER) {
        const struct pel_pool *pool = &residency->pool;
        for (int b = 0; good && b < VOXEL_BUFFERS; b++) {
            // Every buffer argument of the kernel needs a buffer, if only of something else.
            const struct pel_buffer *shelf =
                pool->shelves[b].buffer ? pool->shelves[b].buffer : pool->pages;
            good = pel_kernel_set_buffer(kernel, index++,
                                         residency->layout.pool ? shelf : residency->buffers[b]);
        }
        if (good && residency->layout.pool)
            good = pel_kernel_set_buffer(kernel, index++, pool->pages);
        if (good && residency->has_live)
            good = pel_kernel_set_buffer(kernel, index, residency->live.recipes.buffer) &&
                   pel_kernel_set_buffer(kernel, index + 1, residency->live.objects);
        return good;
    }
    uint32_t atlas_count = 0;
    for (int class = 0; good && class < VOXEL_CLASS_COUNT; class ++) {
        if (!(voxels & 1 << class))
            continue;
        good = pel_kernel_set_texture(kernel, index++, residency->atlases[class]);
        atlas_count++;
    }
    return good && pel_kernel_set_u32(kernel, index, atlas_count);
}

bool pel_residency_check(const struct pel_layout *layout, const struct pel_layout_limits *limits,
                         uint64_t frame_bytes) {
    uint64_t needed = frame_bytes;
    for (int b = 0; b < VOXEL_BUFFERS; b++)
        needed += layout->buffer_bytes[b];
    for (int class = 0; class < VOXEL_CLASS_COUNT; class ++)
        needed += (uint64_t)layout->atlas[class][0] * layout->atlas[class][1] *
                  layout->atlas[class][2] * pel_voxel_class_bytes(class);
    if (needed > limits->memory_bytes)
        return pel_fail(PEL_ERROR_DEVICE,
                        "volumes and picture need %llu bytes, the device has %llu",
                        (unsigned long long)needed, (unsigned long long)limits->memory_bytes);
    return true;
}

void pel_residency_finish(struct pel_residency *residency) {
    for (int b = 0; b < VOXEL_BUFFERS; b++) {
        pel_buffer_destroy(residency->buffers[b]);
        residency->buffers[b] = NULL;
    }
    for (int class = 0; class < VOXEL_CLASS_COUNT; class ++) {
        pel_texture_destroy(residency->atlases[class]);
        residency->atlases[class] = NULL;
    }
    pel_pool_finish(&residency->pool);
    pel_live_finish(&residency->live);
    pel_buffer_destroy(residency->ranges);
    residency->ranges = NULL;
    memset(&residency->layout, 0, sizeof residency->layout);
}
