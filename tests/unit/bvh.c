// bvh.c - a hierarchy holds every box once, in the boxes of all nodes above it, and is not too
// deep.
#include "accel/bvh.h"
#include "support/test.h"

// Walks the nodes below `n` and returns the index behind the last of them.
static size_t walk(const struct bvh_node *nodes, const struct pel_box *boxes, size_t count,
                   size_t n, int depth, int *found) {
    assert_true(n < 2 * count - 1);
    assert_true(depth <= BVH_DEPTH_MAX);
    const struct bvh_node *node = &nodes[n];
    if (node->link < 0) {
        int box = -1 - node->link;
        found[box]++;
        assert_memory_equal(node->low, boxes[box].low, sizeof node->low);
        assert_memory_equal(node->high, boxes[box].high, sizeof node->high);
        return n + 1;
    }
    const struct bvh_node *children[] = {node + 1, &nodes[node->link]};
    for (int i = 0; i < 2; i++)
        for (int c = 0; c < 3; c++) {
            assert_true(children[i]->low[c] >= node->low[c]);
            assert_true(children[i]->high[c] <= node->high[c]);
        }
    size_t right = walk(nodes, boxes, count, n + 1, depth + 1, found);
    assert_int_equal(right, node->link);
    return walk(nodes, boxes, count, right, depth + 1, found);
}

static void assert_sound(const struct pel_box *boxes, size_t count) {
    struct bvh_node *nodes = calloc(2 * count - 1, sizeof *nodes);
    int *found = calloc(count, sizeof *found);
    assert_non_null(nodes);
    assert_non_null(found);
    assert_true(pel_bvh_build(nodes, boxes, count));
    assert_int_equal(walk(nodes, boxes, count, 0, 0, found), 2 * count - 1);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(found[i], 1);
    free(nodes);
    free(found);
}

static void test_random_boxes(void **state) {
    (void)state;
    enum { MOST = 700 };
    uint64_t seed = 3;
    for (size_t count = 1; count <= MOST; count = count * 3 / 2 + 1) {
        struct pel_box boxes[MOST];
        for (size_t i = 0; i < count; i++)
            for (int c = 0; c < 3; c++) {
                boxes[i].low[c] = (float)(1000 * test_random(&seed));
                boxes[i].high[c] = boxes[i].low[c] + (float)(100 * test_random(&seed));
            }
        assert_sound(boxes, count);
    }
}

// The surface-area heuristic alone would peel off one box after the other.
static void test_hostile_boxes(void **state) {
    (void)state;
    enum { COUNT = 120 };
    struct pel_box boxes[COUNT];
    for (int i = 0; i < COUNT; i++)
        for (int c = 0; c < 3; c++) {
            boxes[i].low[c] = i ? boxes[i - 1].low[c] * 1.9F : 1e-2F;
            boxes[i].high[c] = boxes[i].low[c];
        }
    assert_sound(boxes, COUNT);
    for (int i = 0; i < COUNT; i++)
        boxes[i] = boxes[0];
    assert_sound(boxes, COUNT);
}

// Two groups far apart are split between them.
static void test_split(void **state) {
    (void)state;
    struct pel_box boxes[6];
    for (int i = 0; i < 6; i++) {
        float x = (float)(i % 2 ? 100 + i : i);
        boxes[i] = (struct pel_box){{x, 0, 0}, {x + 1, 1, 1}};
    }
    struct bvh_node nodes[11];
    assert_true(pel_bvh_build(nodes, boxes, 6));
    assert_int_equal(nodes[0].axis, 0);
    assert_true(nodes[1].high[0] == 5);
    assert_true(nodes[nodes[0].link].low[0] == 101);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_boxes),
        cmocka_unit_test(test_hostile_boxes),
        cmocka_unit_test(test_split),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
