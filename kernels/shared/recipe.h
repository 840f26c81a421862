// recipe.h - a hypertexture's recipe as a kernel reads it from constant memory: a program for a
// stack of floats.
//
// docs/hypertexture.md defines the language that is compiled to this, and every operation. An
// instruction takes its operands off the stack, the last one on top, and leaves one result there.
// Positions are those of the recipe: the longest side of the grid runs from -1 to 1.
#ifndef SHARED_RECIPE_H
#define SHARED_RECIPE_H

#include "shared/types.h"

#define RECIPE_CODE_MAX 256  // instructions
#define RECIPE_STACK_MAX 16  // numbers at once
#define RECIPE_NAME_MAX 16   // definitions
#define RECIPE_PLACE_MAX 4   // positions within positions
#define RECIPE_OCTAVE_MAX 12 // of a sum of noises
#define RECIPE_LATTICE 256   // entries of the lattice's tables
#define RECIPE_LIVE_MAX 4    // recipes that a frame works out at every sample
#define BAKE_ROUND 64        // batches begin at multiples of this, so that 32 bits count them

// Operations. `value` is the instruction's own number.
enum recipe_op {
    RECIPE_CONSTANT, // value
    RECIPE_X,
    RECIPE_Y,
    RECIPE_Z,
    RECIPE_RADIUS,
    RECIPE_TIME,
    RECIPE_OBJECT,       // of the volume, 0..1 from its least to its greatest value
    RECIPE_OBJECT_VALUE, // the same in its own unit
    RECIPE_STORE,        // takes a number away: definition number `value`
    RECIPE_LOAD,         // definition number `value`
    RECIPE_MOVE,         // takes x, y, z away, which become the position
    RECIPE_RETURN,       // back to the position before
    RECIPE_ADD,
    RECIPE_SUBTRACT,
    RECIPE_MULTIPLY,
    RECIPE_DIVIDE,
    RECIPE_MIN,
    RECIPE_MAX,
    RECIPE_POW,
    RECIPE_BIAS,
    RECIPE_GAIN,
    RECIPE_NEGATE,
    RECIPE_ABS,
    RECIPE_SIN,
    RECIPE_COS,
    RECIPE_SQRT,
    RECIPE_EXP,
    RECIPE_FLOOR,
    RECIPE_FRACT,
    RECIPE_CLAMP,
    RECIPE_SMOOTHSTEP,
    RECIPE_MIX,
    RECIPE_SPHERE,
    RECIPE_BOX,
    RECIPE_TORUS,
    RECIPE_NOISE,
    RECIPE_NOISE_1985,
    RECIPE_FBM,        // value = octaves
    RECIPE_TURBULENCE, // likewise
    RECIPE_RIDGED,     // likewise
    RECIPE_WORLEY,     // value = which of the nearest points
};

// How many numbers an operation takes off the stack. Each leaves one, but STORE, MOVE and RETURN
// none.
static inline int recipe_operands(int op) {
    if (op < RECIPE_STORE || op == RECIPE_LOAD || op == RECIPE_RETURN)
        return 0;
    if (op == RECIPE_STORE || (op >= RECIPE_NEGATE && op <= RECIPE_FRACT) || op >= RECIPE_NOISE)
        return 1;
    if (op == RECIPE_BOX)
        return 4;
    return (op <= RECIPE_GAIN && op != RECIPE_MOVE) || op == RECIPE_SPHERE ? 2 : 3;
}

struct instruction {
    i32 op;
    float value;
};

struct recipe {
    float4 gradients[RECIPE_LATTICE];         // unit vectors of the 1985 lattice
    float4 grid_start, grid_step;             // position of voxel (i,j,k) = start + (i,j,k) * step
    float4 object_scale, object_bias;         // the volume's voxel = position * scale + bias
    int4 grid_dims, object_dims;              // voxels; object_dims.x = 0 without a volume
    struct instruction code[RECIPE_CODE_MAX]; //
    u32 permutation[RECIPE_LATTICE];          // of 0..255
    i32 length;                               // instructions used
    u32 seed;                                 // of Worley's points
    float time;
    float object_low, object_span; // value = low + span * RECIPE_OBJECT
    u32 object_offset;             // of the volume's first value among those of all recipes
    float pad[2];
};
SHARED_ASSERT(sizeof(struct instruction) == 8, instruction_size);
SHARED_ASSERT(sizeof(struct recipe) == 7296, recipe_size);

#endif
