// noise.cl - noises of three dimensions, as docs/hypertexture.md defines them. All are float and
// continuous.
//
// Perlin, "Improving Noise" (2002): a lattice of 12 gradients chosen through a permutation of
// 0..255, faded by 6t^5 - 15t^4 + 10t^3. Perlin, "An Image Synthesizer" (1985): a lattice of 256
// unit vectors, faded by 3t^2 - 2t^3. Worley, "A Cellular Texture Basis Function" (1996): distances
// to random points. The tables come from the host.
#include "shared/recipe.h"

// A lattice point's pseudo-random number, 0..255, of two coordinates and the third one to be added.
int lattice_column(__constant struct recipe *recipe, int x, int y) {
    return (int)recipe->permutation[((int)recipe->permutation[x & 255] + y) & 255];
}

// One of the 12 vectors from a cube's middle to its edges (four of them twice), times `d`.
float edge_gradient(int hash, float3 d) {
    const int h = hash & 15;
    const float u = h < 8 ? d.x : d.y;
    const float v = h < 4 ? d.y : h == 12 || h == 14 ? d.x : d.z;
    return ((h & 1) ? -u : u) + ((h & 2) ? -v : v);
}

// The lattice's contribution of the corner at `cell`, `d` away from the point.
float corner(__constant struct recipe *recipe, int3 cell, float3 d, bool improved) {
    const int index = (lattice_column(recipe, cell.x, cell.y) + cell.z) & 255;
    if (improved)
        return edge_gradient((int)recipe->permutation[index], d);
    const float4 gradient = recipe->gradients[index];
    return dot(gradient.xyz, d);
}

// Gradient noise: 0 at the lattice's points, about -1..1.
float lattice_noise(__constant struct recipe *recipe, float3 p, bool improved) {
    const float3 low = floor(p), d = p - low;
    const int3 cell = convert_int3_sat(low);
    const float3 fade =
        improved ? d * d * d * (d * (d * 6.0f - 15.0f) + 10.0f) : d * d * (3.0f - 2.0f * d);
    float across[4];
    for (int i = 0; i < 4; i++) {
        const int3 at = cell + (int3)(0, i & 1, i >> 1);
        const float3 from = d - (float3)(0.0f, (float)(i & 1), (float)(i >> 1));
        const float left = corner(recipe, at, from, improved);
        const float right =
            corner(recipe, at + (int3)(1, 0, 0), from - (float3)(1.0f, 0.0f, 0.0f), improved);
        across[i] = mix(left, right, fade.x);
    }
    return mix(mix(across[0], across[1], fade.y), mix(across[2], across[3], fade.y), fade.z);
}

// A sum of improved noises, each of twice the frequency and half the height of the one before.
float noise_sum(__constant struct recipe *recipe, float3 p, int op, int octaves) {
    float sum = 0.0f, weight = 1.0f, weights = 0.0f;
    for (int i = 0; i < octaves; i++) {
        const float noise = lattice_noise(recipe, p, op != RECIPE_NOISE_1985);
        const float ridge = 1.0f - fabs(noise);
        sum += weight * (op == RECIPE_TURBULENCE ? fabs(noise)
                         : op == RECIPE_RIDGED   ? ridge * ridge
                                                 : noise);
        weights += weight;
        weight *= 0.5f;
        p *= 2.0f;
    }
    return op == RECIPE_RIDGED ? sum / weights : sum;
}

// A hash of 32 bits in which every bit of the input turns half of the output's (Wellons's
// lowbias32).
uint hash_u32(uint x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

// How many points a cell has: Poisson with mean 4, but 1..9, from a byte of its hash.
int point_count(uint hash) {
    const uint byte = hash >> 24;
    return 1 + (byte >= 23) + (byte >= 61) + (byte >= 111) + (byte >= 161) + (byte >= 201) +
           (byte >= 228) + (byte >= 243) + (byte >= 251);
}

// Puts a squared distance among the four least, which are in ascending order.
float4 insert_distance(float4 f, float d) {
    return fmin(f, fmax((float4)(d, f.xyz), d));
}

// The distance to the `nth` nearest point, 1..4, of those in the 27 cells around `p`. There are
// four points to a unit cube on average.
float worley(__constant struct recipe *recipe, float3 p, int nth) {
    const float3 low = floor(p);
    const int3 cell = convert_int3_sat(low);
    float4 nearest = 16.0f;
    for (int c = 0; c < 27; c++) {
        // The cell that holds p comes first, so that most of the others are too far away.
        const int number = (c + 13) % 27;
        const int3 step = (int3)(number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1);
        const float3 corner_low = convert_float3(step) - (p - low);
        const float3 away = fmax(fmax(corner_low, -1.0f - corner_low), 0.0f);
        if (dot(away, away) > nearest.w)
            continue;
        const uint3 at = as_uint3(cell + step);
        const uint hash = hash_u32(at.x + hash_u32(at.y + hash_u32(at.z + hash_u32(recipe->seed))));
        const int count = point_count(hash);
        for (int i = 0; i < count; i++) {
            const uint next = hash + 3u * (uint)i;
            const float3 point =
                (float3)((float)(hash_u32(next + 1u) >> 8), (float)(hash_u32(next + 2u) >> 8),
                         (float)(hash_u32(next + 3u) >> 8)) *
                0x1p-24f;
            const float3 d = corner_low + point;
            nearest = insert_distance(nearest, dot(d, d));
        }
    }
    return sqrt(nth == 1 ? nearest.x : nth == 2 ? nearest.y : nth == 3 ? nearest.z : nearest.w);
}
