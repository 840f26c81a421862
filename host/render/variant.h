// variant.h - which kernel a frame needs, and the -D definitions that make it.
#ifndef PEL_RENDER_VARIANT_H
#define PEL_RENDER_VARIANT_H

#include "world/world.h"

enum { PEL_VARIANT_BYTES = 640 };

// Zero-initialise and fill: variants are compared by the text they are written as.
struct pel_variant {
    int lanes;      // rays per work-item
    int group_rows; // packets above each other in a work-group
    int reader;     // READER_*
    int voxels;     // VOXELS_*
    int filters;    // FILTERS_*
    int mixing;     // MIXING_*
    int models;     // MODELS_*
    int skip;       // SKIP_*
    bool pool;      // bricks come from a pool
    bool border;    // bricks have a border, for gradients
    int eyes;       // EYES_*
    int capacity;   // parts: 1, 8 or WORLD_PART_MAX
    bool clip;      // some part is clipped
    bool masked;    // where some part is shown, another volume decides
    bool shading;   // some part needs normals
    int secondary;  // SECONDARY_*
    bool style;     // other gradients than central differences, or opacity that follows them
    bool table_linear;
    bool supersampling; // one of several rays of each pixel at a time
    bool jitter;        // every ray has a phase of its own
    bool debug;         // a number of each ray in place of its light
    bool live;          // some volume is worked out at every sample
    bool probe;         // one ray that writes down what it meets
    bool table_global;  // the tables do not fit into constant memory
};

// The variant for a world on a device with `constant_bytes` of constant memory.
struct pel_variant pel_variant_choose(const struct pel_world *world, enum pel_reader reader,
                                      enum pel_skip skip, int lanes, uint64_t constant_bytes);

// Every definition by name. The only place that knows the kernels' knobs.
void pel_variant_write(const struct pel_variant *variant, char text[PEL_VARIANT_BYTES]);

#endif
