// hierarchy.cl - the search for the leaf of a bounding volume hierarchy that a ray enters next,
// nearer children first, with one short stack for the packet: a node is entered while some lane may
// find a nearer leaf below it.
//
// Included by span.cl before bvh.cl and blocks.cl.
#ifndef HIERARCHY_CL
#define HIERARCHY_CL

#include "shared/block.h"
#include "traverse/cursor.cl"

#if SKIP == SKIP_BVH || SKIP == SKIP_BLOCKS

// Boxes are widened by this many voxels, so that rounding can only cost another look.
#define BVH_MARGIN 0x1p-6f

// With blocks, a node also says which bins of values there are below it.
#if SKIP == SKIP_BLOCKS
#define NODE_AXIS(node) ((node).axis & ((1 << BLOCK_AXIS_BITS) - 1))
#define NODE_IS_SEEN(node, visible) ((node).axis >> BLOCK_AXIS_BITS & (visible))
#else
#define NODE_AXIS(node) (node).axis
#define NODE_IS_SEEN(node, visible) 1
#endif

// The nearest leaf that a ray is in from some sample on.
struct leaf {
    struct span span; // the stretch in it, in samples; far away where there is none
    integer link;
};

// Where rays enter and leave a node, in samples.
INLINE struct span node_span(__global const struct bvh_node *node, const struct cursor *cursor) {
    struct span span = {(real)(-FLT_MAX), (real)(FLT_MAX)};
    clip_slab(&span, cursor->ox, cursor->dx, node->low[0] - BVH_MARGIN, node->high[0] + BVH_MARGIN);
    clip_slab(&span, cursor->oy, cursor->dy, node->low[1] - BVH_MARGIN, node->high[1] + BVH_MARGIN);
    clip_slab(&span, cursor->oz, cursor->dz, node->low[2] - BVH_MARGIN, node->high[2] + BVH_MARGIN);
    return span;
}

// Searches from sample `from` on, in the lanes that ask. `nodes` may be NULL.
INLINE struct leaf find_leaf(__global const struct bvh_node *nodes, int visible,
                             const struct cursor *cursor, real from, mask asks) {
    struct leaf found = {{(real)(FLT_MAX), (real)(FLT_MAX)}, (integer)(-1)};
    const bool backward[3] = {FIRST_LANE(cursor->dx) < 0.0f, FIRST_LANE(cursor->dy) < 0.0f,
                              FIRST_LANE(cursor->dz) < 0.0f};
    int stack[BVH_DEPTH_MAX + 2];
    int depth = 0;
    if (nodes)
        stack[depth++] = 0;
    while (depth > 0) {
        const int n = stack[--depth];
        if (!NODE_IS_SEEN(nodes[n], visible))
            continue;
        struct span span = node_span(&nodes[n], cursor);
        span.near = fmax(span.near, from);
        const mask nearer = asks & MASK(span.near <= span.far) & MASK(span.near < found.span.near);
        if (!any_lane(nearer))
            continue;
        const int link = nodes[n].link;
        if (link < 0) {
            found.span.near = CHOOSE(found.span.near, span.near, nearer);
            found.span.far = CHOOSE(found.span.far, span.far, nearer);
            found.link = CHOOSE(found.link, (integer)(link), nearer);
        } else {
            const bool right_first = backward[NODE_AXIS(nodes[n])];
            stack[depth++] = right_first ? n + 1 : link;
            stack[depth++] = right_first ? link : n + 1;
        }
    }
    return found;
}

// The first sample at or behind the start of a leaf; a hundredth of a sample of rounding can only
// cost another look.
INLINE integer leaf_entry(const struct leaf *leaf) {
    return TO_INTEGER(ceil(fmin(leaf->span.near, (real)(1e9f)) - 0.01f));
}

#endif
#endif
