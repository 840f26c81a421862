// gradient_brick.cl - central differences straight from the bricks, for integers and the linear filter.
//
// The six samples one voxel away have the weights of the sample between them, and interpolation is
// linear: so voxels are subtracted first, as integers, and half the interpolation is saved. Where the
// voxels lie follows from one index along each axis. At the volume's edge an index stays, because the
// border repeats the edge, whatever the weight. The same numbers as central_differences, which takes
// what is not handled here.
#ifndef GRADIENT_BRICK_CL
#define GRADIENT_BRICK_CL

#include "sample.cl"

// 1: there are parts that brick_differences handles. Bricks in a pool are not where their index says.
#if READER == READER_BUFFER && !POOL && (VOXELS & (VOXELS_U8 | VOXELS_U16)) != 0 &&                \
    (FILTERS & FILTERS_LINEAR) != 0
#define BRICK_GRADIENT 1
#else
#define BRICK_GRADIENT 0
#endif

#if BRICK_GRADIENT
#if LIVE
#define HAS_VOXELS(part) ((part)->recipe == 0)
#else
#define HAS_VOXELS(part) true
#endif
#define HAS_BRICK_GRADIENT(part)                                                                   \
    (IS_FILTER(part, FILTERS_LINEAR) && HAS_VOXELS(part) &&                                        \
     (IS_CLASS(part, VOXELS_U8) || IS_CLASS(part, VOXELS_U16)))

// What a field of `bits` grows by from one word to the other.
INLINE real change_of(integer more, integer less, int first, int bits) {
    return TO_REAL(((more >> first) & bits) - ((less >> first) & bits));
}

#if VOXELS & VOXELS_U8
INLINE real face_change_u8(__global const ushort *row, const struct indices *more,
                           const struct indices *less, const struct cell *cell) {
    const integer b = load_words(row, more), a = load_words(row, less);
    return mix_lanes(mix_lanes(change_of(b, a, 0, 255), change_of(b, a, 8, 255), cell->y),
                     mix_lanes(change_of(b, a, 16, 255), change_of(b, a, 24, 255), cell->y),
                     cell->x);
}
#endif

#if VOXELS & VOXELS_U16
INLINE real row_change_u16(__global const ushort *row, const struct indices *more,
                           const struct indices *less, real x) {
    const integer b = load_words(row, more), a = load_words(row, less);
    return mix_lanes(change_of(b, a, 0, 65535), change_of(b, a, 16, 65535), x);
}

INLINE real face_change_u16(__global const ushort *row, const struct indices *more,
                            const struct indices *less, const struct cell *cell) {
    return mix_lanes(row_change_u16(row, more, less, cell->x),
                     row_change_u16(row + BRICK_ROW, more, less, cell->x), cell->y);
}
#endif

// How much more the volume is at the cell `more` than at the cell `less`, at the weights of `cell`.
INLINE real change_between(__constant struct part *part, __global const ushort *voxels,
                           integer more, integer less, const struct cell *cell) {
    const struct indices b = spread_indices(more), a = spread_indices(less);
    __global const ushort *next = voxels + BRICK_SLICE;
#if VOXELS & VOXELS_U8
    if (IS_CLASS(part, VOXELS_U8))
        return mix_lanes(face_change_u8(voxels, &b, &a, cell), face_change_u8(next, &b, &a, cell),
                         cell->z);
#endif
#if VOXELS & VOXELS_U16
    return mix_lanes(face_change_u16(voxels, &b, &a, cell), face_change_u16(next, &b, &a, cell),
                     cell->z);
#else
    return (real)(0.0f);
#endif
}

// Where a voxel's index along one axis brings it, if bricks along it lie `brick` elements apart.
INLINE integer axis_offset(integer index, int brick, int voxel) {
    return (index >> BRICK_BITS) * brick + (index & (integer)(BRICK_SIDE - 1)) * voxel;
}

// What the volume grows by over two voxels along one axis; the other two add up to `others`.
INLINE real change_along(__constant struct part *part, __global const ushort *voxels, integer index,
                         float high, int brick, int voxel, integer others,
                         const struct cell *cell) {
    const integer behind = min(index + 1, (integer)((int)high)), before = max(index - 1, (integer)(0));
    return change_between(part, voxels, others + axis_offset(behind, brick, voxel),
                          others + axis_offset(before, brick, voxel), cell);
}

INLINE void brick_differences(MEMORY_PARAMETERS, __constant struct part *part, real x, real y,
                              real z, real difference[3]) {
    const integer ix = TO_INTEGER(x), iy = TO_INTEGER(y), iz = TO_INTEGER(z);
    const struct cell cell = {.x = x - TO_REAL(ix), .y = y - TO_REAL(iy), .z = z - TO_REAL(iz)};
    const int row = part->brick_row * BRICK_VOXELS, slice = part->brick_slice * BRICK_VOXELS;
    const integer at_x = axis_offset(ix, BRICK_VOXELS, 1), at_y = axis_offset(iy, row, BRICK_ROW),
                  at_z = axis_offset(iz, slice, BRICK_SLICE);
    __global const ushort *voxels =
        (__global const ushort *)part_buffer(MEMORY_ARGUMENTS, part) + part->offset + BRICK_LEAD;
    const float4 high = part->memory_high;
    difference[0] = change_along(part, voxels, ix, high.x, BRICK_VOXELS, 1, at_y + at_z, &cell);
    difference[1] = change_along(part, voxels, iy, high.y, row, BRICK_ROW, at_x + at_z, &cell);
    difference[2] = change_along(part, voxels, iz, high.z, slice, BRICK_SLICE, at_x + at_y, &cell);
}
#endif

#endif
