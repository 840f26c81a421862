// sample_buffer.cl - voxels in plain memory, and our own interpolation in float.
//
// A volume is stored with a border of one voxel that repeats its edge, so clamp-to-edge costs nothing and
// rounding can never lead outside. Included by sample.cl.
#ifndef SAMPLE_BUFFER_CL
#define SAMPLE_BUFFER_CL

#if POOL
#define PAGES_PARAMETER , __global const int *pages
#define PAGES_ARGUMENT , pages
#else
#define PAGES_PARAMETER
#define PAGES_ARGUMENT
#endif

// Of the bricks of all parts (shared/brick.h).
#define BRICK_ROW BRICK_ROW_OF(BORDER)
#define BRICK_SLICE BRICK_SLICE_OF(BORDER)

#define MEMORY_PARAMETERS                                                                          \
    __global const uchar *buffer0, __global const uchar *buffer1, __global const uchar *buffer2,   \
        __global const uchar *buffer3 PAGES_PARAMETER LIVE_PARAMETERS
#define MEMORY_ARGUMENTS buffer0, buffer1, buffer2, buffer3 PAGES_ARGUMENT LIVE_ARGUMENTS

// Recipes, and the values of the volumes that they grow on.
#if LIVE
#define LIVE_PARAMETERS , __constant struct recipe *recipes, __global const float *objects
#define LIVE_ARGUMENTS , recipes, objects
#else
#define LIVE_PARAMETERS
#define LIVE_ARGUMENTS
#endif

// The eight voxels around a position: the index of the first, and the weights along the axes.
struct cell {
    integer offset; // by keep_indices
    real x, y, z;
};

#define LOAD_PAGE(at) pages[at]

// The index of a voxel, from the part's first, with the next ones along all axes in the same brick.
INLINE integer voxel_index(__constant struct part *part, integer x, integer y,
                           integer z PAGES_PARAMETER) {
    const integer bx = x >> BRICK_BITS, by = y >> BRICK_BITS, bz = z >> BRICK_BITS;
#if POOL
    const integer inside = BRICK_SIDE - 1;
    const integer page = bz * part->brick_slice + by * part->brick_row + bx + (int)part->ranges;
    return GATHER(int, LOAD_PAGE, page) * BRICK_VOXELS_OF(BORDER) + (z & inside) * BRICK_SLICE +
           (y & inside) * BRICK_ROW + (x & inside) + BRICK_FIRST_OF(BORDER);
#else
    // As if all were one brick, in floats, which are exact there (BRICK_ALONG_MAX) and have one instruction to multiply
    // and add; and for every brick before, what lies between that and its true place.
    const int bricks = BRICK_VOXELS_OF(BORDER);
    const integer one =
        TO_INTEGER(TO_REAL(z) * (float)BRICK_SLICE + (TO_REAL(y) * (float)BRICK_ROW + TO_REAL(x)));
    return bz * (part->brick_slice * bricks - BRICK_SIDE * BRICK_SLICE) +
           by * (part->brick_row * bricks - BRICK_SIDE * BRICK_ROW) + bx * (bricks - BRICK_SIDE) +
           (one + BRICK_FIRST_OF(BORDER));
#endif
}

#define LOAD(at) row[at]
#define LOAD_NEXT(at) row[(at) + 1]

#if VOXELS & (VOXELS_U8 | VOXELS_U16)
// Words that begin at any element.
struct __attribute__((packed, aligned(2))) loose_word {
    int word;
};
struct __attribute__((packed, aligned(2))) loose_words {
    int4 words;
};

// The word of each lane that begins at its element of `row`. With a packet each is loaded among four such that it comes
// to lie in its place: a load and a blend, where a list of words becomes a slow gather instruction.
INLINE integer load_words(__global const ushort *row, const struct indices *at) {
#define WORDS(lane, place)                                                                         \
    ((__global const struct loose_words *)(row + at->of[lane] - 2 * (place)))->words
#define FOUR_WORDS(lane)                                                                           \
    (int4)(WORDS(lane, 0).x, WORDS(lane + 1, 1).y, WORDS(lane + 2, 2).z, WORDS(lane + 3, 3).w)
#if LANES == 1
    return ((__global const struct loose_word *)(row + at->of[0]))->word;
#elif LANES == 4
    return FOUR_WORDS(0);
#elif LANES == 8
    return (int8)(FOUR_WORDS(0), FOUR_WORDS(4));
#else
    return (int16)(FOUR_WORDS(0), FOUR_WORDS(4), FOUR_WORDS(8), FOUR_WORDS(12));
#endif
}

INLINE real bits_of(integer word, int first, int bits) {
    return TO_REAL((word >> first) & bits);
}
#endif

#if VOXELS & VOXELS_U8
// Interpolates over x and y. A word holds voxels (0,0), (0,1), (1,0) and (1,1).
INLINE real face_u8(__global const ushort *row, const struct indices *at, const struct cell *cell) {
    const integer word = load_words(row, at);
    return mix_lanes(mix_lanes(bits_of(word, 0, 255), bits_of(word, 8, 255), cell->y),
                     mix_lanes(bits_of(word, 16, 255), bits_of(word, 24, 255), cell->y), cell->x);
}

INLINE real linear_u8(__global const ushort *voxels, const struct cell *cell) {
    const struct indices at = read_indices(&cell->offset);
    return mix_lanes(face_u8(voxels, &at, cell), face_u8(voxels + BRICK_SLICE, &at, cell), cell->z);
}

INLINE real nearest_u8(__global const ushort *row, integer offset) {
    return TO_REAL(TO_INTEGER(GATHER(ushort, LOAD, offset)) & 255);
}
#endif

#if VOXELS & VOXELS_U16
// Interpolates over x. A word holds voxels 0 and 1.
INLINE real row_u16(__global const ushort *row, const struct indices *at, real x) {
    const integer word = load_words(row, at);
    return mix_lanes(bits_of(word, 0, 65535), bits_of(word, 16, 65535), x);
}

INLINE real linear_u16(__global const ushort *voxels, const struct cell *cell) {
    const struct indices at = read_indices(&cell->offset);
    __global const ushort *next = voxels + BRICK_SLICE;
    return mix_lanes(mix_lanes(row_u16(voxels, &at, cell->x),
                               row_u16(voxels + BRICK_ROW, &at, cell->x), cell->y),
                     mix_lanes(row_u16(next, &at, cell->x),
                               row_u16(next + BRICK_ROW, &at, cell->x), cell->y),
                     cell->z);
}

INLINE real nearest_u16(__global const ushort *row, integer offset) {
    return TO_REAL(GATHER(ushort, LOAD, offset));
}
#endif

#if VOXELS & VOXELS_F32
INLINE real row_f32(__global const float *row, integer offset, real x) {
    return mix_lanes(GATHER(float, LOAD, offset), GATHER(float, LOAD_NEXT, offset), x);
}

INLINE real nearest_f32(__global const float *row, integer offset) {
    return GATHER(float, LOAD, offset);
}

INLINE real linear_f32(__global const float *voxels, const struct cell *cell) {
    const integer at = cell->offset;
    __global const float *next = voxels + BRICK_SLICE;
    return mix_lanes(
        mix_lanes(row_f32(voxels, at, cell->x), row_f32(voxels + BRICK_ROW, at, cell->x), cell->y),
        mix_lanes(row_f32(next, at, cell->x), row_f32(next + BRICK_ROW, at, cell->x), cell->y),
        cell->z);
}
#endif

#if VOXELS & VOXELS_RGBA
INLINE real channel(integer voxel, int shift) {
    return TO_REAL((voxel >> shift) & 255);
}

// One corner of the cell, added to the sample with its weight.
INLINE void add_corner(struct sample *s, __global const int *row, integer offset, real weight) {
    const integer voxel = GATHER(int, LOAD, offset);
    s->r += weight * channel(voxel, 0);
    s->g += weight * channel(voxel, 8);
    s->b += weight * channel(voxel, 16);
    s->raw += weight * channel(voxel, 24);
}

INLINE void sample_rgba(struct sample *s, __global const int *voxels, const struct cell *c,
                        bool nearest) {
    s->r = s->g = s->b = s->raw = (real)(0.0f);
    if (nearest) {
        add_corner(s, voxels, c->offset, (real)(1.0f));
    } else {
        for (int corner = 0; corner < 8; corner++) {
            const real x = corner & 1 ? c->x : 1.0f - c->x;
            const real y = corner & 2 ? c->y : 1.0f - c->y;
            const real z = corner & 4 ? c->z : 1.0f - c->z;
            const int shift =
                (corner & 1) + (corner & 2 ? BRICK_ROW : 0) + (corner & 4 ? BRICK_SLICE : 0);
            add_corner(s, voxels + shift, c->offset, x * y * z);
        }
    }
    s->r *= 1.0f / 255.0f;
    s->g *= 1.0f / 255.0f;
    s->b *= 1.0f / 255.0f;
}
#endif

// The buffer that a part's voxels are in.
INLINE __global const uchar *part_buffer(MEMORY_PARAMETERS, __constant struct part *part) {
    return part->buffer == 0   ? buffer0
           : part->buffer == 1 ? buffer1
           : part->buffer == 2 ? buffer2
                               : buffer3;
}

INLINE void find_cell(__constant struct part *part, bool nearest, real x, real y, real z,
                      struct cell *cell PAGES_PARAMETER) {
    // Positions are positive, so truncation is floor.
    const integer ix = TO_INTEGER(nearest ? x + 0.5f : x), iy = TO_INTEGER(nearest ? y + 0.5f : y),
                  iz = TO_INTEGER(nearest ? z + 0.5f : z);
    cell->x = x - TO_REAL(ix);
    cell->y = y - TO_REAL(iy);
    cell->z = z - TO_REAL(iz);
    keep_indices(&cell->offset, voxel_index(part, ix, iy, iz PAGES_ARGUMENT));
}

INLINE void fetch_cell(MEMORY_PARAMETERS, __constant struct part *part, bool nearest,
                       const struct cell *cell, struct sample *s) {
    __global const uchar *buffer = part_buffer(MEMORY_ARGUMENTS, part);
    s->raw = (real)(0.0f);
#if VOXELS & VOXELS_U8
    if (IS_CLASS(part, VOXELS_U8)) {
        __global const ushort *voxels = (__global const ushort *)buffer + part->offset;
        s->raw = nearest ? nearest_u8(voxels, cell->offset) : linear_u8(voxels, cell);
    }
#endif
#if VOXELS & VOXELS_U16
    if (IS_CLASS(part, VOXELS_U16)) {
        __global const ushort *voxels = (__global const ushort *)buffer + part->offset;
        s->raw = nearest ? nearest_u16(voxels, cell->offset) : linear_u16(voxels, cell);
    }
#endif
#if VOXELS & VOXELS_F32
    if (IS_CLASS(part, VOXELS_F32)) {
        __global const float *voxels = (__global const float *)buffer + part->offset;
        s->raw = nearest ? nearest_f32(voxels, cell->offset) : linear_f32(voxels, cell);
    }
#endif
#if VOXELS & VOXELS_RGBA
    s->r = s->g = s->b = (real)(0.0f);
    if (IS_CLASS(part, VOXELS_RGBA))
        sample_rgba(s, (__global const int *)buffer + part->offset, cell, nearest);
#endif
}

INLINE struct sample fetch_part(MEMORY_PARAMETERS, __constant struct part *part, bool nearest,
                                real x, real y, real z) {
    struct cell cell;
    find_cell(part, nearest, x, y, z, &cell PAGES_ARGUMENT);
    struct sample sample;
    fetch_cell(MEMORY_ARGUMENTS, part, nearest, &cell, &sample);
    return sample;
}

#endif
