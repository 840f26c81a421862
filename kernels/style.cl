// style.cl - what the gradient does to a sample: its light, and an opacity that follows it.
#ifndef STYLE_CL
#define STYLE_CL

#include "gradient_opacity.cl"
#include "shade.cl"
#include "sight.cl"

#if SHADING
// Shades the straight colour of what sample i at (x, y, z) shows, as shade does, in the lanes where
// it is visible, and scales its strength.
INLINE void style(FRAME_PARAMETERS, __constant struct part *part, MEMORY_PARAMETERS,
                  const struct ray *ray, real t_first, real i, struct sight *sight, real *r, real *g,
                  real *b) {
    const mask where = sight->visible;
    real difference[3], slope;
#if BRICK_GRADIENT
    if (LOOKS_AROUND(part)) {
        for (int axis = 0; axis < 3; axis++)
            difference[axis] = sight->around.difference[axis];
    } else
#endif
        find_differences(MEMORY_ARGUMENTS, part, CHOOSE((real)(0.0f), sight->sample.raw, where),
                         sight->x, sight->y, sight->z, difference);
    const struct vector normal = make_normal(part, difference, &slope);
#if STYLE
    if (part->styled)
        sight->entry.strength =
            scale_strength(sight->entry.strength, style_factor(part, ray, &normal, slope));
    if (part->shading == SHADING_NONE)
        return;
#endif
    light_up(FRAME_ARGUMENTS, part, MEMORY_ARGUMENTS, ray, t_first + i * world->step_mm, &normal,
             where, r, g, b);
}
#endif

#endif
