// pattern.c - shared/pattern.h: every pattern has the property that gave it its name, for every n,
// and choices look random.
#include "shared/pattern.h"
#include "support/test.h"

#include <math.h>

enum { N_MAX = 8, SIDE = 1 << 24, KEYS = 40 };

// How often each of `count` even cells of a side has been hit.
static void hit(int hits[], u32 place, int count) {
    assert_in_range(place, 0, SIDE - 1);
    hits[(uint64_t)place * (uint64_t)count >> 24]++;
}

static void check_once(const int hits[], int count, const char *what, int n) {
    for (int i = 0; i < count; i++)
        if (hits[i] != 1)
            fail_msg("n = %d: %s %d is hit %d times", n, what, i, hits[i]);
}

static u32 key_number(int i) {
    return pattern_key(7, (u32)i * 5, (u32)i / 3);
}

// Each of n x n cells holds one ray.
static void check_cells(int pattern) {
    for (int n = 1; n <= N_MAX; n++) {
        for (int i = 0; i < KEYS; i++) {
            int hits[PATTERN_RAYS_MAX] = {0};
            for (int s = 0; s < n * n; s++) {
                struct pattern_place place = pattern_place(pattern, (u32)n, key_number(i), (u32)s);
                int column = (int)((uint64_t)place.x * (uint64_t)n >> 24);
                int row = (int)((uint64_t)place.y * (uint64_t)n >> 24);
                hits[row * n + column]++;
            }
            check_once(hits, n * n, "cell", n);
        }
    }
}

// Each of n^2 columns and each of n^2 rows holds one ray.
static void check_rooks(int pattern) {
    for (int n = 1; n <= N_MAX; n++) {
        for (int i = 0; i < KEYS; i++) {
            int columns[PATTERN_RAYS_MAX] = {0}, rows[PATTERN_RAYS_MAX] = {0};
            for (int s = 0; s < n * n; s++) {
                struct pattern_place place = pattern_place(pattern, (u32)n, key_number(i), (u32)s);
                hit(columns, place.x, n * n);
                hit(rows, place.y, n * n);
            }
            check_once(columns, n * n, "column", n);
            check_once(rows, n * n, "row", n);
        }
    }
}

static void test_regular(void **state) {
    (void)state;
    check_cells(PATTERN_REGULAR);
    struct pattern_place place = pattern_place(PATTERN_REGULAR, 1, 1, 0);
    assert_int_equal(place.x, SIDE / 2);
    assert_int_equal(place.y, SIDE / 2);
    place = pattern_place(PATTERN_REGULAR, 4, 1, 6); // the third of the second row
    assert_int_equal(place.x, SIDE / 8 * 5);
    assert_int_equal(place.y, SIDE / 8 * 3);
    // It does not depend on the pixel, jittered does.
    for (int pattern = PATTERN_REGULAR; pattern <= PATTERN_HAMMERSLEY; pattern++) {
        struct pattern_place a = pattern_place(pattern, 4, key_number(1), 6);
        struct pattern_place b = pattern_place(pattern, 4, key_number(2), 6);
        bool fixed = pattern == PATTERN_REGULAR || pattern == PATTERN_HAMMERSLEY;
        assert_int_equal(a.x == b.x && a.y == b.y, fixed);
    }
}

static void test_jittered(void **state) {
    (void)state;
    check_cells(PATTERN_JITTERED);
}

static void test_rooks(void **state) {
    (void)state;
    check_rooks(PATTERN_ROOKS);
}

static void test_multi_jittered(void **state) {
    (void)state;
    check_cells(PATTERN_MULTI_JITTERED);
    check_rooks(PATTERN_MULTI_JITTERED);
}

// One ray in each column; and in each row where n^2 is a power of two, as bits are.
static void test_hammersley(void **state) {
    (void)state;
    for (int n = 1; n <= N_MAX; n++) {
        int columns[PATTERN_RAYS_MAX] = {0}, rows[PATTERN_RAYS_MAX] = {0}, rows_count = 1;
        while (rows_count < n * n)
            rows_count *= 2;
        for (int s = 0; s < n * n; s++) {
            struct pattern_place place = pattern_place(PATTERN_HAMMERSLEY, (u32)n, 5, (u32)s);
            hit(columns, place.x, n * n);
            hit(rows, place.y, rows_count);
        }
        check_once(columns, n * n, "column", n);
        for (int row = 0; row < rows_count; row++)
            assert_in_range(rows[row], n * n == rows_count, 1);
    }
}

// Of 0 .. 7 in binary: 0, .1, .01, .11, .001, .101, .011, .111.
static void test_radical_inverse(void **state) {
    (void)state;
    static const double eighths[] = {0, 4, 2, 6, 1, 5, 3, 7};
    for (u32 s = 0; s < 8; s++)
        assert_float_equal(ldexp(pattern_radical_inverse(s), -24), eighths[s] / 8, 0);
    assert_float_equal(ldexp(pattern_radical_inverse(37), -24), 41 / 64.0, 0); // .101001
    // Four points: half a column, and half a gap of 1/4, further.
    for (u32 s = 0; s < 4; s++) {
        struct pattern_place place = pattern_place(PATTERN_HAMMERSLEY, 2, 9, s);
        assert_float_equal(ldexp(place.x, -24), (s + 0.5) / 4, 0);
        assert_float_equal(ldexp(place.y, -24), eighths[s] / 8 + 0.125, 0);
    }
    struct pattern_place one = pattern_place(PATTERN_HAMMERSLEY, 1, 9, 0);
    assert_int_equal(one.x, SIDE / 2);
    assert_int_equal(one.y, SIDE / 2);
}

// A shuffle is one to one, and over many choices everything goes everywhere equally often.
static void test_shuffle(void **state) {
    (void)state;
    enum { CHOICES = 6400 };
    for (u32 count = 1; count <= PATTERN_RAYS_MAX; count++) {
        static int went[PATTERN_RAYS_MAX][PATTERN_RAYS_MAX];
        memset(went, 0, sizeof went);
        for (u32 choice = 0; choice < CHOICES; choice++) {
            int hits[PATTERN_RAYS_MAX] = {0};
            for (u32 i = 0; i < count; i++) {
                u32 to = pattern_shuffle(i, count, pattern_draw(3, choice));
                assert_true(to < count);
                hits[to]++;
                went[i][to]++;
            }
            check_once(hits, (int)count, "element", (int)count);
        }
        // Six standard deviations of a binomial distribution.
        double expected = CHOICES / (double)count;
        for (u32 i = 0; i < count * count; i++)
            if (fabs(went[i / count][i % count] - expected) > 6 * sqrt(expected) + 1)
                fail_msg("of %u, %u goes to %u %d times in %d", count, i / count, i % count,
                         went[i / count][i % count], CHOICES);
    }
}

// Draws of neighbouring pixels, seeds and numbers: each bit is set half of the time, and changes
// half of the time from one to the next.
static void test_draws_look_random(void **state) {
    (void)state;
    enum { DRAWS = 20000 };
    for (int what = 0; what < 4; what++) {
        int set[32] = {0}, changed[32] = {0};
        u32 before = 0;
        for (u32 i = 0; i < DRAWS; i++) {
            u32 key = pattern_key(what == 0 ? i : 1, what == 1 ? i : 2, what == 2 ? i : 3);
            u32 draw = pattern_draw(key, what == 3 ? i : 4);
            for (int bit = 0; bit < 32; bit++) {
                set[bit] += draw >> bit & 1;
                changed[bit] += (draw ^ before) >> bit & 1;
            }
            before = draw;
        }
        for (int bit = 0; bit < 32; bit++) {
            assert_in_range(set[bit], DRAWS / 2 - 350, DRAWS / 2 + 350); // five deviations
            assert_in_range(changed[bit], DRAWS / 2 - 350, DRAWS / 2 + 350);
        }
    }
}

// A jittered place is spread evenly over its cell.
static void test_jitter_fills_its_cell(void **state) {
    (void)state;
    enum { PIXELS = 10000 };
    double sum = 0, square_sum = 0, product_sum = 0;
    for (u32 pixel = 0; pixel < PIXELS; pixel++) {
        u32 key = pattern_key(0, pixel % 100, pixel / 100);
        struct pattern_place place = pattern_place(PATTERN_JITTERED, 2, key, 0);
        double x = ldexp(place.x, -23) - 0.5, y = ldexp(place.y, -23) - 0.5;
        sum += x;
        square_sum += x * x;
        product_sum += x * y;
    }
    assert_float_equal(sum / PIXELS, 0, 0.015);
    assert_float_equal(square_sum / PIXELS, 1 / 12.0, 0.004);
    assert_float_equal(product_sum / PIXELS, 0, 0.004);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_regular),
        cmocka_unit_test(test_jittered),
        cmocka_unit_test(test_rooks),
        cmocka_unit_test(test_multi_jittered),
        cmocka_unit_test(test_hammersley),
        cmocka_unit_test(test_radical_inverse),
        cmocka_unit_test(test_shuffle),
        cmocka_unit_test(test_draws_look_random),
        cmocka_unit_test(test_jitter_fills_its_cell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
