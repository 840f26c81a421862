// leap.cl - what the ways to skip by cells share: how far to the next plane between them, and the
// leap.
//
// Included by span.cl before grid.cl, octree.cl and blocks.cl.
#ifndef LEAP_CL
#define LEAP_CL

#include "traverse/cursor.cl"

#if SKIP != SKIP_NONE && SKIP != SKIP_BVH

// How many samples from x on lie before the ray meets a plane between voxels, along one axis.
INLINE real samples_to_plane(real x, real delta, integer plane) {
    // A ray along the cells' walls never leaves them on this axis.
    const real speed = CHOOSE(delta, (real)(1e-20f), MASK(fabs(delta) < 1e-20f));
    return (TO_REAL(plane) - x) / speed;
}

// The number of samples to leap over, at least one, of `count` before a wall: a hundredth of a
// sample less than computed, so that rounding can only cost another look.
INLINE integer whole_leap(real count) {
    return max(TO_INTEGER(ceil(fmin(count, (real)(1e8f)) - 0.01f)), (integer)(1));
}

// The next sample from i on that may be visible: `count` samples behind `start`, the sample of the
// part nearest to i, where that is in something empty.
INLINE integer leap_from(const struct cursor *cursor, integer i, integer start, real count,
                         mask empty) {
    const integer leap = whole_leap(count);
    const integer next = start + CHOOSE((integer)(0), leap, empty);
    return CHOOSE((integer)(SAMPLE_NEVER), next, MASK(i < cursor->end) & MASK(next < cursor->end));
}

#endif
#endif
