// tiles.c - shared/tiles.h: every tile comes once, from the border inwards, beside the one before.
#include "shared/tiles.h"
#include "support/test.h"

#include <stdlib.h>

static int ring_of(struct tile_place tile, int columns, int rows) {
    int x = tile.x < columns - 1 - tile.x ? tile.x : columns - 1 - tile.x;
    int y = tile.y < rows - 1 - tile.y ? tile.y : rows - 1 - tile.y;
    return x < y ? x : y;
}

static void check_order(int columns, int rows) {
    bool seen[9][9] = {{false}};
    struct tile_place last = {0, -1};
    for (int n = 0; n < columns * rows; n++) {
        struct tile_place tile = tile_at((uint32_t)n, columns, rows);
        assert_in_range(tile.x, 0, columns - 1);
        assert_in_range(tile.y, 0, rows - 1);
        assert_false(seen[tile.y][tile.x]);
        seen[tile.y][tile.x] = true;
        if (n > 0)
            assert_true(ring_of(tile, columns, rows) >= ring_of(last, columns, rows));
        assert_true(abs(tile.x - last.x) + abs(tile.y - last.y) == 1);
        last = tile;
    }
}

static void test_every_tile_comes_once(void **state) {
    (void)state;
    for (int columns = 1; columns <= 9; columns++)
        for (int rows = 1; rows <= 9; rows++)
            check_order(columns, rows);
}

static void test_rings_run_clockwise(void **state) {
    (void)state;
    static const int order[3][4] = {{0, 1, 2, 3}, {9, 10, 11, 4}, {8, 7, 6, 5}};
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 4; x++) {
            struct tile_place tile = tile_at((uint32_t)order[y][x], 4, 3);
            assert_int_equal(tile.x, x);
            assert_int_equal(tile.y, y);
        }
}

static void test_others_lie_below_the_picture(void **state) {
    (void)state;
    assert_int_equal(tile_at(12, 4, 3).y, 3);
    assert_int_equal(tile_at(UINT32_MAX, 4, 3).y, 3);
    assert_int_equal(tile_at(1, 1, 1).y, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_tile_comes_once),
        cmocka_unit_test(test_rings_run_clockwise),
        cmocka_unit_test(test_others_lie_below_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
