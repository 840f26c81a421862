// Tests of host/output/anaglyph.c: white, numbers worked out by hand, and every kind against the
// reference.
#include "support/test.h"

#include <math.h>

#include "reference/stereo.h"
#include "support/near.h"

enum { FIRST = PEL_STEREO_TRUE_RED_CYAN, LAST = PEL_STEREO_MATRIX };

// A user's matrix whose rows sum to 1: the mean of both eyes.
static const double mean_matrix[3][6] = {
    {0.5, 0, 0, 0.5, 0, 0}, {0, 0.5, 0, 0, 0.5, 0}, {0, 0, 0.5, 0, 0, 0.5}};

static struct pel_stereo stereo_of(int kind) {
    struct pel_stereo stereo = {.kind = (enum pel_stereo_kind)kind};
    memcpy(stereo.matrix, mean_matrix, sizeof mean_matrix);
    return stereo;
}

static struct pel_image *pixel(const float rgba[4]) {
    struct pel_image *image = pel_image_create(1, 1);
    memcpy(image->rgba, rgba, 4 * sizeof *rgba);
    return image;
}

// The anaglyph of one pixel.
static void compose(float out[4], const struct pel_stereo *stereo, const float left[4],
                    const float right[4]) {
    struct pel_image *eyes[2] = {pixel(left), pixel(right)};
    struct pel_image *image = pel_stereo_compose(stereo, eyes[0], eyes[1]);
    if (!image)
        fail_msg("%s", pel_error_message());
    assert_int_equal(image->width, 1);
    assert_int_equal(image->height, 1);
    memcpy(out, image->rgba, 4 * sizeof *out);
    pel_image_destroy(image);
    pel_image_destroy(eyes[0]);
    pel_image_destroy(eyes[1]);
}

static void assert_pixel(const float actual[4], double red, double green, double blue,
                         double alpha) {
    const double expected[4] = {red, green, blue, alpha};
    for (int c = 0; c < 4; c++)
        assert_near(actual[c], expected[c], 1e-5);
}

static bool is_kind(int kind, const char *name) {
    return strcmp(pel_stereo_names()[kind], name) == 0;
}

// White stays white, and grey grey, in every channel the glasses use. Kinds with one channel for
// each eye leave the third dark, and the thesis's average is half as bright as its pictures.
static void test_white(void **state) {
    (void)state;
    static const float levels[2][4] = {{1, 1, 1, 1}, {0.735357F, 0.735357F, 0.735357F, 1}};
    for (int i = 0; i < 2 * (LAST + 1 - FIRST); i++) {
        int kind = FIRST + i / 2;
        const float *level = levels[i % 2];
        struct pel_stereo stereo = stereo_of(kind);
        double expected[3] = {level[0], level[1], level[2]};
        if (is_kind(kind, "true-red-cyan") || is_kind(kind, "true-amber-blue") ||
            is_kind(kind, "red-blue"))
            expected[1] = 0;
        if (is_kind(kind, "true-green-magenta") || is_kind(kind, "red-green"))
            expected[2] = 0;
        for (int c = 0; c < 3 && is_kind(kind, "thesis"); c++)
            expected[c] /= 2;
        float out[4];
        compose(out, &stereo, level, level);
        // Dubois gives three digits, so his rows sum to 1 within 0.001: 0.0005 after encoding.
        for (int c = 0; c < 3; c++)
            if (!(fabs(out[c] - expected[c]) < 0.0005))
                fail_msg("%s: channel %d of %g is %g", pel_stereo_names()[kind], c, level[c],
                         out[c]);
        assert_float_equal(out[3], 1, 0);
    }
}

// Light 0.5 is stored as 1.055 * 0.5^(1/2.4) - 0.055 = 0.735357, and 0.2 as 0.484529.
static void test_by_hand(void **state) {
    (void)state;
    static const float red[4] = {1, 0, 0, 1}, green[4] = {0, 1, 0, 1}, black[4] = {0, 0, 0, 1};
    static const float half[4] = {0.735357F, 0.735357F, 0.735357F, 1};
    float out[4];
    struct pel_stereo stereo = stereo_of(PEL_STEREO_COLOUR_RED_CYAN);
    compose(out, &stereo, red, green);
    assert_pixel(out, 1, 1, 0, 1);
    compose(out, &stereo, green, red);
    assert_pixel(out, 0, 0, 0, 1);

    // Grey of a red left eye: light 0.299 is 1.055 * 0.299^(1/2.4) - 0.055 = 0.582943.
    stereo = stereo_of(PEL_STEREO_GREY_RED_CYAN);
    compose(out, &stereo, red, black);
    assert_pixel(out, 0.582943, 0, 0, 1);

    // Dubois, green-magenta, a right eye of full blue: red 0.024, green -0.065, blue 0.937.
    stereo = stereo_of(PEL_STEREO_DUBOIS_GREEN_MAGENTA);
    compose(out, &stereo, black, (const float[4]){0, 0, 1, 1});
    assert_pixel(out, 0.168018, 0, 0.971780, 1);

    // The mean is one of light, not of stored values; that of the thesis is not.
    stereo = stereo_of(PEL_STEREO_MATRIX);
    compose(out, &stereo, (const float[4]){1, 1, 1, 1}, black);
    assert_pixel(out, half[0], half[1], half[2], 1);
    stereo = stereo_of(PEL_STEREO_THESIS);
    compose(out, &stereo, green, half);
    assert_pixel(out, 0.735357 / 2, 0.5, 0, 1);
}

// Where only one eye sees something, the anaglyph has that eye's colour and covers as it does.
static void test_alpha(void **state) {
    (void)state;
    static const float clear[4] = {0, 0, 0, 0}, veil[4] = {0.25F, 0.25F, 0.25F, 0.25F};
    float out[4];
    struct pel_stereo stereo = stereo_of(PEL_STEREO_COLOUR_RED_CYAN);
    compose(out, &stereo, veil, clear);
    assert_pixel(out, 0.25, 0, 0, 0.25);
    compose(out, &stereo, veil, veil);
    assert_pixel(out, 0.25, 0.25, 0.25, 0.25);
    compose(out, &stereo, clear, clear);
    assert_pixel(out, 0, 0, 0, 0);
}

enum { WIDTH = 40, HEIGHT = 25 };

// Random pixels, every other one opaque.
static struct pel_image *random_image(uint64_t *random) {
    struct pel_image *image = pel_image_create(WIDTH, HEIGHT);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double alpha = i % 2 ? 1 : test_random(random);
        for (int c = 0; c < 4; c++)
            image->rgba[4 * i + c] = (float)(c < 3 ? alpha * test_random(random) : alpha);
    }
    return image;
}

static void widen(double out[4], const struct pel_image *image, int i) {
    for (int c = 0; c < 4; c++)
        out[c] = image->rgba[4 * i + c];
}

static void test_reference(void **state) {
    (void)state;
    uint64_t random = 5;
    struct pel_image *left = random_image(&random), *right = random_image(&random);
    for (int kind = FIRST; kind <= LAST; kind++) {
        struct pel_stereo stereo = stereo_of(kind);
        struct pel_image *image = pel_stereo_compose(&stereo, left, right);
        assert_non_null(image);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            double eyes[2][4], expected[4];
            widen(eyes[0], left, i);
            widen(eyes[1], right, i);
            reference_anaglyph(expected, &stereo, eyes[0], eyes[1]);
            for (int c = 0; c < 4; c++)
                if (!(fabs(image->rgba[4 * i + c] - expected[c]) < 1e-5))
                    fail_msg("%s: channel %d is %g, not %g", pel_stereo_names()[kind], c,
                             image->rgba[4 * i + c], expected[c]);
        }
        pel_image_destroy(image);
    }
    pel_image_destroy(left);
    pel_image_destroy(right);
}

static void count_warning(const char *message, void *user) {
    assert_non_null(strstr(message, "row of green sums to 0.5"));
    ++*(int *)user;
}

static void test_user_matrix(void **state) {
    (void)state;
    static const float white[4] = {1, 1, 1, 1};
    int warnings = 0;
    float out[4];
    struct pel_stereo stereo = stereo_of(PEL_STEREO_MATRIX);
    pel_on_warning(count_warning, &warnings);
    compose(out, &stereo, white, white);
    assert_int_equal(warnings, 0);
    stereo.matrix[1][1] = 0;
    compose(out, &stereo, white, white);
    assert_int_equal(warnings, 1);
    assert_pixel(out, 1, 0.735357, 1, 1);
    pel_on_warning(NULL, NULL);

    struct pel_image *image = pixel(white);
    stereo.matrix[2][5] = NAN;
    assert_null(pel_stereo_compose(&stereo, image, image));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    pel_image_destroy(image);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_white),       cmocka_unit_test(test_by_hand),
        cmocka_unit_test(test_alpha),       cmocka_unit_test(test_reference),
        cmocka_unit_test(test_user_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
