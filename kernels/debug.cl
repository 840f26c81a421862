// debug.cl - what a debug view shows of each ray instead of its light: a number.
//
// The host paints the numbers (host/render/debug.c). Rays are followed as ever, so what is counted
// is what a picture costs.
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
    // The mask that ends the loop is made within it: LLVM 18 does not get done with one that goes
    // around, starting as a constant, and PoCL 6 has it stop the program then.
    while (true) {
        // On to the next sample at which some part begins or ends.
        integer change = (integer)(SAMPLE_NEVER);
        for (int c = 0; c < crossing->count; c++) {
            const struct cursor *cursor = &crossing->cursors[c];
            const mask runs = MASK(cursor->first < cursor->end);
            change = CHOOSE(change, min(change, cursor->first), runs & MASK(cursor->first > i));
            change = CHOOSE(change, min(change, cursor->end), runs & MASK(cursor->end > i));
        }
        i = change;
        const mask more = MASK(i < (integer)(SAMPLE_NEVER));
        if (!any_lane(more))
            return spans;
        mask active = (mask)(0);
        for (int c = 0; c < crossing->count; c++) {
            const struct cursor *cursor = &crossing->cursors[c];
            active |= MASK(cursor->first <= i) & MASK(i < cursor->end);
        }
        // Oclgrind extends the sign of a single lane's comparison to a byte, so it is not
        // subtracted.
        spans += CHOOSE((integer)(0), (integer)(1), active & more);
    }
}

#if SKIP == SKIP_BVH || SKIP == SKIP_BLOCKS
// The nodes of all hierarchies whose box a ray crosses where it has samples, or their leaves alone:
// clusters, or blocks. What is in front of the eye is not told from what opacity hides.
INLINE integer crossed_nodes(__constant struct world *world, __global const uchar *cells,
                             const struct crossing *crossing, bool leaves) {
    integer count = (integer)(0);
    for (int c = 0; c < crossing->count; c++) {
        const struct cursor *cursor = &crossing->cursors[c];
        __constant struct part *part = &world->parts[LISTED(crossing->parts, c)];
        __global const struct bvh_node *nodes = part_nodes(part, cells);
        const mask runs = MASK(cursor->first < cursor->end);
        const real first = TO_REAL(cursor->first), end = TO_REAL(cursor->end);
        int stack[BVH_DEPTH_MAX + 2];
        int depth = 0;
        if (nodes)
            stack[depth++] = 0;
        while (depth > 0) {
            const int n = stack[--depth];
            const struct span span = node_span(&nodes[n], cursor);
            const mask crosses =
                runs & MASK(span.near < span.far) & MASK(span.near < end) & MASK(span.far > first);
            if (!any_lane(crosses))
                continue;
            const int link = nodes[n].link;
            if (!leaves || link < 0)
                count += CHOOSE((integer)(0), (integer)(1), crosses);
            if (link >= 0) {
                stack[depth++] = link;
                stack[depth++] = n + 1;
            }
        }
    }
    return count;
}
#endif

// The number that the view shows of each ray.
INLINE real debug_number(__constant struct world *world, __global const uchar *cells,
                         const struct crossing *crossing, integer samples) {
    switch (world->debug) {
#if SKIP == SKIP_BVH || SKIP == SKIP_BLOCKS
    case DEBUG_CLUSTERS:
        return TO_REAL(crossed_nodes(world, cells, crossing, true));
    case DEBUG_NODES:
        return TO_REAL(crossed_nodes(world, cells, crossing, false));
#endif
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
