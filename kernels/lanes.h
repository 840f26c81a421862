// lanes.h - one ray per work-item, or a packet of 4, 8 or 16 rays, from the same source.
//
// A GPU runs work-items in lockstep by itself. A CPU does not, and PoCL does not vectorise a ray
// march across work-items, so there each work-item carries a packet in OpenCL vector types. `real`,
// `integer` and `mask` hold one value per lane. A mask is 0 or -1 in each lane, also when there is
// only one (OpenCL's scalar comparisons give 1, its vector comparisons -1; MASK hides that).
#ifndef LANES_H
#define LANES_H

#ifndef LANES
#define LANES 1 // rays per work-item: 1, 4, 8 or 16
#endif

// What belongs into the ray loop, and what is better kept out of a kernel's body: it takes registers there, and
// compilers work on it again and again.
#define INLINE static inline __attribute__((always_inline))
#define OUTLINE static __attribute__((noinline))

#define LANES_JOIN_(a, b) a##b
#define LANES_JOIN(a, b) LANES_JOIN_(a, b)

#if LANES == 1
typedef float real;
typedef int integer;
typedef int mask;
#define MASK(comparison) (-(comparison))
#define CHOOSE(otherwise, chosen, where) ((where) ? (chosen) : (otherwise))
#define FIRST_LANE(v) (v)
#define PACKET_W 1
#define PACKET_H 1
#define LANE_X 0
#define LANE_Y 0
// EACH(f, v): f of every lane of v, as a list. GATHER(type, f, v): the same as a vector of `type`.
#define EACH(f, v) f(v)
#define GATHER(type, f, v) f(v)
#else
typedef LANES_JOIN(float, LANES) real;
typedef LANES_JOIN(int, LANES) integer;
typedef LANES_JOIN(int, LANES) mask;
#define MASK(comparison) (comparison)
#define CHOOSE(otherwise, chosen, where) select((otherwise), (chosen), (where))
#define FIRST_LANE(v) (v).s0
#define GATHER(type, f, v) ((LANES_JOIN(type, LANES))(EACH(f, v)))
#if LANES == 4
#define PACKET_W 2
#define PACKET_H 2
#define LANE_X ((int4)(0, 1, 0, 1))
#define LANE_Y ((int4)(0, 0, 1, 1))
#define EACH(f, v) f((v).s0), f((v).s1), f((v).s2), f((v).s3)
#elif LANES == 8
#define PACKET_W 4
#define PACKET_H 2
#define LANE_X ((int8)(0, 1, 2, 3, 0, 1, 2, 3))
#define LANE_Y ((int8)(0, 0, 0, 0, 1, 1, 1, 1))
#define EACH(f, v)                                                                                 \
    f((v).s0), f((v).s1), f((v).s2), f((v).s3), f((v).s4), f((v).s5), f((v).s6), f((v).s7)
#elif LANES == 16
#define PACKET_W 4
#define PACKET_H 4
#define LANE_X ((int16)(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3))
#define LANE_Y ((int16)(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3))
#define EACH(f, v)                                                                                 \
    f((v).s0), f((v).s1), f((v).s2), f((v).s3), f((v).s4), f((v).s5), f((v).s6), f((v).s7),        \
        f((v).s8), f((v).s9), f((v).sa), f((v).sb), f((v).sc), f((v).sd), f((v).se), f((v).sf)
#else
#error "LANES must be 1, 4, 8 or 16"
#endif
#endif

// LANE_NUMBERS(f): f(0), f(1) ... of every lane.
#if LANES == 1
#define LANE_NUMBERS(f) f(0)
#elif LANES == 4
#define LANE_NUMBERS(f) f(0), f(1), f(2), f(3)
#elif LANES == 8
#define LANE_NUMBERS(f) f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)
#else
#define LANE_NUMBERS(f)                                                                            \
    f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7), f(8), f(9), f(10), f(11), f(12), f(13), f(14), \
        f(15)
#endif

#define TO_INTEGER(v) LANES_JOIN(lanes_convert_int, LANES)(v)
#define TO_REAL(v) LANES_JOIN(lanes_convert_float, LANES)(v)
#define AS_REAL(v) LANES_JOIN(lanes_as_float, LANES)(v)
#define AS_INTEGER(v) LANES_JOIN(lanes_as_int, LANES)(v)
#define lanes_convert_int1 convert_int
#define lanes_convert_int4 convert_int4
#define lanes_convert_int8 convert_int8
#define lanes_convert_int16 convert_int16
#define lanes_convert_float1 convert_float
#define lanes_convert_float4 convert_float4
#define lanes_convert_float8 convert_float8
#define lanes_convert_float16 convert_float16
#define lanes_as_float1 as_float
#define lanes_as_float4 as_float4
#define lanes_as_float8 as_float8
#define lanes_as_float16 as_float16
#define lanes_as_int1 as_int
#define lanes_as_int4 as_int4
#define lanes_as_int8 as_int8
#define lanes_as_int16 as_int16

// Oclgrind reads a scalar second operand of min and max on integers as if it were a vector, so both
// operands are of one type everywhere.

// The built-in clamp has to care for NaN; where there is none, a comparison and a choice are one
// instruction.
#define AT_LEAST(v, low) CHOOSE((v), (low), MASK((v) < (low)))
#define AT_MOST(v, high) CHOOSE((v), (high), MASK((v) > (high)))

// ALL_LANES(f): the vector of f(0), f(1) ... STORE_LANES(v, array): the way back, for loops over
// lanes. LOAD_LANES(array): the vector of what they have left there.
#if LANES == 1
#define ALL_LANES(f) f(0)
#define STORE_LANES(v, array) (*(array) = (v))
#define LOAD_LANES(array) (*(array))
#else
#define ALL_LANES(f) ((real)(LANE_NUMBERS(f)))
#define STORE_LANES(v, array) LANES_JOIN(vstore, LANES)(v, 0, array)
#define LOAD_LANES(array) LANES_JOIN(vload, LANES)(0, array)
#endif

// True when any lane of a mask is set. The built-in any() costs 13 % of a frame through PoCL; a
// mask narrowed to bytes is one or two words.
INLINE bool any_lane(mask m) {
#if LANES == 1
    return m != 0;
#elif LANES == 4
    return as_uint(convert_char4(m)) != 0;
#elif LANES == 8
    return as_ulong(convert_char8(m)) != 0;
#else
    const ulong2 words = as_ulong2(convert_char16(m));
    return (words.x | words.y) != 0;
#endif
}

// Indices of each lane as plain numbers. They go through memory, because two dozen instructions
// would take them out of a vector register one by one. Kept there some time before they are read,
// they need not be waited for.
struct indices {
    uint of[LANES];
};

#if LANES == 1
#define KEPT
#else
#define KEPT volatile
#endif

INLINE void keep_indices(integer *memory, integer v) {
    *(KEPT integer *)memory = v;
}

INLINE struct indices read_indices(const integer *memory) {
#define LANE_INDEX(lane) lanes[lane]
    const KEPT uint *lanes = (const KEPT uint *)memory;
    const struct indices at = {{LANE_NUMBERS(LANE_INDEX)}};
    return at;
}

// The least of an integer over all lanes.
INLINE int least_lane(integer v) {
#if LANES == 1
    return v;
#else
#if LANES == 16
    const int8 eight = min(v.lo, v.hi);
    const int4 four = min(eight.lo, eight.hi);
#elif LANES == 8
    const int4 four = min(v.lo, v.hi);
#else
    const int4 four = v;
#endif
    return min(min(four.x, four.y), min(four.z, four.w));
#endif
}

// The sum of an integer over all lanes.
INLINE int sum_lanes(integer v) {
#if LANES == 1
    return v;
#else
#if LANES == 16
    const int8 eight = v.lo + v.hi;
    const int4 four = eight.lo + eight.hi;
#elif LANES == 8
    const int4 four = v.lo + v.hi;
#else
    const int4 four = v;
#endif
    return four.x + four.y + four.z + four.w;
#endif
}

#endif
