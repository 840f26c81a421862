// candidates.cl - which parts a packet of rays may cross at all.
//
// With many parts apart most packets miss most of them, and turning rays into each one's own space
// only to find that out would cost more than their samples. So a part is first asked whether any
// ray comes near the ball around its box, which takes a tenth of that. The ball is a little too
// large and never too small, so the picture stays the same.
#ifndef CANDIDATES_CL
#define CANDIDATES_CL

#include "ray.cl"

#ifndef CAPACITY
#define CAPACITY 1 // parts the kernel has room for: 1, 8 or WORLD_PART_MAX
#endif

// Rounding in the distance of a far away ray from the middle of a ball, as a share of the distance
// of the ray's origin.
#define BALL_MARGIN 1e-5f

// Whether some ray of the packet may hit the ball: its middle, and its radius as the fourth
// component.
INLINE bool may_hit_ball(const struct ray *ray, float4 ball) {
    const real x = ball.x - ray->ox, y = ball.y - ray->oy, z = ball.z - ray->oz;
    const real along = x * ray->dx + y * ray->dy + z * ray->dz;
    const real squared = x * x + y * y + z * z, reach = ball.w * ball.w + BALL_MARGIN * squared;
    // The squared distance of the line from the middle, and of its origin where it runs away from
    // it.
    const real away = squared - CHOOSE((real)(0.0f), along * along, MASK(along > 0.0f));
    return any_lane(MASK(away <= reach));
}

// The parts that some ray of the packet crosses, as bits, and the distance at which each ray enters
// the first one.
INLINE ulong find_candidates(__constant struct world *world, const struct ray *ray, real *t_near) {
    ulong candidates = 0;
    *t_near = (real)(FLT_MAX);
    for (int p = 0; p < (CAPACITY == 1 ? 1 : world->part_count); p++) {
        if (CAPACITY > 1 && !may_hit_ball(ray, world->balls[p]))
            continue;
        __constant struct part *part = &world->parts[p];
        const struct ray ray_voxel = transform_ray(part->voxel_from_world, ray);
        const struct span span = box_span(&ray_voxel, part->box_low, part->box_high);
        const mask hit = MASK(span.near < span.far);
        *t_near = CHOOSE(*t_near, span.near, hit & MASK(span.near < *t_near));
        candidates |= any_lane(hit) ? (ulong)1 << p : 0;
    }
    return candidates;
}

// The number of the first candidate. There must be one.
INLINE int first_candidate(ulong candidates) {
    return 63 - (int)clz(candidates & (~candidates + 1));
}

#endif
