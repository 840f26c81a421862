// cursor.cl - what all ways to skip share: a packet's place in one part.
//
// A cursor answers one question, per lane: from sample i of this ray in this part, which is the
// next sample that may be visible? The ray loop never knows which cursor it holds. Each way to skip
// is a file that defines cursor_leap.
#ifndef CURSOR_CL
#define CURSOR_CL

#include "ray.cl"
#include "shared/grid.h"

#ifndef POOL
#define POOL 0
#endif
#ifndef SKIP
#define SKIP SKIP_NONE // how empty space is skipped
#endif

#define SAMPLE_NEVER INT_MAX // the part has nothing more to show

// The samples first <= i < end of a ray lie inside the part, and none before `next` may be visible.
// Positions in memory coordinates are origin + i * delta; lanes that miss the part rest at a safe
// place inside it.
struct cursor {
    integer first, end, next;
#if SKIP == SKIP_BVH || SKIP == SKIP_BLOCKS
    integer inside; // before this sample, the ray is inside a cluster or a sub-block
#endif
#if SKIP == SKIP_BLOCKS
    integer block; // the one that the ray has been in last, or -1
#endif
    real ox, oy, oz;
    real dx, dy, dz;
};

// The number of the first sample at or behind distance t.
INLINE integer sample_at(real t, real t_near, ray_phase phase, float per_mm) {
    const real number = ceil((t - t_near) * per_mm - phase);
    return TO_INTEGER(clamp(number, 0.0f, 1e9f));
}

// How far a ray moves along an axis from sample to sample: never 0, because leaps divide by it, but
// where it runs along the cells' walls, or not at all, so little that it never leaves them.
INLINE real move_along(real delta, mask runs) {
    const mask moves = runs & MASK(fabs(delta) > 1e-20f);
    return CHOOSE((real)(1e-20f), delta, moves);
}

// Places the cursor at the start of the part, whose samples are `step_mm` apart.
INLINE struct cursor cursor_begin(__constant struct world *world, __constant struct part *part,
                                  const struct ray *ray_voxel, const struct span *span, real t_near,
                                  float step_mm) {
    const float per_mm = 1.0f / step_mm;
    // A short span may lie between two samples: then there is nothing to show either.
    const ray_phase phase = RAY_PHASE(world, ray_voxel);
    const integer first = sample_at(span->near, t_near, phase, per_mm);
    const integer end = sample_at(span->far, t_near, phase, per_mm);
    const mask runs = MASK(span->near < span->far) & MASK(first < end) & RAY_RUNS(ray_voxel);
    struct cursor cursor;
    cursor.first = CHOOSE((integer)(SAMPLE_NEVER), first, runs);
    cursor.end = CHOOSE((integer)(0), end, runs);
    cursor.next = cursor.first;
#if SKIP == SKIP_BVH || SKIP == SKIP_BLOCKS
    cursor.inside = (integer)(0);
#endif
#if SKIP == SKIP_BLOCKS
    cursor.block = (integer)(-1);
#endif

    const real t_first = t_near + phase * step_mm;
    const float4 shift = part->memory_from_voxel;
    const real one = (real)(1.0f);
    cursor.ox = CHOOSE(one, ray_voxel->ox + t_first * ray_voxel->dx + shift.x, runs);
    cursor.oy = CHOOSE(one, ray_voxel->oy + t_first * ray_voxel->dy + shift.y, runs);
    cursor.oz = CHOOSE(one, ray_voxel->oz + t_first * ray_voxel->dz + shift.z, runs);
    cursor.dx = move_along(step_mm * ray_voxel->dx, runs);
    cursor.dy = move_along(step_mm * ray_voxel->dy, runs);
    cursor.dz = move_along(step_mm * ray_voxel->dz, runs);
    return cursor;
}

// The sample of the part that is nearest to sample i, so that no lane reads beyond it.
INLINE integer cursor_clamp(const struct cursor *cursor, integer i) {
    return max(min(i, cursor->end - 1), cursor->first);
}

// A position in memory coordinates.
struct place {
    real x, y, z;
};

// Where a cursor's sample i is, or the sample of the part that is nearest to it.
INLINE struct place cursor_place(const struct cursor *cursor, integer i) {
    const real t = TO_REAL(cursor_clamp(cursor, i));
    const struct place place = {cursor->ox + t * cursor->dx, cursor->oy + t * cursor->dy,
                                cursor->oz + t * cursor->dz};
    return place;
}

// The cell of a part that a place lies in, counted over all parts.
INLINE integer place_cell(__constant struct part *part, const struct place *place) {
    return (TO_INTEGER(place->z) >> CELL_BITS) * part->cell_slice +
           (TO_INTEGER(place->y) >> CELL_BITS) * part->cell_row +
           (TO_INTEGER(place->x) >> CELL_BITS) + (int)part->cells;
}

#endif
