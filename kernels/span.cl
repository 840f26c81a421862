// span.cl - which parts a packet of rays crosses, and where its samples in each of them lie.
#ifndef SPAN_CL
#define SPAN_CL

#include "shared/probe.h"
#include "clip.cl"
#include "traverse/hierarchy.cl"
#include "traverse/leap.cl"
#include "shared/grid.h"

#ifndef MASKED
#define MASKED 0 // 1: where some volume is shown, another one decides
#endif
#if MASKED
#include "mask.cl"
#endif
#ifndef ADAPTIVE
#define ADAPTIVE 0 // 1: samples are farther apart where volumes are locally thin or smooth
#endif
#if SKIP != SKIP_NONE || POOL || ADAPTIVE
#include "occupancy.cl"
#endif
#if SKIP == SKIP_NONE
#include "traverse/none.cl"
#else
#if SKIP == SKIP_BVH
#include "traverse/bvh.cl"
#elif SKIP == SKIP_BLOCKS
#include "traverse/blocks.cl"
#else
#include "traverse/cells.cl"
#endif
#endif

#ifndef SHADING
#define SHADING 0 // 1: some volume is shaded
#endif
#ifndef MIXING
#define MIXING MIXING_SUM // how volumes that overlap share a sample
#endif
#ifndef PROBE
#define PROBE 0 // 1: one ray writes down what it meets
#endif
#ifndef CAPACITY
#define CAPACITY 1 // parts the kernel has room for: 1, 8 or WORLD_PART_MAX
#endif
#include "candidates.cl"

#ifndef MODELS
#define MODELS 0 // what else than absorption, gathered front to back, occurs: MODELS_*
#endif

// With room for one part only, the compiler must see that there is only one, or it keeps the cursor in
// memory instead of registers.
#define LISTED(list, index) (CAPACITY == 1 ? 0 : (list)[index])
#define COUNTED(count) (CAPACITY == 1 ? 1 : (count))

// 1: a cursor looks for its first visible sample only when a ray comes to its part, which behind an opaque one it never
// does. Views and probes show every part that has something to be seen.
#define LATE_CURSORS (CAPACITY > 1 && MIXING != MIXING_ORDERED && !DEBUG && !PROBE)

// The parts that some lane of the packet crosses, with their cursors.
struct crossing {
    struct cursor cursors[CAPACITY];
    int parts[CAPACITY];
    int count;
#if CAPACITY > 1
    // The cursors in the order in which the first of the rays enters their parts, and where it does.
    int order[CAPACITY], entries[CAPACITY];
#endif
    integer possible; // samples of each ray, were all of them taken
    integer behind;   // of these, those behind the end of a ray that ended early
#if ADAPTIVE
    __global const uchar *strides; // a byte for each cell of each part
    integer spared;                // samples that others stand for
#endif
#if SHADING || CLIP
    struct ray ray;
#endif
#if SHADING || PROBE || CLIP || EYES == EYES_DEPTH
    real t_first; // where sample 0 lies
#endif
#if EYES == EYES_DEPTH
    real depth, depth_weight; // sample numbers times their weights, and the sum of these (depth.cl)
#endif
#if PROBE
    __global struct probe_sample *log;
    int logged; // samples that have been there to write
#endif
#if MODELS & MODELS_BACKWARD
    integer mirror; // what the numbers of a sample front to back and back to front add up to
#endif
#if MIXING == MIXING_ORDERED
    // Where samples 0 of each lie and how far apart they are, in steps of the world from its sample 0.
    real starts[CAPACITY];
    float strides[CAPACITY];
#endif
};

#if MODELS & MODELS_BACKWARD
// Turns a cursor round, so that the part's last sample comes first. Each sample stays where it is.
INLINE void cursor_mirror(struct cursor *cursor, integer mirror) {
    const mask runs = MASK(cursor->first < cursor->end);
    const integer first = mirror - cursor->end + 1, end = mirror - cursor->first + 1;
    const real t = TO_REAL(mirror);
    cursor->first = CHOOSE(cursor->first, first, runs);
    cursor->end = CHOOSE(cursor->end, end, runs);
    cursor->next = cursor->first;
    cursor->ox += t * cursor->dx;
    cursor->oy += t * cursor->dy;
    cursor->oz += t * cursor->dz;
    cursor->dx = -cursor->dx;
    cursor->dy = -cursor->dy;
    cursor->dz = -cursor->dz;
}
#endif

// The number that a cursor's sample has front to back among those of the world's step.
#if MODELS & MODELS_BACKWARD
#define SAMPLE_NUMBER(crossing, c, t) (TO_REAL((crossing)->mirror) - (t))
#elif MIXING == MIXING_ORDERED
#define SAMPLE_NUMBER(crossing, c, t) ((crossing)->starts[c] + (t) * (crossing)->strides[c])
#else
#define SAMPLE_NUMBER(crossing, c, t) (t)
#endif

#if MIXING == MIXING_ORDERED
// Where the rays enter the instance whose first part is p.
INLINE real enter_instance(__constant struct world *world, const struct ray *ray, int p) {
    const int medium = world->parts[p].medium;
    real near = (real)(FLT_MAX);
    for (int q = p; q < world->part_count && world->parts[q].medium == medium; q++) {
        const struct ray ray_voxel = transform_ray(world->parts[q].voxel_from_world, ray);
        const struct span span =
            box_span(&ray_voxel, world->parts[q].box_low, world->parts[q].box_high);
        near = CHOOSE(near, fmin(near, span.near), MASK(span.near < span.far));
    }
    return near;
}
#endif

#if CAPACITY > 1
// Gives the newest cursor, c, its place in the order of entries.
INLINE void place_in_order(struct crossing *crossing, int c, int entry) {
    int place = c;
    for (; place > 0 && crossing->entries[place - 1] > entry; place--) {
        crossing->entries[place] = crossing->entries[place - 1];
        crossing->order[place] = crossing->order[place - 1];
    }
    crossing->entries[place] = entry;
    crossing->order[place] = c;
}
#endif

// Takes the cursor of a part on from sample i, in which none of the lanes `present` there has shown anything.
INLINE void pass_over(__constant struct part *part, __global const uchar *cells,
                      struct cursor *cursor, integer i, mask present) {
#if MIXING == MIXING_ORDERED
    const integer next = cursor_leap(part, cells, cursor, cursor->next, present);
    cursor->next = CHOOSE(cursor->next, next, present);
#else
    cursor->next = cursor_leap(part, cells, cursor, i + 1, present);
#endif
}

// Finds the parts that the packet crosses and where each ray's samples begin.
INLINE void find_crossing(__constant struct world *world, __global const uchar *cells,
                          const struct ray *ray, struct crossing *crossing) {
    const struct span bounds = box_span(ray, world->bounds_low, world->bounds_high);
    real t_near;
    ulong candidates = find_candidates(world, ray, &t_near);
    if (world->origin_bounds)
        t_near = bounds.near;
#if SHADING || CLIP
    crossing->ray = *ray;
#endif
#if SHADING || PROBE || CLIP || EYES == EYES_DEPTH
    crossing->t_first = fmin(t_near, 1e9f) + RAY_PHASE(world, ray) * world->step_mm;
#endif
#if MODELS & MODELS_BACKWARD
    const float samples_per_mm = 1.0f / world->step_mm;
    crossing->mirror = sample_at(bounds.far, t_near, RAY_PHASE(world, ray), samples_per_mm) + 1;
#endif
#if EYES == EYES_DEPTH
    crossing->depth = crossing->depth_weight = (real)(0.0f);
#endif
    crossing->count = 0;
    crossing->possible = crossing->behind = (integer)(0);
#if MIXING == MIXING_ORDERED
    real t_own = t_near;
    int entered = -1; // the instance's first part that t_own is of
#endif
    for (; candidates != 0 && crossing->count < CAPACITY; candidates &= candidates - 1) {
        const int p = CAPACITY == 1 ? 0 : first_candidate(candidates);
        __constant struct part *part = &world->parts[p];
        const struct ray ray_voxel = transform_ray(part->voxel_from_world, ray);
        struct span span = box_span(&ray_voxel, part->box_low, part->box_high);
#if CLIP
        clip_span(world, part, ray, &span);
#endif
#if MIXING == MIXING_ORDERED
        int start = p;
        while (start > 0 && world->parts[start - 1].medium == part->medium)
            start--;
        if (!world->origin_bounds && start != entered)
            t_own = enter_instance(world, ray, start);
        entered = start;
        const float step_mm = part->step_mm;
#else
        const real t_own = t_near;
        const float step_mm = world->step_mm;
#endif
        struct cursor cursor = cursor_begin(world, part, &ray_voxel, &span, t_own, step_mm);
#if MODELS & MODELS_BACKWARD
        cursor_mirror(&cursor, crossing->mirror);
#endif
        crossing->possible +=
            CHOOSE((integer)(0), cursor.end - cursor.first, MASK(cursor.first < cursor.end));
#if !LATE_CURSORS
        cursor.next = cursor_leap(part, cells, &cursor, cursor.first, (mask)(-1));
#endif
        // With runs of samples all parts count, so that these are the same whatever is skipped.
        const integer seen = ADAPTIVE ? cursor.first : cursor.next;
        if (any_lane(MASK(seen < cursor.end))) {
            const int c = CAPACITY == 1 ? 0 : crossing->count;
            crossing->cursors[c] = cursor;
            crossing->parts[c] = p;
#if CAPACITY > 1
            place_in_order(crossing, c, least_lane(cursor.first));
#endif
#if MIXING == MIXING_ORDERED
            const ray_phase phase = RAY_PHASE(world, ray);
            crossing->strides[c] = step_mm / world->step_mm;
            crossing->starts[c] =
                (t_own - t_near) / world->step_mm + phase * crossing->strides[c] - phase;
#endif
            crossing->count++;
        }
    }
}

#include "active.cl"

#endif
