// memo.c - what a frame keeps of the frame before gives the same tables as none, whatever is
// edited, hidden and shown again in between.
#include "world/memo.h"

#include <math.h>

#include "support/scenes.h"
#include "support/test.h"
#include "world/world.h"

enum { INSTANCES = 5, FRAMES = 60 };

static void build(struct pel_world *world, const struct pel_scene *scene, struct pel_memo *memo) {
    static const struct pel_layout_limits endless = {.memory_bytes = UINT64_MAX,
                                                     .max_allocation_bytes = UINT64_MAX};
    struct pel_layout layout;
    assert_true(pel_layout_plan(&layout, scene, &endless, PEL_READER_BUFFER, PEL_READER_BUFFER));
    assert_true(pel_world_build(world, scene, &layout, memo));
}

static void assert_same(const struct pel_memo_words *a, const struct pel_memo_words *b) {
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->words, b->words, a->count * sizeof *a->words);
}

// Changes something that tables, or where they lie, depend on; often nothing at all.
static void edit(struct pel_scene *scene, uint64_t *seed) {
    struct pel_instance *instance = &scene->instances[(int)(INSTANCES * test_random(seed))];
    switch ((int)(9 * test_random(seed))) {
    case 0:
    case 1:
        instance->hidden = !instance->hidden;
        break;
    case 2:
        instance->transfer->opacities[0].opacity = (float)test_random(seed);
        break;
    case 3:
        instance->model =
            instance->model == PEL_MODEL_ABSORPTION ? PEL_MODEL_MIP : PEL_MODEL_ABSORPTION;
        break;
    case 4:
        scene->render.adaptive_step = scene->render.adaptive_step > 0 ? 0 : 0.01;
        break;
    case 5:
        scene->render.step = 0.25 + test_random(seed);
        break;
    default:
        break;
    }
}

static void test_frames(void **state) {
    (void)state;
    struct pel_scene *scene = scene_create(4, 3);
    uint64_t seed = 11;
    for (int k = 0; k < INSTANCES; k++)
        scene_add(
            scene,
            scene_volume_waves((int[]){4, 4, 4}, k % 2 ? PEL_VOXEL_U8 : PEL_VOXEL_U16, seed + k, 3),
            scene_transfer_constant((double[]){1, 0.5, 0, 0.1 * k}));
    struct pel_memo memo = {0};
    static struct pel_world world, fresh;
    uint64_t version = 0, sent = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        edit(scene, &seed);
        build(&world, scene, &memo);
        struct pel_memo none = {0};
        build(&fresh, scene, &none);
        assert_same(world.tables, fresh.tables);
        assert_same(world.visible, fresh.visible);
        for (int p = 0; p < fresh.bytes.part_count; p++) {
            assert_true(world.bytes.parts[p].seen_from == fresh.bytes.parts[p].seen_from);
            assert_true(world.bytes.parts[p].seen_to == fresh.bytes.parts[p].seen_to);
        }
        pel_memo_finish(&none);
        // Only what is of another version has to be looked at.
        sent += world.tables->version != version;
        version = world.tables->version;
        build(&world, scene, &memo);
        assert_int_equal(world.tables->version, version);
    }
    assert_in_range(sent, FRAMES / 4, FRAMES - 1);
    pel_memo_finish(&memo);
    pel_scene_destroy(scene);
}

static float strength_of(const struct pel_world *world, const struct part *part, int entry) {
    float strength;
    memcpy(&strength, &world->tables->words[part->table + PEL_STRENGTH_WORDS * (size_t)entry],
           sizeof strength);
    return strength;
}

// No entry outside the range that a part is said to show has a strength, and its ends have, but for
// the entry more that interpolation may need before it.
static void test_seen(void **state) {
    (void)state;
    const double opacities[][5] = {
        {0, 0, 0.5, 0, 0}, {0, 0, 0, 0, 0}, {0.5, 0, 0, 0, 0}, {0, 0, 0, 0.1, 0.5},
        {0, 0, 0, 0, 0.5}, {1, 0, 0, 0, 1}, {0, 1, 0, 1, 0},   {0.1, 0.1, 0.1, 0.1, 0.1},
    };
    for (size_t n = 0; n < sizeof opacities / sizeof *opacities; n++) {
        double points[5][5];
        for (int i = 0; i < 5; i++)
            memcpy(points[i], (double[]){20 + 50 * i, 1, 1, 1, opacities[n][i]}, sizeof points[i]);
        struct pel_scene *scene = scene_create(4, 3);
        scene_add(scene, scene_volume_waves((int[]){4, 4, 4}, PEL_VOXEL_U8, n, 3),
                  scene_transfer((const double(*)[5])points, 5));
        struct pel_memo memo = {0};
        static struct pel_world world;
        build(&world, scene, &memo);
        const struct part *part = &world.bytes.parts[0];
        int last = (int)part->table_last;
        int from = isinf(part->seen_from) ? 0 : (int)part->seen_from + 1;
        int to = isinf(part->seen_to) ? last + 1 : (int)part->seen_to;
        bool any = false;
        for (int entry = 0; entry <= last; entry++) {
            bool shows = strength_of(&world, part, entry) > 0;
            any |= shows;
            assert_true(!shows || (from <= entry && entry < to));
        }
        assert_true(any == (from < to));
        assert_true(!any ||
                    (strength_of(&world, part, from) > 0 && strength_of(&world, part, to - 1) > 0));
        // What lies outside the table is shown as its end.
        assert_true(!(strength_of(&world, part, 0) > 0) || part->seen_from == -INFINITY);
        assert_true(!(strength_of(&world, part, last) > 0) || part->seen_to == INFINITY);
        pel_memo_finish(&memo);
        pel_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_frames), cmocka_unit_test(test_seen)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
