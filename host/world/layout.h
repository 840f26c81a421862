// layout.h - where each volume of a scene goes in a device's memory.
//
// A volume is stored with a border of one voxel on every side that repeats its edge. One that is
// larger than the largest allocation is cut across z into slabs, each with its own border taken
// from its neighbours, of three voxels so that cubic filters and gradients have no seam there
// either. With the `image` reader volumes of one class lie in one atlas; with the `buffer` reader
// volumes share up to VOXEL_BUFFERS buffers.
#ifndef PEL_WORLD_LAYOUT_H
#define PEL_WORLD_LAYOUT_H

#include "pellucid.h"
#include "shared/variant.h"
#include "shared/world.h"

// What a device can hold.
struct pel_layout_limits {
    uint64_t memory_bytes, max_allocation_bytes;
    size_t max_image[3];
    bool texels[VOXEL_CLASS_COUNT]; // 3-D images of that class can be read
    bool images;                    // there are 3-D images at all
};

// Slices first <= z < first + count of a volume, and where they are.
struct pel_slab {
    uint64_t serial;       // of the volume
    int volume;            // index in the scene
    int class_index;       // which bit of VOXELS_*
    int first, count;      // slices, border not counted
    int border[2];         // stored slices before and behind them
    int buffer;            // `buffer` reader: which buffer,
    uint64_t offset_bytes; // and where in it
    u32 ranges;            // index of the first cell's range of values
    size_t origin[3];      // `image` reader: the border's first texel in its atlas
};

struct pel_layout {
    enum pel_reader reader;
    int slab_count;
    struct pel_slab slabs[WORLD_PART_MAX];
    uint64_t buffer_bytes[VOXEL_BUFFERS];
    int border;         // `buffer` reader: 1 where bricks have one, for gradients (shared/brick.h)
    size_t range_count; // cells of all slabs
    int cell_side;      // voxels along a side of a cell
    bool pool;          // bricks come and go behind a table of pages; cells are bricks
    int margin;         // with it: how near a brick's values count for it, in voxels
    size_t atlas[VOXEL_CLASS_COUNT][3]; // texels; 0 where a class does not occur
};

// The class of a voxel type, as the index of its bit in VOXELS_*, and the bytes of one stored
// voxel.
int pel_voxel_class(enum pel_voxel_type type);
size_t pel_voxel_class_bytes(int class_index);

// Stored voxels of a slab along x, y and z, border included.
void pel_slab_dims(const struct pel_slab *slab, const struct pel_volume *volume, size_t dims[3]);

// What the reader multiplies a stored voxel by: images give 0..1 for integers.
double pel_reader_factor(enum pel_reader reader, int class_index);

// Finds a place for all of the scene's volumes. `reader` may be PEL_READER_AUTO with a `preferred`
// one: then the other is taken where the preferred cannot be. Fails (DEVICE) with needed and
// available bytes.
bool pel_layout_plan(struct pel_layout *layout, const struct pel_scene *scene,
                     const struct pel_layout_limits *limits, enum pel_reader reader,
                     enum pel_reader preferred);

#endif
