// order.cl - mixing `ordered`: every volume keeps its own step, and the next nearest sample of any
// is taken.
//
// Each cursor counts samples of its own. Where they lie on the ray is compared in units of a 64th
// of the world's step; samples in one place are taken together, in the order of the list. See
// docs/mixing.md.
#ifndef ORDER_CL
#define ORDER_CL

#include "span.cl"

#if MIXING == MIXING_ORDERED
#define PLACES_PER_STEP 64.0f
#define NOWHERE FLT_MAX

// The place of a cursor's next sample.
INLINE real order_place(const struct crossing *crossing, int c) {
    const struct cursor *cursor = &crossing->cursors[c];
    const real place =
        rint(SAMPLE_NUMBER(crossing, c, TO_REAL(cursor->next)) * PLACES_PER_STEP);
    return CHOOSE((real)(NOWHERE), place, MASK(cursor->next < cursor->end));
}

// The nearest place with a sample; NOWHERE at the end.
INLINE real order_nearest(const struct crossing *crossing) {
    real nearest = (real)(NOWHERE);
    for (int c = 0; c < crossing->count; c++)
        nearest = fmin(nearest, order_place(crossing, c));
    return nearest;
}
#endif

#endif
