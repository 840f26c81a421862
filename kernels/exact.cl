// exact.cl - the other integrator: light along a ray through voxels of constant colour, with the
// exact length in each.
//
// For model `emission` (Max 1995) the integral is a sum over the voxels that the ray crosses, so
// there is no step and no sampling error. Voxels are found one after the other by their faces
// (Amanatides & Woo 1987); the distance of each face is computed from its number, not added up, so
// that rounding does not grow with the way. Parts only add, in any order.
//
// Where a part is clipped or masked the lengths are those that are left, as exactly: the ray is cut
// at the faces of the mask's voxels and of cut-away boxes, too. Light only adds up, so an inverted
// mask takes what it selects from the whole.
#ifndef EXACT_CL
#define EXACT_CL

#include "classify.cl"
#include "pixel.cl"
#include "span.cl"

// One axis of the way through a part's voxels, in memory coordinates, where voxel n reaches from
// n - 1/2 to n + 1/2.
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

// The voxel that a ray is in, of a part or of its mask.
struct voxel_place {
    struct axis x, y, z;
};

// Begins at distance `near`. What is added to the ray's coordinates makes them memory's.
INLINE struct voxel_place voxel_place_begin(const struct ray *ray, float4 shift, real near,
                                            mask runs) {
    const struct voxel_place place = {axis_begin(ray->ox, ray->dx, shift.x, near, runs),
                                      axis_begin(ray->oy, ray->dy, shift.y, near, runs),
                                      axis_begin(ray->oz, ray->dz, shift.z, near, runs)};
    return place;
}

INLINE real voxel_place_exit(const struct voxel_place *place) {
    return fmin(axis_exit(&place->x), fmin(axis_exit(&place->y), axis_exit(&place->z)));
}

// Goes on behind all faces up to t: through an edge or a corner the ray crosses several at once.
INLINE void voxel_place_step(struct voxel_place *place, real t, mask runs) {
    const mask x = MASK(axis_exit(&place->x) <= t), y = MASK(axis_exit(&place->y) <= t),
               z = MASK(axis_exit(&place->z) <= t);
    axis_step(&place->x, runs & x);
    axis_step(&place->y, runs & y);
    axis_step(&place->z, runs & z);
}

#if CLIP
// Where behind t the ray next enters or leaves a cut-away box. Lanes that are in one until then are
// cleared in *kept.
INLINE real clip_exit(__constant struct world *world, __constant struct part *part,
                      const struct ray *ray, real t, mask *kept) {
    int cut = part->cuts + part->plane_count + 3 * part->box_count;
    real exit = (real)(FLT_MAX);
    for (int n = 0; n < part->hole_count; n++, cut += 3) {
        struct span span = {(real)(-FLT_MAX), (real)(FLT_MAX)};
        clip_box(&span, ray, &world->cuts[cut]);
        const mask meets = MASK(span.near < span.far) & MASK(span.far > t);
        const mask ahead = MASK(span.near > t);
        exit = CHOOSE(exit, fmin(exit, CHOOSE(span.far, span.near, ahead)), meets);
        *kept &= ~meets | ahead;
    }
    return exit;
}
#endif

#if MASKED
// Which of a part's light is counted: what part m of its mask selects, or everything where there is
// no m.
#define MASK_NONE (-1)

// The rays in the memory coordinates of part m of a mask, whose box narrows their span.
INLINE struct ray mask_ray(__constant struct world *world, __constant struct part *part, int m,
                           const struct ray *ray_voxel, struct span *span) {
    __constant struct part *other = &world->parts[part->mask_part + m];
    struct ray ray_memory = *ray_voxel;
    ray_memory.ox += part->memory_from_voxel.x;
    ray_memory.oy += part->memory_from_voxel.y;
    ray_memory.oz += part->memory_from_voxel.z;
    const struct ray ray = transform_ray(world->cuts + part->mask_cuts + 3 * m, &ray_memory);
    const struct span box = box_span(&ray, other->box_low + other->memory_from_voxel,
                                     other->box_high + other->memory_from_voxel);
    span->near = fmax(span->near, box.near);
    span->far = fmin(span->far, box.far);
    return ray;
}

// The lanes whose voxel of part m of the mask is selected.
INLINE mask mask_selected(__constant struct world *world, __constant struct part *part, int m,
                          MEMORY_PARAMETERS, const struct voxel_place *place) {
    __constant const float4 *ranges = world->cuts + part->mask_cuts + 3 * part->mask_count;
    const real raw = mask_value(MEMORY_ARGUMENTS, &world->parts[part->mask_part + m],
                                TO_REAL(place->x.voxel), TO_REAL(place->y.voxel),
                                TO_REAL(place->z.voxel));
    mask selected = (mask)(0);
    for (int r = 0; r < part->mask_range_count; r++)
        selected |= MASK(raw >= ranges[r].x) & MASK(raw <= ranges[r].y);
    return selected;
}
#endif

// Adds the light of one part: of a masked one what part `m` of its mask selects, which is taken
// away where the mask is inverted.
INLINE void follow_voxels(__constant struct world *world, TABLE_SPACE const uint *table,
                          MEMORY_PARAMETERS, __constant struct part *part, int m,
                          const struct ray *ray, struct light *light, integer *samples) {
    const struct ray ray_voxel = transform_ray(part->voxel_from_world, ray);
    struct span span = box_span(&ray_voxel, part->box_low, part->box_high);
#if CLIP
    clip_span(world, part, ray, &span);
#endif
#if MASKED
    struct ray ray_mask = ray_voxel;
    if (m != MASK_NONE)
        ray_mask = mask_ray(world, part, m, &ray_voxel, &span);
    const float sign = m != MASK_NONE && part->mask_inverted ? -1.0f : 1.0f;
#endif
    mask runs = MASK(span.near < span.far) & RAY_RUNS(ray);
    struct voxel_place place =
        voxel_place_begin(&ray_voxel, part->memory_from_voxel, span.near, runs);
#if MASKED
    struct voxel_place other = voxel_place_begin(&ray_mask, (float4)(0.0f), span.near, runs);
#endif
    real t = span.near;
    while (any_lane(runs)) {
        mask present = runs;
        real face = voxel_place_exit(&place);
#if CLIP
        face = fmin(face, clip_exit(world, part, ray, t, &present));
#endif
#if MASKED
        if (m != MASK_NONE) {
            face = fmin(face, voxel_place_exit(&other));
            present &= mask_selected(world, part, m, MEMORY_ARGUMENTS, &other);
        }
#endif
        const real end = fmax(fmin(face, span.far), t);
        const struct sample sample =
            sample_part(MEMORY_ARGUMENTS, part, TO_REAL(place.x.voxel), TO_REAL(place.y.voxel),
                        TO_REAL(place.z.voxel));
        *samples -= present;
        const struct entry entry = find_entry(table, part, sample.raw, &present);
        real amount = CHOOSE((real)(0.0f), (end - t) * entry.strength, present);
        if (any_lane(MASK(amount > 0.0f))) {
            real r, g, b;
            entry_colour(&entry, &r, &g, &b);
#if VOXELS & VOXELS_RGBA
            if (IS_CLASS(part, VOXELS_RGBA)) {
                r = sample.r;
                g = sample.g;
                b = sample.b;
            }
#endif
#if MASKED
            amount *= sign;
#endif
            light->r += amount * r;
            light->g += amount * g;
            light->b += amount * b;
        }
        t = end;
        runs &= MASK(face < span.far);
        voxel_place_step(&place, end, runs);
#if MASKED
        voxel_place_step(&other, end, runs);
#endif
    }
}

// Follows the rays through every part and returns the light they gather; it hides nothing. Adds the
// voxels to *samples.
INLINE struct light follow_exactly(__constant struct world *world, TABLE_SPACE const uint *table,
                                   MEMORY_PARAMETERS, const struct ray *ray, integer *samples) {
    const real zero = (real)(0.0f);
    struct light light = {zero, zero, zero, zero};
    for (ulong met = PARTS_MET(world, ray, (real)(FLT_MAX)); met != 0; met &= met - 1) {
        const int p = FIRST_PART(met);
        __constant struct part *part = &world->parts[p];
#if MASKED
        const bool whole = part->mask_count == 0 || part->mask_inverted;
        for (int m = whole ? MASK_NONE : 0; m < part->mask_count; m++)
            follow_voxels(world, table, MEMORY_ARGUMENTS, part, m, ray, &light, samples);
#else
        follow_voxels(world, table, MEMORY_ARGUMENTS, part, 0, ray, &light, samples);
#endif
    }
    return light;
}

#endif
