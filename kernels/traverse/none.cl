// none.cl - the cursor that skips nothing: every sample inside the box may be visible.
//
// A cursor answers one question, per lane: from sample i of this ray in this part, which is the next
// sample that may be visible? The ray loop never knows which cursor it holds.
#ifndef TRAVERSE_CL
#define TRAVERSE_CL

#include "ray.cl"

#define SAMPLE_NEVER INT_MAX // the part has nothing more to show

// The samples first <= i < end of a ray lie inside the part. Positions in memory coordinates are
// origin + i * delta; lanes that miss the part rest at a safe place inside it.
struct cursor {
    integer first, end;
    real ox, oy, oz;
    real dx, dy, dz;
};

// The number of the first sample at or behind distance t.
INLINE integer sample_at(real t, real t_near, float phase, float per_mm) {
    const real number = ceil((t - t_near) * per_mm - phase);
    return TO_INTEGER(clamp(number, 0.0f, 1e9f));
}

// Places the cursor at the start of the part.
INLINE struct cursor cursor_begin(__constant struct world *world, __constant struct part *part,
                                  const struct ray *ray_voxel, const struct span *span,
                                  real t_near) {
    const float per_mm = 1.0f / world->step_mm;
    const mask hit = MASK(span->near < span->far);
    struct cursor cursor;
    cursor.first = CHOOSE((integer)(SAMPLE_NEVER),
                          sample_at(span->near, t_near, world->phase, per_mm), hit);
    cursor.end = CHOOSE((integer)(0), sample_at(span->far, t_near, world->phase, per_mm), hit);

    const real t_first = t_near + world->phase * world->step_mm;
    const float4 shift = part->memory_from_voxel;
    const real zero = (real)(0.0f), one = (real)(1.0f);
    const mask runs = MASK(cursor.first < cursor.end);
    cursor.ox = CHOOSE(one, ray_voxel->ox + t_first * ray_voxel->dx + shift.x, runs);
    cursor.oy = CHOOSE(one, ray_voxel->oy + t_first * ray_voxel->dy + shift.y, runs);
    cursor.oz = CHOOSE(one, ray_voxel->oz + t_first * ray_voxel->dz + shift.z, runs);
    cursor.dx = CHOOSE(zero, world->step_mm * ray_voxel->dx, runs);
    cursor.dy = CHOOSE(zero, world->step_mm * ray_voxel->dy, runs);
    cursor.dz = CHOOSE(zero, world->step_mm * ray_voxel->dz, runs);
    return cursor;
}

// The next sample from i on that may be visible, or SAMPLE_NEVER.
INLINE integer cursor_leap(const struct cursor *cursor, integer i) {
    return CHOOSE((integer)(SAMPLE_NEVER), max(i, cursor->first), MASK(i < cursor->end));
}

#endif
