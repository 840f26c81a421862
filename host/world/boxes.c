// boxes.c - a hierarchy over the boxes of all parts, by which rays find those that they cross.
//
// It does not depend on the camera, so only a pose that changes sends it again. kernels/boxes.cl
// walks it. A part's box along the world's axes holds its oriented one and what rounding may add,
// there and where rays are turned into the part's own space.
#include "world/boxes.h"

#include <math.h>
#include <string.h>

#include "base/math.h"

// What is added on all sides, as a share of the farthest coordinate.
static const double margin = 1e-5;

// The world's place of a corner of a part: bit j tells which end along axis j.
static void find_corner(double place[3], const struct part *part, int corner,
                        const struct pel_matrix *world_from_voxel) {
    const double low[3] = {part->box_low.x, part->box_low.y, part->box_low.z};
    const double high[3] = {part->box_high.x, part->box_high.y, part->box_high.z};
    for (int i = 0; i < 3; i++) {
        place[i] = world_from_voxel->m[i][3];
        for (int j = 0; j < 3; j++)
            place[i] += world_from_voxel->m[i][j] * (corner >> j & 1 ? high[j] : low[j]);
    }
}

void pel_boxes_bound(struct pel_world *world, const struct part *part,
                     const struct pel_matrix *world_from_voxel) {
    double low[3], high[3], diagonal = 0, farthest = 0;
    for (int corner = 0; corner < 8; corner++) {
        double place[3], other[3];
        find_corner(place, part, corner, world_from_voxel);
        find_corner(other, part, 7 - corner, world_from_voxel);
        for (int i = 0; i < 3; i++) {
            low[i] = corner ? fmin(low[i], place[i]) : place[i];
            high[i] = corner ? fmax(high[i], place[i]) : place[i];
            farthest = fmax(farthest, fabs(place[i]));
            other[i] -= place[i];
        }
        diagonal = fmax(diagonal, pel_length(other));
    }
    for (int i = 0; i < 3; i++) {
        world->boxes[part->number].low[i] = (float)(low[i] - margin * farthest);
        world->boxes[part->number].high[i] = (float)(high[i] + margin * farthest);
    }
    world->diagonals_mm[part->number] = diagonal;
}

// ---- The hierarchy -----------------------------------------------------------------------------

// A row of boxes is cut in two where that is likely to cost rays the least (the surface area
// heuristic, MacDonald & Booth 1990). Rows go by the boxes' lower and upper sides rather than by
// their middles, because volumes often share one: then a large one comes apart from those in it.
// All cuts of all six rows are tried, which takes too long for the many bricks of accel/bvh.c: that
// one sorts middles into a few bins.

// Where a box stands in the row of one of six directions.
static float side_of(const struct pel_box *box, int direction) {
    return direction < 3 ? box->low[direction] : box->high[direction - 3];
}

static void sort(int *row, int count, const struct pel_box *boxes, int direction) {
    for (int i = 1; i < count; i++) {
        int moved = row[i], place = i;
        float side = side_of(&boxes[moved], direction);
        for (; place > 0 && side_of(&boxes[row[place - 1]], direction) > side; place--)
            row[place] = row[place - 1];
        row[place] = moved;
    }
}

// The cheapest cut of a row: the first ones come to the left. *cost is lowered to its cost, or
// what it returns is 0.
static int cut_row(const int *row, int count, const struct pel_box *boxes, double *cost) {
    double left[WORLD_PART_MAX];
    struct pel_box joined = boxes[row[0]];
    for (int i = 0; i < count; i++) {
        pel_box_widen(&joined, &boxes[row[i]]);
        left[i] = pel_box_area(&joined) * (i + 1);
    }
    int best = 0;
    joined = boxes[row[count - 1]];
    for (int i = count - 1; i > 0; i--) {
        pel_box_widen(&joined, &boxes[row[i]]);
        double both = left[i - 1] + pel_box_area(&joined) * (count - i);
        if (both < *cost) {
            *cost = both;
            best = i;
        }
    }
    return best;
}

// Writes the nodes over the boxes of a row and returns how many. It calls itself no deeper than
// there are parts.
static int grow(struct bvh_node *nodes, int first, const struct pel_box *boxes, int *row,
                int count) {
    struct bvh_node *node = &nodes[first];
    struct pel_box whole = boxes[row[0]];
    for (int i = 1; i < count; i++)
        pel_box_widen(&whole, &boxes[row[i]]);
    *node = (struct bvh_node){.link = -1 - row[0]};
    memcpy(node->low, whole.low, sizeof node->low);
    memcpy(node->high, whole.high, sizeof node->high);
    if (count == 1)
        return 1;
    double cost = INFINITY;
    int left = 1, cut_row_of = 0;
    for (int direction = 0; direction < 6; direction++) {
        sort(row, count, boxes, direction);
        int cut = cut_row(row, count, boxes, &cost);
        if (cut > 0) {
            left = cut;
            cut_row_of = direction;
        }
    }
    sort(row, count, boxes, cut_row_of);
    int below = grow(nodes, first + 1, boxes, row, left);
    node->link = first + 1 + below;
    return 1 + below + grow(nodes, node->link, boxes, row + left, count - left);
}

void pel_boxes_join(struct pel_world *world) {
    int row[WORLD_PART_MAX], count = world->bytes.part_count;
    for (int p = 0; p < count; p++)
        row[p] = p;
    if (count > 1)
        grow(world->bytes.nodes, 0, world->boxes, row, count);
}
