// clip.cl - what clip planes and boxes leave of a part.
//
// Planes and boxes of which the inside is kept are convex, so they narrow the span of a ray in the
// part. A box whose inside is cut away would leave two spans; there each sample is asked. Samples
// stay where they are. All are in world space, float4 by float4 in world->cuts: planes (normal,
// offset), kept where normal . p + offset >= 0, then the three rows of each kept box and then of
// each cut-away one, inside where -1 <= row . p < 1. See docs/mixing.md.
#ifndef CLIP_CL
#define CLIP_CL

#include "ray.cl"

#ifndef CLIP
#define CLIP 0 // 1: some volume is clipped
#endif

#if CLIP
// Narrows a span of the ray to the side of a plane that is kept.
INLINE void clip_plane(struct span *span, const struct ray *ray, float4 plane) {
    const real height = plane.x * ray->ox + plane.y * ray->oy + plane.z * ray->oz + plane.w;
    const real speed = plane.x * ray->dx + plane.y * ray->dy + plane.z * ray->dz;
    const mask still = MASK(fabs(speed) < 1e-20f);
    const real t = -height / CHOOSE(speed, (real)(1e-20f), still);
    const mask leaves = still & MASK(height < 0.0f);
    span->near = CHOOSE(span->near, fmax(span->near, t), ~still & MASK(speed > 0.0f));
    span->far = CHOOSE(span->far, fmin(span->far, t), ~still & MASK(speed < 0.0f));
    span->far = CHOOSE(span->far, (real)(-FLT_MAX), leaves);
}

// Narrows a span to what is inside a box, which is the cube from -1 to 1 where its rows lead to.
INLINE void clip_box(struct span *span, const struct ray *ray, __constant const float4 *rows) {
    const struct ray ray_box = transform_ray(rows, ray);
    clip_slab(span, ray_box.ox, ray_box.dx, -1.0f, 1.0f);
    clip_slab(span, ray_box.oy, ray_box.dy, -1.0f, 1.0f);
    clip_slab(span, ray_box.oz, ray_box.dz, -1.0f, 1.0f);
}

// Narrows the span of a ray in a part to what planes and kept boxes leave. Cuts are counted, not
// pointed at: llvmpipe of Mesa 26 reads through a pointer that goes around in a loop also where no
// ray runs it, and the pointer is none there.
INLINE void clip_span(__constant struct world *world, __constant struct part *part,
                      const struct ray *ray, struct span *span) {
    int cut = part->cuts;
    for (int n = 0; n < part->plane_count; n++, cut++)
        clip_plane(span, ray, world->cuts[cut]);
    for (int n = 0; n < part->box_count; n++, cut += 3)
        clip_box(span, ray, &world->cuts[cut]);
}

INLINE real clip_row(float4 row, real x, real y, real z) {
    return row.x * x + row.y * y + row.z * z + row.w;
}

// The lanes whose place at t millimetres along the ray is in none of the part's cut-away boxes.
INLINE mask clip_keeps(__constant struct world *world, __constant struct part *part,
                       const struct ray *ray, real t) {
    int cut = part->cuts + part->plane_count + 3 * part->box_count;
    const real x = ray->ox + t * ray->dx, y = ray->oy + t * ray->dy, z = ray->oz + t * ray->dz;
    mask kept = (mask)(-1);
    for (int n = 0; n < part->hole_count; n++, cut += 3)
        kept &= MASK(fabs(clip_row(world->cuts[cut], x, y, z)) > 1.0f) |
                MASK(fabs(clip_row(world->cuts[cut + 1], x, y, z)) > 1.0f) |
                MASK(fabs(clip_row(world->cuts[cut + 2], x, y, z)) > 1.0f);
    return kept;
}
#endif

#endif
