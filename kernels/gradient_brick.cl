// gradient_brick.cl - samples with central differences straight from bricks with a border, for integers and the linear
// filter.
//
// The six samples one voxel away have the weights of the sample between them, and interpolation is linear: so voxels
// are subtracted first, and half the interpolation is saved. All 32 voxels lie at fixed distances from the first of the
// sample's own, four of a row, or of two rows of bytes, in each load of eight bytes. Up to rounding the same numbers as
// central_differences, which takes what is not handled here. The sample's own voxels are among them: its value costs no
// load more, and is to the bit what sample_part gives.
//
// Integers become floats without conversion: n below the exponent bits of 2^23 is 2^23 + n, and the difference of two
// such floats is exact. The second byte of a word need not even move: below the exponent bits of 2^15 it adds n. So
// voxels that are subtracted from each other are both made from an even byte or both from an odd one.
#ifndef GRADIENT_BRICK_CL
#define GRADIENT_BRICK_CL

#include "sample.cl"

// 1: there are parts that look_around handles.
#if READER == READER_BUFFER && BORDER && (VOXELS & (VOXELS_U8 | VOXELS_U16)) != 0 &&               \
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

// The eight bytes of each lane that begin at its element of `row`, as two words. With a packet two lanes are loaded
// such that each comes to lie in its place, and the words of even and odd lanes then change places by shifts.
struct twin {
    integer first, second;
};

struct __attribute__((packed, aligned(2))) loose_longs {
    ulong2 longs;
};

INLINE struct twin load_twins(__global const ushort *row, const struct indices *at) {
    struct twin twin;
#if LANES == 1
    twin.first = load_words(row, at);
    twin.second = load_words(row + 2, at);
#else
#define LONGS(lane, place)                                                                         \
    ((__global const struct loose_longs *)(row - 4 * (place) + at->of[lane]))->longs
#define TWO_LANES(a, b) ((ulong2)(LONGS(a, 0).x, LONGS(b, 1).y))
#if LANES == 4
    const ulong2 even = TWO_LANES(0, 2), odd = TWO_LANES(1, 3);
#elif LANES == 8
    const ulong4 even = (ulong4)(TWO_LANES(0, 2), TWO_LANES(4, 6)),
                 odd = (ulong4)(TWO_LANES(1, 3), TWO_LANES(5, 7));
#else
    const ulong8 even = (ulong8)(TWO_LANES(0, 2), TWO_LANES(4, 6), TWO_LANES(8, 10),
                                 TWO_LANES(12, 14)),
                 odd = (ulong8)(TWO_LANES(1, 3), TWO_LANES(5, 7), TWO_LANES(9, 11),
                                TWO_LANES(13, 15));
#endif
    twin.first = AS_INTEGER((even & 0xffffffffUL) | (odd << 32));
    twin.second = AS_INTEGER((even >> 32) | (odd & 0xffffffff00000000UL));
#endif
    return twin;
}

// Voxels (x, y), (x + 1, y), (x, y + 1) and (x + 1, y + 1) of a slice, as floats with something above them; and where
// the slice is one of the cell's two, its value and how it changes along x and y.
struct slice {
    real near, right, down, far;
    real value, along_x, along_y;
};

// What the voxels around a sample tell: its raw value, and the difference that the gradient makes over two voxels.
struct surroundings {
    real raw, difference[3];
};

INLINE real mix_face(real near, real right, real down, real far, const struct cell *cell) {
    return mix_lanes(mix_lanes(near, right, cell->x), mix_lanes(down, far, cell->x), cell->y);
}

#if VOXELS & VOXELS_U8
#define ABOVE_EVEN_BYTE 0x1p23f
#define ABOVE_ODD_BYTE 0x1p15f

INLINE real even_byte(integer word) {
    return AS_REAL((word & 0xff) | 0x4b000000);
}

INLINE real odd_byte(integer word) {
    return AS_REAL((word & 0xff00) | 0x47000000);
}

// A slice beside the cell.
INLINE struct slice outer_slice_u8(__global const ushort *voxels, const struct indices *at) {
    const integer word = load_words(voxels, at);
    struct slice s;
    s.near = odd_byte(word << 8);
    s.right = odd_byte(word >> 8);
    s.down = even_byte(word >> 8);
    s.far = even_byte(word >> 24);
    return s;
}

// One of the cell's own. Two loads hold rows y - 1 and y, and y + 1 and y + 2, each of x - 1 ... x + 2.
INLINE struct slice inner_slice_u8(__global const ushort *voxels, const struct indices *at,
                                   const struct cell *cell) {
    const struct twin up = load_twins(voxels - BRICK_ROW - 1, at),
                      low = load_twins(voxels + BRICK_ROW - 1, at);
    const integer up_high = up.first >> 16, low_high = low.first >> 16;
    struct slice s;
    s.near = odd_byte(up_high);
    s.right = odd_byte(up.second);
    s.down = even_byte(low_high);
    s.far = even_byte(low.second);
    s.value = mix_lanes(
        mix_lanes(s.near - ABOVE_ODD_BYTE, s.down - ABOVE_EVEN_BYTE, cell->y),
        mix_lanes(s.right - ABOVE_ODD_BYTE, s.far - ABOVE_EVEN_BYTE, cell->y), cell->x);
    s.along_x = mix_face(s.right - odd_byte(up.first), odd_byte(up.second >> 16) - s.near,
                         s.far - even_byte(low.first), even_byte(low.second >> 16) - s.down, cell);
    s.along_y = mix_face(s.down - even_byte(up_high), s.far - even_byte(up.second), odd_byte(low_high) - s.near,
                         odd_byte(low.second) - s.right, cell);
    return s;
}
#endif

#if VOXELS & VOXELS_U16
#define ABOVE_HALF 0x1p23f

INLINE real low_half(integer word) {
    return AS_REAL((word & 0xffff) | 0x4b000000);
}

INLINE real high_half(integer word) {
    return low_half(word >> 16);
}

INLINE struct slice outer_slice_u16(__global const ushort *voxels, const struct indices *at) {
    const integer row = load_words(voxels, at), next = load_words(voxels + BRICK_ROW, at);
    struct slice s;
    s.near = low_half(row);
    s.right = high_half(row);
    s.down = low_half(next);
    s.far = high_half(next);
    return s;
}

INLINE struct slice inner_slice_u16(__global const ushort *voxels, const struct indices *at,
                                    const struct cell *cell) {
    const struct twin row = load_twins(voxels - 1, at),
                      next = load_twins(voxels + BRICK_ROW - 1, at);
    const integer before = load_words(voxels - BRICK_ROW, at),
                  behind = load_words(voxels + 2 * BRICK_ROW, at);
    struct slice s;
    s.near = high_half(row.first);
    s.right = low_half(row.second);
    s.down = high_half(next.first);
    s.far = low_half(next.second);
    s.value = mix_face(s.near - ABOVE_HALF, s.right - ABOVE_HALF, s.down - ABOVE_HALF, s.far - ABOVE_HALF, cell);
    s.along_x = mix_face(s.right - low_half(row.first), high_half(row.second) - s.near,
                         s.far - low_half(next.first), high_half(next.second) - s.down, cell);
    s.along_y = mix_face(s.down - low_half(before), s.far - high_half(before),
                         low_half(behind) - s.near, high_half(behind) - s.right, cell);
    return s;
}
#endif

// What values grow by over two slices.
INLINE real change_across(const struct slice *more, const struct slice *less,
                          const struct cell *cell) {
    return mix_face(more->near - less->near, more->right - less->right, more->down - less->down,
                    more->far - less->far, cell);
}

// The surroundings of a place in memory coordinates.
INLINE void look_around(MEMORY_PARAMETERS, __constant struct part *part, real x, real y, real z,
                        struct surroundings *around) {
    const integer ix = TO_INTEGER(x), iy = TO_INTEGER(y), iz = TO_INTEGER(z);
    const struct cell cell = {.x = x - TO_REAL(ix), .y = y - TO_REAL(iy), .z = z - TO_REAL(iz)};
    integer offset;
    keep_indices(&offset, voxel_index(part, ix, iy, iz PAGES_ARGUMENT));
    const struct indices at = read_indices(&offset);
    __global const ushort *voxels =
        (__global const ushort *)part_buffer(MEMORY_ARGUMENTS, part) + part->offset;
    struct slice before, first, second, behind;
#if VOXELS & VOXELS_U8
    if (IS_CLASS(part, VOXELS_U8)) {
        first = inner_slice_u8(voxels, &at, &cell);
        second = inner_slice_u8(voxels + BRICK_SLICE, &at, &cell);
        before = outer_slice_u8(voxels - BRICK_SLICE, &at);
        behind = outer_slice_u8(voxels + 2 * BRICK_SLICE, &at);
    }
#endif
#if VOXELS & VOXELS_U16
    if (IS_CLASS(part, VOXELS_U16)) {
        first = inner_slice_u16(voxels, &at, &cell);
        second = inner_slice_u16(voxels + BRICK_SLICE, &at, &cell);
        before = outer_slice_u16(voxels - BRICK_SLICE, &at);
        behind = outer_slice_u16(voxels + 2 * BRICK_SLICE, &at);
    }
#endif
    around->raw = mix_lanes(first.value, second.value, cell.z);
    around->difference[0] = mix_lanes(first.along_x, second.along_x, cell.z);
    around->difference[1] = mix_lanes(first.along_y, second.along_y, cell.z);
    around->difference[2] = mix_lanes(change_across(&second, &before, &cell),
                                      change_across(&behind, &first, &cell), cell.z);
}
#endif

#endif
