// recipe_run.cl - the density of a hypertexture (Perlin & Hoffert 1989) at a position: an
// interpreter for recipes.
//
// A recipe is data, so a new one needs no new kernel. All work-items run the same instruction at
// the same time, so the interpreter's switch does not diverge.
#include "noise.cl"
#include "shared/recipe.h"

// The volume's value at a position, 0..1, interpolated between the centres of voxels and constant
// beyond the outer ones.
float object_at(__constant struct recipe *recipe, __global const float *object, float3 p) {
    const int4 dims = recipe->object_dims;
    if (dims.x == 0)
        return 0.0f;
    const float3 last = convert_float3(dims.xyz - 1);
    const float3 at =
        fmin(fmax(p * recipe->object_scale.xyz + recipe->object_bias.xyz, 0.0f), last);
    const int3 low = convert_int3(at), high = min(low + 1, dims.xyz - 1);
    const float3 weight = at - convert_float3(low);
    float along[4];
    for (int i = 0; i < 4; i++) {
        const size_t row =
            (size_t)(i & 2 ? high.z : low.z) * (size_t)dims.y + (size_t)(i & 1 ? high.y : low.y);
        __global const float *values = object + row * (size_t)dims.x;
        along[i] = mix(values[low.x], values[high.x], weight.x);
    }
    return mix(mix(along[0], along[1], weight.y), mix(along[2], along[3], weight.y), weight.z);
}

// From 1 inside to 0 outside, with a ramp `softness` wide around the surface at distance 0.
float soften(float distance, float softness) {
    return clamp(0.5f - distance / fmax(softness, 1e-6f), 0.0f, 1.0f);
}

float box_distance(float3 p, float3 half_size) {
    const float3 out = fabs(p) - half_size;
    return length(fmax(out, 0.0f)) + fmin(fmax(out.x, fmax(out.y, out.z)), 0.0f);
}

float torus_distance(float3 p, float ring, float tube) {
    return hypot(hypot(p.x, p.y) - ring, p.z) - tube;
}

// Perlin & Hoffert's bias: 0, 1/2 and 1 go to 0, b and 1.
float bias_of(float b, float t) {
    return pow(clamp(t, 0.0f, 1.0f), -log2(clamp(b, 0.001f, 0.999f)));
}

// And their gain, two biases back to back: 0, 1/4, 1/2, 3/4 and 1 go to 0, (1 - g)/2, 1/2, (1 +
// g)/2 and 1.
float gain_of(float g, float t) {
    return t < 0.5f ? 0.5f * bias_of(1.0f - g, 2.0f * t)
                    : 1.0f - 0.5f * bias_of(1.0f - g, 2.0f - 2.0f * t);
}

float smooth_between(float low, float high, float v) {
    const float t = low == high ? (float)(v >= high) : clamp((v - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// Operations whose result depends on their operands alone.
float calculate(int op, float a, float b, float c) {
    switch (op) {
    case RECIPE_ADD:
        return a + b;
    case RECIPE_SUBTRACT:
        return a - b;
    case RECIPE_MULTIPLY:
        return a * b;
    case RECIPE_DIVIDE:
        return b == 0.0f ? 0.0f : a / b;
    case RECIPE_MIN:
        return fmin(a, b);
    case RECIPE_MAX:
        return fmax(a, b);
    case RECIPE_POW:
        return pow(fmax(a, 0.0f), b);
    case RECIPE_BIAS:
        return bias_of(a, b);
    case RECIPE_GAIN:
        return gain_of(a, b);
    case RECIPE_NEGATE:
        return -a;
    case RECIPE_ABS:
        return fabs(a);
    case RECIPE_SIN:
        return sin(a);
    case RECIPE_COS:
        return cos(a);
    case RECIPE_SQRT:
        return sqrt(fmax(a, 0.0f));
    case RECIPE_EXP:
        return exp(a);
    case RECIPE_FLOOR:
        return floor(a);
    case RECIPE_FRACT:
        return a - floor(a);
    case RECIPE_CLAMP:
        return fmin(fmax(a, b), c);
    case RECIPE_SMOOTHSTEP:
        return smooth_between(a, b, c);
    default:
        return mix(a, b, c);
    }
}

// Runs the recipe at a position.
float run_recipe(__constant struct recipe *recipe, __global const float *object, float3 p) {
    float stack[RECIPE_STACK_MAX], names[RECIPE_NAME_MAX];
    float3 places[RECIPE_PLACE_MAX];
    int top = 0, place = 0;
    for (int i = 0; i < recipe->length; i++) {
        const int op = recipe->code[i].op;
        const float value = recipe->code[i].value;
        const int count = recipe_operands(op);
        top -= count;
        // Operations with fewer operands do not look at the others.
        const float a = count > 0 ? stack[top] : 0.0f, b = count > 1 ? stack[top + 1] : 0.0f;
        const float c = count > 2 ? stack[top + 2] : 0.0f, d = count > 3 ? stack[top + 3] : 0.0f;
        float result = 0.0f;
        switch (op) {
        case RECIPE_CONSTANT:
            result = value;
            break;
        case RECIPE_X:
            result = p.x;
            break;
        case RECIPE_Y:
            result = p.y;
            break;
        case RECIPE_Z:
            result = p.z;
            break;
        case RECIPE_RADIUS:
            result = length(p);
            break;
        case RECIPE_TIME:
            result = recipe->time;
            break;
        case RECIPE_OBJECT:
            result = object_at(recipe, object, p);
            break;
        case RECIPE_OBJECT_VALUE:
            result = recipe->object_low + recipe->object_span * object_at(recipe, object, p);
            break;
        case RECIPE_STORE:
            names[(int)value] = a;
            continue;
        case RECIPE_LOAD:
            result = names[(int)value];
            break;
        case RECIPE_MOVE:
            places[place++] = p;
            p = (float3)(a, b, c);
            continue;
        case RECIPE_RETURN:
            p = places[--place];
            continue;
        case RECIPE_SPHERE:
            result = soften(length(p) - a, b);
            break;
        case RECIPE_BOX:
            result = soften(box_distance(p, (float3)(a, b, c)), d);
            break;
        case RECIPE_TORUS:
            result = soften(torus_distance(p, a, b), c);
            break;
        case RECIPE_NOISE:
        case RECIPE_NOISE_1985:
        case RECIPE_FBM:
        case RECIPE_TURBULENCE:
        case RECIPE_RIDGED:
            result = noise_sum(recipe, a * p, op, (int)value);
            break;
        case RECIPE_WORLEY:
            result = worley(recipe, a * p, (int)value);
            break;
        default:
            result = calculate(op, a, b, c);
        }
        stack[top++] = result;
    }
    return stack[0];
}
