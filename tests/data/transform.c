// The known transform of a phantom pair: a plain 4x4 that turns by 15 degrees about (1, 2, 3).
#include "support/near.h"
#include "support/test.h"

#include "base/math.h"

#define PHANTOM "data/pair_phantom_known_rigid/phantom01_rigid.mat"

static void test_phantom(void **state) {
    (void)state;
    struct pel_matrix matrix;
    assert_true(pel_transform_load(&matrix, test_data_path(PHANTOM), NULL, NULL));
    assert_true(pel_matrix_is_rigid(&matrix, 1e-12));
    double trace = matrix.m[0][0] + matrix.m[1][1] + matrix.m[2][2];
    assert_near(acos((trace - 1) / 2) * 180 / PEL_PI, 15, 5e-4);
    double axis[3] = {matrix.m[2][1] - matrix.m[1][2], matrix.m[0][2] - matrix.m[2][0],
                      matrix.m[1][0] - matrix.m[0][1]};
    assert_true(pel_normalize(axis));
    for (int i = 0; i < 3; i++)
        assert_near(axis[i], (i + 1) / sqrt(14), 1e-5);
    // The file's six digits, as they are.
    assert_near(matrix.m[0][1], -0.202649, 1e-6);
    assert_near(matrix.m[0][3], -21.4932, 0);
    assert_near(matrix.m[1][3], 19.7943, 0);
    assert_near(matrix.m[2][3], 2.63485, 0);
}

int main(void) {
    test_need_data(PHANTOM);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_phantom)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
