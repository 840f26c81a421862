// ray.cl - a packet's rays, and where they are inside a box.
#ifndef RAY_CL
#define RAY_CL

#include "lanes.h"
#include "shared/variant.h"
#include "shared/world.h"

#ifndef SUPERSAMPLING
#define SUPERSAMPLING 0 // 1: one of several rays of each pixel
#endif
#ifndef EYES
#define EYES EYES_ONE // whose rays they are: EYES_*
#endif
#ifndef JITTER
#define JITTER 0 // 1: every ray has a phase of its own
#endif

struct ray {
    real ox, oy, oz; // origin, world millimetres
    real dx, dy, dz; // unit direction
#if JITTER
    real phase; // of the first sample, in steps
#endif
#if SUPERSAMPLING
    mask runs; // 0: the pixel is done already
#endif
};

#if JITTER
typedef real ray_phase;
#define RAY_PHASE(world, ray) ((ray)->phase)
#else
typedef float ray_phase;
#define RAY_PHASE(world, ray) ((world)->phase)
#endif
#if SUPERSAMPLING
#define RAY_RUNS(ray) ((ray)->runs)
#else
#define RAY_RUNS(ray) ((mask)(-1))
#endif

// A stretch of a ray: inside for near <= t < far. Empty when far <= near.
struct span {
    real near, far;
};

// The rays of a camera through the places x and y of the whole picture: pixels, from its left and
// top edge. Whether they run, and their phases, are left to the caller.
INLINE struct ray camera_ray(__constant struct world *world, __constant struct camera *camera, real x,
                             real y) {
    const real u = x * (2.0f / (float)world->whole_width) - 1.0f;
    const real v = 1.0f - y * (2.0f / (float)world->whole_height);
    struct ray ray;
    ray.ox = camera->eye.x + u * camera->eye_right.x + v * camera->eye_up.x;
    ray.oy = camera->eye.y + u * camera->eye_right.y + v * camera->eye_up.y;
    ray.oz = camera->eye.z + u * camera->eye_right.z + v * camera->eye_up.z;
    ray.dx = camera->forward.x + u * camera->right.x + v * camera->up.x;
    ray.dy = camera->forward.y + u * camera->right.y + v * camera->up.y;
    ray.dz = camera->forward.z + u * camera->right.z + v * camera->up.z;
    const real length = 1.0f / sqrt(ray.dx * ray.dx + ray.dy * ray.dy + ray.dz * ray.dz);
    ray.dx *= length;
    ray.dy *= length;
    ray.dz *= length;
    return ray;
}

#if EYES == EYES_WOVEN
// The rays of one camera, and where `second`, those of another.
INLINE struct ray choose_rays(const struct ray *first, const struct ray *other, mask second) {
    struct ray ray = *first;
    ray.ox = CHOOSE(first->ox, other->ox, second);
    ray.oy = CHOOSE(first->oy, other->oy, second);
    ray.oz = CHOOSE(first->oz, other->oz, second);
    ray.dx = CHOOSE(first->dx, other->dx, second);
    ray.dy = CHOOSE(first->dy, other->dy, second);
    ray.dz = CHOOSE(first->dz, other->dz, second);
    return ray;
}
#endif

// The same ray in the space that an affine matrix of three rows leads to; lengths along it stay
// world millimetres.
INLINE struct ray transform_ray(__constant const float4 *rows, const struct ray *ray) {
    struct ray result;
#if JITTER
    result.phase = ray->phase;
#endif
#if SUPERSAMPLING
    result.runs = ray->runs;
#endif
    result.ox = rows[0].x * ray->ox + rows[0].y * ray->oy + rows[0].z * ray->oz + rows[0].w;
    result.oy = rows[1].x * ray->ox + rows[1].y * ray->oy + rows[1].z * ray->oz + rows[1].w;
    result.oz = rows[2].x * ray->ox + rows[2].y * ray->oy + rows[2].z * ray->oz + rows[2].w;
    result.dx = rows[0].x * ray->dx + rows[0].y * ray->dy + rows[0].z * ray->dz;
    result.dy = rows[1].x * ray->dx + rows[1].y * ray->dy + rows[1].z * ray->dz;
    result.dz = rows[2].x * ray->dx + rows[2].y * ray->dy + rows[2].z * ray->dz;
    return result;
}

// Narrows a span to one slab of a box (Kay & Kajiya 1986). A ray parallel to the slab is inside it
// for ever or never; 1e-20 keeps the division finite and makes that so.
INLINE void clip_slab(struct span *span, real origin, real direction, float low, float high) {
    const real safe = CHOOSE(direction, (real)(1e-20f), MASK(fabs(direction) < 1e-20f));
    const real inverse = 1.0f / safe;
    const real t_low = (low - origin) * inverse, t_high = (high - origin) * inverse;
    span->near = fmax(span->near, fmin(t_low, t_high));
    span->far = fmin(span->far, fmax(t_low, t_high));
}

// Where a ray, in the box's own space, is inside the box and not behind the eye.
INLINE struct span box_span(const struct ray *ray, float4 low, float4 high) {
    struct span span = {(real)(0.0f), (real)(FLT_MAX)};
    clip_slab(&span, ray->ox, ray->dx, low.x, high.x);
    clip_slab(&span, ray->oy, ray->dy, low.y, high.y);
    clip_slab(&span, ray->oz, ray->dz, low.z, high.z);
    return span;
}

#endif
