// cubic.cl - tricubic filters over either reader: the value from the 4^3 voxels around a place.
//
// The cubic B-spline is a sum of eight linear samples (Sigg & Hadwiger 2005, "Fast Third-Order
// Texture Filtering"): two neighbouring weights of one sign are one linear sample between the
// voxels, times their sum. Catmull & Rom's spline (1974) has weights of both signs, so it takes its
// 64 voxels one by one, and what a texture unit does to linear weights never gets near it. Both go
// through fetch_part alone. docs/picture.md, "Values".
// Included by sample.cl.
#ifndef CUBIC_CL
#define CUBIC_CL

// Where the samples along one axis lie, in memory coordinates, and what each counts.
struct taps {
    real at[4], weight[4];
};

// Beyond the volume it goes on as at its edge.
INLINE real inside_memory(real x, float high) {
    return AT_MOST(AT_LEAST(x, (real)(0.5f)), (real)(high));
}

// The B-spline's four weights for a place a share f of the way from one voxel to the next.
INLINE void b_spline_weights(real f, real weight[4]) {
    const real g = 1.0f - f;
    weight[0] = g * g * g * (1.0f / 6.0f);
    weight[1] = (4.0f + f * f * (3.0f * f - 6.0f)) * (1.0f / 6.0f);
    weight[2] = (4.0f + g * g * (3.0f * g - 6.0f)) * (1.0f / 6.0f);
    weight[3] = f * f * f * (1.0f / 6.0f);
}

INLINE void catmull_rom_weights(real f, real weight[4]) {
    weight[0] = 0.5f * f * (f * (2.0f - f) - 1.0f);
    weight[1] = 0.5f * (f * f * (3.0f * f - 5.0f) + 2.0f);
    weight[2] = 0.5f * f * (f * (4.0f - 3.0f * f) + 1.0f);
    weight[3] = 0.5f * f * f * (f - 1.0f);
}

// The derivatives of the weights by the place. Those of a pair have one sign, too.
INLINE void b_spline_slopes(real f, real weight[4]) {
    const real g = 1.0f - f;
    weight[0] = -0.5f * g * g;
    weight[1] = 0.5f * f * (3.0f * f - 4.0f);
    weight[2] = -0.5f * g * (3.0f * g - 4.0f);
    weight[3] = 0.5f * f * f;
}

INLINE void catmull_rom_slopes(real f, real weight[4]) {
    weight[0] = 0.5f * (f * (4.0f - 3.0f * f) - 1.0f);
    weight[1] = 0.5f * f * (9.0f * f - 10.0f);
    weight[2] = 0.5f * (f * (8.0f - 9.0f * f) + 1.0f);
    weight[3] = 0.5f * f * (3.0f * f - 2.0f);
}

// Two linear samples in the place of four voxels.
INLINE void pair_taps(struct taps *taps, real start, const real weight[4], float high) {
    for (int pair = 0; pair < 2; pair++) {
        const real sum = weight[2 * pair] + weight[2 * pair + 1];
        const real at = start + (2.0f * (float)pair - 1.0f) + weight[2 * pair + 1] / sum;
        taps->at[pair] = inside_memory(at, high);
        taps->weight[pair] = sum;
    }
}

// One sample on each voxel. Rounded, the middle of the border is one of the border's voxels.
INLINE void single_taps(struct taps *taps, real start, const real weight[4], float high) {
    for (int tap = 0; tap < 4; tap++) {
        taps->at[tap] = inside_memory(start + (float)(tap - 1), high);
        taps->weight[tap] = weight[tap];
    }
}

// With `slope`, those of the derivative.
INLINE void cubic_taps(struct taps *taps, __constant struct part *part, real x, float high,
                       bool slope) {
    const real start = floor(x);
    real weight[4];
    if (IS_FILTER(part, FILTERS_CUBIC_B_SPLINE)) {
        if (slope)
            b_spline_slopes(x - start, weight);
        else
            b_spline_weights(x - start, weight);
        pair_taps(taps, start, weight, high);
    } else {
        if (slope)
            catmull_rom_slopes(x - start, weight);
        else
            catmull_rom_weights(x - start, weight);
        single_taps(taps, start, weight, high);
    }
}

// The value at a place, or its derivative along an axis of the volume (0, 1, 2; -1: the value).
INLINE struct sample sample_cubic(MEMORY_PARAMETERS, __constant struct part *part, real x, real y,
                                  real z, int slope) {
    const bool linear = IS_FILTER(part, FILTERS_CUBIC_B_SPLINE);
    const int count = linear ? 2 : 4;
    struct taps along_x, along_y, along_z;
    cubic_taps(&along_x, part, x, part->memory_high.x, slope == 0);
    cubic_taps(&along_y, part, y, part->memory_high.y, slope == 1);
    cubic_taps(&along_z, part, z, part->memory_high.z, slope == 2);
    struct sample sum;
    sum.raw = (real)(0.0f);
#if VOXELS & VOXELS_RGBA
    sum.r = sum.g = sum.b = (real)(0.0f);
#endif
#pragma unroll 1
    for (int k = 0; k < count; k++)
#pragma unroll 1
        for (int j = 0; j < count; j++)
            for (int i = 0; i < count; i++) {
                const real weight = along_x.weight[i] * along_y.weight[j] * along_z.weight[k];
                const struct sample tap = fetch_part(MEMORY_ARGUMENTS, part, !linear, along_x.at[i],
                                                     along_y.at[j], along_z.at[k]);
                sum.raw += weight * tap.raw;
#if VOXELS & VOXELS_RGBA
                sum.r += weight * tap.r;
                sum.g += weight * tap.g;
                sum.b += weight * tap.b;
#endif
            }
#if VOXELS & VOXELS_RGBA
    // A colour beyond black or white, where the spline overshoots, is none.
    sum.r = clamp(sum.r, 0.0f, 1.0f);
    sum.g = clamp(sum.g, 0.0f, 1.0f);
    sum.b = clamp(sum.b, 0.0f, 1.0f);
#endif
    return sum;
}

#endif
