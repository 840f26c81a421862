// style.cl - what the gradient does to a sample: its light, and an opacity that follows it.
//
// Opacity is scaled as extinction, so that the picture does not depend on the step: by a function
// of the gradient's length (after Levoy 1988), and by how far the surface turns away from the
// viewer (silhouettes; Ebert & Rheingans 2000). docs/picture.md, "Opacity by gradient".
#ifndef STYLE_CL
#define STYLE_CL

#include "mix.cl"
#include "shade.cl"

#if SHADING
#if STYLE
#define HAS_NORMALS(part) ((part)->shading != SHADING_NONE || (part)->styled)
#else
#define HAS_NORMALS(part) ((part)->shading != SHADING_NONE)
#endif

#if STYLE
// By how much the extinction is multiplied.
INLINE real style_factor(__constant struct part *part, const struct ray *ray,
                         const struct vector *normal, real slope) {
    const real zero = (real)(0.0f);
    const float4 silhouette = part->silhouette;
    real factor = (real)(silhouette.w);
    for (int n = 0; n < part->ramp_count; n++) {
        const float4 ramp = part->ramps[n];
        factor += ramp.z * clamp((slope - ramp.x) * ramp.y, 0.0f, 1.0f);
    }
    // Where there is no gradient there is no silhouette either.
    const real length = sqrt(dot_lanes(normal, normal));
    const real facing = fabs(normal->x * ray->dx + normal->y * ray->dy + normal->z * ray->dz);
    const real away = AT_LEAST(length - facing, (real)(1e-30f));
    return factor * (silhouette.x + silhouette.y * power(away, (real)(silhouette.z)));
}

// A strength for extinction multiplied by a factor.
INLINE real scale_strength(real strength, real factor) {
#if STRENGTH_DEPTH
    return strength * factor;
#else
    return 1.0f - power(AT_LEAST(1.0f - strength, (real)(0x1p-24f)), factor);
#endif
}
#endif

// Shades the straight colour of sample i, as shade does, and scales its strength.
INLINE void style(__constant struct world *world, __constant struct part *part, MEMORY_PARAMETERS,
                  const struct ray *ray, real t_first, real i, real x, real y, real z, real raw,
                  real *strength, real *r, real *g, real *b) {
    real slope;
    const struct vector normal = find_normal(MEMORY_ARGUMENTS, part, raw, x, y, z, &slope);
#if STYLE
    if (part->styled)
        *strength = scale_strength(*strength, style_factor(part, ray, &normal, slope));
    if (part->shading == SHADING_NONE)
        return;
#endif
    light_up(world, part, ray, t_first + i * world->step_mm, &normal, r, g, b);
}
#endif

#endif
