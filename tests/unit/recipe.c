// Tests of the recipe compiler: programs, what it refuses, and where it says that is.
#include "support/test.h"

#include "world/recipe.h"

static void expect_code(const char *text, const struct instruction *code, int length) {
    struct recipe program;
    if (!pel_recipe_compile(&program, text))
        fail_msg("%s", pel_error_message());
    assert_int_equal(program.length, length);
    for (int i = 0; i < length; i++) {
        assert_int_equal(program.code[i].op, code[i].op);
        assert_true(program.code[i].value == code[i].value);
    }
}

#define EXPECT_CODE(text, ...)                                                                     \
    do {                                                                                           \
        const struct instruction code[] = {__VA_ARGS__};                                           \
        expect_code(text, code, sizeof code / sizeof *code);                                       \
    } while (0)

static void test_programs(void **state) {
    (void)state;
    EXPECT_CODE("{\"value\": 0.5}", {RECIPE_CONSTANT, 0.5f});
    EXPECT_CODE("{\"value\": [\"-\", \"x\"]}", {RECIPE_X, 0}, {RECIPE_NEGATE, 0});
    EXPECT_CODE("{\"value\": [\"-\", \"x\", \"y\", 2]}", {RECIPE_X, 0}, {RECIPE_Y, 0},
                {RECIPE_SUBTRACT, 0}, {RECIPE_CONSTANT, 2}, {RECIPE_SUBTRACT, 0});
    EXPECT_CODE("{\"value\": [\"fbm\", 3, 5]}", {RECIPE_CONSTANT, 3}, {RECIPE_FBM, 5});
    EXPECT_CODE("{\"define\": {\"a\": \"time\", \"b\": [\"sin\", \"a\"]}, \"value\": \"b\"}",
                {RECIPE_TIME, 0}, {RECIPE_STORE, 0}, {RECIPE_LOAD, 0}, {RECIPE_SIN, 0},
                {RECIPE_STORE, 1}, {RECIPE_LOAD, 1});
    EXPECT_CODE("{\"value\": [\"at\", [1, \"y\", \"radius\"], [\"noise\", \"z\"]]}",
                {RECIPE_CONSTANT, 1}, {RECIPE_Y, 0}, {RECIPE_RADIUS, 0}, {RECIPE_MOVE, 0},
                {RECIPE_Z, 0}, {RECIPE_NOISE, 1}, {RECIPE_RETURN, 0});
}

static void expect_failure(const char *text, enum pel_error code, const char *message) {
    struct recipe program;
    if (pel_recipe_compile(&program, text))
        fail_msg("taken: %s", text);
    if (!strstr(pel_error_message(), message))
        fail_msg("'%s' is not in: %s", message, pel_error_message());
    assert_int_equal(pel_error_code(), code);
}

static void test_refusals(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"{", "recipe:1:"},
        {"{}", "recipe:1:1: 'value' is missing"},
        {"{\"value\": 1, \"value\": 2}", "duplicate"},
        {"{\"valeu\": 1}", "recipe:1:2: valeu: unknown key 'valeu'; did you mean 'value'"},
        {"{\"value\": true}", "value: expected a number, a name or [\"operation\", ...]"},
        {"{\"value\": {}}", "value: expected a number"},
        {"{\"value\": 1e300}", "value: 1e+300 is more than a float holds"},
        {"{\"value\": []}", "value: expected [\"operation\", operands...]"},
        {"{\"value\": [1, 2]}", "value: expected [\"operation\""},
        {"{\"value\":\n [\"nosie\", 2]}", "recipe:1:2: value: unknown operation 'nosie'; did you "
                                          "mean 'noise'"},
        {"{\"value\": [\"+\", 1,\n [\"sin\", \"radus\"]]}",
         "recipe:2:10: value.2.1: unknown name 'radus'; did you mean 'radius'"},
        {"{\"value\": [\"sin\", 1, 2]}", "value: expected [\"sin\", a]"},
        {"{\"value\": [\"+\", 1]}", "value: expected [\"+\", a, b, ...]"},
        {"{\"value\": [\"-\"]}", "value: expected [\"-\", a, b, ...]"},
        {"{\"value\": [\"sphere\", 1]}", "value: expected [\"sphere\", radius, softness]"},
        {"{\"value\": [\"fbm\", 1, 13]}", "value.2: expected a whole number in 1..12"},
        {"{\"value\": [\"fbm\", 1, 2.5]}", "value.2: expected a whole number"},
        {"{\"value\": [\"fbm\", 1, \"x\"]}", "value.2: expected a whole number"},
        {"{\"value\": [\"worley\", 1, 5]}", "value.2: expected a whole number in 1..4"},
        {"{\"value\": [\"worley\", 1, 0]}", "value.2: expected a whole number in 1..4"},
        {"{\"value\": [\"at\", [1, 2], 3]}", "value.1: expected a position [x, y, z]"},
        {"{\"value\": [\"at\", [1, 2, \"q\"], 3]}", "value.1.2: unknown name 'q'"},
        {"{\"define\": 1, \"value\": 1}", "define: expected an object"},
        {"{\"define\": {\"time\": 1}, \"value\": 1}", "define.time: 'time' has a meaning already"},
        {"{\"define\": {\"a\": \"b\", \"b\": 1}, \"value\": 1}", "define.a: unknown name 'b'"},
        {"{\"define\": {\"a\": \"a\"}, \"value\": 1}", "define.a: unknown name 'a'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_failure(cases[i][0], PEL_ERROR_FORMAT, cases[i][1]);
    expect_failure("fierball", PEL_ERROR_ARGUMENT, "no recipe 'fierball'; did you mean 'fireball'");
    expect_failure("fire", PEL_ERROR_ARGUMENT, "no recipe 'fire'");
    expect_failure("", PEL_ERROR_ARGUMENT, "no recipe ''");
    expect_failure("nowhere/none.json", PEL_ERROR_FILE, "nowhere/none.json");
}

// Writes `before` so often, then `middle`, then `after` as often.
static char *nested(const char *begin, const char *before, const char *middle, const char *after,
                    const char *end, int count) {
    static char text[65536];
    char *at = text + sprintf(text, "%s", begin);
    for (int i = 0; i < count; i++)
        at += sprintf(at, "%s", before);
    at += sprintf(at, "%s", middle);
    for (int i = 0; i < count; i++)
        at += sprintf(at, "%s", after);
    sprintf(at, "%s", end);
    return text;
}

// The greatest program that fits is taken, and the next one refused.
static void test_limits(void **state) {
    (void)state;
    struct recipe program;
    const char *begin = "{\"value\": ", *end = "}";
    const char *sum[] = {"[\"+\", 1, ", "1", "]"}, *minus[] = {"[\"-\", ", "1", "]"};
    const char *at[] = {"[\"at\", [1, 1, 1], ", "1", "]"};
    assert_true(pel_recipe_compile(
        &program, nested(begin, sum[0], sum[1], sum[2], end, RECIPE_STACK_MAX - 1)));
    expect_failure(nested(begin, sum[0], sum[1], sum[2], end, RECIPE_STACK_MAX), PEL_ERROR_FORMAT,
                   "more than 16 numbers at once");
    assert_true(pel_recipe_compile(&program, nested(begin, minus[0], minus[1], minus[2], end, 63)));
    expect_failure(nested(begin, minus[0], minus[1], minus[2], end, 64), PEL_ERROR_FORMAT,
                   "more than 64 operations within each other");
    assert_true(
        pel_recipe_compile(&program, nested(begin, at[0], at[1], at[2], end, RECIPE_PLACE_MAX)));
    expect_failure(nested(begin, at[0], at[1], at[2], end, RECIPE_PLACE_MAX + 1), PEL_ERROR_FORMAT,
                   "more than 4 positions within each other");
    // "+" of n + 1 numbers is 2 n + 1 operations, and a minus sign one more.
    assert_true(pel_recipe_compile(
        &program, nested("{\"value\": [\"-\", [\"+\", 1", ", 1", "", "", "]]}", 127)));
    assert_int_equal(program.length, RECIPE_CODE_MAX);
    expect_failure(nested("{\"value\": [\"+\", 1", ", 1", "", "", "]}", 128), PEL_ERROR_FORMAT,
                   "more than 256 operations");
}

static void test_definitions(void **state) {
    (void)state;
    struct recipe program;
    char text[1024] = "{\"define\": {", *at = text + strlen(text);
    for (int i = 0; i < RECIPE_NAME_MAX; i++)
        at += sprintf(at, "%s\"n%d\": 1", i ? ", " : "", i);
    strcpy(at, "}, \"value\": 1}");
    assert_true(pel_recipe_compile(&program, text));
    strcpy(at, ", \"last\": 1}, \"value\": 1}");
    expect_failure(text, PEL_ERROR_FORMAT, "define.last: more than 16 definitions");
}

// Every preset compiles, and from its file just so.
static void test_presets(void **state) {
    (void)state;
    int count = 0;
    for (const char *const *name = pel_recipe_presets(); *name; name++, count++) {
        struct recipe program = {.length = 0}, from_file = {.length = 0};
        char path[1024];
        snprintf(path, sizeof path, "%s/scenes/recipes/%s.json", TEST_SOURCE, *name);
        if (!pel_recipe_compile(&program, *name) || !pel_recipe_compile(&from_file, path))
            fail_msg("%s", pel_error_message());
        assert_memory_equal(&program, &from_file, sizeof program);
        assert_false(pel_recipe_needs_object(&program));
    }
    assert_int_equal(count, 8);
    struct recipe program;
    assert_true(pel_recipe_compile(&program, "{\"value\": [\"+\", 1, \"object\"]}"));
    assert_true(pel_recipe_needs_object(&program));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_programs), cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_limits),   cmocka_unit_test(test_definitions),
        cmocka_unit_test(test_presets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
