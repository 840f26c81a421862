// Transfer functions: evaluation, resolution and checks, against values worked out by hand.
#include "support/near.h"
#include "support/test.h"

#include "transfer/transfer.h"

// Black to red over 0..10, a step to blue at 10, green at 30; opacity 0 -> 1 over 0..20.
static struct pel_transfer *example(void) {
    struct pel_transfer *transfer = pel_transfer_create(4, 2);
    assert_non_null(transfer);
    transfer->colours[0] = (struct pel_colour_point){0, {0, 0, 0}};
    transfer->colours[1] = (struct pel_colour_point){10, {1, 0, 0}};
    transfer->colours[2] = (struct pel_colour_point){10, {0, 0, 1}};
    transfer->colours[3] = (struct pel_colour_point){30, {0, 1, 0}};
    transfer->opacities[0] = (struct pel_opacity_point){0, 0};
    transfer->opacities[1] = (struct pel_opacity_point){20, 1};
    return transfer;
}

static void check_at(const struct pel_transfer *transfer, double value, double r, double g,
                     double b, double a) {
    double rgba[4], expected[4] = {r, g, b, a};
    pel_transfer_evaluate(transfer, value, rgba);
    for (int i = 0; i < 4; i++)
        if (!(fabs(rgba[i] - expected[i]) < 1e-12))
            fail_msg("at %g: channel %d is %.15g, not %.15g", value, i, rgba[i], expected[i]);
}

static void test_evaluates(void **state) {
    (void)state;
    struct pel_transfer *transfer = example();
    check_at(transfer, -1e30, 0, 0, 0, 0);
    check_at(transfer, 0, 0, 0, 0, 0);
    check_at(transfer, 2.5, 0.25, 0, 0, 0.125);
    check_at(transfer, 15, 0, 0.25, 0.75, 0.75);
    check_at(transfer, 20, 0, 0.5, 0.5, 1);
    check_at(transfer, 30, 0, 1, 0, 1);
    check_at(transfer, 1e30, 0, 1, 0, 1);
    pel_transfer_destroy(transfer);
}

static void test_later_point_of_a_step_counts_at_its_value(void **state) {
    (void)state;
    struct pel_transfer *transfer = example();
    check_at(transfer, nextafter(10, 0), 1, 0, 0, 0.5);
    check_at(transfer, 10, 0, 0, 1, 0.5);
    // Steps at the very ends, and three points of one value: the one between is never seen.
    transfer->colours[0].value = transfer->colours[1].value = transfer->colours[2].value = 5;
    transfer->colours[3].value = 5;
    check_at(transfer, nextafter(5, 0), 0, 0, 0, 0.25);
    check_at(transfer, 5, 0, 1, 0, 0.25);
    pel_transfer_destroy(transfer);
}

static void test_one_point_is_constant(void **state) {
    (void)state;
    struct pel_transfer *transfer = pel_transfer_create(1, 1);
    transfer->colours[0] = (struct pel_colour_point){7, {0.25, 0.5, 1}};
    transfer->opacities[0] = (struct pel_opacity_point){-3, 0.125};
    for (int value = -10; value <= 10; value += 10)
        check_at(transfer, value, 0.25, 0.5, 1, 0.125);
    pel_transfer_destroy(transfer);
}

static void test_resolves_relative_values(void **state) {
    (void)state;
    struct pel_transfer *transfer = example();
    for (int i = 0; i < 4; i++)
        transfer->colours[i].value /= 30;
    for (int i = 0; i < 2; i++)
        transfer->opacities[i].value /= 20;
    transfer->scale = PEL_VALUES_RELATIVE;
    pel_transfer_resolve(transfer, &(struct pel_statistics){.min = -1000, .max = 2000});
    assert_int_equal(transfer->scale, PEL_VALUES_ABSOLUTE);
    assert_near(transfer->colours[1].value, 0, 1e-9);
    assert_near(transfer->colours[2].value, 0, 1e-9);
    assert_near(transfer->colours[3].value, 2000, 1e-9);
    assert_near(transfer->opacities[0].value, -1000, 0);
    // Resolving again changes nothing.
    pel_transfer_resolve(transfer, &(struct pel_statistics){.min = 5, .max = 6});
    assert_near(transfer->colours[3].value, 2000, 1e-9);
    pel_transfer_destroy(transfer);
}

static void test_resolves_percentiles(void **state) {
    (void)state;
    struct pel_transfer *transfer = example();
    struct pel_statistics statistics = {.min = 0, .max = 10000};
    for (int p = 0; p <= 100; p++)
        statistics.percentiles[p] = p * p;
    const double percents[4] = {0, 50, 50.25, 100}, values[4] = {0, 2500, 2525.25, 10000};
    for (int i = 0; i < 4; i++)
        transfer->colours[i].value = percents[i];
    transfer->opacities[1].value = 99.5; // (9801 + 10000) / 2
    transfer->scale = PEL_VALUES_PERCENTILE;
    pel_transfer_resolve(transfer, &statistics);
    for (int i = 0; i < 4; i++)
        assert_near(transfer->colours[i].value, values[i], 1e-9);
    assert_near(transfer->opacities[1].value, 9900.5, 1e-9);
    pel_transfer_destroy(transfer);
}

static void test_resolved_values_ascend(void **state) {
    (void)state;
    uint64_t random = 3;
    struct pel_transfer *transfer = pel_transfer_create(200, 1);
    for (int trial = 0; trial < 200; trial++) {
        struct pel_statistics statistics = {0};
        double value = test_random(&random) - 0.5;
        for (int p = 0; p <= 100; p++)
            statistics.percentiles[p] = value += p % 7 ? 0 : 0.1 * test_random(&random);
        for (int i = 0; i < 200; i++)
            transfer->colours[i].value =
                i ? fmin(100, transfer->colours[i - 1].value + test_random(&random)) : 0;
        transfer->scale = PEL_VALUES_PERCENTILE;
        pel_transfer_resolve(transfer, &statistics);
        assert_true(pel_transfer_check(transfer));
        for (int i = 1; i < 200; i++)
            assert_true(transfer->colours[i].value >= transfer->colours[i - 1].value);
    }
    pel_transfer_destroy(transfer);
}

static void test_stretches(void **state) {
    (void)state;
    struct pel_transfer *transfer = example();
    pel_transfer_stretch(transfer, 100, 102);
    assert_int_equal(transfer->scale, PEL_VALUES_ABSOLUTE);
    assert_near(transfer->colours[1].value, 120, 1e-12);
    assert_near(transfer->opacities[0].value, 100, 1e-12);
    pel_transfer_destroy(transfer);
}

static void test_copy_is_deep(void **state) {
    (void)state;
    struct pel_transfer *transfer = example();
    transfer->nearest = true;
    transfer->table_entries = 17;
    transfer->opacity_unit_mm = 2.5;
    struct pel_transfer *copy = pel_transfer_copy(transfer);
    transfer->colours[1].rgb[0] = 0;
    transfer->opacities[1].opacity = 0;
    check_at(copy, 2.5, 0.25, 0, 0, 0.125);
    assert_true(copy->nearest);
    assert_int_equal(copy->table_entries, 17);
    assert_near(copy->opacity_unit_mm, 2.5, 0);
    pel_transfer_destroy(copy);
    pel_transfer_destroy(transfer);
    pel_transfer_destroy(NULL);
}

static void refuse(struct pel_transfer *transfer, const char *sentence) {
    assert_false(pel_transfer_check(transfer));
    assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
    assert_string_equal(pel_error_message(), sentence);
    pel_transfer_destroy(transfer);
}

static void test_refuses_what_is_not_a_function(void **state) {
    (void)state;
    struct pel_transfer *transfer = example();
    assert_true(pel_transfer_check(transfer));
    transfer->colours[3].value = 9;
    refuse(transfer, "colour point 3: value 9 is less than 10 before it");
    transfer = example();
    transfer->colours[2].rgb[1] = 255;
    refuse(transfer, "colour point 2: green 255 is outside 0..1");
    transfer = example();
    transfer->colours[0].rgb[2] = NAN;
    refuse(transfer, "colour point 0: blue nan is outside 0..1");
    transfer = example();
    transfer->opacities[1].opacity = -0.5;
    refuse(transfer, "opacity point 1: opacity -0.5 is outside 0..1");
    transfer = example();
    transfer->opacities[1].value = INFINITY;
    refuse(transfer, "opacity point 1: value inf is beyond 1e+37");
    transfer = example();
    transfer->opacities[0].value = NAN;
    refuse(transfer, "opacity point 0: value nan is beyond 1e+37");
    transfer = example();
    transfer->scale = PEL_VALUES_PERCENTILE;
    transfer->colours[3].value = 101;
    refuse(transfer, "colour point 3: percentile 101 is outside 0..100");
    transfer = example();
    transfer->opacity_unit_mm = 0;
    refuse(transfer, "opacity unit of 0 mm is not a positive length");
    transfer = example();
    transfer->table_entries = 1;
    refuse(transfer, "1 table entries are outside 2..65536");
    transfer = example();
    transfer->opacity_count = 0;
    refuse(transfer, "4 colour points and 0 opacity points, not 1 or more");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_evaluates),
        cmocka_unit_test(test_later_point_of_a_step_counts_at_its_value),
        cmocka_unit_test(test_one_point_is_constant),
        cmocka_unit_test(test_resolves_relative_values),
        cmocka_unit_test(test_resolves_percentiles),
        cmocka_unit_test(test_resolved_values_ascend),
        cmocka_unit_test(test_stretches),
        cmocka_unit_test(test_copy_is_deep),
        cmocka_unit_test(test_refuses_what_is_not_a_function),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
