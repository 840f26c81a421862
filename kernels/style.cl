// style.cl - what the gradient does to a sample: its light, and an opacity that follows it.
#ifndef STYLE_CL
#define STYLE_CL

#include "gradient_opacity.cl"
#include "shade.cl"

#if SHADING
#if STYLE
#define HAS_NORMALS(part) ((part)->shading != SHADING_NONE || (part)->styled)
#else
#define HAS_NORMALS(part) ((part)->shading != SHADING_NONE)
#endif

// Shades the straight colour of sample i in the lanes where it is visible, as shade does, and
// scales its strength.
INLINE void style(FRAME_PARAMETERS, __constant struct part *part, MEMORY_PARAMETERS,
                  const struct ray *ray, real t_first, real i, real x, real y, real z, real raw,
                  mask where, real *strength, real *r, real *g, real *b) {
    real slope;
    const struct vector normal = find_normal(MEMORY_ARGUMENTS, part, raw, x, y, z, &slope);
#if STYLE
    if (part->styled)
        *strength = scale_strength(*strength, style_factor(part, ray, &normal, slope));
    if (part->shading == SHADING_NONE)
        return;
#endif
    light_up(FRAME_ARGUMENTS, part, MEMORY_ARGUMENTS, ray, t_first + i * world->step_mm, &normal,
             where, r, g, b);
}
#endif

#endif
