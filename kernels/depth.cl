// depth.cl - how far away it is what a ray shows: the mean distance of its samples, weighted by
// what each adds to the ray's opacity. See docs/stereo.md, "Reprojection".
#ifndef DEPTH_CL
#define DEPTH_CL

#include "pixel.cl"
#include "span.cl"

#if EYES == EYES_DEPTH
// Weighs sample `number` by the opacity that the ray has gained since this was last asked.
#define NOTE_DEPTH(crossing, light, number)                                                        \
    do {                                                                                           \
        (crossing)->depth += ((light)->a - (crossing)->depth_weight) * (number);                   \
        (crossing)->depth_weight = (light)->a;                                                     \
    } while (0)
#define STORE_DEPTH(...) store_depth(__VA_ARGS__)

// Stores distances in millimetres: FLT_MAX where nothing is to be seen, 0 where it is not known how
// far that is, because most of it is no sample's (a projection) or because samples came back to
// front.
INLINE void store_depth(__constant struct world *world, __global float4 *picture, int left, int top,
                        const struct ray *ray, const struct crossing *crossing,
                        const struct light *light) {
    const real weight = crossing->depth_weight;
    const real number = crossing->depth / fmax(weight, FLT_MIN);
    const mask known = MODELS & MODELS_BACKWARD ? (mask)(0) : MASK(weight > 0.5f * light->a);
    real distance = CHOOSE((real)(0.0f), crossing->t_first + number * world->step_mm, known);
    distance = CHOOSE(distance, (real)(FLT_MAX), MASK(light->a <= 0.0f));
    const struct light depth = {distance, distance, distance, distance};
    store_pixels(world, picture, 1, left, top, ray, &depth);
}
#else
#define NOTE_DEPTH(crossing, light, number)
#define STORE_DEPTH(...)
#endif

#endif
