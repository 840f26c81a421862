// boxes.cl - which parts rays may cross, by a hierarchy over the boxes of all parts.
//
// With many parts most rays miss most of them, and turning rays into each one's own space only to
// find that out would cost more than their samples. So boxes along the world's axes are asked
// first, which hold one another and in the end each one part (shared/bvh.h; host/world/boxes.c
// makes them). They are a little too large and never too small, so the picture stays the same.
#ifndef BOXES_CL
#define BOXES_CL

#include "ray.cl"
#include "shared/bvh.h"

#ifndef CAPACITY
#define CAPACITY 1 // parts the kernel has room for: 1, 8 or WORLD_PART_MAX
#endif

// The parts that may be met by some ray before `far`, as bits, and the first of such.
#if CAPACITY == 1
#define PARTS_MET(world, ray, far) 1
#define FIRST_PART(parts) 0
#else
#define PARTS_MET(world, ray, far) find_boxes(world, ray, far)
#define FIRST_PART(parts) first_part(parts)
#endif

#if CAPACITY == 1
// Where the rays enter the only part; FLT_MAX where they miss it.
INLINE real find_first_entry(__constant struct world *world, const struct ray *ray) {
    const struct span span = part_span(&world->parts[0], ray);
    return CHOOSE((real)(FLT_MAX), span.near, MASK(span.near < span.far));
}
#else
// Rounding in the place of a far away ray, as a share of its origin's distance.
#define BOX_MARGIN 1e-5f

// Rays on their way to boxes: for each axis the origin, a margin on towards what is asked of it,
// and 1 / direction.
struct approach {
    real low_x, low_y, low_z, high_x, high_y, high_z;
    real x, y, z;
};

INLINE real invert(real direction) {
    return 1.0f / CHOOSE(direction, (real)(1e-20f), MASK(fabs(direction) < 1e-20f));
}

INLINE struct approach approach_boxes(const struct ray *ray) {
    const real margin = BOX_MARGIN * (fabs(ray->ox) + fabs(ray->oy) + fabs(ray->oz));
    const struct approach approach = {ray->ox + margin, ray->oy + margin, ray->oz + margin,
                                      ray->ox - margin, ray->oy - margin, ray->oz - margin,
                                      invert(ray->dx),  invert(ray->dy),  invert(ray->dz)};
    return approach;
}

// Where rays are inside a node's box and not behind their origin.
INLINE struct span meet_box(__constant struct bvh_node *node, const struct approach *approach) {
    const real low_x = (node->low[0] - approach->low_x) * approach->x,
               low_y = (node->low[1] - approach->low_y) * approach->y,
               low_z = (node->low[2] - approach->low_z) * approach->z;
    const real high_x = (node->high[0] - approach->high_x) * approach->x,
               high_y = (node->high[1] - approach->high_y) * approach->y,
               high_z = (node->high[2] - approach->high_z) * approach->z;
    struct span span;
    span.near = fmax(fmax(fmin(low_x, high_x), fmin(low_y, high_y)), fmin(low_z, high_z));
    span.far = fmin(fmin(fmax(low_x, high_x), fmax(low_y, high_y)), fmax(low_z, high_z));
    span.near = AT_LEAST(span.near, (real)(0.0f));
    return span;
}

// The parts whose box some ray meets before `far`, as bits.
INLINE ulong find_boxes(__constant struct world *world, const struct ray *ray, real far) {
    const struct approach approach = approach_boxes(ray);
    ulong found = 0;
    int stack[CAPACITY]; // no two of these nodes are one below the other
    int depth = 1;
    stack[0] = 0;
    while (depth > 0) {
        const int n = stack[--depth];
        __constant struct bvh_node *node = &world->nodes[n];
        const struct span span = meet_box(node, &approach);
        if (!any_lane(MASK(span.near <= span.far) & MASK(span.near <= far)))
            continue;
        if (node->link < 0) {
            found |= (ulong)1 << (-1 - node->link);
        } else {
            stack[depth++] = node->link;
            stack[depth++] = n + 1;
        }
    }
    return found;
}

// The number of the first part of some. There must be one.
INLINE int first_part(ulong parts) {
    return 63 - (int)clz(parts & (~parts + 1));
}

// Where rays come to a node's box; FLT_MAX where they miss it.
INLINE real reach_box(__constant struct bvh_node *node, const struct approach *approach) {
    const struct span span = meet_box(node, approach);
    return CHOOSE((real)(FLT_MAX), span.near, MASK(span.near <= span.far));
}

// Where each ray enters the first part that it crosses; FLT_MAX where it crosses none. Nearer boxes
// come first, and what no ray enters before that is left out.
INLINE real find_first_entry(__constant struct world *world, const struct ray *ray,
                             const struct approach *approach) {
    real first = (real)(FLT_MAX);
    real entries[CAPACITY]; // no two of these nodes are one below the other
    int stack[CAPACITY];
    int depth = 1;
    stack[0] = 0;
    entries[0] = reach_box(&world->nodes[0], approach);
    while (depth > 0) {
        depth--;
        if (!any_lane(MASK(entries[depth] < first)))
            continue;
        const int n = stack[depth], link = world->nodes[n].link;
        if (link < 0) {
            const struct span span = part_span(&world->parts[-1 - link], ray);
            first = CHOOSE(first, span.near, MASK(span.near < span.far) & MASK(span.near < first));
            continue;
        }
        const real left = reach_box(&world->nodes[n + 1], approach),
                   right = reach_box(&world->nodes[link], approach);
        // As numbers of bits, distances have the same order.
        const bool swapped = least_lane(AS_INTEGER(right)) < least_lane(AS_INTEGER(left));
        stack[depth] = swapped ? n + 1 : link;
        entries[depth++] = swapped ? left : right;
        stack[depth] = swapped ? link : n + 1;
        entries[depth++] = swapped ? right : left;
    }
    return first;
}
#endif

#endif
