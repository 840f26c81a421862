// debug.cl - what a debug view shows of each ray instead of its light: a number.
//
// The host paints the numbers (host/render/debug.c). Rays are followed as ever, so what is counted is what a picture
// costs.
#ifndef DEBUG_CL
#define DEBUG_CL

#include "span.cl"

// The parts that each ray crosses and has not been able to rule out.
INLINE integer crossed_parts(const struct crossing *crossing) {
    integer parts = (integer)(0);
    for (int c = 0; c < crossing->count; c++)
        parts += CHOOSE((integer)(0), (integer)(1),
                        MASK(crossing->cursors[c].first < crossing->cursors[c].end));
    return parts;
}

// The spans of each ray in which a constant set of such parts is active, the empty set left out.
INLINE integer crossed_spans(const struct crossing *crossing) {
    integer spans = (integer)(0), i = (integer)(-1);
    mask more = (mask)(-1);
    while (any_lane(more)) {
        // On to the next sample at which some part begins or ends.
        integer change = (integer)(SAMPLE_NEVER);
        for (int c = 0; c < crossing->count; c++) {
            const struct cursor *cursor = &crossing->cursors[c];
            const mask runs = MASK(cursor->first < cursor->end);
            change = CHOOSE(change, min(change, cursor->first), runs & MASK(cursor->first > i));
            change = CHOOSE(change, min(change, cursor->end), runs & MASK(cursor->end > i));
        }
        i = change;
        more = MASK(i < (integer)(SAMPLE_NEVER));
        mask active = (mask)(0);
        for (int c = 0; c < crossing->count; c++) {
            const struct cursor *cursor = &crossing->cursors[c];
            active |= MASK(cursor->first <= i) & MASK(i < cursor->end);
        }
        // Oclgrind extends the sign of a single lane's comparison to a byte, so it is not subtracted.
        spans += CHOOSE((integer)(0), (integer)(1), active & more);
    }
    return spans;
}

// The number that the view shows of each ray.
INLINE real debug_number(__constant struct world *world, const struct crossing *crossing,
                         integer samples) {
    switch (world->debug) {
    case DEBUG_SPANS:
        return TO_REAL(crossed_spans(crossing));
    case DEBUG_PARTS:
        return TO_REAL(crossed_parts(crossing));
    case DEBUG_WORK_GROUP:
        return (real)((float)get_group_id(0));
    case DEBUG_WORK_ITEM:
        return (real)((float)get_local_id(0));
    default:
        return TO_REAL(samples);
    }
}

#endif
