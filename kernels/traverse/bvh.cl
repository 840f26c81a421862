// bvh.cl - skips by a bounding volume hierarchy over clusters of active bricks (Ganter & Manzke
// 2019).
//
// Where a ray is outside all clusters, the hierarchy is searched for the one that it enters next,
// nearer children first, with one short stack for the packet: a node is entered while some lane may
// find a nearer cluster below it. A cursor keeps where its ray leaves the cluster again, and until
// then there is nothing to search.
// Included by span.cl.
#ifndef BVH_CL
#define BVH_CL

#include "shared/bvh.h"
#include "traverse/cursor.cl"

// The roots' indices, one of each part, or -1 where nothing is visible, lie before the nodes.
#define BVH_NODES(cells)                                                                           \
    ((__global const struct bvh_node *)((cells) + WORLD_PART_MAX * sizeof(int)))
#define BVH_ROOT(cells, part) ((__global const int *)(cells))[(part)->number]

// Boxes are widened by this many voxels, so that rounding can only cost another look.
#define BVH_MARGIN 0x1p-6f

#if LANES == 1
#define FIRST_LANE(v) (v)
#else
#define FIRST_LANE(v) (v).s0
#endif

// Where rays enter and leave a node, in samples.
INLINE struct span node_span(__global const struct bvh_node *node, const struct cursor *cursor) {
    struct span span = {(real)(-FLT_MAX), (real)(FLT_MAX)};
    clip_slab(&span, cursor->ox, cursor->dx, node->low[0] - BVH_MARGIN, node->high[0] + BVH_MARGIN);
    clip_slab(&span, cursor->oy, cursor->dy, node->low[1] - BVH_MARGIN, node->high[1] + BVH_MARGIN);
    clip_slab(&span, cursor->oz, cursor->dz, node->low[2] - BVH_MARGIN, node->high[2] + BVH_MARGIN);
    return span;
}

// The stretch of the nearest cluster that a ray is in from sample `from` on, in the lanes that ask;
// elsewhere, and where there is none, it is empty and far away.
INLINE struct span find_cluster(__constant struct part *part, __global const uchar *cells,
                                const struct cursor *cursor, real from, mask asks) {
    // Links count from the part's own first node.
    const int root = BVH_ROOT(cells, part);
    __global const struct bvh_node *nodes = BVH_NODES(cells) + max(root, 0);
    struct span found = {(real)(FLT_MAX), (real)(FLT_MAX)};
    const bool backward[3] = {FIRST_LANE(cursor->dx) < 0.0f, FIRST_LANE(cursor->dy) < 0.0f,
                              FIRST_LANE(cursor->dz) < 0.0f};
    int stack[BVH_DEPTH_MAX + 2];
    int depth = 0;
    if (root >= 0)
        stack[depth++] = 0;
    while (depth > 0) {
        const int n = stack[--depth];
        struct span span = node_span(&nodes[n], cursor);
        span.near = fmax(span.near, from);
        const mask nearer = asks & MASK(span.near <= span.far) & MASK(span.near < found.near);
        if (!any_lane(nearer))
            continue;
        const int link = nodes[n].link;
        if (link < 0) {
            found.near = CHOOSE(found.near, span.near, nearer);
            found.far = CHOOSE(found.far, span.far, nearer);
        } else {
            const bool right_first = backward[nodes[n].axis];
            stack[depth++] = right_first ? n + 1 : link;
            stack[depth++] = right_first ? link : n + 1;
        }
    }
    return found;
}

// The next sample from i on that may be visible.
INLINE integer cursor_leap(__constant struct part *part, __global const uchar *cells,
                           struct cursor *cursor, integer i) {
    i = max(i, cursor->next);
    const mask runs = MASK(i < cursor->end), asks = runs & MASK(i >= cursor->inside);
    if (!any_lane(asks))
        return CHOOSE((integer)(SAMPLE_NEVER), i, runs);
    const struct span span = find_cluster(part, cells, cursor, TO_REAL(i), asks);
    // A hundredth of a sample of rounding can only cost another look.
    const integer enter = TO_INTEGER(ceil(fmin(span.near, (real)(1e9f)) - 0.01f));
    const integer leave = TO_INTEGER(fmin(span.far, (real)(1e9f))) + 1;
    const integer next = CHOOSE(i, max(i, enter), asks);
    cursor->inside = CHOOSE(cursor->inside, max(leave, next + 1), asks);
    return CHOOSE((integer)(SAMPLE_NEVER), next, runs & MASK(next < cursor->end));
}

#endif
