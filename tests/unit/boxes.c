// boxes.c - the hierarchy over all parts holds each once, in boxes around all corners of what is
// below them, and takes a large part away from those that lie in it.
#include "world/boxes.h"

#include <math.h>

#include "support/test.h"

// Places part p: the box from 0 to `size`, turned, stretched and moved.
static void place(struct pel_world *world, int p, const double size[3],
                  const struct pel_matrix *matrix) {
    struct part *part = &world->bytes.parts[p];
    part->number = p;
    part->box_low = (float4){0, 0, 0, 0};
    part->box_high = (float4){(float)size[0], (float)size[1], (float)size[2], 0};
    pel_boxes_bound(world, part, matrix);
}

static void assert_holds(const struct bvh_node *node, const struct part *part,
                         const struct pel_matrix *matrix) {
    for (int corner = 0; corner < 8; corner++)
        for (int i = 0; i < 3; i++) {
            double x = matrix->m[i][3];
            x += corner & 1 ? matrix->m[i][0] * (double)part->box_high.x : 0;
            x += corner & 2 ? matrix->m[i][1] * (double)part->box_high.y : 0;
            x += corner & 4 ? matrix->m[i][2] * (double)part->box_high.z : 0;
            assert_true((double)node->low[i] < x && x < (double)node->high[i]);
        }
}

// Walks the nodes below `n`, whose parts each ancestor has to hold; returns the index behind them.
static int walk(const struct pel_world *world, const struct pel_matrix *matrices, int n, int *path,
                int depth, int *found) {
    const struct bvh_node *nodes = world->bytes.nodes;
    int count = world->bytes.part_count;
    assert_in_range(n, 0, 2 * count - 2);
    assert_in_range(depth, 0, count - 1);
    path[depth] = n;
    if (nodes[n].link < 0) {
        int p = -1 - nodes[n].link;
        found[p]++;
        for (int d = 0; d <= depth; d++)
            assert_holds(&nodes[path[d]], &world->bytes.parts[p], &matrices[p]);
        return n + 1;
    }
    int right = walk(world, matrices, n + 1, path, depth + 1, found);
    assert_int_equal(right, nodes[n].link);
    return walk(world, matrices, right, path, depth + 1, found);
}

static void assert_sound(struct pel_world *world, const struct pel_matrix *matrices) {
    int path[WORLD_PART_MAX], found[WORLD_PART_MAX] = {0};
    pel_boxes_join(world);
    assert_int_equal(walk(world, matrices, 0, path, 0, found), 2 * world->bytes.part_count - 1);
    for (int p = 0; p < world->bytes.part_count; p++)
        assert_int_equal(found[p], 1);
}

static struct pel_world *world_of(int count) {
    struct pel_world *world = calloc(1, sizeof *world);
    assert_non_null(world);
    world->bytes.part_count = count;
    return world;
}

static void test_random_parts(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int count = 2; count <= WORLD_PART_MAX; count = count * 3 / 2 + 1) {
        struct pel_world *world = world_of(count);
        struct pel_matrix matrices[WORLD_PART_MAX];
        for (int p = 0; p < count; p++) {
            double far = p % 5 == 0 ? 1e6 : 10;
            for (int i = 0; i < 4; i++)
                for (int j = 0; j < 4; j++)
                    matrices[p].m[i][j] =
                        i == 3 ? j == 3 : (test_random(&seed) - 0.5) * (j == 3 ? far : 2);
            double size[3] = {1 + 9 * test_random(&seed), 1 + 9 * test_random(&seed), 1};
            place(world, p, size, &matrices[p]);
        }
        assert_sound(world, matrices);
        free(world);
    }
}

// All in one place, one in another: as deep as a hierarchy can be.
static void test_nested_parts(void **state) {
    (void)state;
    struct pel_world *world = world_of(WORLD_PART_MAX);
    struct pel_matrix matrices[WORLD_PART_MAX];
    for (int p = 0; p < WORLD_PART_MAX; p++) {
        double side = 1 + p;
        matrices[p] = (struct pel_matrix){
            {{1, 0, 0, -side / 2}, {0, 1, 0, -side / 2}, {0, 0, 1, -side / 2}, {0, 0, 0, 1}}};
        place(world, p, (double[]){side, side, side}, &matrices[p]);
        assert_true(fabs(world->diagonals_mm[p] - sqrt(3) * side) < 1e-9);
    }
    assert_sound(world, matrices);
    free(world);
}

// A large block around others that share its middle is by itself, so that the others are asked
// only by rays that come to them.
static void test_block_around_others(void **state) {
    (void)state;
    enum { COUNT = 32, BLOCK = 7 };
    struct pel_world *world = world_of(COUNT);
    struct pel_matrix matrices[COUNT];
    for (int p = 0; p < COUNT; p++) {
        double side = p == BLOCK ? 3 : 2, angle = p == BLOCK ? 0 : 0.2 * p;
        double c = cos(angle), s = sin(angle), half = side / 2;
        matrices[p] = (struct pel_matrix){{{c, 0, -s, half * (s - c)},
                                           {0, 1, 0, -half},
                                           {s, 0, c, half * (-s - c)},
                                           {0, 0, 0, 1}}};
        place(world, p, (double[]){side, side, side}, &matrices[p]);
    }
    assert_sound(world, matrices);
    const struct bvh_node *nodes = world->bytes.nodes;
    assert_true(nodes[1].link == -1 - BLOCK || nodes[nodes[0].link].link == -1 - BLOCK);
    free(world);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_parts),
        cmocka_unit_test(test_nested_parts),
        cmocka_unit_test(test_block_around_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
