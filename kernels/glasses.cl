// glasses.cl - what both eyes see as one colour, through a pair of coloured glasses
// (docs/stereo.md, "Anaglyphs").
//
// A matrix makes red, green and blue of those of both eyes, in linear light or of values as they
// are stored. host/output/anaglyph.c does the same to two pictures.
//
// A packet is merged four lanes at a time. Some thirty multiplications close together in registers
// of 256 bits or more make an Intel core take a lower clock for the next half a millisecond, and a
// packet is merged every few microseconds: so whole frames ran at 2.4 GHz instead of the 2.7 of the
// ray loop, whose multiplications are farther apart. In registers of 128 bits they may follow each
// other. Channels are taken in loops for the same reason: PoCL joins three of them that are written
// out in wider registers.
// Included by render.cl.
#ifndef GLASSES_CL
#define GLASSES_CL

#if EYES == EYES_MERGED
#if LANES == 1
#define TINT_LANES 1
typedef float tint;
typedef int tint_integer;
#else
#define TINT_LANES 4
typedef float4 tint;
typedef int4 tint_integer;
#endif
#define TINTS (LANES / TINT_LANES)

// Light of some lanes, and that of all lanes as so many tints.
struct tints {
    tint r, g, b, a;
};
union tinted {
    struct light light;
    tint channels[4][TINTS];
};

// The curve of sRGB (IEC 61966-2-1) and its inverse for 0..1, within 1e-6. Their powers are
// polynomials, fitted at Chebyshev's nodes within 4e-7: pow, log2 and even sqrt would make them ten
// times as expensive on a CPU.
INLINE tint srgb_decode(tint value) {
    value = AT_MOST(AT_LEAST(value, (tint)(0.0f)), (tint)(1.0f));
    tint curve = 0.081870236f * value - 0.45162019f;
    curve = curve * value + 1.0954472f;
    curve = curve * value - 1.5548166f;
    curve = curve * value + 1.4735311f;
    curve = curve * value - 1.0691577f;
    curve = curve * value + 0.90861809f;
    curve = curve * value + 0.47963679f;
    curve = curve * value + 0.035643924f;
    curve = curve * value + 0.00084717147f;
    return CHOOSE(curve, value * (1.0f / 12.92f), MASK(value <= 0.04045f));
}

// Light is m 2^e, with m in 1..2. As e is a whole number and never above 0, 2^(e / 2.4) needs
// nothing of exp2 but its polynomial (SLEEF's) for what is left of the exponent, about -0.5..0.5.
INLINE tint srgb_encode(tint light) {
    light = AT_MOST(AT_LEAST(light, (tint)(0.0f)), (tint)(1.0f));
    const tint_integer bits = LANES_JOIN(lanes_as_int, TINT_LANES)(light);
    const tint e = LANES_JOIN(lanes_convert_float, TINT_LANES)((bits >> 23) - 127);
    const tint m = LANES_JOIN(lanes_as_float, TINT_LANES)((bits & 0x7fffff) | 0x3f800000);
    tint curve = -0.0028395597f * m + 0.031079426f;
    curve = curve * m - 0.1474364f;
    curve = curve * m + 0.40065891f;
    curve = curve * m - 0.71334803f;
    curve = curve * m + 1.1156628f;
    curve = curve * m + 0.371223f;
    const tint power = e * (1.0f / 2.4f);
    const tint_integer whole = LANES_JOIN(lanes_convert_int, TINT_LANES)(power - 0.49f);
    const tint rest = power - LANES_JOIN(lanes_convert_float, TINT_LANES)(whole);
    tint scale = 0.00015359209f * rest + 0.0013392627f;
    scale = scale * rest + 0.0096183848f;
    scale = scale * rest + 0.055503473f;
    scale = scale * rest + 0.24022645f;
    scale = scale * rest + 0.69314718f;
    scale = scale * rest + 1.0f;
    const tint_integer raised = LANES_JOIN(lanes_as_int, TINT_LANES)(scale) + (whole << 23);
    scale = LANES_JOIN(lanes_as_float, TINT_LANES)(raised);
    curve = scale * curve - 0.055f;
    return CHOOSE(curve, 12.92f * light, MASK(light <= 0.0031308f));
}

// Adds to a sum what an eye sees, given straight, through its three columns of the matrix.
INLINE void add_eye(struct tints *sum, __constant const float4 *columns, const struct tints *eye,
                    tint straighten, int linear) {
    const tint values[3] = {eye->r, eye->g, eye->b};
    for (int c = 0; c < 3; c++) {
        const tint value = linear ? eye->a * srgb_decode(values[c] * straighten) : values[c];
        sum->r += columns[c].x * value;
        sum->g += columns[c].y * value;
        sum->b += columns[c].z * value;
    }
}

INLINE tint finish_channel(tint sum, tint straighten, tint opacity, int linear) {
    return linear ? opacity * srgb_encode(sum * straighten)
                  : AT_MOST(AT_LEAST(sum, (tint)(0.0f)), opacity);
}

// One colour of what the first and the second eye see. It covers what either eye's does.
INLINE struct tints merge_tints(__constant struct world *world, const struct tints *first,
                                const struct tints *second) {
    const tint zero = (tint)(0.0f);
    const int linear = world->merge_linear;
    // The reciprocals of opacities, which are 0 where there is nothing.
    const tint straighten = CHOOSE(zero, 1.0f / first->a, MASK(first->a > 0.0f));
    const tint straighten_second = CHOOSE(zero, 1.0f / second->a, MASK(second->a > 0.0f));
    const tint_integer covers = MASK(second->a > first->a);
    const tint opacity = CHOOSE(first->a, second->a, covers);
    const tint straighten_both = CHOOSE(straighten, straighten_second, covers);
    struct tints sum = {zero, zero, zero, opacity};
    add_eye(&sum, &world->merge[0], first, straighten, linear);
    add_eye(&sum, &world->merge[3], second, straighten_second, linear);
    tint channels[3] = {sum.r, sum.g, sum.b};
    for (int c = 0; c < 3; c++)
        channels[c] = finish_channel(channels[c], straighten_both, opacity, linear);
    const struct tints merged = {channels[0], channels[1], channels[2], opacity};
    return merged;
}

// Stores the colours of a packet's lanes from `first` on.
INLINE void store_tints(__constant struct world *world, __global float4 *picture, int left, int top,
                        int first, const struct tints *tints) {
    const int x = left + first % PACKET_W, y = top + first / PACKET_W, width = world->width;
#if LANES == 1
    picture[y * width + x] = (float4)(tints->r, tints->g, tints->b, tints->a);
#else
#if LANES >= 8
    // Most rows lie in the picture as a whole.
    if (y < world->height && x + TINT_LANES <= width) {
        store_row(&picture[y * width + x], tints->r, tints->g, tints->b, tints->a);
        return;
    }
#endif
    float r[TINT_LANES], g[TINT_LANES], b[TINT_LANES], a[TINT_LANES];
    vstore4(tints->r, 0, r);
    vstore4(tints->g, 0, g);
    vstore4(tints->b, 0, b);
    vstore4(tints->a, 0, a);
    for (int lane = 0; lane < TINT_LANES; lane++) {
        const int lane_x = x + lane % PACKET_W, lane_y = y + lane / PACKET_W;
        if (lane_x < width && lane_y < world->height)
            picture[lane_y * width + lane_x] = (float4)(r[lane], g[lane], b[lane], a[lane]);
    }
#endif
}

INLINE struct tints get_tints(const union tinted *tinted, int i) {
    const struct tints tints = {tinted->channels[0][i], tinted->channels[1][i],
                                tinted->channels[2][i], tinted->channels[3][i]};
    return tints;
}

// Stores what the first and the second eye see in a packet as one colour.
INLINE void store_merged(__constant struct world *world, __global float4 *picture, int left,
                         int top, const struct light *first, const struct light *second) {
    const bool seen = any_lane(MASK(first->a > 0.0f) | MASK(second->a > 0.0f));
    union tinted eyes[2] = {{*first}, {*second}};
    if (seen) {
        add_background(&eyes[0].light, world);
        add_background(&eyes[1].light, world);
    }
    const tint zero = (tint)(0.0f);
    const float4 behind = world->merged_background;
    struct tints merged = {zero + behind.x, zero + behind.y, zero + behind.z, zero + behind.w};
    for (int i = 0; i < TINTS; i++) {
        if (seen) {
            const struct tints l = get_tints(&eyes[0], i), r = get_tints(&eyes[1], i);
            merged = merge_tints(world, &l, &r);
        }
        store_tints(world, picture, left, top, i * TINT_LANES, &merged);
    }
}
#endif

#endif
