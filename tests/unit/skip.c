// skip.c - the rule by which `auto` picks a way to skip, and the facts that it goes by.
#include "support/scenes.h"
#include "support/test.h"
#include "world/skip.h"

static void test_rule(void **state) {
    (void)state;
    static const struct {
        struct pel_skip_facts facts;
        enum pel_skip skip;
        const char *reason;
    } cases[] = {
        {{.voxels = 1 << 24, .visible = 0.3}, PEL_SKIP_DISTANCE, "30 % of the voxels"},
        {{.voxels = 1 << 24, .visible = 0.95}, PEL_SKIP_DISTANCE, "95 % of the voxels"},
        {{.voxels = 1 << 24, .visible = 0.96}, PEL_SKIP_NONE, "96 % of the voxels"},
        {{.voxels = 8191, .visible = 0.1}, PEL_SKIP_NONE, "8191 voxels are too few"},
        {{.voxels = 8192, .visible = 0.1}, PEL_SKIP_DISTANCE, "10 % of the voxels"},
        {{.voxels = 1 << 24, .visible = 0.1, .nothing = true}, PEL_SKIP_NONE, "every sample"},
        {{.voxels = 1 << 24, .visible = 1, .counts = true}, PEL_SKIP_BVH, "the debug view"},
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        char reason[PEL_SKIP_REASON_BYTES];
        assert_int_equal(pel_skip_choose(&cases[n].facts, reason), cases[n].skip);
        if (!strstr(reason, cases[n].reason))
            fail_msg("case %zu: '%s'", n, reason);
    }
}

// A quarter of the voxels is 0, a quarter 1, a quarter 100 and a quarter 200.
static double quarters(const double p[3], const void *user) {
    static const double values[] = {0, 1, 100, 200};
    (void)user;
    return values[(int)p[2] % 4];
}

// The share of voxels that can be seen, in percent, when values above an edge are.
static double share(enum pel_voxel_type type, double edge, void (*change)(struct pel_scene *)) {
    struct pel_scene *scene = scene_create(8, 8);
    struct pel_volume *volume = scene_volume((int[]){24, 24, 16}, type, quarters, NULL);
    scene_add(scene, volume,
              scene_transfer((const double[][5]){{edge, 1, 1, 1, 0},
                                                 {edge + 0.5, 1, 1, 1, 0.5},
                                                 {255, 1, 1, 1, 0.5}},
                             3));
    scene_view_parallel(scene, 20);
    if (change)
        change(scene);
    enum pel_skip skip;
    char reason[PEL_SKIP_REASON_BYTES];
    if (!pel_scene_choose_skip(scene, &skip, reason))
        fail_msg("%s", pel_error_message());
    double percent = strtod(reason, NULL);
    assert_int_equal(skip, percent > 95 ? PEL_SKIP_NONE : PEL_SKIP_DISTANCE);
    pel_scene_destroy(scene);
    return percent;
}

static void hide_nothing(struct pel_scene *scene) {
    scene->instances[0].transfer->opacities[0].opacity = 0.1;
}

static void clip(struct pel_scene *scene) {
    scene->instances[0].clip_count = 1;
    scene->instances[0].clips[0] = (struct pel_clip){.normal = {1, 0, 0}};
}

static void test_share(void **state) {
    (void)state;
    static const enum pel_voxel_type types[] = {PEL_VOXEL_U8, PEL_VOXEL_U16, PEL_VOXEL_F32};
    for (int n = 0; n < 3; n++) {
        // Air is exactly 0 and stays air, however little lies above it.
        assert_true(share(types[n], 0, NULL) == 75);
        assert_true(share(types[n], 50, NULL) == 50);
        assert_true(share(types[n], 150, NULL) == 25);
        assert_true(share(types[n], 230, NULL) == 0);
        assert_true(share(types[n], 0, hide_nothing) == 100);
        // What is cut away is not known from values.
        assert_true(share(types[n], 0, clip) == 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rule),
        cmocka_unit_test(test_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
