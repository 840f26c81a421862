// residency.c - a scene's voxels on the device, kept from frame to frame.
#include "render/residency.h"

#include <stdlib.h>
#include <string.h>

#include "accel/grid.h"
#include "base/error.h"
#include "base/memory.h"
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
    for (int b = 0; !image && b < VOXEL_BUFFERS; b++) {
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

// Sends `count` packed slices of a slab, from its border's slice `first` on.
static bool send_slices(struct pel_residency *residency, const struct pel_slab *slab,
                        const size_t slice_dims[2], size_t slice_bytes, size_t first, size_t count,
                        const void *slices) {
    if (residency->layout.reader == PEL_READER_BUFFER)
        return pel_buffer_write(residency->buffers[slab->buffer],
                                slab->offset_bytes + first * slice_bytes, count * slice_bytes,
                                slices);
    size_t origin[3] = {slab->origin[0], slab->origin[1], slab->origin[2] + first};
    size_t dims[3] = {slice_dims[0], slice_dims[1], count};
    return pel_texture_write(residency->atlases[slab->class_index], origin, dims, slices);
}

// Packs and sends a slab, and on the way finds the range of values in each of its cells.
static bool send_slab(struct pel_residency *residency, const struct pel_volume *volume,
                      const struct pel_slab *slab) {
    size_t dims[3], slice_bytes;
    pel_slab_dims(slab, volume, dims);
    if (!pel_size_multiply(&slice_bytes, 3,
                           (size_t[]){dims[0], dims[1], pel_voxel_class_bytes(slab->class_index)}))
        return false;
    size_t most = piece_bytes / slice_bytes > 0 ? piece_bytes / slice_bytes : 1;
    if (most > dims[2])
        most = dims[2];
    struct pel_grid grid;
    if (!pel_grid_init(&grid, dims))
        return false;
    char *piece = pel_allocate_voxels(most * slice_bytes);
    bool good = piece != NULL;
    double scale = 1 / pel_reader_factor(residency->layout.reader, slab->class_index);
    for (size_t first = 0; good && first < dims[2]; first += most) {
        size_t count = dims[2] - first < most ? dims[2] - first : most;
        for (size_t i = 0; i < count; i++) {
            char *slice = piece + i * slice_bytes;
            pel_pack_slice(volume, slab->first - slab->border[0] + (int)(first + i), slice);
            pel_grid_add_slice(&grid, first + i, slice, slab->class_index, (float)scale);
        }
        good = send_slices(residency, slab, dims, slice_bytes, first, count, piece);
    }
    size_t cells = grid.cells[0] * grid.cells[1] * grid.cells[2];
    good = good && pel_buffer_write(residency->ranges, slab->ranges * sizeof *grid.range,
                                    cells * sizeof *grid.range, grid.range);
    free(piece);
    pel_grid_finish(&grid);
    return good;
}

bool pel_residency_update(struct pel_residency *residency, const struct pel_scene *scene,
                          const struct pel_layout *layout) {
    if (memcmp(&residency->layout, layout, sizeof *layout) == 0)
        return true;
    pel_residency_finish(residency);
    residency->layout = *layout;
    bool good = create_memory(residency, layout);
    for (int s = 0; good && s < layout->slab_count; s++) {
        const struct pel_volume *volume = scene->volumes[layout->slabs[s].volume];
        good = send_slab(residency, volume, &layout->slabs[s]);
        if (!good)
            pel_fail_in("volume '%s'", volume->name);
    }
    if (!good)
        pel_residency_finish(residency);
    return good;
}

bool pel_residency_bind(const struct pel_residency *residency, struct pel_kernel *kernel, int index,
                        int voxels) {
    bool good = true;
    if (residency->layout.reader == PEL_READER_BUFFER) {
        for (int b = 0; good && b < VOXEL_BUFFERS; b++)
            good = pel_kernel_set_buffer(kernel, index++, residency->buffers[b]);
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

void pel_residency_finish(struct pel_residency *residency) {
    for (int b = 0; b < VOXEL_BUFFERS; b++) {
        pel_buffer_destroy(residency->buffers[b]);
        residency->buffers[b] = NULL;
    }
    for (int class = 0; class < VOXEL_CLASS_COUNT; class ++) {
        pel_texture_destroy(residency->atlases[class]);
        residency->atlases[class] = NULL;
    }
    pel_buffer_destroy(residency->ranges);
    residency->ranges = NULL;
    memset(&residency->layout, 0, sizeof residency->layout);
}
