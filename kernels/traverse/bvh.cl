// bvh.cl - skips by a bounding volume hierarchy over clusters of active bricks (Ganter & Manzke
// 2019).
//
// Where a ray is outside all clusters, the hierarchy is searched for the one that it enters next. A
// cursor keeps where its ray leaves the cluster again, and until then there is nothing to search.
// Included by span.cl.
#ifndef BVH_CL
#define BVH_CL

#include "traverse/hierarchy.cl"

// The roots' indices, one of each part, or -1 where nothing is visible, lie before the nodes.
#define BVH_NODES(cells)                                                                           \
    ((__global const struct bvh_node *)((cells) + WORLD_PART_MAX * sizeof(int)))
#define BVH_ROOT(cells, part) ((__global const int *)(cells))[(part)->number]

// The hierarchy of a part, or NULL where nothing is visible. Links count from the part's own first
// node.
INLINE __global const struct bvh_node *part_nodes(__constant struct part *part,
                                                  __global const uchar *cells) {
    const int root = BVH_ROOT(cells, part);
    return root < 0 ? 0 : BVH_NODES(cells) + root;
}

// The next sample from i on that may be visible, in the lanes that ask.
INLINE integer cursor_leap(__constant struct part *part, __global const uchar *cells,
                           struct cursor *cursor, integer i, mask asks) {
    i = max(i, cursor->next);
    const mask runs = MASK(i < cursor->end);
    asks &= runs & MASK(i >= cursor->inside);
    if (!any_lane(asks))
        return CHOOSE((integer)(SAMPLE_NEVER), i, runs);
    const struct leaf cluster = find_leaf(part_nodes(part, cells), 0, cursor, TO_REAL(i), asks);
    const integer enter = leaf_entry(&cluster);
    const integer leave = TO_INTEGER(fmin(cluster.span.far, (real)(1e9f))) + 1;
    const integer next = CHOOSE(i, max(i, enter), asks);
    cursor->inside = CHOOSE(cursor->inside, max(leave, next + 1), asks);
    return CHOOSE((integer)(SAMPLE_NEVER), next, runs & MASK(next < cursor->end));
}

#endif
