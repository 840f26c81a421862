// glasses.cl - what both eyes see as one colour, through a pair of coloured glasses
// (docs/stereo.md, "Anaglyphs").
//
// A matrix makes red, green and blue of those of both eyes, in linear light or of values as they
// are stored. host/output/anaglyph.c does the same to two pictures.
// Included by render.cl.
#ifndef GLASSES_CL
#define GLASSES_CL

#if EYES == EYES_MERGED
// The curve of sRGB (IEC 61966-2-1) and its inverse for 0..1, within 1e-6. Their powers are
// polynomials, fitted at Chebyshev's nodes within 4e-7: pow, log2 and even sqrt would make them ten
// times as expensive on a CPU.
INLINE real srgb_decode(real value) {
    value = AT_MOST(AT_LEAST(value, (real)(0.0f)), (real)(1.0f));
    real curve = 0.081870236f * value - 0.45162019f;
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

// Light is m 2^e, with m in 1..2.
INLINE real srgb_encode(real light) {
    light = AT_MOST(AT_LEAST(light, (real)(0.0f)), (real)(1.0f));
    const integer bits = AS_INTEGER(light);
    const real e = TO_REAL((bits >> 23) - 127), m = AS_REAL((bits & 0x7fffff) | 0x3f800000);
    real curve = -0.0028395597f * m + 0.031079426f;
    curve = curve * m - 0.1474364f;
    curve = curve * m + 0.40065891f;
    curve = curve * m - 0.71334803f;
    curve = curve * m + 1.1156628f;
    curve = curve * m + 0.371223f;
    curve = exp2(e * (1.0f / 2.4f)) * curve - 0.055f;
    return CHOOSE(curve, 12.92f * light, MASK(light <= 0.0031308f));
}

// Adds to a sum what an eye sees, given straight, through its three columns of the matrix.
INLINE void add_eye(struct light *sum, __constant const float4 *columns, const struct light *eye, real straighten,
                    int linear) {
    real values[3] = {eye->r, eye->g, eye->b};
    for (int c = 0; c < 3; c++) {
        if (linear)
            values[c] = eye->a * srgb_decode(values[c] * straighten);
        sum->r += columns[c].x * values[c];
        sum->g += columns[c].y * values[c];
        sum->b += columns[c].z * values[c];
    }
}

INLINE real finish_channel(real sum, real straighten, real opacity, int linear) {
    return linear ? opacity * srgb_encode(sum * straighten) : AT_MOST(AT_LEAST(sum, (real)(0.0f)), opacity);
}

// One colour of what the first and the second eye see. It covers what either eye's does.
INLINE struct light merge_eyes(__constant struct world *world, struct light *first, struct light *second) {
    const real zero = (real)(0.0f);
    if (!any_lane(MASK(first->a > 0.0f) | MASK(second->a > 0.0f))) {
        const float4 behind = world->merged_background;
        struct light empty = {zero + behind.x, zero + behind.y, zero + behind.z, zero + behind.w};
        return empty;
    }
    add_background(first, world);
    add_background(second, world);
    const int linear = world->merge_linear;
    // The reciprocals of opacities, which are 0 where there is nothing.
    const real straighten = CHOOSE(zero, 1.0f / first->a, MASK(first->a > 0.0f));
    const real straighten_second = CHOOSE(zero, 1.0f / second->a, MASK(second->a > 0.0f));
    const mask covers = MASK(second->a > first->a);
    const real opacity = CHOOSE(first->a, second->a, covers);
    const real straighten_both = CHOOSE(straighten, straighten_second, covers);
    struct light merged = {zero, zero, zero, opacity};
    add_eye(&merged, &world->merge[0], first, straighten, linear);
    add_eye(&merged, &world->merge[3], second, straighten_second, linear);
    merged.r = finish_channel(merged.r, straighten_both, opacity, linear);
    merged.g = finish_channel(merged.g, straighten_both, opacity, linear);
    merged.b = finish_channel(merged.b, straighten_both, opacity, linear);
    return merged;
}
#endif

#endif
