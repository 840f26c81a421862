// recipe.c - docs/hypertexture.md, "The language", over the instructions that a recipe is compiled
// to.
#include "reference/recipe.h"

#include <math.h>
#include <string.h>

#include "reference/noise.h"
#include "volume/hypertexture.h"

static double clamp(double v, double low, double high) {
    return fmin(fmax(v, low), high);
}

static double soft(double distance, double softness) {
    return clamp(0.5 - distance / fmax(softness, 1e-6), 0, 1);
}

static double bias(double b, double t) {
    return pow(clamp(t, 0, 1), log(clamp(b, 0.001, 0.999)) / log(0.5));
}

static double gain(double g, double t) {
    return t < 0.5 ? bias(1 - g, 2 * t) / 2 : 1 - bias(1 - g, 2 - 2 * t) / 2;
}

static double smooth(double low, double high, double v) {
    double t = low == high ? v >= high : clamp((v - low) / (high - low), 0, 1);
    return t * t * (3 - 2 * t);
}

static double length(const double p[3]) {
    return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

static double box(const double p[3], const double half_size[3]) {
    double out[3], inside = -INFINITY;
    for (int i = 0; i < 3; i++) {
        inside = fmax(inside, fabs(p[i]) - half_size[i]);
        out[i] = fmax(fabs(p[i]) - half_size[i], 0);
    }
    return length(out) + fmin(inside, 0);
}

// The object's value as a share of its range, interpolated between voxels.
static double object(const struct recipe *program, const struct pel_volume *volume,
                     const double p[3]) {
    const float *scale = &program->object_scale.x, *shift = &program->object_bias.x;
    double sum = 0;
    for (int corner = 0; volume && corner < 8; corner++) {
        int voxel[3];
        double weight = 1;
        for (int c = 0; c < 3; c++) {
            double at = clamp(p[c] * scale[c] + shift[c], 0, volume->dims[c] - 1);
            double share = at - floor(at);
            voxel[c] = (int)floor(at) + (corner >> c & 1);
            voxel[c] = voxel[c] < volume->dims[c] ? voxel[c] : volume->dims[c] - 1;
            weight *= corner >> c & 1 ? share : 1 - share;
        }
        double value = pel_volume_value(volume, voxel[0], voxel[1], voxel[2]);
        if (!isnan(value) && program->object_span > 0)
            sum += weight * (value - program->object_low) / program->object_span;
    }
    return sum;
}

static double noise(const struct recipe *program, const struct instruction *code, const double p[3],
                    double frequency) {
    const double scaled[3] = {p[0] * frequency, p[1] * frequency, p[2] * frequency};
    int number = (int)code->value;
    switch (code->op) {
    case RECIPE_NOISE:
        return reference_noise_2002(program, scaled);
    case RECIPE_NOISE_1985:
        return reference_noise_1985(program, scaled);
    case RECIPE_FBM:
        return reference_fbm(program, scaled, number);
    case RECIPE_TURBULENCE:
        return reference_turbulence(program, scaled, number);
    case RECIPE_RIDGED:
        return reference_ridged(program, scaled, number);
    default:
        return reference_worley(program, scaled, number);
    }
}

static double calculate(int op, const double v[4]) {
    switch (op) {
    case RECIPE_ADD:
        return v[0] + v[1];
    case RECIPE_SUBTRACT:
        return v[0] - v[1];
    case RECIPE_MULTIPLY:
        return v[0] * v[1];
    case RECIPE_DIVIDE:
        return v[1] == 0 ? 0 : v[0] / v[1];
    case RECIPE_MIN:
        return fmin(v[0], v[1]);
    case RECIPE_MAX:
        return fmax(v[0], v[1]);
    case RECIPE_POW:
        return pow(fmax(v[0], 0), v[1]);
    case RECIPE_BIAS:
        return bias(v[0], v[1]);
    case RECIPE_GAIN:
        return gain(v[0], v[1]);
    case RECIPE_NEGATE:
        return -v[0];
    case RECIPE_ABS:
        return fabs(v[0]);
    case RECIPE_SIN:
        return sin(v[0]);
    case RECIPE_COS:
        return cos(v[0]);
    case RECIPE_SQRT:
        return sqrt(fmax(v[0], 0));
    case RECIPE_EXP:
        return exp(v[0]);
    case RECIPE_FLOOR:
        return floor(v[0]);
    case RECIPE_FRACT:
        return v[0] - floor(v[0]);
    case RECIPE_CLAMP:
        return clamp(v[0], v[1], v[2]);
    case RECIPE_SMOOTHSTEP:
        return smooth(v[0], v[1], v[2]);
    default:
        return v[0] + (v[1] - v[0]) * v[2];
    }
}

// What an instruction leaves; `p` is the position, `v` its operands.
static double run(const struct recipe *program, const struct instruction *code,
                  const struct pel_volume *volume, const double p[3], const double v[4]) {
    switch (code->op) {
    case RECIPE_CONSTANT:
        return code->value;
    case RECIPE_X:
    case RECIPE_Y:
    case RECIPE_Z:
        return p[code->op - RECIPE_X];
    case RECIPE_RADIUS:
        return length(p);
    case RECIPE_TIME:
        return program->time;
    case RECIPE_OBJECT:
        return object(program, volume, p);
    case RECIPE_OBJECT_VALUE:
        return program->object_low + program->object_span * object(program, volume, p);
    case RECIPE_SPHERE:
        return soft(length(p) - v[0], v[1]);
    case RECIPE_BOX:
        return soft(box(p, v), v[3]);
    case RECIPE_TORUS:
        return soft(hypot(hypot(p[0], p[1]) - v[0], p[2]) - v[1], v[2]);
    default:
        return code->op >= RECIPE_NOISE ? noise(program, code, p, v[0]) : calculate(code->op, v);
    }
}

double reference_hypertexture(const struct pel_volume *volume, const double p_voxel[3]) {
    const struct recipe *program = volume->hypertexture->program;
    double stack[RECIPE_STACK_MAX + 4] = {0}, names[RECIPE_NAME_MAX];
    double places[RECIPE_PLACE_MAX + 1][3];
    int top = 0, place = 0;
    // A gradient's places beyond the box are moved to its faces.
    for (int c = 0; c < 3; c++)
        places[0][c] =
            (&program->grid_start.x)[c] +
            clamp(p_voxel[c], -0.5, volume->dims[c] - 0.5) * (double)(&program->grid_step.x)[c];
    for (int i = 0; i < program->length; i++) {
        const struct instruction *code = &program->code[i];
        top -= recipe_operands(code->op);
        const double *operands = &stack[top];
        if (code->op == RECIPE_STORE)
            names[(int)code->value] = operands[0];
        else if (code->op == RECIPE_MOVE)
            memcpy(places[++place], operands, sizeof places[0]);
        else if (code->op == RECIPE_RETURN)
            place--;
        else if (code->op == RECIPE_LOAD)
            stack[top++] = names[(int)code->value];
        else
            stack[top++] =
                run(program, code, volume->hypertexture->object, places[place], operands);
    }
    return stack[0];
}
