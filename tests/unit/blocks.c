// blocks.c - blocks store each sub-block once, know the blocks beside them, and lie in a hierarchy
// with the bins of all below.
#include "accel/blocks.h"
#include "support/test.h"

enum { X = 20, Y = 7, Z = 13, SIDE = 8 };

// Sub-blocks of random bins in some places.
static void fill(uint8_t bins[X * Y * Z], uint64_t seed, double share) {
    for (int i = 0; i < X * Y * Z; i++)
        bins[i] = test_random(&seed) < share ? (uint8_t)(1 + 255 * test_random(&seed)) : 0;
}

static void unpack(const struct block *block, int at[3]) {
    for (int c = 0; c < 3; c++)
        at[c] = (int)(block->place >> c * BLOCK_PLACE_BITS & ((1 << BLOCK_PLACE_BITS) - 1));
}

static int find(const struct pel_blocks *blocks, const int at[3]) {
    for (size_t b = 0; b < blocks->count; b++) {
        int other[3];
        unpack(&blocks->list[b], other);
        if (memcmp(other, at, sizeof other) == 0)
            return (int)b;
    }
    return -1;
}

// What a kernel finds at a sub-block's place: its bins, 0 where none is stored.
static int look_up(const struct pel_blocks *blocks, int x, int y, int z) {
    int number = find(blocks, (int[]){x / BLOCK_SIDE, y / BLOCK_SIDE, z / BLOCK_SIDE});
    if (number < 0)
        return 0;
    const struct block *block = &blocks->list[number];
    int inside = ((z % BLOCK_SIDE) * BLOCK_SIDE + y % BLOCK_SIDE) * BLOCK_SIDE + x % BLOCK_SIDE;
    uint8_t numbers[BLOCK_PLACES];
    memcpy(numbers, block->numbers, sizeof numbers);
    if (numbers[inside] == BLOCK_ABSENT)
        return 0;
    size_t stored = block->first + numbers[inside];
    assert_true(stored < blocks->stored);
    assert_int_equal(blocks->places[stored], (z * Y + y) * X + x);
    return blocks->bins[stored];
}

static void test_look_up(void **state) {
    (void)state;
    static const double shares[] = {0.003, 0.05, 0.5, 1};
    for (int n = 0; n < 4; n++) {
        uint8_t bins[X * Y * Z];
        struct pel_blocks blocks;
        fill(bins, (uint64_t)n + 5, shares[n]);
        assert_true(pel_blocks_build(&blocks, bins, (size_t[]){X, Y, Z}, SIDE, true));
        size_t stored = 0;
        for (int i = 0; i < X * Y * Z; i++) {
            assert_int_equal(look_up(&blocks, i % X, i / X % Y, i / X / Y), bins[i]);
            stored += bins[i] != 0;
        }
        assert_int_equal(blocks.stored, stored);
        pel_blocks_finish(&blocks);
    }
}

static void test_neighbours(void **state) {
    (void)state;
    uint8_t bins[X * Y * Z];
    struct pel_blocks blocks;
    fill(bins, 3, 0.006);
    for (int walk = 0; walk < 2; walk++) {
        assert_true(pel_blocks_build(&blocks, bins, (size_t[]){X, Y, Z}, SIDE, walk));
        assert_in_range(blocks.count, 2, 4 * 2 * 3 - 1);
        for (size_t b = 0; b < blocks.count; b++)
            for (int n = 0; n < 27; n++) {
                int at[3];
                unpack(&blocks.list[b], at);
                for (int c = 0, rest = n; c < 3; c++, rest /= 3)
                    at[c] += rest % 3 - 1;
                int expected = walk || n == 13 ? find(&blocks, at) : -1;
                assert_int_equal(blocks.list[b].beside[n], expected);
            }
        pel_blocks_finish(&blocks);
    }
}

// The bins of the leaves below a node, whose boxes are where their blocks are.
static int walk_nodes(const struct pel_blocks *blocks, size_t n, int *leaves) {
    const struct bvh_node *node = &blocks->nodes[n];
    int bins = 0;
    if (node->link < 0) {
        const struct block *block = &blocks->list[-1 - node->link];
        int at[3], dims[3] = {X, Y, Z};
        unpack(block, at);
        for (int c = 0; c < 3; c++) {
            int end = (at[c] + 1) * BLOCK_SIDE;
            assert_true(node->low[c] == (float)(at[c] * BLOCK_SIDE * SIDE));
            assert_true(node->high[c] == (float)((end < dims[c] ? end : dims[c]) * SIDE));
        }
        bins = (int)block->bins;
        ++*leaves;
    } else {
        bins = walk_nodes(blocks, n + 1, leaves) | walk_nodes(blocks, (size_t)node->link, leaves);
    }
    assert_int_equal(node->axis >> BLOCK_AXIS_BITS, bins);
    assert_in_range(node->axis & 3, 0, 2);
    return bins;
}

static void test_hierarchy(void **state) {
    (void)state;
    uint8_t bins[X * Y * Z];
    struct pel_blocks blocks;
    fill(bins, 9, 0.01);
    assert_true(pel_blocks_build(&blocks, bins, (size_t[]){X, Y, Z}, SIDE, true));
    int all = 0, leaves = 0;
    for (int i = 0; i < X * Y * Z; i++)
        all |= bins[i];
    assert_int_equal(walk_nodes(&blocks, 0, &leaves), all);
    assert_int_equal(leaves, blocks.count);
    pel_blocks_finish(&blocks);
}

static void test_nothing(void **state) {
    (void)state;
    uint8_t bins[X * Y * Z] = {0};
    struct pel_blocks blocks;
    assert_true(pel_blocks_build(&blocks, bins, (size_t[]){X, Y, Z}, SIDE, true));
    assert_int_equal(blocks.count, 0);
    assert_int_equal(blocks.stored, 0);
    assert_null(blocks.nodes);
    pel_blocks_finish(&blocks);
    // A row of more blocks than a place has bits for.
    size_t long_row = ((size_t)BLOCK_SIDE << BLOCK_PLACE_BITS) + 1;
    uint8_t *row = calloc(long_row, 1);
    assert_non_null(row);
    assert_false(pel_blocks_build(&blocks, row, (size_t[]){long_row, 1, 1}, SIDE, true));
    assert_non_null(strstr(pel_error_message(), "1025 blocks"));
    free(row);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_look_up),
        cmocka_unit_test(test_neighbours),
        cmocka_unit_test(test_hierarchy),
        cmocka_unit_test(test_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
