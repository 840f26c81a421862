// Tests of world/scene_override.c: what an override makes of a scene, and which keys it decides.
#include "support/test.h"

#include "world/scene_override.h"

// Applies overrides to `before` and compares with `after`; both in JSON with ' for ".
static json_t *parse(const char *quoted) {
    char text[512];
    snprintf(text, sizeof text, "%s", quoted);
    for (char *at = text; *at; at++)
        if (*at == '\'')
            *at = '"';
    json_t *value = json_loads(text, 0, NULL);
    assert_non_null(value);
    return value;
}

static void expect(const char *before, const char *override, const char *after) {
    json_t *scene = parse(before), *wanted = parse(after);
    if (!pel_scene_override(scene, override))
        fail_msg("%s: %s", override, pel_error_message());
    char *text = json_dumps(scene, JSON_COMPACT);
    if (!json_equal(scene, wanted))
        fail_msg("%s with %s is %s", before, override, text);
    free(text);
    json_decref(scene);
    json_decref(wanted);
}

static void expect_failure(const char *before, const char *override, const char *message) {
    json_t *scene = parse(before), *untouched = parse(before);
    assert_false(pel_scene_override(scene, override));
    assert_string_equal(pel_error_message(), message);
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_true(json_equal(scene, untouched));
    json_decref(scene);
    json_decref(untouched);
}

static void test_values(void **state) {
    (void)state;
    expect("{'a':1}", "a=2", "{'a':2}");
    expect("{'a':1}", "a=2.5e1", "{'a':25.0}");
    expect("{'a':1}", "a=true", "{'a':true}");
    expect("{'a':1}", "a=word", "{'a':'word'}");
    expect("{'a':1}", "a=two words=x", "{'a':'two words=x'}");
    expect("{'a':1}", "a=\"2\"", "{'a':'2'}");
    expect("{'a':1}", "a=[1,{\"b\":2}]", "{'a':[1,{'b':2}]}");
    expect("{'a':1}", "a=#ff0000", "{'a':'#ff0000'}");
    expect("{'a':1}", "a=", "{'a':''}");
    expect("{'a':1}", "a=.5", "{'a':'.5'}");
}

static void test_paths(void **state) {
    (void)state;
    expect("{}", "a.b.c=1", "{'a':{'b':{'c':1}}}");
    expect("{'a':{'b':1,'d':2}}", "a.b=3", "{'a':{'b':3,'d':2}}");
    expect("{'v':[{'d':1},{'d':2}]}", "v.1.d=3", "{'v':[{'d':1},{'d':3}]}");
    expect("{'v':[{'d':1},{'d':2}]}", "v.*.d=3", "{'v':[{'d':3},{'d':3}]}");
    expect("{'v':[{'d':1}]}", "v.1.d=3", "{'v':[{'d':1},{'d':3}]}");
    expect("{}", "v.0.d=3", "{'v':[{'d':3}]}");
    expect("{'v':[1,2,3]}", "v.1=9", "{'v':[1,9,3]}");
}

static void test_removal(void **state) {
    (void)state;
    expect("{'a':1,'b':2}", "a=null", "{'b':2}");
    expect("{'b':2}", "a=null", "{'b':2}");
    expect("{'v':[1,2,3]}", "v.1=null", "{'v':[1,3]}");
    expect("{'v':[1,2,3]}", "v.*=null", "{'v':[]}");
}

static void test_failures(void **state) {
    (void)state;
    expect_failure("{}", "a", "--set a: must be KEY=VALUE");
    expect_failure("{}", "=1", "--set =1: must be KEY=VALUE");
    expect_failure("{'a':{}}", "a..b=1", "--set a..b=1: a step of the key is empty");
    expect_failure("{'a':5}", "a.b=1", "--set a.b=1: 'b' would be inside a plain value");
    expect_failure("{'v':[1]}", "v.2=1", "--set v.2=1: no element 2 in a list of 1");
    expect_failure("{'v':[1]}", "v.1=null", "--set v.1=null: no element 1 in a list of 1");
    expect_failure("{'v':[1]}", "v.x=1", "--set v.x=1: 'x' is not an index of a list");
    expect_failure("{'v':[1]}", "v.-1=1", "--set v.-1=1: '-1' is not an index of a list");
    expect_failure("{'v':[1]}", "v.99999999999999999999=1",
                   "--set v.99999999999999999999=1: '99999999999999999999' is not an index of a "
                   "list");
    expect_failure("{}", "a=[1,", "--set a=[1,: ']' expected near end of file");
    expect_failure("{}", "a=\xff", "--set a=\xff: the value is not valid UTF-8");
    expect_failure("{}", "\xff=1", "--set \xff=1: '\xff' is not valid UTF-8");
}

static void test_too_deep(void **state) {
    (void)state;
    char override[512] = "a";
    for (int i = 0; i < 100; i++)
        strcat(override, ".a");
    strcat(override, "=1");
    json_t *scene = json_object();
    assert_false(pel_scene_override(scene, override));
    assert_non_null(strstr(pel_error_message(), "the key has more than 32 steps"));
    json_decref(scene);
}

static void test_covers(void **state) {
    (void)state;
    assert_true(pel_scene_override_covers("a.b=1", "a.b"));
    assert_true(pel_scene_override_covers("a.b=[1]", "a.b.0"));
    assert_true(pel_scene_override_covers("v.*.d=1", "v.12.d"));
    assert_false(pel_scene_override_covers("a.b=1", "a"));
    assert_false(pel_scene_override_covers("a.b=1", "a.bc"));
    assert_false(pel_scene_override_covers("a.bc=1", "a.b"));
    assert_false(pel_scene_override_covers("v.*.d=1", "v.x.d"));
    assert_false(pel_scene_override_covers("v.*.d=1", "v.1.e"));
    assert_true(pel_scene_override_touches("a.b=1", "a"));
    assert_true(pel_scene_override_touches("a.b=1", "a.b"));
    assert_true(pel_scene_override_touches("a.b=1", ""));
    assert_false(pel_scene_override_touches("a.b=1", "c"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),   cmocka_unit_test(test_paths),
        cmocka_unit_test(test_removal),  cmocka_unit_test(test_failures),
        cmocka_unit_test(test_too_deep), cmocka_unit_test(test_covers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
