// Lists of words, the nearest word, and places in JSON text.
#include "support/test.h"

#include "base/text.h"

static const char *const known[] = {"camera", "background", "volumes", "render", "output",
                                    "colour", "fov",        "eye",     NULL};

static void test_lists(void **state) {
    (void)state;
    char text[64];
    assert_int_equal(pel_text_count(known), 8);
    assert_int_equal(pel_text_count(known + 8), 0);
    pel_text_list(text, sizeof text, known, 3, " or ");
    assert_string_equal(text, "camera, background or volumes");
    pel_text_list(text, sizeof text, known, 1, " or ");
    assert_string_equal(text, "camera");
    pel_text_list(text, sizeof text, known, 0, " or ");
    assert_string_equal(text, "");
    char cut[12];
    pel_text_list(cut, sizeof cut, known, 8, " and ");
    assert_string_equal(cut, "camera, bac");
}

static void test_finds_slips(void **state) {
    (void)state;
    assert_string_equal(pel_text_nearest("camera", known), "camera");
    assert_string_equal(pel_text_nearest("Camera", known), "camera");
    assert_string_equal(pel_text_nearest("volume", known), "volumes");
    assert_string_equal(pel_text_nearest("volmues", known), "volumes");
    assert_string_equal(pel_text_nearest("color", known), "colour");
    assert_string_equal(pel_text_nearest("backgroud", known), "background");
    assert_string_equal(pel_text_nearest("backround_", known), "background");
    assert_string_equal(pel_text_nearest("fvo", known), "fov");
}

static void test_does_not_guess_wildly(void **state) {
    (void)state;
    assert_null(pel_text_nearest("banana", known));
    assert_null(pel_text_nearest("", known));
    assert_null(pel_text_nearest("x", known));
    assert_null(pel_text_nearest("lens", known));
    char endless[4096];
    memset(endless, 'c', sizeof endless);
    endless[sizeof endless - 1] = 0;
    assert_null(pel_text_nearest(endless, known));
    assert_null(pel_text_nearest("camera", (const char *const[]){NULL}));
}

static void test_prefers_the_nearest_and_then_the_first(void **state) {
    (void)state;
    assert_string_equal(pel_text_nearest("stepp", (const char *const[]){"stop", "step", NULL}),
                        "step");
    assert_string_equal(pel_text_nearest("cat", (const char *const[]){"bat", "hat", NULL}), "bat");
}

static const char scene[] = "{\n"
                            "  \"a]{\": \"brackets ]}[ and \\\" quotes, {\",\n"
                            "  \"camera\": {\"fov\": 30, \"eye\": [1, 2, 3]},\n"
                            "  \"volumes\": [\n"
                            "    {\"file\": \"a\"},\n"
                            "    {\"file\": \"\xc3\xa4\xc3\xb6\", \"density\": -1.5e3}\n"
                            "  ]\n"
                            "}\n";

static void check_place(const char *path, bool found, int line, int column) {
    int got_line = 0, got_column = 0;
    bool got = pel_text_locate(scene, path, &got_line, &got_column);
    if (got != found || got_line != line || got_column != column)
        fail_msg("'%s' is at %d:%d (%d), not %d:%d (%d)", path, got_line, got_column, got, line,
                 column, found);
}

static void test_locates(void **state) {
    (void)state;
    check_place("", true, 1, 1);
    check_place("a]{", true, 2, 3);
    check_place("camera", true, 3, 3);
    check_place("camera.fov", true, 3, 14);
    check_place("camera.eye", true, 3, 25);
    check_place("camera.eye.0", true, 3, 33);
    check_place("camera.eye.2", true, 3, 39);
    check_place("volumes.0", true, 5, 5);
    check_place("volumes.1.file", true, 6, 6);
    // Columns count characters: the umlauts have two bytes each.
    check_place("volumes.1.density", true, 6, 20);
}

static void test_locates_the_deepest_part(void **state) {
    (void)state;
    check_place("lights", false, 1, 1);
    check_place("camera.lens.f", false, 3, 3);
    check_place("camera.fov.x", false, 3, 14);
    check_place("camera.eye.3", false, 3, 25);
    check_place("volumes.x", false, 4, 3);
    check_place("volumes.7.file", false, 4, 3);
}

static void test_locates_in_nothing(void **state) {
    (void)state;
    int line, column;
    assert_false(pel_text_locate("", "a.b", &line, &column));
    assert_false(pel_text_locate("{\"a", "a.b", &line, &column));
    assert_false(pel_text_locate("{\"a\\", "b", &line, &column));
    assert_false(pel_text_locate("[[[", "0.0.0.0", &line, &column));
    assert_true(pel_text_locate("7", "", &line, &column));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lists),
        cmocka_unit_test(test_finds_slips),
        cmocka_unit_test(test_does_not_guess_wildly),
        cmocka_unit_test(test_prefers_the_nearest_and_then_the_first),
        cmocka_unit_test(test_locates),
        cmocka_unit_test(test_locates_the_deepest_part),
        cmocka_unit_test(test_locates_in_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
