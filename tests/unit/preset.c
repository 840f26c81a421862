// Presets: each is valid and transparent where nothing is, and a few known colours.
#include "support/near.h"
#include "support/test.h"

#include "transfer/table.h"
#include "transfer/transfer.h"

static void test_every_preset_is_valid(void **state) {
    (void)state;
    int count = 0;
    for (const char *const *name = pel_transfer_presets(); *name; name++, count++) {
        struct pel_transfer *transfer = pel_transfer_preset(*name);
        if (!transfer || !pel_transfer_check(transfer))
            fail_msg("%s: %s", *name, pel_error_message());
        double greatest = 0;
        for (int i = 0; i < transfer->opacity_count; i++)
            greatest = fmax(greatest, transfer->opacities[i].opacity);
        assert_in_range((int)(1000 * greatest), 50, 900);
        // Only cool-warm, which is for data around zero, shows its least values.
        assert_int_equal(transfer->opacities[0].opacity > 0, strcmp(*name, "cool-warm") == 0);
        pel_transfer_destroy(transfer);
    }
    assert_int_equal(count, 20);
}

static void check_colour(const char *name, double value, int r, int g, int b) {
    struct pel_transfer *transfer = pel_transfer_preset(name);
    double rgba[4];
    const int expected[3] = {r, g, b};
    pel_transfer_evaluate(transfer, value, rgba);
    for (int i = 0; i < 3; i++)
        if (!(fabs(rgba[i] * 255 - expected[i]) < 1.5))
            fail_msg("%s at %g: channel %d is %g, not %d", name, value, i, rgba[i] * 255,
                     expected[i]);
    pel_transfer_destroy(transfer);
}

static void test_known_colours(void **state) {
    (void)state;
    check_colour("grey", 0.5, 128, 128, 128);
    // matplotlib's tables of 256 entries at 100 and 200, which no control point is at.
    check_colour("viridis", 100 / 255.0, 42, 118, 142);
    check_colour("viridis", 200 / 255.0, 112, 207, 87);
    check_colour("plasma", 0, 13, 8, 135);
    check_colour("inferno", 1, 252, 255, 164);
    // Moreland's published table of 33 entries at 16 and 24.
    check_colour("cool-warm", 0.5, 221, 221, 221);
    check_colour("cool-warm", 0.75, 244, 154, 123);
    // The third texel of volumeRender's table, and halfway to the fourth.
    check_colour("rainbow", 2.5 / 9, 255, 128, 0);
    check_colour("rainbow", 3.0 / 9, 255, 191, 0);
}

static void test_labels_have_an_entry_each(void **state) {
    (void)state;
    const enum pel_voxel_type types[] = {PEL_VOXEL_U8, PEL_VOXEL_U16};
    struct pel_transfer *transfer = pel_transfer_preset("labels");
    for (int t = 0; t < 2; t++) {
        struct pel_volume *volume = pel_volume_create("labels", (int[]){1, 1, 1}, types[t]);
        struct pel_table table;
        assert_true(pel_table_build(&table, transfer, volume));
        assert_true(table.nearest);
        assert_int_equal(table.entry_count, 256);
        assert_near(table.low, 0, 0);
        assert_near(table.high, 255, 0);
        assert_float_equal(table.rgba[0][3], 0, 1e-5);
        for (int label = 1; label < 256; label++) {
            assert_float_equal(table.rgba[label][3], 0.5, 1e-5);
            for (int other = 1; other < label; other++) {
                double apart = 0;
                for (int i = 0; i < 3; i++)
                    apart += fabs((double)(table.rgba[label][i] - table.rgba[other][i]));
                assert_true(apart > 1 / 256.0);
            }
        }
        pel_table_finish(&table);
        pel_volume_destroy(volume);
    }
    pel_transfer_destroy(transfer);
}

static void test_unknown_name(void **state) {
    (void)state;
    assert_null(pel_transfer_preset("gray"));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_string_equal(pel_error_message(), "no preset 'gray'; did you mean 'grey'");
    assert_null(pel_transfer_preset("banana"));
    assert_non_null(strstr(pel_error_message(), "no preset 'banana'; there are grey, hot, "));
    assert_non_null(strstr(pel_error_message(), " and labels"));
    assert_null(pel_transfer_preset("ct-soft"));
    assert_string_equal(pel_error_message(), "no preset 'ct-soft'; did you mean 'ct-soft-tissue'");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_preset_is_valid),
        cmocka_unit_test(test_known_colours),
        cmocka_unit_test(test_labels_have_an_entry_each),
        cmocka_unit_test(test_unknown_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
