// exact.cl - the other integrator: light along a ray through voxels of constant colour, with the exact length in each.
//
// For model `emission` (Max 1995) the integral is a sum over the voxels that the ray crosses, so there is no step and no
// sampling error. Voxels are found one after the other by their faces (Amanatides & Woo 1987); the distance of each face is
// computed from its number, not added up, so that rounding does not grow with the way. Parts only add, in any order.
#ifndef EXACT_CL
#define EXACT_CL

#include "classify.cl"
#include "pixel.cl"
#include "span.cl"

// One axis of the way through a part's voxels, in memory coordinates, where voxel n reaches from n - 1/2 to n + 1/2.
struct axis {
    real origin, inverse; // of the ray, and of its direction
    real side;            // of a voxel, on which the ray leaves it: -1/2 or 1/2
    integer voxel;
};

INLINE struct axis axis_begin(real origin, real direction, float shift, real near, mask runs) {
    const real safe = CHOOSE(direction, (real)(1e-20f), MASK(fabs(direction) < 1e-20f));
    struct axis axis;
    axis.origin = CHOOSE((real)(1.0f), origin + shift, runs);
    axis.inverse = 1.0f / safe;
    axis.side = CHOOSE((real)(-0.5f), (real)(0.5f), MASK(safe > 0.0f));
    // Rounding may lead into the border, but not beyond it.
    axis.voxel = TO_INTEGER(AT_LEAST(axis.origin + CHOOSE((real)(0.0f), near * direction, runs) + 0.5f,
                                     (real)(0.0f)));
    return axis;
}

// Where the ray leaves the voxel along this axis.
INLINE real axis_exit(const struct axis *axis) {
    return (TO_REAL(axis->voxel) + axis->side - axis->origin) * axis->inverse;
}

INLINE void axis_step(struct axis *axis, mask where) {
    const integer step = CHOOSE((integer)(-1), (integer)(1), MASK(axis->side > 0.0f));
    axis->voxel += CHOOSE((integer)(0), step, where);
}

// Adds the light of one part.
INLINE void follow_voxels(TABLE_SPACE const uint *table, MEMORY_PARAMETERS,
                          __constant struct part *part, const struct ray *ray, struct light *light,
                          integer *samples) {
    const struct ray ray_voxel = transform_ray(part->voxel_from_world, ray);
    const struct span span = box_span(&ray_voxel, part->box_low, part->box_high);
    mask runs = MASK(span.near < span.far) & RAY_RUNS(ray);
    const float4 shift = part->memory_from_voxel;
    struct axis x = axis_begin(ray_voxel.ox, ray_voxel.dx, shift.x, span.near, runs);
    struct axis y = axis_begin(ray_voxel.oy, ray_voxel.dy, shift.y, span.near, runs);
    struct axis z = axis_begin(ray_voxel.oz, ray_voxel.dz, shift.z, span.near, runs);
    real t = span.near;
    while (any_lane(runs)) {
        const real x_exit = axis_exit(&x), y_exit = axis_exit(&y), z_exit = axis_exit(&z);
        const real face = fmin(x_exit, fmin(y_exit, z_exit));
        const real end = fmax(fmin(face, span.far), t);
        const struct sample sample = sample_part(MEMORY_ARGUMENTS, part, TO_REAL(x.voxel),
                                                 TO_REAL(y.voxel), TO_REAL(z.voxel));
        mask present = runs;
        *samples -= runs;
        const struct entry entry = find_entry(part, sample.raw, &present);
        const real amount = CHOOSE((real)(0.0f), (end - t) * entry_strength(table, &entry), present);
        if (any_lane(MASK(amount > 0.0f))) {
            real r, g, b;
            entry_colour(table, &entry, &r, &g, &b);
#if VOXELS & VOXELS_RGBA
            if (IS_CLASS(part, VOXELS_RGBA)) {
                r = sample.r;
                g = sample.g;
                b = sample.b;
            }
#endif
            light->r += amount * r;
            light->g += amount * g;
            light->b += amount * b;
        }
        // Through an edge or a corner the ray crosses several faces at once.
        t = end;
        runs &= MASK(face < span.far);
        axis_step(&x, runs & MASK(x_exit <= end));
        axis_step(&y, runs & MASK(y_exit <= end));
        axis_step(&z, runs & MASK(z_exit <= end));
    }
}

// Follows the rays through every part and returns the light they gather; it hides nothing. Adds the voxels to *samples.
INLINE struct light follow_exactly(__constant struct world *world, TABLE_SPACE const uint *table,
                                   MEMORY_PARAMETERS, const struct ray *ray, integer *samples) {
    const real zero = (real)(0.0f);
    struct light light = {zero, zero, zero, zero};
    for (int p = 0; p < world->part_count; p++)
        follow_voxels(table, MEMORY_ARGUMENTS, &world->parts[p], ray, &light, samples);
    return light;
}

#endif
