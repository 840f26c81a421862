// Tests of host/output/stereo_layout.c: each layout, pixel by pixel. A left pixel at (x, y) is
// 10 y + x in every channel, a right one 100 more, so a letter-sized picture tells where all of it
// came from.
#include "support/test.h"

static struct pel_image *eye(int width, int height, float add) {
    struct pel_image *image = pel_image_create(width, height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 4; c++)
                image->rgba[4 * (y * width + x) + c] = (float)(10 * y + x) + add;
    return image;
}

// Composes eyes of 4 x 2 pixels and compares with rows of expected numbers.
static void check(enum pel_stereo_kind kind, int width, int height, const float *expected) {
    struct pel_stereo stereo = {.kind = kind};
    struct pel_image *left = eye(4, 2, 0), *right = eye(4, 2, 100);
    struct pel_image *image = pel_stereo_compose(&stereo, left, right);
    if (!image)
        fail_msg("%s", pel_error_message());
    assert_int_equal(image->width, width);
    assert_int_equal(image->height, height);
    for (int i = 0; i < 4 * width * height; i++)
        if (image->rgba[i] != expected[i / 4])
            fail_msg("%s: pixel %d is %g, not %g", pel_stereo_names()[kind], i / 4, image->rgba[i],
                     expected[i / 4]);
    pel_image_destroy(left);
    pel_image_destroy(right);
    pel_image_destroy(image);
}

static void test_full(void **state) {
    (void)state;
    static const float beside[] = {0,  1,  2,  3,  100, 101, 102, 103, //
                                   10, 11, 12, 13, 110, 111, 112, 113};
    static const float above[] = {0,   1,   2,   3,   10,  11,  12,  13, //
                                  100, 101, 102, 103, 110, 111, 112, 113};
    check(PEL_STEREO_SIDE_BY_SIDE, 8, 2, beside);
    check(PEL_STEREO_TWO_FILES, 8, 2, beside);
    check(PEL_STEREO_TOP_BOTTOM, 4, 4, above);
}

static void test_half(void **state) {
    (void)state;
    static const float beside[] = {0.5F, 2.5F, 100.5F, 102.5F, 10.5F, 12.5F, 110.5F, 112.5F};
    static const float above[] = {5, 6, 7, 8, 105, 106, 107, 108};
    check(PEL_STEREO_SIDE_BY_SIDE_HALF, 4, 2, beside);
    check(PEL_STEREO_TOP_BOTTOM_HALF, 4, 2, above);
}

static void test_interlaced(void **state) {
    (void)state;
    check(PEL_STEREO_ROW_INTERLACED, 4, 2, (const float[]){0, 1, 2, 3, 110, 111, 112, 113});
    check(PEL_STEREO_COLUMN_INTERLACED, 4, 2, (const float[]){0, 101, 2, 103, 10, 111, 12, 113});
    check(PEL_STEREO_CHECKERBOARD, 4, 2, (const float[]){0, 101, 2, 103, 110, 11, 112, 13});
    check(PEL_STEREO_NONE, 4, 2, (const float[]){0, 1, 2, 3, 10, 11, 12, 13});
}

static void refuse(int kind, int width, int height, int right_width, const char *sentence) {
    struct pel_stereo stereo = {.kind = (enum pel_stereo_kind)kind};
    struct pel_image *left = eye(width, height, 0), *right = eye(right_width, height, 100);
    assert_null(pel_stereo_compose(&stereo, left, right));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_non_null(strstr(pel_error_message(), sentence));
    pel_image_destroy(left);
    pel_image_destroy(right);
}

static void test_refused(void **state) {
    (void)state;
    refuse(PEL_STEREO_SIDE_BY_SIDE_HALF, 1, 2, 1, "even width, not 1");
    refuse(PEL_STEREO_TOP_BOTTOM_HALF, 2, 3, 2, "even height, not 3");
    refuse(PEL_STEREO_CHECKERBOARD, 2, 2, 3, "2 x 2 and 3 x 2");
    refuse(PEL_STEREO_TWO_FILES + 1, 2, 2, 2, "kind");
    refuse(-1, 2, 2, 2, "kind");
}

// The names are in the order of the enum.
static void test_names(void **state) {
    (void)state;
    const char *const *names = pel_stereo_names();
    assert_string_equal(names[PEL_STEREO_NONE], "none");
    assert_string_equal(names[PEL_STEREO_DUBOIS_GREEN_MAGENTA], "dubois-green-magenta");
    assert_string_equal(names[PEL_STEREO_RED_BLUE], "red-blue");
    assert_string_equal(names[PEL_STEREO_MATRIX], "matrix");
    assert_string_equal(names[PEL_STEREO_TOP_BOTTOM_HALF], "top-bottom-half");
    assert_string_equal(names[PEL_STEREO_TWO_FILES], "two-files");
    assert_null(names[PEL_STEREO_TWO_FILES + 1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_full),       cmocka_unit_test(test_half),
        cmocka_unit_test(test_interlaced), cmocka_unit_test(test_refused),
        cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
