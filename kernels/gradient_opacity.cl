// gradient_opacity.cl - an opacity that follows the gradient.
//
// Opacity is scaled as extinction, so that the picture does not depend on the step: by a function
// of the gradient's length (after Levoy 1988), and by how far the surface turns away from the
// viewer (silhouettes; Ebert & Rheingans 2000). docs/picture.md, "Opacity by gradient".
#ifndef GRADIENT_OPACITY_CL
#define GRADIENT_OPACITY_CL

#include "mix.cl"
#include "normal.cl"

#if SHADING && STYLE
// By how much the extinction is multiplied.
INLINE real style_factor(__constant struct part *part, const struct ray *ray,
                         const struct vector *normal, real slope) {
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
    return 1.0f - exp2(factor * log2(AT_LEAST(1.0f - strength, (real)(0x1p-24f))));
#endif
}
#endif

#endif
