// ahead.cl - what a packet of rays has not come to yet, the nearest last.
//
// These are parts whose cursors wait at their first samples, and nodes of the hierarchy over all
// parts that are not yet looked into (boxes.cl): what lies below one is asked only when some ray,
// with what it has met so far, comes to the node's box. So parts behind something opaque cost
// nothing. There are never more of them than parts. Included by span.cl.
#ifndef AHEAD_CL
#define AHEAD_CL

struct ahead {
    int count;
    int entries[CAPACITY]; // the samples at which the first of the rays comes there, descending
    int links[CAPACITY];   // of a node: its index; of a cursor: -1 minus its index in the crossing
};

INLINE void put_ahead(struct ahead *ahead, int entry, int link) {
    int place = ahead->count++;
    for (; place > 0 && ahead->entries[place - 1] < entry; place--) {
        ahead->entries[place] = ahead->entries[place - 1];
        ahead->links[place] = ahead->links[place - 1];
    }
    ahead->entries[place] = entry;
    ahead->links[place] = link;
}

#endif
