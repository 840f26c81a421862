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

#if EYES == EYES_WOVEN
// The second camera where -1, else the first one. Each lane's numbers are chosen before its ray is
// worked out: two rays at a time are arithmetic so dense that the clock slows down (glasses.cl).
typedef mask viewpoint;
#define FROM(member) CHOOSE((real)(world->camera.member), (real)(world->second.member), from)
#else
typedef __constant struct camera *viewpoint;
#define FROM(member) from->member
#endif

// The rays from a viewpoint through the places x and y of the whole picture: pixels, from its left
// and top edge. Whether they run, and their phases, are left to the caller.
INLINE struct ray camera_ray(__constant struct world *world, viewpoint from, real x, real y) {
    const real u = x * (2.0f / (float)world->whole_width) - 1.0f;
    const real v = 1.0f - y * (2.0f / (float)world->whole_height);
    struct ray ray;
    ray.ox = FROM(eye.x) + u * FROM(eye_right.x) + v * FROM(eye_up.x);
    ray.oy = FROM(eye.y) + u * FROM(eye_right.y) + v * FROM(eye_up.y);
    ray.oz = FROM(eye.z) + u * FROM(eye_right.z) + v * FROM(eye_up.z);
    ray.dx = FROM(forward.x) + u * FROM(right.x) + v * FROM(up.x);
    ray.dy = FROM(forward.y) + u * FROM(right.y) + v * FROM(up.y);
    ray.dz = FROM(forward.z) + u * FROM(right.z) + v * FROM(up.z);
    const real length = 1.0f / sqrt(ray.dx * ray.dx + ray.dy * ray.dy + ray.dz * ray.dz);
    ray.dx *= length;
    ray.dy *= length;
    ray.dz *= length;
    return ray;
}

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

// Where a ray, in the world, is inside a part's box.
INLINE struct span part_span(__constant struct part *part, const struct ray *ray) {
    const struct ray ray_voxel = transform_ray(part->voxel_from_world, ray);
    return box_span(&ray_voxel, part->box_low, part->box_high);
}

#endif
