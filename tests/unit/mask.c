// mask.c - masks of a scene in memory: their values as text, and volumes that change places.
#include <math.h>

#include "support/scenes.h"
#include "support/test.h"

static void expect_text(const char *typed, const char *expected) {
    char text[256];
    struct pel_mask mask = {0};
    if (!pel_mask_read_values(&mask, typed))
        fail_msg("'%s': %s", typed, pel_error_message());
    pel_mask_write_values(&mask, text, sizeof text);
    assert_string_equal(text, expected);
}

static void test_values(void **state) {
    (void)state;
    struct pel_mask mask = {.instance = 3, .inverted = true};
    assert_true(pel_mask_read_values(&mask, "7,-3..5.5,1e3,>=0.25"));
    const struct pel_value_range expected[4] = {{7, 7}, {-3, 5.5}, {1000, 1000}, {0.25, INFINITY}};
    assert_int_equal(mask.range_count, 4);
    assert_memory_equal(mask.ranges, expected, sizeof expected);
    assert_true(mask.instance == 3 && mask.inverted);
    expect_text("7,-3..5.5,1e3,>=0.25", "7,-3..5.5,1000,>=0.25");
    expect_text("3..5", "3..5");
    expect_text("-5..-3", "-5..-3");
    char cut[5];
    pel_mask_write_values(&mask, cut, sizeof cut);
    assert_string_equal(cut, "7,-3");
}

static void test_bad_values(void **state) {
    (void)state;
    static const char *const bad[] = {"",   "7,",  ",7",  "a",      "5..3", "3..", "..3",
                                      ">=", "nan", "inf", ">=1..2", "1 2",  "3-5", "0x"};
    struct pel_mask mask = {.range_count = 1, .ranges = {{1, 2}}};
    for (size_t n = 0; n < sizeof bad / sizeof *bad; n++) {
        if (pel_mask_read_values(&mask, bad[n]))
            fail_msg("'%s' is taken", bad[n]);
        assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
        assert_true(mask.range_count == 1 && mask.ranges[0].high == 2);
    }
    assert_false(pel_mask_read_values(&mask, "1,2,x"));
    assert_string_equal(pel_error_message(), "'x' is no value, and not like 3..5 or >=0.5");
    char many[3 * 33 + 1] = "";
    for (int n = 0; n < 33; n++)
        strcat(many, n ? ",12" : "12");
    assert_false(pel_mask_read_values(&mask, many));
    assert_non_null(strstr(pel_error_message(), "has more than 32 values and ranges"));
}

// Four instances of one volume, the first two masked by the last.
static struct pel_scene *scene_of_four(void) {
    const double grey[4] = {1, 1, 1, 0.1};
    struct pel_scene *scene = scene_create(4, 4);
    struct pel_volume *volume = scene_volume_constant((int[]){2, 2, 2}, PEL_VOXEL_U8, 1);
    scene_add(scene, volume, scene_transfer_constant(grey));
    for (int k = 1; k < 4; k++)
        scene_add_again(scene, 0, scene_transfer_constant(grey));
    for (int k = 0; k < 2; k++)
        scene->instances[k].mask =
            (struct pel_mask){.instance = 3, .range_count = 1, .ranges = {{k, k}}};
    return scene;
}

static void expect_mask(const struct pel_scene *scene, int instance, double label, int mask) {
    assert_int_equal(scene->instances[instance].mask.range_count, 1);
    assert_true(scene->instances[instance].mask.ranges[0].low == label);
    assert_int_equal(scene->instances[instance].mask.instance, mask);
}

// Masks follow their volumes through the list.
static void test_places(void **state) {
    (void)state;
    struct pel_scene *scene = scene_of_four();
    assert_true(pel_scene_move(scene, 3, 0));
    expect_mask(scene, 1, 0, 0);
    expect_mask(scene, 2, 1, 0);
    assert_true(pel_scene_move(scene, 1, 3));
    expect_mask(scene, 3, 0, 0);
    expect_mask(scene, 1, 1, 0);
    assert_true(pel_scene_move(scene, 0, 2));
    expect_mask(scene, 3, 0, 2);
    expect_mask(scene, 0, 1, 2);
    assert_true(pel_scene_remove(scene, 1));
    expect_mask(scene, 2, 0, 1);
    expect_mask(scene, 0, 1, 1);
    assert_int_equal(pel_scene_add_copy(scene, 0), 3);
    expect_mask(scene, 3, 1, 1);
    // Without the mask they are shown whole.
    assert_true(pel_scene_remove(scene, 1));
    for (int k = 0; k < 3; k++)
        assert_int_equal(scene->instances[k].mask.range_count, 0);
    pel_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),
        cmocka_unit_test(test_bad_values),
        cmocka_unit_test(test_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
