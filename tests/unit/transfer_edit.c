// Tests of transfer functions under a hand: the plot, points, window and level.
#include "support/test.h"

#include <math.h>

#include "viewer/transfer_edit.h"

static struct pel_transfer *ramp(void) {
    struct pel_transfer *transfer = pel_transfer_preset("grey");
    struct pel_statistics statistics = {.min = 100, .max = 200};
    pel_transfer_resolve(transfer, &statistics);
    while (transfer->opacity_count > 1)
        assert_true(pel_transfer_remove_opacity(transfer, 0));
    assert_false(pel_transfer_remove_opacity(transfer, 0));
    transfer->opacities[0] = (struct pel_opacity_point){200, 0.8};
    assert_int_equal(pel_transfer_add_opacity(transfer, 100, 0), 0);
    return transfer;
}

static const struct pel_plot plot = {100, 200, 10, 20, 200, 50};

static void test_plot(void **state) {
    (void)state;
    assert_float_equal(pel_plot_x(&plot, 150), 110, 1e-12);
    assert_float_equal(pel_plot_value(&plot, 110), 150, 1e-12);
    assert_float_equal(pel_plot_y(&plot, 1), 20, 1e-12);
    assert_float_equal(pel_plot_opacity(&plot, 45), 0.5, 1e-12);
    assert_float_equal(pel_plot_opacity(&plot, 100), 0, 0);
    struct pel_plot zoomed = plot;
    pel_plot_zoom(&zoomed, 60, 0.5);
    assert_float_equal(pel_plot_value(&zoomed, 60), 125, 1e-12);
    assert_float_equal(zoomed.high - zoomed.low, 50, 1e-12);
    struct pel_transfer *transfer = ramp();
    struct pel_statistics statistics = {.min = 50, .max = 150};
    pel_plot_fit(&zoomed, transfer, &statistics);
    assert_float_equal(zoomed.low, 50 - 3, 1e-9);
    assert_float_equal(zoomed.high, 200 + 3, 1e-9);
    pel_transfer_destroy(transfer);
}

// Bins of 1 from 0 to 256; one holds e^2 - 1 voxels, another e - 1, to about.
static void test_histogram(void **state) {
    (void)state;
    struct pel_statistics statistics = {.min = 0, .max = 256};
    statistics.histogram[10] = 1000;
    statistics.histogram[20] = 10;
    struct pel_plot whole = {.low = 0, .high = 256, .width = 1, .height = 1};
    float heights[256];
    pel_plot_histogram(&whole, &statistics, 256, heights);
    assert_float_equal(heights[10], 1, 0);
    assert_float_equal(heights[20], log(11) / log(1001), 1e-6);
    assert_float_equal(heights[11], 0, 0);
    // Columns of 64 bins lose no peak; columns of a part of a bin repeat it.
    pel_plot_histogram(&whole, &statistics, 4, heights);
    assert_float_equal(heights[0], 1, 0);
    assert_float_equal(heights[1], 0, 0);
    struct pel_plot part = {.low = 20, .high = 21, .width = 1, .height = 1};
    pel_plot_histogram(&part, &statistics, 8, heights);
    for (int i = 0; i < 8; i++)
        assert_float_equal(heights[i], log(11) / log(1001), 1e-6);
    part = (struct pel_plot){.low = 300, .high = 400, .width = 1, .height = 1};
    pel_plot_histogram(&part, &statistics, 2, heights);
    assert_float_equal(heights[0], 0, 0);
    statistics = (struct pel_statistics){.min = 7, .max = 7};
    statistics.histogram[0] = 5;
    part = (struct pel_plot){.low = 6, .high = 8, .width = 1, .height = 1};
    pel_plot_histogram(&part, &statistics, 2, heights);
    assert_float_equal(heights[1], 1, 0);
}

static void test_points(void **state) {
    (void)state;
    struct pel_transfer *transfer = ramp();
    assert_int_equal(pel_transfer_hit_opacity(transfer, &plot, 12, 68, 5), 0);
    assert_int_equal(pel_transfer_hit_opacity(transfer, &plot, 110, 45, 5), -1);
    int middle = pel_transfer_add_opacity(transfer, 150, 0.4);
    assert_int_equal(middle, 1);
    assert_int_equal(pel_transfer_hit_opacity(transfer, &plot, 110, 50, 5), 1);
    // A point stays between its neighbours.
    pel_transfer_move_opacity(transfer, middle, 250, 1.5);
    assert_float_equal(transfer->opacities[1].value, 200, 0);
    assert_float_equal(transfer->opacities[1].opacity, 1, 0);
    pel_transfer_move_opacity(transfer, middle, 0, -1);
    assert_float_equal(transfer->opacities[1].value, 100, 0);
    pel_transfer_move_opacity(transfer, 2, 1e5, 0.5);
    assert_float_equal(transfer->opacities[2].value, 1e5, 0);
    assert_true(pel_transfer_remove_opacity(transfer, middle));
    assert_int_equal(transfer->opacity_count, 2);
    assert_float_equal(transfer->opacities[1].opacity, 0.5, 0);
    // A new colour is the one that was there: grey goes from black to white.
    int colour = pel_transfer_add_colour(transfer, 150);
    assert_float_equal(transfer->colours[colour].rgb[1], 0.5, 1e-9);
    assert_int_equal(pel_transfer_hit_colour(transfer, &plot, 112, 5), colour);
    pel_transfer_move_colour(transfer, colour, 120);
    assert_float_equal(transfer->colours[colour].value, 120, 0);
    assert_true(pel_transfer_remove_colour(transfer, colour));
    // What is left is a function that can be written and read.
    assert_true(pel_transfer_save(transfer, test_temporary_path("edited.json")));
    struct pel_transfer *again = pel_transfer_load(test_temporary_path("edited.json"));
    assert_non_null(again);
    pel_transfer_destroy(again);
    pel_transfer_destroy(transfer);
}

static void test_window(void **state) {
    (void)state;
    struct pel_transfer *transfer = ramp();
    struct pel_statistics statistics = {.min = 0, .max = 1000};
    double low, high;
    pel_transfer_add_opacity(transfer, 125, 0.1);
    pel_transfer_window(transfer, &low, &high);
    assert_true(low == 100 && high == 200);
    pel_transfer_set_window(transfer, -1, 1);
    assert_float_equal(transfer->opacities[1].value, -0.5, 1e-12);
    assert_float_equal(transfer->opacities[2].value, 1, 0);
    assert_float_equal(transfer->colours[0].value, -1, 0);
    low = 100, high = 200;
    pel_transfer_drag_window(&low, &high, &statistics, 1, 0);
    assert_float_equal(high - low, 100 * exp(1), 1e-9);
    assert_float_equal((low + high) / 2, 150, 1e-9);
    pel_transfer_drag_window(&low, &high, &statistics, -1, 0.1);
    assert_float_equal(low, 0, 1e-9);
    assert_float_equal(high, 100, 1e-9);
    pel_transfer_drag_window(&low, &high, &statistics, -100, 0);
    assert_true(high > low);
    pel_transfer_drag_window(&low, &high, &statistics, 1000, 0);
    assert_true(isfinite(high - low));
    pel_transfer_destroy(transfer);
}

static void test_presets(void **state) {
    (void)state;
    struct pel_statistics statistics = {.min = 0, .max = 1000};
    struct pel_transfer *before = ramp();
    before->opacity_unit_mm = 7;
    for (const char *const *name = pel_transfer_presets(); *name; name++) {
        struct pel_transfer *transfer =
            pel_transfer_fit_preset(*name, &statistics, 300, 400, before);
        assert_non_null(transfer);
        assert_int_equal(transfer->scale, PEL_VALUES_ABSOLUTE);
        assert_float_equal(transfer->opacity_unit_mm, 7, 0);
        if (strcmp(*name, "hot") == 0) {
            double low, high;
            pel_transfer_window(transfer, &low, &high);
            assert_true(low == 300 && high == 400);
        }
        pel_transfer_destroy(transfer);
    }
    assert_null(pel_transfer_fit_preset("none such", &statistics, 0, 1, before));
    pel_transfer_destroy(before);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plot),    cmocka_unit_test(test_histogram),
        cmocka_unit_test(test_points),  cmocka_unit_test(test_window),
        cmocka_unit_test(test_presets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
