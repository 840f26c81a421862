// bvh.c - a bounding volume hierarchy by the surface-area heuristic.
//
// Built from the root down (Wald 2007): along each axis boxes are sorted by their middles into a
// few bins, and of the planes between bins the one is taken for which count times surface, summed
// over both sides, is least. Where that would make the tree too deep, boxes are halved by number
// instead. The few boxes of whole parts get a hierarchy with more care: world/boxes.c.
#include "accel/bvh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"

enum { BINS = 16 };

struct builder {
    const struct pel_box *boxes;
    size_t *order; // numbers of the boxes; those below one node are neighbours
    struct bvh_node *nodes;
    size_t node_count;
};

// Where a node is split: boxes whose middle lies before `bin` of `axis` go left.
struct split {
    int axis, bin;
    double cost;
};

static const struct pel_box nothing = {{INFINITY, INFINITY, INFINITY},
                                       {-INFINITY, -INFINITY, -INFINITY}};

static float middle(const struct pel_box *box, int axis) {
    return 0.5F * box->low[axis] + 0.5F * box->high[axis];
}

// The boxes around `count` boxes from `first` on, and around their middles.
static void bound(const struct builder *builder, size_t first, size_t count, struct pel_box *whole,
                  struct pel_box *middles) {
    *whole = *middles = nothing;
    for (size_t i = first; i < first + count; i++) {
        const struct pel_box *box = &builder->boxes[builder->order[i]];
        struct pel_box point;
        for (int c = 0; c < 3; c++)
            point.low[c] = point.high[c] = middle(box, c);
        pel_box_widen(whole, box);
        pel_box_widen(middles, &point);
    }
}

static int bin_of(const struct pel_box *box, const struct pel_box *middles, int axis) {
    float span = middles->high[axis] - middles->low[axis];
    int bin = (int)((middle(box, axis) - middles->low[axis]) / span * BINS);
    return bin < BINS ? bin : BINS - 1;
}

// The best split along one axis, of boxes whose middles do not all coincide there.
static struct split split_along(const struct builder *builder, size_t first, size_t count,
                                const struct pel_box *middles, int axis) {
    struct pel_box bins[BINS];
    size_t counts[BINS] = {0};
    for (int b = 0; b < BINS; b++)
        bins[b] = nothing;
    for (size_t i = first; i < first + count; i++) {
        const struct pel_box *box = &builder->boxes[builder->order[i]];
        int b = bin_of(box, middles, axis);
        pel_box_widen(&bins[b], box);
        counts[b]++;
    }
    double left_costs[BINS];
    struct pel_box side = nothing;
    size_t sum = 0;
    for (int b = 0; b < BINS - 1; b++) {
        pel_box_widen(&side, &bins[b]);
        sum += counts[b];
        left_costs[b + 1] = sum ? (double)sum * pel_box_area(&side) : INFINITY;
    }
    struct split best = {axis, 0, INFINITY};
    side = nothing;
    sum = 0;
    for (int b = BINS - 1; b > 0; b--) {
        pel_box_widen(&side, &bins[b]);
        sum += counts[b];
        double cost = sum ? (double)sum * pel_box_area(&side) + left_costs[b] : INFINITY;
        if (cost < best.cost)
            best = (struct split){axis, b, cost};
    }
    return best;
}

// Moves the boxes that go left before the others; returns how many there are.
static size_t partition(struct builder *builder, size_t first, size_t count,
                        const struct pel_box *middles, const struct split *split) {
    size_t left = first;
    for (size_t i = first; i < first + count; i++) {
        size_t box = builder->order[i];
        if (bin_of(&builder->boxes[box], middles, split->axis) >= split->bin)
            continue;
        builder->order[i] = builder->order[left];
        builder->order[left++] = box;
    }
    return left - first;
}

// Moves the half of the boxes with the lesser middles along `axis` before the others (Hoare's
// selection, as Wirth 1976 has it).
static void halve(struct builder *builder, size_t first, size_t count, int axis) {
    ptrdiff_t low = (ptrdiff_t)first, high = (ptrdiff_t)(first + count) - 1;
    ptrdiff_t wanted = (ptrdiff_t)(first + count / 2);
    size_t *order = builder->order;
    while (low < high) {
        float pivot = middle(&builder->boxes[order[wanted]], axis);
        ptrdiff_t i = low, j = high;
        do {
            while (middle(&builder->boxes[order[i]], axis) < pivot)
                i++;
            while (middle(&builder->boxes[order[j]], axis) > pivot)
                j--;
            if (i <= j) {
                size_t swapped = order[i];
                order[i++] = order[j];
                order[j--] = swapped;
            }
        } while (i <= j);
        if (j < wanted)
            low = i;
        if (wanted < i)
            high = j;
    }
}

// Orders the boxes below a node into those of its left and of its right child; returns how many
// there are in the left one, and along which axis they lie.
static size_t divide(struct builder *builder, size_t first, size_t count, int depth,
                     const struct pel_box *middles, int *axis) {
    struct split best = {0, 0, INFINITY};
    int longest = 0;
    for (int c = 0; c < 3; c++) {
        float span = middles->high[c] - middles->low[c];
        if (span > middles->high[longest] - middles->low[longest])
            longest = c;
        // There is one way to part two.
        if (!(span > 0) || count == 2)
            continue;
        struct split split = split_along(builder, first, count, middles, c);
        if (split.cost < best.cost)
            best = split;
    }
    // A balanced tree over either side must still fit below.
    size_t most = (size_t)1 << (BVH_DEPTH_MAX - depth - 1);
    if (isfinite(best.cost)) {
        size_t left = partition(builder, first, count, middles, &best);
        *axis = best.axis;
        if (left > 0 && left < count && left <= most && count - left <= most)
            return left;
    }
    *axis = longest;
    halve(builder, first, count, longest);
    return count / 2;
}

// Appends the nodes over `count` boxes from `first` on. It calls itself no deeper than the tree is.
static void grow(struct builder *builder, size_t first, size_t count, int depth) {
    struct pel_box whole, middles;
    bound(builder, first, count, &whole, &middles);
    struct bvh_node *node = &builder->nodes[builder->node_count++];
    memcpy(node->low, whole.low, sizeof node->low);
    memcpy(node->high, whole.high, sizeof node->high);
    node->axis = 0;
    if (count == 1) {
        node->link = -1 - (i32)builder->order[first];
        return;
    }
    size_t left = divide(builder, first, count, depth, &middles, &node->axis);
    grow(builder, first, left, depth + 1);
    node->link = (i32)builder->node_count;
    grow(builder, first + left, count - left, depth + 1);
}

bool pel_bvh_build(struct bvh_node *nodes, const struct pel_box *boxes, size_t count) {
    if (count > PEL_BVH_BOXES)
        return pel_fail(PEL_ERROR_MEMORY, "%zu boxes, a hierarchy takes %zu", count, PEL_BVH_BOXES);
    struct builder builder = {boxes, pel_allocate(count, sizeof(size_t)), nodes, 0};
    if (!builder.order)
        return false;
    for (size_t i = 0; i < count; i++)
        builder.order[i] = i;
    grow(&builder, 0, count, 0);
    free(builder.order);
    return true;
}
