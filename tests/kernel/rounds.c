// rounds.c - the device that leaves loops too early is warned of, and only there and then.
#include "render/rounds.h"

#include <string.h>

#include "support/judge.h"
#include "support/render.h"
#include "support/scenes.h"
#include "support/test.h"

static void count_rounds(const char *message, void *user) {
    if (strstr(message, "ends the loops of a ray after 65535 rounds"))
        ++*(int *)user;
}

// A scene within the limit, one beyond it twice, and within it again.
static void test_warning(void **state) {
    (void)state;
    struct pel_renderer *renderer = judge_renderer(PEL_READER_BUFFER, 1);
    struct pel_scene *scene = scene_create(4, 3);
    struct pel_instance *block =
        scene_add(scene, scene_volume_constant((int[]){6, 6, 6}, PEL_VOXEL_U8, 1),
                  scene_transfer_constant((double[]){1, 1, 1, 0.5}));
    block->material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    static const int expected[] = {0, 1, 1, 1, 2};
    int warnings = 0;
    pel_on_warning(count_rounds, &warnings);
    for (int i = 0; i < 5; i++) {
        bool heavy = i == 1 || i == 2 || i == 4;
        scene->render.step = heavy ? 0.05 : 0.5;
        scene->render.ambient_occlusion =
            (struct pel_ambient_occlusion){.on = heavy, .directions = 64, .step = 1};
        struct pel_render_statistics statistics;
        pel_image_destroy(render_picture(renderer, scene, &statistics));
        bool limited = strstr(statistics.device, "llvmpipe") != NULL;
        assert_int_equal(warnings, limited ? expected[i] : 0);
    }
    pel_on_warning(NULL, NULL);
    pel_scene_destroy(scene);
    pel_renderer_destroy(renderer);
}

// Two volumes in boxes of 30 x 40 x 0 mm, 50 mm across, at steps of 1 mm: 51 samples.
static void test_by_hand(void **state) {
    (void)state;
    static struct pel_world world;
    world = (struct pel_world){.eyes = EYES_ONE, .mixing = MIXING_SUM};
    world.bytes.bounds_high = (float4){30, 40, 0, 0};
    world.bytes.step_mm = 1;
    world.bytes.part_count = 1;
    world.diagonals_mm[0] = world.diagonals_mm[1] = 50;
    assert_float_equal(pel_rounds_most(&world, PEL_SKIP_NONE), 51 + 4, 1e-3);
    assert_float_equal(pel_rounds_most(&world, PEL_SKIP_GRID), 2 * 51 + 4, 1e-3);
    // Each of two asks at each sample, and finds its way.
    world.bytes.part_count = 2;
    assert_float_equal(pel_rounds_most(&world, PEL_SKIP_GRID), 51 + 2 * 51 * 2 + 10, 1e-3);
    // One of them is lit by two lamps, with shadows of 10 mm in steps of 2 mm: 6 samples.
    world.bytes.parts[0].shading = SHADING_PHONG;
    world.bytes.lamp_count = 2;
    world.secondary = SECONDARY_SHADOWS;
    world.bytes.shadow_length_mm = 10;
    world.bytes.shadow_step_mm = 2;
    double shadow = 6 + 6 * (1 + 2 * 1);
    double lit = 51 + 2 * 51 + 51 * (2 + 2 * shadow) + 10;
    assert_float_equal(pel_rounds_most(&world, PEL_SKIP_NONE), lit, 1e-2);
    world.eyes = EYES_MERGED;
    assert_float_equal(pel_rounds_most(&world, PEL_SKIP_NONE), 2 * lit, 1e-2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_warning),
        cmocka_unit_test(test_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
