// cluster.c - clusters cover the active bricks, each once, and nothing else.
#include "accel/cluster.h"
#include "support/test.h"

enum { MOST = 24 };

static void assert_covers(const struct pel_clusters *clusters, const uint8_t *active,
                          const size_t dims[3]) {
    uint8_t covered[MOST * MOST * MOST] = {0};
    size_t count = dims[0] * dims[1] * dims[2];
    for (size_t n = 0; n < clusters->count; n++) {
        const struct pel_cluster *cluster = &clusters->list[n];
        for (uint32_t z = 0; z < cluster->size; z++)
            for (uint32_t y = 0; y < cluster->size; y++)
                for (uint32_t x = 0; x < cluster->size; x++) {
                    size_t at[3] = {cluster->low[0] + x, cluster->low[1] + y, cluster->low[2] + z};
                    for (int c = 0; c < 3; c++)
                        assert_true(at[c] < dims[c]);
                    covered[(at[2] * dims[1] + at[1]) * dims[0] + at[0]]++;
                }
    }
    for (size_t i = 0; i < count; i++)
        assert_int_equal(covered[i], active[i] != 0);
}

static struct pel_clusters find(const uint8_t *active, const size_t dims[3], uint32_t largest) {
    struct pel_clusters clusters;
    assert_true(pel_clusters_find(&clusters, active, dims, largest));
    assert_covers(&clusters, active, dims);
    return clusters;
}

static void test_random_bricks(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int round = 0; round < 30; round++) {
        uint8_t active[MOST * MOST * MOST];
        size_t dims[3], count = 1, active_count = 0;
        for (int c = 0; c < 3; c++)
            count *= dims[c] = 1 + (size_t)(test_random(&seed) * (MOST - 1));
        double share = test_random(&seed) * test_random(&seed);
        for (size_t i = 0; i < count; i++)
            active_count += active[i] = test_random(&seed) > share;
        struct pel_clusters clusters = find(active, dims, 16);
        assert_true(clusters.count <= active_count);
        pel_clusters_finish(&clusters);
        clusters = find(active, dims, 1);
        assert_int_equal(clusters.count, active_count);
        pel_clusters_finish(&clusters);
    }
}

// A box of 8 x 4 x 4 active bricks is two cubes of 4, with 8 single ones on top.
static void test_known_clusters(void **state) {
    (void)state;
    const size_t dims[3] = {8, 5, 4};
    uint8_t active[8 * 5 * 4] = {0};
    for (size_t z = 0; z < 4; z++)
        for (size_t y = 0; y < (z == 0 ? 5 : 4); y++)
            memset(active + (z * 5 + y) * 8, 1, 8);
    struct pel_clusters clusters = find(active, dims, 16);
    assert_int_equal(clusters.count, 10);
    assert_int_equal(clusters.list[0].size, 4);
    assert_int_equal(clusters.list[1].size, 4);
    assert_int_equal(clusters.list[1].low[0], 4);
    assert_int_equal(clusters.list[2].size, 1);
    pel_clusters_finish(&clusters);

    clusters = find(active, dims, 2);
    assert_int_equal(clusters.count, 16 + 8);
    pel_clusters_finish(&clusters);

    memset(active, 0, sizeof active);
    clusters = find(active, dims, 16);
    assert_int_equal(clusters.count, 0);
    pel_clusters_finish(&clusters);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_bricks),
        cmocka_unit_test(test_known_clusters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
