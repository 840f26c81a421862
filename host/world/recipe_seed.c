// recipe_seed.c - the tables of the noises' lattices.
//
// Seed 0 is the permutation printed with Perlin's "Improving Noise" (2002), so that the noise has
// the published values. Other seeds shuffle 0..255 after Fisher and Yates. Random numbers are
// hashes of a count, which makes them the same everywhere.
#include <math.h>

#include "world/recipe.h"

static const uint8_t published[RECIPE_LATTICE] = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103,
    30,  69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,
    197, 62,  94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174,
    20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231,
    83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143,
    54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196,
    135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124,
    123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,
    182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101,
    155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185,
    112, 104, 218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,
    51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176,
    115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114, 67,  29,  24,  72,  243,
    141, 128, 195, 78,  66,  215, 61,  156, 180,
};

// Every bit of the input turns half of the output's (Wellons's lowbias32).
static uint32_t hash_u32(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

struct random {
    uint32_t seed, count;
};

static uint32_t next_random(struct random *random) {
    return hash_u32(random->count++ + hash_u32(random->seed));
}

// A number in [-1, 1).
static double next_signed(struct random *random) {
    return (double)next_random(random) * 0x1p-31 - 1;
}

static void shuffle(uint32_t permutation[RECIPE_LATTICE], struct random *random) {
    for (uint32_t i = RECIPE_LATTICE - 1; i > 0; i--) {
        // The bias of a modulus of 32 bits by at most 256 is below 1 in 16 million.
        uint32_t j = next_random(random) % (i + 1), kept = permutation[i];
        permutation[i] = permutation[j];
        permutation[j] = kept;
    }
}

// A vector that points anywhere on the sphere alike: of points in the cube those in the ball.
static float4 unit_vector(struct random *random) {
    for (;;) {
        double x = next_signed(random), y = next_signed(random), z = next_signed(random);
        double length = sqrt(x * x + y * y + z * z);
        if (length <= 1 && length > 1e-3)
            return (float4){(float)(x / length), (float)(y / length), (float)(z / length), 0};
    }
}

void pel_recipe_seed(struct recipe *program, uint32_t seed) {
    struct random random = {.seed = seed};
    for (uint32_t i = 0; i < RECIPE_LATTICE; i++)
        program->permutation[i] = published[i];
    if (seed)
        shuffle(program->permutation, &random);
    for (int i = 0; i < RECIPE_LATTICE; i++)
        program->gradients[i] = unit_vector(&random);
    program->seed = seed;
}
