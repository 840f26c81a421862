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
#include "boxes.cl"

#ifndef MODELS
#define MODELS 0 // what else than absorption, gathered front to back, occurs: MODELS_*
#endif

// 1: strengths are optical depths of a step, 0: opacities. With one part there is nothing to mix.
#define STRENGTH_DEPTH (CAPACITY > 1 && MIXING != MIXING_OVER && MIXING != MIXING_ORDERED)

// With room for one part only, the compiler must see that there is only one, or it keeps the cursor
// in memory instead of registers.
#define LISTED(list, index) (CAPACITY == 1 ? 0 : (list)[index])
#define COUNTED(count) (CAPACITY == 1 ? 1 : (count))

// 1: parts join the samples of a packet, and leave them (active.cl).
#define JOINS (CAPACITY > 1 && MIXING != MIXING_ORDERED)

// 1: a cursor looks for its first visible sample only when a ray comes to its part, which behind an
// opaque one it never does. Views and probes show every part that has something to be seen.
#define LATE_CURSORS (JOINS && !DEBUG && !PROBE)

// 1: and only then is it asked whether rays cross the part. Back to front the first part is behind
// all others, and projections find their places part by part.
#define LATE_PARTS (LATE_CURSORS && !(MODELS & (MODELS_BACKWARD | MODELS_PROJECTION | MODELS_EMISSION)))

#if JOINS
#include "ahead.cl"
#endif

// How many samples of a ray are looked at together. A packet's sample is a chain of instructions, of
// which each waits for the one before, and one is as long as a processor can look ahead. Of some
// that do not wait for each other it goes on with others meanwhile: one volume takes three quarters
// of the time. Samples go one at a time where they ask for the one before, or are layers by
// themselves; and where more work than a look-up is done for each.
#if LANES == 1 || READER != READER_BUFFER || MODELS || ADAPTIVE || SHADING || LIVE ||              \
    (FILTERS & FILTERS_CUBIC) || MIXING == MIXING_ORDERED || (CAPACITY > 1 && !STRENGTH_DEPTH)
#define AT_ONCE 1
#else
#define AT_ONCE (CAPACITY == 1 ? 3 : 2)
#endif

// The parts that some lane of the packet crosses, with their cursors; with LATE_PARTS those that it
// has come to.
struct crossing {
    struct cursor cursors[CAPACITY];
    int parts[CAPACITY];
    int count;
#if JOINS
    struct ahead ahead;
#endif
#if LATE_PARTS
    struct approach approach;
    real t_near; // where sample numbers count from
    mask runs;   // the rays that cross something
    integer end; // behind the last sample of all cursors
#endif
    integer possible; // samples of each ray, were all of them taken
    integer behind;   // of these, those behind the end of a ray that ended early
#if ADAPTIVE
    __global const uchar *strides; // a byte for each cell of each part
    integer spared;                // samples that others stand for
#endif
#if SHADING || CLIP || LATE_PARTS
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
    // Where samples 0 of each lie and how far apart they are, in steps of the world from its sample
    // 0.
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

// Whether some ray may have samples.
#if LATE_PARTS
#define HAS_SAMPLES(crossing) ((crossing)->ahead.count > 0)
#else
#define HAS_SAMPLES(crossing) ((crossing)->count > 0)
#endif

// Takes the cursor of a part on from sample i, in which none of the lanes `present` there has shown
// anything.
INLINE void pass_over(__constant struct part *part, __global const uchar *cells,
                      struct cursor *cursor, integer i, mask present) {
#if MIXING == MIXING_ORDERED
    const integer next = cursor_leap(part, cells, cursor, cursor->next, present);
    cursor->next = CHOOSE(cursor->next, next, present);
#else
    cursor->next = cursor_leap(part, cells, cursor, i + 1, present);
#endif
}

#include "crossing.cl"
#include "active.cl"

#endif
