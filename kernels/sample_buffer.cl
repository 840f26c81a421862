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

// Two neighbouring voxels of one byte, wherever they begin.
struct __attribute__((packed)) byte_pair {
    ushort both;
};

// The eight voxels around a position: the index of the first, and the weights along the axes.
struct cell {
    integer offset;
    real x, y, z;
};

#define LOAD_PAGE(at) pages[at]

// The index of a voxel, from the part's first, with the next ones along all axes in the same brick.
INLINE integer voxel_index(__constant struct part *part, integer x, integer y,
                           integer z PAGES_PARAMETER) {
    const integer inside = BRICK_SIDE - 1;
    integer brick = (z >> BRICK_BITS) * part->brick_slice +
                          (y >> BRICK_BITS) * part->brick_row + (x >> BRICK_BITS);
#if POOL
    brick += (int)part->ranges;
    brick = GATHER(int, LOAD_PAGE, brick);
#endif
    return brick * BRICK_VOXELS + (z & inside) * BRICK_SLICE + (y & inside) * BRICK_ROW +
           (x & inside);
}

#define LOAD_PAIR(at) ((__global const struct byte_pair *)(row + (at)))->both
#define LOAD(at) row[at]
#define LOAD_NEXT(at) row[(at) + 1]

#if VOXELS & VOXELS_U8
INLINE real row_u8(__global const uchar *row, integer offset, real x) {
#if LANES == 1
    return mix_lanes(row[offset], row[offset + 1], x);
#else
    const integer pair = TO_INTEGER(GATHER(ushort, LOAD_PAIR, offset));
    return mix_lanes(TO_REAL(pair & 255), TO_REAL(pair >> 8), x);
#endif
}

INLINE real nearest_u8(__global const uchar *row, integer offset) {
    return TO_REAL(GATHER(uchar, LOAD, offset));
}
#endif

#if VOXELS & VOXELS_U16
INLINE real row_u16(__global const ushort *row, integer offset, real x) {
    return mix_lanes(TO_REAL(GATHER(ushort, LOAD, offset)),
                     TO_REAL(GATHER(ushort, LOAD_NEXT, offset)), x);
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
#endif

// Trilinear interpolation over the rows of a cell, for one class of voxels.
#define TRILINEAR(class, voxels, cell)                                                             \
    mix_lanes(mix_lanes(row_##class(voxels, (cell).offset, (cell).x),                              \
                        row_##class(voxels + BRICK_ROW, (cell).offset, (cell).x), (cell).y),      \
              mix_lanes(row_##class(voxels + BRICK_SLICE, (cell).offset, (cell).x),               \
                        row_##class(voxels + BRICK_SLICE + BRICK_ROW, (cell).offset, (cell).x),  \
                        (cell).y),                                                                 \
              (cell).z)

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

INLINE struct sample fetch_part(MEMORY_PARAMETERS, __constant struct part *part, bool nearest,
                                real x, real y, real z) {
    const real half_voxel = (real)(nearest ? 0.5f : 0.0f);
    // Positions are positive, so truncation is floor.
    const integer ix = TO_INTEGER(x + half_voxel), iy = TO_INTEGER(y + half_voxel),
                  iz = TO_INTEGER(z + half_voxel);
    const struct cell cell = {.offset = voxel_index(part, ix, iy, iz PAGES_ARGUMENT),
                              .x = x - TO_REAL(ix),
                              .y = y - TO_REAL(iy),
                              .z = z - TO_REAL(iz)};
    __global const uchar *buffer = part->buffer == 0   ? buffer0
                                   : part->buffer == 1 ? buffer1
                                   : part->buffer == 2 ? buffer2
                                                       : buffer3;

    struct sample s;
    s.raw = (real)(0.0f);
#if VOXELS & VOXELS_U8
    if (IS_CLASS(part, VOXELS_U8)) {
        __global const uchar *voxels = buffer + part->offset;
        s.raw = nearest ? nearest_u8(voxels, cell.offset) : TRILINEAR(u8, voxels, cell);
    }
#endif
#if VOXELS & VOXELS_U16
    if (IS_CLASS(part, VOXELS_U16)) {
        __global const ushort *voxels = (__global const ushort *)buffer + part->offset;
        s.raw = nearest ? nearest_u16(voxels, cell.offset) : TRILINEAR(u16, voxels, cell);
    }
#endif
#if VOXELS & VOXELS_F32
    if (IS_CLASS(part, VOXELS_F32)) {
        __global const float *voxels = (__global const float *)buffer + part->offset;
        s.raw = nearest ? nearest_f32(voxels, cell.offset) : TRILINEAR(f32, voxels, cell);
    }
#endif
#if VOXELS & VOXELS_RGBA
    s.r = s.g = s.b = (real)(0.0f);
    if (IS_CLASS(part, VOXELS_RGBA))
        sample_rgba(&s, (__global const int *)buffer + part->offset, &cell, nearest);
#endif
    return s;
}

#endif
