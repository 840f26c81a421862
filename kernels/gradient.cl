// gradient.cl - how values change along a volume's own axes, around a place.
//
// All ways give the difference that a gradient makes over two voxels. Central differences of
// interpolated values one voxel away are six more samples, as in VTK. Sobel's operator in three
// dimensions smooths these across their axis by 1-2-1 in both directions, from 26 samples. The
// analytic derivative is that of the interpolation itself. docs/picture.md, "Gradients".
#ifndef GRADIENT_CL
#define GRADIENT_CL

#include "gradient_brick.cl"
#include "sample.cl"

#ifndef SHADING
#define SHADING 0 // 1: some volume needs normals
#endif
#ifndef STYLE
#define STYLE 0 // 1: other gradients than central differences, and opacity that follows them
#endif

#if SHADING
// The raw value near a sample whose own is `raw`, which takes the place of an absent one. Beyond
// the volume it goes on as at its edge: a cubic filter sees to that itself, voxel by voxel.
INLINE real neighbour(MEMORY_PARAMETERS, __constant struct part *part, real raw, real x, real y,
                      real z) {
    if (!IS_CUBIC(part)) {
        const float4 high = part->memory_high;
        x = AT_MOST(AT_LEAST(x, (real)(0.5f)), (real)(high.x));
        y = AT_MOST(AT_LEAST(y, (real)(0.5f)), (real)(high.y));
        z = AT_MOST(AT_LEAST(z, (real)(0.5f)), (real)(high.z));
    }
    const struct sample sample = sample_part(MEMORY_ARGUMENTS, part, x, y, z);
#if VOXELS & VOXELS_F32
    return CHOOSE(sample.raw, raw, MASK(sample.raw != sample.raw));
#else
    return sample.raw;
#endif
}

INLINE void central_differences(MEMORY_PARAMETERS, __constant struct part *part, real raw, real x,
                                real y, real z, real difference[3]) {
#if BRICK_GRADIENT
    if (HAS_BRICK_GRADIENT(part)) {
        struct surroundings around;
        look_around(MEMORY_ARGUMENTS, part, x, y, z, &around);
        for (int axis = 0; axis < 3; axis++)
            difference[axis] = around.difference[axis];
        return;
    }
#endif
    for (int axis = 0; axis < 3; axis++) {
        const float dx = axis == 0 ? 1.0f : 0.0f, dy = axis == 1 ? 1.0f : 0.0f,
                    dz = axis == 2 ? 1.0f : 0.0f;
        const real before = neighbour(MEMORY_ARGUMENTS, part, raw, x - dx, y - dy, z - dz);
        const real behind = neighbour(MEMORY_ARGUMENTS, part, raw, x + dx, y + dy, z + dz);
        difference[axis] = behind - before;
    }
}

#if STYLE
INLINE void sobel_differences(MEMORY_PARAMETERS, __constant struct part *part, real raw, real x,
                              real y, real z, real difference[3]) {
    difference[0] = difference[1] = difference[2] = (real)(0.0f);
#pragma unroll 1
    for (int n = 0; n < 27; n++) {
        if (n == 13)
            continue;
        const float dx = (float)(n % 3 - 1), dy = (float)(n / 3 % 3 - 1), dz = (float)(n / 9 - 1);
        const float across_x = 2.0f - fabs(dx), across_y = 2.0f - fabs(dy),
                    across_z = 2.0f - fabs(dz);
        const real value =
            neighbour(MEMORY_ARGUMENTS, part, raw, x + dx, y + dy, z + dz) * (1.0f / 16.0f);
        difference[0] += dx * across_y * across_z * value;
        difference[1] += dy * across_x * across_z * value;
        difference[2] += dz * across_x * across_y * value;
    }
}

// The derivative of linear interpolation between the eight voxels around, also where the filter is
// `nearest`, whose own is nothing.
INLINE void cell_differences(MEMORY_PARAMETERS, __constant struct part *part, real raw, real x,
                             real y, real z, real difference[3]) {
    difference[0] = difference[1] = difference[2] = (real)(0.0f);
    const real first_x = floor(x), first_y = floor(y), first_z = floor(z);
    const real wx = x - first_x, wy = y - first_y, wz = z - first_z;
#pragma unroll 1
    for (int n = 0; n < 8; n++) {
        const float dx = (float)(n & 1), dy = (float)(n >> 1 & 1), dz = (float)(n >> 2);
        real value =
            fetch_part(MEMORY_ARGUMENTS, part, true, first_x + dx, first_y + dy, first_z + dz).raw;
#if VOXELS & VOXELS_F32
        value = CHOOSE(value, raw, MASK(value != value));
#endif
        const real share_x = n & 1 ? wx : 1.0f - wx, share_y = n & 2 ? wy : 1.0f - wy,
                   share_z = n & 4 ? wz : 1.0f - wz;
        difference[0] += (4.0f * dx - 2.0f) * share_y * share_z * value;
        difference[1] += (4.0f * dy - 2.0f) * share_x * share_z * value;
        difference[2] += (4.0f * dz - 2.0f) * share_x * share_y * value;
    }
}

INLINE void analytic_differences(MEMORY_PARAMETERS, __constant struct part *part, real raw, real x,
                                 real y, real z, real difference[3]) {
#if FILTERS & FILTERS_CUBIC
    if (IS_CUBIC(part)) {
#pragma unroll 1
        for (int axis = 0; axis < 3; axis++)
            difference[axis] = 2.0f * sample_cubic(MEMORY_ARGUMENTS, part, x, y, z, axis).raw;
        return;
    }
#endif
    cell_differences(MEMORY_ARGUMENTS, part, raw, x, y, z, difference);
}
#endif

// The difference that the gradient at a place in memory coordinates, where the value is `raw`,
// makes over two voxels along each of the volume's axes.
INLINE void find_differences(MEMORY_PARAMETERS, __constant struct part *part, real raw, real x,
                             real y, real z, real difference[3]) {
#if STYLE
    if (part->gradient == GRADIENT_SOBEL) {
        sobel_differences(MEMORY_ARGUMENTS, part, raw, x, y, z, difference);
        return;
    }
    if (part->gradient == GRADIENT_ANALYTIC) {
        analytic_differences(MEMORY_ARGUMENTS, part, raw, x, y, z, difference);
        return;
    }
#endif
    central_differences(MEMORY_ARGUMENTS, part, raw, x, y, z, difference);
}
#endif

#endif
