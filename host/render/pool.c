// pool.c - bricks of voxels on the device, of which only those are there that may be seen (Hadwiger
// et al. 2012 in the simple form of Ganter & Manzke 2019, section 5.3: one table of pages, and all
// ranges of values known).
#include "render/pool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/grid.h"
#include "base/error.h"
#include "base/memory.h"
#include "shared/brick.h"
#include "world/brick.h"
#include "world/pack.h"

// Kernels count voxels with 31 bits.
static const size_t places_most = INT32_MAX / BRICK_VOXELS;

// ---- A layer of bricks -------------------------------------------------------------------------

// The slices of one layer of a slab's bricks, and the bricks made of them.
struct layer {
    const struct pel_volume *volume;
    const struct pel_slab *slab;
    size_t dims[3], bricks[3]; // of the slab
    size_t voxel_bytes, brick_bytes, slice_bytes;
    char *slices, *packed; // owned
};

static bool layer_init(struct layer *layer, const struct pel_volume *volume,
                       const struct pel_slab *slab) {
    *layer = (struct layer){.volume = volume, .slab = slab};
    pel_slab_dims(slab, volume, layer->dims);
    for (int c = 0; c < 3; c++)
        layer->bricks[c] = pel_brick_count(layer->dims[c]);
    layer->voxel_bytes = pel_voxel_class_bytes(slab->class_index);
    layer->brick_bytes = BRICK_VOXELS * pel_brick_element_bytes(layer->voxel_bytes);
    layer->slice_bytes = layer->dims[0] * layer->dims[1] * layer->voxel_bytes;
    size_t bytes;
    if (!pel_size_multiply(&bytes, 3,
                           (size_t[]){layer->bricks[0], layer->bricks[1], layer->brick_bytes}))
        return false;
    layer->slices = pel_allocate_voxels((BRICK_SIDE + 1) * layer->slice_bytes);
    layer->packed = layer->slices ? pel_allocate_voxels(bytes) : NULL;
    if (layer->packed)
        return true;
    free(layer->slices);
    return false;
}

static void layer_finish(struct layer *layer) {
    free(layer->slices);
    free(layer->packed);
}

// Packs the bricks of layer z.
static void layer_pack(struct layer *layer, size_t z) {
    size_t first = z * BRICK_SIDE, left = layer->dims[2] - first;
    size_t count = left < BRICK_SIDE + 1 ? left : BRICK_SIDE + 1;
    for (size_t i = 0; i < count; i++)
        pel_pack_slice(layer->volume,
                       layer->slab->first - layer->slab->border[0] + (int)(first + i),
                       layer->slices + i * layer->slice_bytes);
    struct pel_brick_source source = {
        layer->slices, {layer->dims[0], layer->dims[1], count}, 0, layer->voxel_bytes, 0};
    pel_brick_layer(layer->packed, &source);
}

// ---- Ranges of values --------------------------------------------------------------------------

static bool measure_slab(struct pel_pool *pool, const struct pel_volume *volume,
                         const struct pel_slab *slab, int margin) {
    size_t dims[3], bytes;
    pel_slab_dims(slab, volume, dims);
    size_t voxel_bytes = pel_voxel_class_bytes(slab->class_index);
    struct pel_grid grid;
    if (!pel_size_multiply(&bytes, 3, (size_t[]){dims[0], dims[1], voxel_bytes}) ||
        !pel_grid_init(&grid, dims, BRICK_SIDE, (size_t)margin))
        return false;
    void *slice = pel_allocate_voxels(bytes);
    for (size_t z = 0; slice && z < dims[2]; z++) {
        pel_pack_slice(volume, slab->first - slab->border[0] + (int)z, slice);
        pel_grid_add_slice(&grid, z, slice, slab->class_index, 1);
    }
    memcpy(pool->ranges + slab->ranges, grid.range,
           grid.cells[0] * grid.cells[1] * grid.cells[2] * sizeof *grid.range);
    free(slice);
    pel_grid_finish(&grid);
    return slice != NULL;
}

bool pel_pool_init(struct pel_pool *pool, struct pel_device *device, const struct pel_scene *scene,
                   const struct pel_layout *layout) {
    pool->page_count = layout->range_count;
    pool->ranges = pel_allocate(pool->page_count, sizeof *pool->ranges);
    pool->places = pel_allocate(pool->page_count, sizeof *pool->places);
    pool->pages = pel_buffer_create(device, pool->page_count * sizeof(i32), "pages");
    bool good = pool->ranges && pool->places && pool->pages;
    for (int s = 0; good && s < layout->slab_count; s++)
        good = measure_slab(pool, scene->volumes[layout->slabs[s].volume], &layout->slabs[s],
                            layout->margin);
    for (size_t i = 0; good && i < pool->page_count; i++)
        pool->places[i] = -1;
    if (!good)
        pel_pool_finish(pool);
    return good;
}

static void shelf_finish(struct pel_shelf *shelf) {
    pel_buffer_destroy(shelf->buffer);
    free(shelf->pages);
    *shelf = (struct pel_shelf){NULL, NULL, 0};
}

void pel_pool_finish(struct pel_pool *pool) {
    for (int class = 0; class < VOXEL_CLASS_COUNT; class ++)
        shelf_finish(&pool->shelves[class]);
    free(pool->ranges);
    free(pool->places);
    pel_buffer_destroy(pool->pages);
    memset(pool, 0, sizeof *pool);
}

// ---- Places ------------------------------------------------------------------------------------

// The page behind a slab's last one.
static size_t pages_end(const struct pel_layout *layout, int s) {
    return s + 1 < layout->slab_count ? layout->slabs[s + 1].ranges : layout->range_count;
}

// Makes room for `needed` bricks of a class, and some more where the device has it. What was there
// is gone.
static bool shelf_grow(struct pel_pool *pool, struct pel_device *device,
                       const struct pel_layout *layout, const struct pel_layout_limits *limits,
                       int class, size_t needed) {
    struct pel_shelf *shelf = &pool->shelves[class];
    size_t brick_bytes = BRICK_VOXELS * pel_brick_element_bytes(pel_voxel_class_bytes(class));
    size_t most = limits->max_allocation_bytes / brick_bytes;
    if (most > places_most)
        most = places_most;
    if (needed > most)
        return pel_fail(PEL_ERROR_DEVICE,
                        "the %zu bricks that can be seen need %zu bytes, the device's largest "
                        "allocation is %llu",
                        needed, needed * brick_bytes,
                        (unsigned long long)limits->max_allocation_bytes);
    shelf_finish(shelf);
    for (int s = 0; s < layout->slab_count; s++)
        for (size_t i = layout->slabs[s].ranges; i < pages_end(layout, s); i++)
            if (layout->slabs[s].class_index == class)
                pool->places[i] = -1;
    size_t room = needed + needed / 8;
    shelf->capacity = room < most ? room : most;
    shelf->pages = pel_allocate(shelf->capacity, sizeof *shelf->pages);
    shelf->buffer = pel_buffer_create(device, shelf->capacity * brick_bytes, "bricks");
    if (!shelf->pages || !shelf->buffer)
        return false;
    for (size_t i = 0; i < shelf->capacity; i++)
        shelf->pages[i] = PEL_SHELF_FREE;
    return true;
}

// The next place from *from on that is free, or whose brick is not active. There is one.
static i32 shelf_take(struct pel_pool *pool, struct pel_shelf *shelf, const uint8_t *active,
                      size_t *from) {
    for (;; ++*from) {
        i32 page = shelf->pages[*from];
        if (page == PEL_SHELF_STAND_IN || (page >= 0 && active[page]))
            continue;
        if (page >= 0)
            pool->places[page] = -1;
        shelf->pages[*from] = PEL_SHELF_FREE;
        return (i32)(*from)++;
    }
}

// Brings what is missing of one layer of bricks, packed where something is, from page `first` on.
// Bricks that follow each other in both places travel together.
static bool send_layer(struct pel_pool *pool, struct layer *layer, size_t z, size_t first,
                       const uint8_t *active, size_t *from) {
    struct pel_shelf *shelf = &pool->shelves[layer->slab->class_index];
    size_t count = layer->bricks[0] * layer->bricks[1], run = 0;
    bool packed = false;
    for (size_t i = 0; i < count; i++) {
        if (!active[first + i] || pool->places[first + i] >= 0)
            continue;
        if (!packed)
            layer_pack(layer, z);
        packed = true;
        for (run = 0;
             i + run < count && active[first + i + run] && pool->places[first + i + run] < 0;
             run++) {
            size_t probe = *from;
            i32 place = shelf_take(pool, shelf, active, &probe);
            if (run > 0 && place != pool->places[first + i] + (i32)run)
                break;
            *from = probe;
            pool->places[first + i + run] = place;
            shelf->pages[place] = (i32)(first + i + run);
        }
        if (!pel_buffer_write(shelf->buffer, (size_t)pool->places[first + i] * layer->brick_bytes,
                              run * layer->brick_bytes, layer->packed + i * layer->brick_bytes))
            return false;
        i += run - 1;
    }
    return true;
}

// ---- Stand-ins ---------------------------------------------------------------------------------

// Fills a brick with one value as its class stores it.
static void fill_brick(char *brick, int class, float value) {
    for (size_t i = 0; i < BRICK_VOXELS; i++) {
        uint16_t word = (uint16_t)value;
        uint8_t rgba[4] = {0, 0, 0, (uint8_t)value};
        switch (class) {
        case 0:
            brick[2 * i] = brick[2 * i + 1] = (char)(uint8_t)value;
            break;
        case 1:
            memcpy(brick + 2 * i, &word, sizeof word);
            break;
        case 2:
            memcpy(brick + 4 * i, &value, sizeof value);
            break;
        default:
            memcpy(brick + 4 * i, rgba, sizeof rgba);
            break;
        }
    }
}

// Gives a slab a brick in place of all that are not there; *place is -1 when none is missing.
static bool stand_in(struct pel_pool *pool, const struct layer *layer, const uint8_t *active,
                     size_t end, size_t *from, i32 *place) {
    struct pel_shelf *shelf = &pool->shelves[layer->slab->class_index];
    size_t page = layer->slab->ranges;
    while (page < end && active[page])
        page++;
    *place = -1;
    if (page == end)
        return true;
    *place = shelf_take(pool, shelf, active, from);
    shelf->pages[*place] = PEL_SHELF_STAND_IN;
    // A brick without any value can only be one of floats.
    const float *range = pool->ranges[page];
    fill_brick(layer->packed, layer->slab->class_index, range[0] <= range[1] ? range[0] : NAN);
    return pel_buffer_write(shelf->buffer, (size_t)*place * layer->brick_bytes, layer->brick_bytes,
                            layer->packed);
}

// ---- All of it ---------------------------------------------------------------------------------

// Room for the active bricks of each class and a stand-in for each slab.
static bool make_room(struct pel_pool *pool, struct pel_device *device,
                      const struct pel_layout *layout, const struct pel_layout_limits *limits,
                      const uint8_t *active) {
    size_t needed[VOXEL_CLASS_COUNT] = {0};
    for (int s = 0; s < layout->slab_count; s++) {
        size_t *count = &needed[layout->slabs[s].class_index];
        ++*count;
        for (size_t i = layout->slabs[s].ranges; i < pages_end(layout, s); i++)
            *count += active[i] != 0;
    }
    for (int class = 0; class < VOXEL_CLASS_COUNT; class ++) {
        struct pel_shelf *shelf = &pool->shelves[class];
        for (size_t i = 0; i < shelf->capacity; i++)
            if (shelf->pages[i] == PEL_SHELF_STAND_IN)
                shelf->pages[i] = PEL_SHELF_FREE;
        if (needed[class] > shelf->capacity &&
            !shelf_grow(pool, device, layout, limits, class, needed[class]))
            return false;
    }
    return true;
}

static bool fill_slab(struct pel_pool *pool, const struct pel_volume *volume,
                      const struct pel_layout *layout, int s, const uint8_t *active, size_t *from,
                      i32 *place) {
    const struct pel_slab *slab = &layout->slabs[s];
    struct layer layer;
    if (!layer_init(&layer, volume, slab))
        return false;
    size_t end = pages_end(layout, s), per_layer = layer.bricks[0] * layer.bricks[1];
    bool good = true;
    for (size_t z = 0; good && z < layer.bricks[2]; z++)
        good = send_layer(pool, &layer, z, slab->ranges + z * per_layer, active, from);
    good = good && stand_in(pool, &layer, active, end, from, place);
    layer_finish(&layer);
    return good;
}

bool pel_pool_fill(struct pel_pool *pool, struct pel_device *device, const struct pel_scene *scene,
                   const struct pel_layout *layout, const struct pel_layout_limits *limits,
                   const uint8_t *active) {
    pool->filled = false;
    i32 *table = pel_allocate(pool->page_count, sizeof *table);
    bool good = table && make_room(pool, device, layout, limits, active);
    size_t from[VOXEL_CLASS_COUNT] = {0};
    i32 stand_ins[WORLD_PART_MAX];
    for (int s = 0; good && s < layout->slab_count; s++) {
        const struct pel_volume *volume = scene->volumes[layout->slabs[s].volume];
        good = fill_slab(pool, volume, layout, s, active, &from[layout->slabs[s].class_index],
                         &stand_ins[s]) ||
               pel_fail_in("volume '%s'", volume->name);
    }
    // Only now, because a brick of one slab may have had to make room for one of a later slab.
    pool->resident = 0;
    for (int s = 0; good && s < layout->slab_count; s++)
        for (size_t i = layout->slabs[s].ranges; i < pages_end(layout, s); i++) {
            pool->resident += pool->places[i] >= 0;
            table[i] = pool->places[i] >= 0 ? pool->places[i] : stand_ins[s];
        }
    good = good && pel_buffer_write(pool->pages, 0, pool->page_count * sizeof *table, table);
    free(table);
    pool->filled = good;
    for (int class = 0; !good && class < VOXEL_CLASS_COUNT; class ++) {
        shelf_finish(&pool->shelves[class]);
        for (size_t i = 0; pool->places && i < pool->page_count; i++)
            pool->places[i] = -1;
    }
    return good;
}
