// occupancy.h - which cells of each part may show something, derived on the device, and what a way
// to skip makes of that.
#ifndef PEL_RENDER_OCCUPANCY_H
#define PEL_RENDER_OCCUPANCY_H

#include "render/block_map.h"
#include "render/hierarchy.h"
#include "render/mirror.h"
#include "render/residency.h"
#include "world/world.h"

// What the cells depend on besides the visible entries.
struct pel_occupancy_key {
    struct pel_layout layout;
    int part_count;
    bool linear;                      // tables are interpolated
    enum pel_skip skip;               // for which
    struct pel_brick_settings bricks; // of `bvh` and `blocks`
    uint64_t masks;                   // a hash of what masks select, and of where
    float stride_depth;               // 0: no strides
    // The last member, with only what matters filled in: what is above is for all parts.
    struct part parts[WORLD_PART_MAX];
};

// What kernels/occupancy.cl is compiled for.
struct pel_occupancy_text {
    enum pel_skip skip;
    int filters, models; // FILTERS_* and MODELS_*
    bool pool, masks, strides;
};

// Zero-initialise.
struct pel_occupancy {
    struct pel_kernel *kernel;
    struct pel_occupancy_text text; // what there is in its program
    struct pel_mirror visible;      // of each table, the first visible entry from each one on
    struct pel_buffer *cells,
        *scratch;               // a byte for each cell of each part, and room to work in
    size_t cell_count;          // room in both
    struct pel_buffer *strides; // likewise, how long runs of samples may be; NULL: never asked for
    size_t stride_count;        // room in it
    struct pel_hierarchy hierarchy; // for `bvh`
    struct pel_block_map blocks;    // for `blocks`
    struct pel_occupancy_key key;   // what they are for; part_count 0 = nothing
    bool dirty[WORLD_PART_MAX];     // parts that the present update derives anew
};

// Derives what `skip` (not AUTO) goes by for a world whose bytes are in `world_buffer`, unless it
// is there from the last time. The kernel for it comes from the program of `render`, one that
// skips. With a pool it also brings the bricks to the device that can be seen. With PEL_SKIP_NONE
// and without a pool only a buffer that kernels can be given is made. False: DEVICE, MEMORY, BUILD.
bool pel_occupancy_update(struct pel_occupancy *occupancy, struct pel_device *device,
                          const struct pel_world *world, const struct pel_buffer *world_buffer,
                          struct pel_residency *residency, const struct pel_scene *scene,
                          const struct pel_layout_limits *limits, const struct pel_kernel *render,
                          enum pel_skip skip);

// The bytes on the device for it.
uint64_t pel_occupancy_bytes(const struct pel_occupancy *occupancy);

// What there is of bricks, sub-blocks or the pool; zeros where nothing is.
struct pel_brick_statistics pel_occupancy_bricks(const struct pel_occupancy *occupancy);

// What the kernel skips by. Borrowed.
const struct pel_buffer *pel_occupancy_map(const struct pel_occupancy *occupancy);
void pel_occupancy_finish(struct pel_occupancy *occupancy);

#endif
