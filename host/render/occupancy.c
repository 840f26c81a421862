// occupancy.c - which cells of each part may show something, derived on the device.
//
// Nothing but counts of visible table entries is sent, so editing a transfer function costs two
// look-ups a cell and three passes over the cells, and moving the camera or a volume costs nothing
// here.
#include "render/occupancy.h"

#include <string.h>

enum { GROUP = 16 };

static bool find_kernels(struct pel_occupancy *occupancy, const struct pel_kernel *render) {
    if (!occupancy->occupy)
        occupancy->occupy = pel_kernel_sibling(render, "occupy");
    if (occupancy->occupy && !occupancy->spread)
        occupancy->spread = pel_kernel_sibling(render, "spread");
    return occupancy->occupy && occupancy->spread;
}

static bool make_room(struct pel_occupancy *occupancy, struct pel_device *device, size_t cells) {
    if (occupancy->cells && cells <= occupancy->cell_count)
        return true;
    pel_buffer_destroy(occupancy->cells);
    pel_buffer_destroy(occupancy->scratch);
    occupancy->key.part_count = 0;
    occupancy->cell_count = cells;
    occupancy->cells = pel_buffer_create(device, cells, "cells");
    occupancy->scratch = pel_buffer_create(device, cells, "cells");
    return occupancy->cells && occupancy->scratch;
}

// Padding is cleared, so that keys can be compared byte by byte.
static void make_key(struct pel_occupancy_key *key, const struct pel_world *world,
                     const struct pel_layout *layout) {
    memset(key, 0, sizeof *key);
    memcpy(&key->layout, layout, sizeof *layout);
    key->part_count = world->bytes.part_count;
    key->linear = world->table_linear;
    for (int p = 0; p < key->part_count; p++) {
        const struct part *part = &world->bytes.parts[p];
        struct part *copy = &key->parts[p];
        copy->table_scale = part->table_scale;
        copy->table_bias = part->table_bias;
        copy->table_last = part->table_last;
        copy->table_nearest = part->table_nearest;
        copy->cells = part->cells;
        copy->ranges = part->ranges;
        copy->visible = part->visible;
    }
}

// The number of cells of part p: those up to the next part's.
static size_t part_cells(const struct pel_world *world, int p) {
    size_t end =
        p + 1 < world->bytes.part_count ? world->bytes.parts[p + 1].cells : world->cell_count;
    return end - world->bytes.parts[p].cells;
}

static bool launch(struct pel_kernel *kernel, size_t cells) {
    return pel_kernel_launch(kernel, (cells + GROUP - 1) / GROUP * GROUP, GROUP);
}

static bool spread(struct pel_occupancy *occupancy, const struct pel_buffer *world_buffer,
                   const struct pel_buffer *in, const struct pel_buffer *out, int p, size_t cells,
                   uint32_t axis) {
    struct pel_kernel *kernel = occupancy->spread;
    return pel_kernel_set_buffer(kernel, 0, world_buffer) && pel_kernel_set_buffer(kernel, 1, in) &&
           pel_kernel_set_buffer(kernel, 2, out) && pel_kernel_set_u32(kernel, 3, (uint32_t)p) &&
           pel_kernel_set_u32(kernel, 4, (uint32_t)cells) && pel_kernel_set_u32(kernel, 5, axis) &&
           launch(kernel, cells);
}

static bool derive_part(struct pel_occupancy *occupancy, const struct pel_world *world,
                        const struct pel_buffer *world_buffer,
                        const struct pel_residency *residency, int p) {
    struct pel_kernel *occupy = occupancy->occupy;
    size_t cells = part_cells(world, p);
    return pel_kernel_set_buffer(occupy, 0, world_buffer) &&
           pel_kernel_set_buffer(occupy, 1, residency->ranges) &&
           pel_kernel_set_buffer(occupy, 2, occupancy->visible.buffer) &&
           pel_kernel_set_buffer(occupy, 3, occupancy->scratch) &&
           pel_kernel_set_u32(occupy, 4, (uint32_t)p) &&
           pel_kernel_set_u32(occupy, 5, (uint32_t)cells) &&
           pel_kernel_set_u32(occupy, 6, world->table_linear) && launch(occupy, cells) &&
           spread(occupancy, world_buffer, occupancy->scratch, occupancy->cells, p, cells, 0) &&
           spread(occupancy, world_buffer, occupancy->cells, occupancy->scratch, p, cells, 1) &&
           spread(occupancy, world_buffer, occupancy->scratch, occupancy->cells, p, cells, 2);
}

bool pel_occupancy_update(struct pel_occupancy *occupancy, struct pel_device *device,
                          const struct pel_world *world, const struct pel_buffer *world_buffer,
                          const struct pel_residency *residency, const struct pel_kernel *render,
                          bool skip) {
    if (!skip || world->bytes.part_count == 0)
        return make_room(occupancy, device, 1);
    bool changed = false;
    if (!find_kernels(occupancy, render) || !make_room(occupancy, device, world->cell_count) ||
        !pel_mirror_update(&occupancy->visible, device, world->visible,
                           world->visible_words * sizeof *world->visible, 0, "visible entries",
                           &changed))
        return false;
    struct pel_occupancy_key key;
    make_key(&key, world, &residency->layout);
    if (!changed && memcmp(&key, &occupancy->key, sizeof key) == 0)
        return true;
    occupancy->key.part_count = 0;
    for (int p = 0; p < world->bytes.part_count; p++)
        if (!derive_part(occupancy, world, world_buffer, residency, p))
            return false;
    if (!pel_device_finish(device))
        return false;
    memcpy(&occupancy->key, &key, sizeof key);
    return true;
}

void pel_occupancy_finish(struct pel_occupancy *occupancy) {
    pel_kernel_destroy(occupancy->occupy);
    pel_kernel_destroy(occupancy->spread);
    pel_mirror_finish(&occupancy->visible);
    pel_buffer_destroy(occupancy->cells);
    pel_buffer_destroy(occupancy->scratch);
    memset(occupancy, 0, sizeof *occupancy);
}
