// active.cl - which parts of a crossing take part in a packet's present samples.
//
// The cost of a sample follows this list, so a part joins it when the first of the rays comes to
// it, and leaves it when the last has seen what there is. A ray that has not yet come to a part of
// the list, or has left it, takes no sample there; asking costs less than a list of each ray's own,
// which would change at every few samples. Included by span.cl.
#ifndef ACTIVE_CL
#define ACTIVE_CL

// It lasts until some ray reaches the sample `until`, where the next part may begin.
struct active {
    int list[CAPACITY]; // indices into the crossing, in the order of its parts
    int count;
    integer until;
    integer last; // behind the last sample of all parts
};

// The first sample of each ray, where some part begins or may begin. *alive are the rays that have
// one.
INLINE integer begin_active(struct active *active, const struct crossing *crossing, mask *alive) {
    active->count = 0;
#if LATE_PARTS
    active->until = (integer)(0);
    active->last = (integer)(SAMPLE_NEVER);
    *alive = crossing->runs;
    return (integer)(0);
#else
    integer first = (integer)(SAMPLE_NEVER);
    active->last = (integer)(0);
    for (int c = 0; c < COUNTED(crossing->count); c++) {
        first = min(first, crossing->cursors[c].next);
        active->last = max(active->last, crossing->cursors[c].end);
    }
    active->until = CAPACITY == 1 ? active->last : first;
    *alive = MASK(first < active->last);
    return first;
#endif
}

#if JOINS
// Lets cursor c of the crossing take part.
INLINE void join_part(__constant struct world *world, __global const uchar *cells,
                      struct active *active, struct crossing *crossing, int c) {
    const int p = crossing->parts[c];
#if LATE_CURSORS
    struct cursor *cursor = &crossing->cursors[c];
    cursor->next = cursor_leap(&world->parts[p], cells, cursor, cursor->first, (mask)(-1));
    if (!any_lane(MASK(cursor->next < cursor->end)))
        return;
#endif
    int place = active->count++;
    for (; place > 0 && crossing->parts[active->list[place - 1]] > p; place--)
        active->list[place] = active->list[place - 1];
    active->list[place] = c;
}

// The last sample that is looked at with sample i: of the longest run (stride.cl) that it may be in,
// which asks all parts there, or of those at once.
#define REACH(i) (ADAPTIVE ? (i) | 3 : (i) + (AT_ONCE - 1))

// Adds the parts that some ray has come to at its sample i. It is rarely called, and inside the ray
// loop it would take registers from samples (4 to 9 % of a frame).
OUTLINE void join_active(__constant struct world *world, __global const uchar *cells, struct active *active,
                         struct crossing *crossing, integer i, mask alive) {
    struct ahead *ahead = &crossing->ahead;
    active->until = (integer)(SAMPLE_NEVER);
    while (ahead->count > 0) {
        const integer entry = (integer)(ahead->entries[ahead->count - 1]);
        if (!any_lane(alive & MASK(REACH(i) >= entry))) {
            active->until = entry;
            return;
        }
        const int link = ahead->links[--ahead->count];
#if LATE_PARTS
        if (link >= 0)
            enter_node(world, cells, crossing, link, alive);
        else
#endif
            join_part(world, cells, active, crossing, -1 - link);
    }
#if LATE_PARTS
    active->last = crossing->end;
#endif
}
#endif

// The next sample, from i on, that may show something; SAMPLE_NEVER at the end. Parts with nothing
// more to show leave.
INLINE integer leap(struct active *active, const struct crossing *crossing, integer i) {
    integer next = active->until;
#if CAPACITY > 1
    int kept = 0;
#endif
    for (int a = 0; a < COUNTED(active->count); a++) {
        const int c = LISTED(active->list, a);
        const struct cursor *cursor = &crossing->cursors[c];
        const mask runs = MASK(i < cursor->end);
        const integer own = CHOOSE((integer)(SAMPLE_NEVER), cursor->next, runs);
        next = min(next, own);
#if CAPACITY > 1
        if (any_lane(MASK(own < SAMPLE_NEVER)))
            active->list[kept++] = c;
#endif
    }
#if CAPACITY > 1
    active->count = kept;
#endif
    return max(next, i);
}

// The samples of each ray that lie behind the one at which it has ended.
INLINE integer samples_behind(const struct crossing *crossing, integer i) {
    integer count = (integer)(0);
    for (int c = 0; c < COUNTED(crossing->count); c++) {
        const struct cursor *cursor = &crossing->cursors[c];
#if MIXING == MIXING_ORDERED
        i = cursor->next;
#endif
        count += max(cursor->end - max(cursor->first, i), (integer)(0));
    }
    return count;
}

#endif
