// error.c - the sentence of a failure: one slot, contexts in front, always printable.
#include "support/test.h"

#include "base/error.h"
#include "base/math.h"

#include <math.h>

static void test_contexts(void **state) {
    (void)state;
    assert_false(pel_fail(PEL_ERROR_FORMAT, "page %d: %d bits", 2, 12));
    assert_false(pel_fail_in("%s", "bunny.tif"));
    assert_int_equal(pel_error_code(), PEL_ERROR_FORMAT);
    assert_string_equal(pel_error_message(), "bunny.tif: page 2: 12 bits");
    assert_false(pel_fail(PEL_ERROR_ARGUMENT, "%s again", pel_error_message()));
    assert_string_equal(pel_error_message(), "bunny.tif: page 2: 12 bits again");
    pel_error_clear();
    assert_int_equal(pel_error_code(), PEL_OK);
    assert_string_equal(pel_error_message(), "");
}

static void keep(const char *message, void *user) {
    strcpy(user, message);
}

// What a file says cannot break the line, nor reach the terminal as a command.
static void test_sentences_are_printable(void **state) {
    (void)state;
    pel_fail(PEL_ERROR_FORMAT, "no key '%s'", "a\nb\x1b[2J\x7f µm");
    pel_fail_in("%s", "x\ry");
    assert_string_equal(pel_error_message(), "x y: no key 'a b?[2J? µm'");
    char warning[256] = "";
    pel_on_warning(keep, warning);
    pel_warn("tab\there");
    pel_on_warning(NULL, NULL);
    assert_string_equal(warning, "tab here");
}

static void test_matrices_that_have_no_inverse(void **state) {
    (void)state;
    struct pel_matrix inverse, matrix = pel_matrix_scaling((double[]){1, 0, 1});
    assert_false(pel_matrix_invert(&inverse, &matrix));
    assert_string_equal(pel_error_message(), "matrix is singular");
    matrix = pel_matrix_translation((double[]){0, INFINITY, 0});
    assert_false(pel_matrix_invert(&inverse, &matrix));
    assert_string_equal(pel_error_message(), "matrix is not finite");
    matrix = pel_matrix_translation((double[]){0, 7, 0});
    assert_true(pel_matrix_invert(&inverse, &matrix));
    assert_true(inverse.m[1][3] == -7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_contexts),
        cmocka_unit_test(test_sentences_are_printable),
        cmocka_unit_test(test_matrices_that_have_no_inverse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
