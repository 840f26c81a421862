// stride.cl - longer strides where volumes are locally thin or smooth.
//
// The samples of a ray go in runs of one, two or four, and one sample in the middle of a run stands
// for all of it. A run begins where its length divides its first sample's number, and it is as long
// as all parts there allow: each has a byte for every cell (stride_cells.cl), of which those of the
// first and the last sample are asked, and none begins or ends within a run. So the runs of a ray
// are the same whatever is skipped and whichever rays share its packet. See docs/picture.md,
// "Adaptive steps".
// Included by march.cl.
#ifndef STRIDE_CL
#define STRIDE_CL

#include "shared/grid.h"

#define STRIDE_PARAMETER , __global const uchar *strides
#define STRIDE_ARGUMENT , strides
#define BEGIN_STRIDES(crossing)                                                                    \
    (crossing).strides = strides;                                                                  \
    (crossing).spared = (integer)(0)
#define COUNT_SPARED(crossing, length, present)                                                    \
    (crossing)->spared += CHOOSE((integer)(0), (length) - 1, present)
#define SPARED(crossing) (uint)sum_lanes((crossing).spared)

// The last sample of a run that begins at sample i, and the first one behind it; and, of the run
// that ends before sample i, the middle.
#define RUN_LAST(i, length) ((i) + (length) - 1)
#define RUN_NEXT(i, length, alive) ((i) + CHOOSE((integer)(0), length, alive))
#define RUN_MIDDLE(i, length) (TO_REAL(i) - 0.5f * TO_REAL((length) + 1))

// From the place of a run's first sample to its middle, in the lanes that have the run.
#define RUN_PLACE(t, length, present)                                                              \
    ((t) + CHOOSE((real)(0.0f), 0.5f * TO_REAL((length) - 1), present))
#define RUN_STRENGTH(strength, length) run_strength(strength, length)

#define STRIDE_MAX 4

#define LOAD_STRIDE(at) strides[at]

// The runs of each ray in the block of four samples that it has asked for last.
struct runs {
    integer block;      // its first sample
    integer head, tail; // lengths of the runs at that sample, and at the third
};

INLINE struct runs runs_begin(void) {
    const struct runs runs = {(integer)(-1), (integer)(1), (integer)(1)};
    return runs;
}

// How long a run may be that has sample i of a part, as far as the sample's cell knows.
INLINE integer cell_run(__constant struct part *part, __global const uchar *strides,
                        const struct cursor *cursor, integer i) {
    const struct place place = cursor_place(cursor, i);
    const integer cell = place_cell(part, &place);
    return TO_INTEGER(GATHER(uchar, LOAD_STRIDE, cell));
}

// The lanes in which the samples from `first` on may be one run of that length. *at_first and
// *at_last are what the cells of its first and its last sample allow.
INLINE mask run_fits(__constant struct world *world, const struct crossing *crossing, integer first,
                     int length, integer *at_first, integer *at_last) {
    const integer most = (integer)(STRIDE_MAX), last = first + (length - 1);
    *at_first = *at_last = most;
    mask fits = (mask)(-1);
    for (int c = 0; c < COUNTED(crossing->count); c++) {
        const struct cursor *cursor = &crossing->cursors[c];
        const mask has_first = MASK(cursor->first <= first) & MASK(cursor->end > first),
                   has_last = MASK(cursor->first <= last) & MASK(cursor->end > last);
        fits &= (MASK(cursor->first <= first) & MASK(cursor->end > last)) |
                MASK(cursor->first > last) | MASK(cursor->end <= first);
        if (!any_lane(has_first | has_last))
            continue;
        __constant struct part *part = &world->parts[LISTED(crossing->parts, c)];
        const integer front = cell_run(part, crossing->strides, cursor, first),
                      back = cell_run(part, crossing->strides, cursor, last);
        *at_first = min(*at_first, CHOOSE(most, front, has_first));
        *at_last = min(*at_last, CHOOSE(most, back, has_last));
    }
    return fits & MASK(min(*at_first, *at_last) >= length);
}

// Takes *i back to the first sample of the run that it is in, and returns the run's length, in the
// lanes that ask; 1 in others.
INLINE integer find_run(__constant struct world *world, const struct crossing *crossing,
                        struct runs *runs, integer *i, mask asks) {
    const integer block = *i & -STRIDE_MAX;
    const mask fresh = asks & MASK(block != runs->block);
    if (any_lane(fresh)) {
        runs->block = CHOOSE(runs->block, block, fresh);
        runs->head = CHOOSE(runs->head, (integer)(1), fresh);
        runs->tail = CHOOSE(runs->tail, (integer)(1), fresh);
        // All four samples, then those two of the first and of the second half whose outer cells
        // allow it.
        mask open = fresh;
        integer front, back, inner;
        for (int n = 0; n < 3; n++) {
            const int length = n == 0 ? STRIDE_MAX : 2;
            const mask asked = n == 0 ? open : open & MASK((n == 1 ? front : back) >= 2);
            if (!any_lane(asked))
                continue;
            const mask fits = asked & run_fits(world, crossing, block + (n == 2 ? 2 : 0), length,
                                               n == 0 ? &front : &inner, n == 0 ? &back : &inner);
            runs->head = CHOOSE(runs->head, (integer)(length), n == 2 ? (mask)(0) : fits);
            runs->tail = CHOOSE(runs->tail, (integer)(length), n == 1 ? (mask)(0) : fits);
            if (n == 0)
                open = CHOOSE(open, (mask)(0), fits);
        }
    }
    const integer found = CHOOSE(runs->tail, runs->head, MASK(*i - block < 2));
    const integer length = CHOOSE((integer)(1), found, asks);
    *i &= -length;
    return length;
}

// The strength of a run, of that of one step: opacities go together as layers behind each other.
INLINE real run_strength(real strength, integer length) {
#if STRENGTH_DEPTH
    return strength * TO_REAL(length);
#else
    const real two = strength * (2.0f - strength), four = two * (2.0f - two);
    return CHOOSE(CHOOSE(strength, two, MASK(length == 2)), four, MASK(length == STRIDE_MAX));
#endif
}

#endif
