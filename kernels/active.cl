// active.cl - which parts of a crossing take part in a packet's present samples.
//
// The cost of a sample follows this list, so a part joins it when the first of the rays comes to
// it, and leaves it when the last has seen what there is. A ray that has not yet come to a part of
// the list, or has left it, takes no sample there; asking costs less than a list of each ray's own,
// which would change at every few samples. Included by span.cl.
#ifndef ACTIVE_CL
#define ACTIVE_CL

// It lasts until some ray reaches the sample `until`, where the next part begins.
struct active {
    int list[CAPACITY]; // indices into the crossing, ascending
    int count;
    int joined; // parts that have been in the list
    integer until;
};

#if CAPACITY > 1
// Adds the parts whose first ray is at or before its sample i.
INLINE void join_active(__constant struct world *world, __global const uchar *cells,
                        struct active *active, struct crossing *crossing, integer i, mask alive) {
    active->until = (integer)(SAMPLE_NEVER);
    for (; active->joined < crossing->count; active->joined++) {
        active->until = (integer)(crossing->entries[active->joined]);
        if (!any_lane(alive & MASK(i >= active->until)))
            return;
        active->until = (integer)(SAMPLE_NEVER);
        const int c = crossing->order[active->joined];
#if LATE_CURSORS
        struct cursor *cursor = &crossing->cursors[c];
        cursor->next = cursor_leap(&world->parts[crossing->parts[c]], cells, cursor, cursor->first,
                                   (mask)(-1));
        if (!any_lane(MASK(cursor->next < cursor->end)))
            continue;
#endif
        int place = active->count++;
        for (; place > 0 && active->list[place - 1] > c; place--)
            active->list[place] = active->list[place - 1];
        active->list[place] = c;
    }
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
