// leap.cl - what the ways to skip by cells share: how far a ray has to go to the next plane.
//
// Included by span.cl before cells.cl and blocks.cl.
#ifndef LEAP_CL
#define LEAP_CL

#include "traverse/cursor.cl"

#if SKIP != SKIP_NONE && SKIP != SKIP_BVH

// How many samples from x on lie before the ray meets a plane between voxels, along one axis.
INLINE real samples_to_plane(real x, real delta, integer plane) {
    return (TO_REAL(plane) - x) / delta;
}

// The number of samples to leap over, at least one, of `count` before a wall: rounded up, from a
// hundredth of a sample less than computed, so that rounding can only cost another look.
INLINE integer whole_leap(real count) {
    return max(TO_INTEGER(AT_MOST(count, (real)(1e8f)) + 0.99f), (integer)(1));
}

#endif
#endif
