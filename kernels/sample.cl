// sample.cl - the raw value of a volume at a position in memory coordinates.
//
// The two readers give the same function, fetch_part, which takes the nearest voxel or interpolates
// linearly, and say in MEMORY_PARAMETERS what the kernel has to be given for it. Everything beyond
// is made of that.
#ifndef SAMPLE_CL
#define SAMPLE_CL

#include "lanes.h"
#include "shared/brick.h"
#include "shared/recipe.h"
#include "shared/variant.h"
#include "shared/world.h"

#ifndef READER
#define READER READER_BUFFER // where voxels are read from
#endif
#ifndef POOL
#define POOL 0 // 1: bricks come from a pool, behind a table of pages, and only those that may be seen
#endif
#ifndef BORDER
#define BORDER 0 // 1: bricks have a border, so that gradients come from one brick
#endif
#ifndef VOXELS
#define VOXELS VOXELS_U8 // which classes of voxels occur
#endif
#ifndef LIVE
#define LIVE 0 // 1: some volume is a recipe, which is worked out at every sample
#endif
#ifndef FILTERS
#define FILTERS FILTERS_LINEAR // which filters occur
#endif

// One class, or one filter, needs no question per sample.
#if VOXELS == VOXELS_U8 || VOXELS == VOXELS_U16 || VOXELS == VOXELS_F32 || VOXELS == VOXELS_RGBA
#define IS_CLASS(part, class) ((VOXELS & (class)) != 0)
#else
#define IS_CLASS(part, class) ((VOXELS & (class)) != 0 && (part)->voxels == (class))
#endif
#define IS_FILTER(part, which)                                                                     \
    (FILTERS == (which) || ((FILTERS & (which)) != 0 && (part)->filter == (which)))
#define IS_CUBIC(part) (IS_FILTER(part, FILTERS_CUBIC_B_SPLINE) || IS_FILTER(part, FILTERS_CATMULL_ROM))

// A sample: the value that the transfer function asks for, and a colour volume's own colour in
// 0..1.
struct sample {
    real raw;
#if VOXELS & VOXELS_RGBA
    real r, g, b;
#endif
};

INLINE real mix_lanes(real a, real b, real weight) {
    return a + weight * (b - a);
}

#if READER == READER_BUFFER
#include "sample_buffer.cl"
#else
#include "sample_image.cl"
#endif
#if FILTERS & FILTERS_CUBIC
#include "cubic.cl"
#endif
#if LIVE
#include "live.cl"
#endif

INLINE struct sample sample_part(MEMORY_PARAMETERS, __constant struct part *part, real x, real y,
                                 real z) {
#if LIVE
    if (part->recipe != 0)
        return sample_live(MEMORY_ARGUMENTS, part, x, y, z);
#endif
#if FILTERS & FILTERS_CUBIC
    if (IS_CUBIC(part))
        return sample_cubic(MEMORY_ARGUMENTS, part, x, y, z, -1);
#endif
    return fetch_part(MEMORY_ARGUMENTS, part, IS_FILTER(part, FILTERS_NEAREST), x, y, z);
}

#endif
