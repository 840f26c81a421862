// Tables: their domain for each voxel type, and their entries.
#include "support/near.h"
#include "support/test.h"

#include "transfer/table.h"
#include "transfer/transfer.h"

// White; opacity 0 at `low`, 1 at `high`.
static struct pel_transfer *ramp(double low, double high) {
    struct pel_transfer *transfer = pel_transfer_create(1, 2);
    assert_non_null(transfer);
    transfer->colours[0] = (struct pel_colour_point){low, {1, 1, 1}};
    transfer->opacities[0] = (struct pel_opacity_point){low, 0};
    transfer->opacities[1] = (struct pel_opacity_point){high, 1};
    return transfer;
}

static struct pel_table build(struct pel_transfer *transfer, enum pel_voxel_type type, double slope,
                              double intercept) {
    struct pel_volume *volume = pel_volume_create("test", (int[]){1, 1, 1}, type);
    volume->slope = slope;
    volume->intercept = intercept;
    struct pel_table table;
    assert_true(pel_table_build(&table, transfer, volume));
    pel_volume_destroy(volume);
    pel_transfer_destroy(transfer);
    return table;
}

static void check_domain(struct pel_table *table, double low, double high, int entries) {
    assert_near(table->low, low, 1e-9);
    assert_near(table->high, high, 1e-9);
    assert_int_equal(table->entry_count, entries);
    pel_table_finish(table);
    assert_null(table->rgba);
}

static void test_narrow_types_take_their_whole_range(void **state) {
    (void)state;
    struct pel_table table = build(ramp(10, 20), PEL_VOXEL_U8, 1, 0);
    check_domain(&table, 0, 255, 256);
    table = build(ramp(10, 20), PEL_VOXEL_I8, 2, -1);
    check_domain(&table, -257, 253, 256);
    table = build(ramp(10, 20), PEL_VOXEL_U8, -2, 100);
    check_domain(&table, -410, 100, 256);
    table = build(ramp(10, 20), PEL_VOXEL_RGB8, 1, 0);
    check_domain(&table, 0, 255, 256);
    table = build(ramp(10, 20), PEL_VOXEL_RGBA8, 1, 0);
    check_domain(&table, 0, 255, 256);
}

static void test_wide_types_take_the_control_points(void **state) {
    (void)state;
    struct pel_table table = build(ramp(-1000, 3000), PEL_VOXEL_I16, -1, 0);
    check_domain(&table, -1000, 3000, 4096);
    struct pel_transfer *transfer = ramp(0, 1);
    transfer->colours[0].value = 1.5;
    table = build(transfer, PEL_VOXEL_F32, 1, 0);
    check_domain(&table, 0, 1.5, 4096);
    transfer = ramp(0, 100);
    transfer->table_entries = 11;
    table = build(transfer, PEL_VOXEL_U16, 1, 0);
    assert_float_equal(table.rgba[3][3], 0.3, 1e-6);
    check_domain(&table, 0, 100, 11);
    transfer = ramp(0, 255);
    transfer->table_entries = 2;
    transfer->nearest = true;
    table = build(transfer, PEL_VOXEL_U8, 1, 0);
    assert_true(table.nearest);
    check_domain(&table, 0, 255, 2);
}

static void test_entries_sample_the_function(void **state) {
    (void)state;
    struct pel_table table = build(ramp(50, 100), PEL_VOXEL_U8, 1, 0);
    for (int raw = 0; raw < 256; raw++) {
        assert_float_equal(table.rgba[raw][0], 1, 0);
        assert_float_equal(table.rgba[raw][3], fmin(fmax((raw - 50) / 50.0, 0), 1), 1e-6);
    }
    pel_table_finish(&table);
}

// A step at each raw value in turn, with slopes whose products round.
static void test_steps_on_entries_are_exact(void **state) {
    (void)state;
    const double slopes[] = {1, 0.1, -0.3, 1e-7, 12345.678};
    for (size_t s = 0; s < sizeof slopes / sizeof *slopes; s++) {
        for (int step = 0; step < 256; step++) {
            struct pel_transfer *transfer = ramp(0, 0);
            transfer->opacities[0].value = transfer->opacities[1].value = slopes[s] * step + 0.7;
            struct pel_table table = build(transfer, PEL_VOXEL_U8, slopes[s], 0.7);
            for (int raw = 0; raw < 256; raw++) {
                int entry = slopes[s] > 0 ? raw : 255 - raw;
                bool opaque = slopes[s] > 0 ? raw >= step : raw <= step;
                if (table.rgba[entry][3] != (opaque ? 1.0F : 0.0F))
                    fail_msg("slope %g, step at %d: raw %d has %g", slopes[s], step, raw,
                             (double)table.rgba[entry][3]);
            }
            pel_table_finish(&table);
        }
    }
}

static void test_a_step_at_the_first_point_shows(void **state) {
    (void)state;
    // Opacity 0 below 100, 0.5 there, 1 at 194: entry 0 must be what is below the step.
    struct pel_transfer *transfer = pel_transfer_create(1, 3);
    transfer->colours[0].value = 150;
    transfer->opacities[0] = (struct pel_opacity_point){100, 0};
    transfer->opacities[1] = (struct pel_opacity_point){100, 0.5};
    transfer->opacities[2] = (struct pel_opacity_point){194, 1};
    transfer->table_entries = 96;
    struct pel_table table = build(transfer, PEL_VOXEL_U16, 1, 0);
    assert_float_equal(table.rgba[0][3], 0, 0);
    assert_float_equal(table.rgba[1][3], 0.5, 1e-6);
    assert_float_equal(table.rgba[48][3], 0.75, 1e-6);
    assert_float_equal(table.rgba[95][3], 1, 0);
    check_domain(&table, 99, 194, 96);
}

static void test_one_value_for_all_points(void **state) {
    (void)state;
    const double values[] = {0, -1000, 1e9, 1e-9};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        struct pel_table table = build(ramp(values[i], values[i]), PEL_VOXEL_F32, 1, 0);
        assert_true((float)table.low < (float)table.high);
        assert_near(table.high, values[i], 0);
        assert_float_equal(table.rgba[0][3], 0, 0);
        assert_float_equal(table.rgba[table.entry_count - 2][3], 0, 0);
        assert_float_equal(table.rgba[table.entry_count - 1][3], 1, 0);
        pel_table_finish(&table);
    }
    // The same for a volume whose slope makes all its values one.
    struct pel_table table = build(ramp(5, 5), PEL_VOXEL_U8, 0, 5);
    assert_true(table.low < table.high);
    assert_near(table.high, 5, 0);
    pel_table_finish(&table);
}

static void test_refuses_an_invalid_function(void **state) {
    (void)state;
    struct pel_transfer *transfer = ramp(3, 2);
    struct pel_volume *volume = pel_volume_create("test", (int[]){1, 1, 1}, PEL_VOXEL_U8);
    struct pel_table table;
    assert_false(pel_table_build(&table, transfer, volume));
    assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
    pel_table_finish(&table);
    pel_volume_destroy(volume);
    pel_transfer_destroy(transfer);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_narrow_types_take_their_whole_range),
        cmocka_unit_test(test_wide_types_take_the_control_points),
        cmocka_unit_test(test_entries_sample_the_function),
        cmocka_unit_test(test_steps_on_entries_are_exact),
        cmocka_unit_test(test_a_step_at_the_first_point_shows),
        cmocka_unit_test(test_one_value_for_all_points),
        cmocka_unit_test(test_refuses_an_invalid_function),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
