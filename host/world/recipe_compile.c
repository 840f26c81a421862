// recipe_compile.c - JSON expression trees to stack programs.
//
// A number is a constant, a text a variable or a definition, and a list an operation with its
// operands. Operands are compiled in order and the operation after them, so the program is the tree
// in postfix. Its needs of stack, places and length are known when it is compiled, and a kernel
// never has to check them.
#include "world/recipe_compile.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"

// Deeper trees are no recipes, and the compiler calls itself.
enum { DEPTH_MAX = 64, VARIADIC = -1 };

struct compiler {
    struct recipe *program; // borrowed
    const char *names[RECIPE_NAME_MAX + 1];
    int name_count, stack, places, depth;
    char *key; // of what is being compiled
};

static const char *const variables[] = {"x", "y", "z", "radius", "time", "object", "object_value",
                                        NULL};

// `operands` are those written in a recipe; with `whole`, the last of them is a constant whole
// number in 1..most that becomes part of the instruction.
static const struct operation {
    const char *name;
    int op, operands;
    bool whole;
    int most;
    const char *form;
} operations[] = {
    {"+", RECIPE_ADD, VARIADIC, false, 0, "a, b, ..."},
    {"-", RECIPE_SUBTRACT, VARIADIC, false, 0, "a, b, ..."},
    {"*", RECIPE_MULTIPLY, VARIADIC, false, 0, "a, b, ..."},
    {"min", RECIPE_MIN, VARIADIC, false, 0, "a, b, ..."},
    {"max", RECIPE_MAX, VARIADIC, false, 0, "a, b, ..."},
    {"/", RECIPE_DIVIDE, 2, false, 0, "a, b"},
    {"pow", RECIPE_POW, 2, false, 0, "a, b"},
    {"bias", RECIPE_BIAS, 2, false, 0, "b, t"},
    {"gain", RECIPE_GAIN, 2, false, 0, "g, t"},
    {"abs", RECIPE_ABS, 1, false, 0, "a"},
    {"sin", RECIPE_SIN, 1, false, 0, "a"},
    {"cos", RECIPE_COS, 1, false, 0, "a"},
    {"sqrt", RECIPE_SQRT, 1, false, 0, "a"},
    {"exp", RECIPE_EXP, 1, false, 0, "a"},
    {"floor", RECIPE_FLOOR, 1, false, 0, "a"},
    {"fract", RECIPE_FRACT, 1, false, 0, "a"},
    {"clamp", RECIPE_CLAMP, 3, false, 0, "a, low, high"},
    {"smoothstep", RECIPE_SMOOTHSTEP, 3, false, 0, "low, high, a"},
    {"mix", RECIPE_MIX, 3, false, 0, "a, b, share"},
    {"sphere", RECIPE_SPHERE, 2, false, 0, "radius, softness"},
    {"box", RECIPE_BOX, 4, false, 0, "x, y, z, softness"},
    {"torus", RECIPE_TORUS, 3, false, 0, "ring, tube, softness"},
    {"noise", RECIPE_NOISE, 1, false, 0, "frequency"},
    {"noise-1985", RECIPE_NOISE_1985, 1, false, 0, "frequency"},
    {"fbm", RECIPE_FBM, 2, true, RECIPE_OCTAVE_MAX, "frequency, octaves"},
    {"turbulence", RECIPE_TURBULENCE, 2, true, RECIPE_OCTAVE_MAX, "frequency, octaves"},
    {"ridged", RECIPE_RIDGED, 2, true, RECIPE_OCTAVE_MAX, "frequency, octaves"},
    {"worley", RECIPE_WORLEY, 2, true, 4, "frequency, which"},
    {"at", RECIPE_MOVE, 2, false, 0, "[x, y, z], expression"},
};

enum { OPERATION_COUNT = sizeof operations / sizeof *operations };

// ---- Keys --------------------------------------------------------------------------------------

// Appends ".step" to the key and returns what its length was, for leave.
static size_t enter(struct compiler *compiler, const char *step) {
    size_t length = strlen(compiler->key);
    snprintf(compiler->key + length, PEL_RECIPE_KEY_BYTES - length, "%s%s", length ? "." : "",
             step);
    return length;
}

static size_t enter_element(struct compiler *compiler, size_t index) {
    char step[24];
    snprintf(step, sizeof step, "%zu", index);
    return enter(compiler, step);
}

// Not called after a failure, so that the key stays where that was.
static void leave(struct compiler *compiler, size_t length) {
    compiler->key[length] = '\0';
}

static bool fail_unknown(const char *what, const char *word, const char *const *known) {
    const char *nearest = pel_text_nearest(word, known);
    return nearest ? pel_fail(PEL_ERROR_FORMAT, "unknown %s '%.32s'; did you mean '%s'", what, word,
                              nearest)
                   : pel_fail(PEL_ERROR_FORMAT, "unknown %s '%.32s'", what, word);
}

// ---- Code --------------------------------------------------------------------------------------

static bool emit(struct compiler *compiler, int op, double value) {
    struct recipe *program = compiler->program;
    if (program->length == RECIPE_CODE_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "the recipe has more than %d operations",
                        RECIPE_CODE_MAX);
    bool leaves_none = op == RECIPE_STORE || op == RECIPE_MOVE || op == RECIPE_RETURN;
    compiler->stack += (leaves_none ? 0 : 1) - recipe_operands(op);
    if (compiler->stack > RECIPE_STACK_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "the recipe needs more than %d numbers at once",
                        RECIPE_STACK_MAX);
    program->code[program->length++] = (struct instruction){op, (float)value};
    return true;
}

static bool compile(struct compiler *compiler, const json_t *json);

static bool compile_element(struct compiler *compiler, const json_t *list, size_t index) {
    size_t length = enter_element(compiler, index);
    if (!compile(compiler, json_array_get(list, index)))
        return false;
    leave(compiler, length);
    return true;
}

static bool compile_number(struct compiler *compiler, const json_t *json) {
    double value = json_number_value(json);
    if (!isfinite((float)value))
        return pel_fail(PEL_ERROR_FORMAT, "%g is more than a float holds", value);
    return emit(compiler, RECIPE_CONSTANT, value);
}

static bool compile_name(struct compiler *compiler, const char *name) {
    for (int i = 0; i < compiler->name_count; i++)
        if (strcmp(name, compiler->names[i]) == 0)
            return emit(compiler, RECIPE_LOAD, i);
    for (int i = 0; variables[i]; i++)
        if (strcmp(name, variables[i]) == 0)
            return emit(compiler, RECIPE_X + i, 0);
    const char *known[RECIPE_NAME_MAX + sizeof variables / sizeof *variables];
    memcpy(known, compiler->names, (size_t)compiler->name_count * sizeof *known);
    memcpy(known + compiler->name_count, variables, sizeof variables);
    return fail_unknown("name", name, known);
}

// ["+", a, b, c] is (a + b) + c, and ["-", a] is -a.
static bool compile_variadic(struct compiler *compiler, const struct operation *operation,
                             const json_t *list) {
    size_t count = json_array_size(list) - 1;
    bool negate = operation->op == RECIPE_SUBTRACT && count == 1;
    if (count < 2 && !negate)
        return pel_fail(PEL_ERROR_FORMAT, "expected [\"%s\", %s]", operation->name,
                        operation->form);
    for (size_t i = 1; i <= count; i++)
        if (!compile_element(compiler, list, i) || (i > 1 && !emit(compiler, operation->op, 0)))
            return false;
    return !negate || emit(compiler, RECIPE_NEGATE, 0);
}

// ["at", [x, y, z], expression]
static bool compile_at(struct compiler *compiler, const json_t *list) {
    const json_t *place = json_array_get(list, 1);
    size_t length = enter_element(compiler, 1);
    if (json_array_size(place) != 3)
        return pel_fail(PEL_ERROR_FORMAT, "expected a position [x, y, z]");
    for (size_t i = 0; i < 3; i++)
        if (!compile_element(compiler, place, i))
            return false;
    leave(compiler, length);
    if (compiler->places == RECIPE_PLACE_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "more than %d positions within each other",
                        RECIPE_PLACE_MAX);
    compiler->places++;
    bool good = emit(compiler, RECIPE_MOVE, 0) && compile_element(compiler, list, 2) &&
                emit(compiler, RECIPE_RETURN, 0);
    compiler->places--;
    return good;
}

static bool compile_fixed(struct compiler *compiler, const struct operation *operation,
                          const json_t *list) {
    // A noise is a sum of one octave.
    bool is_noise = operation->op == RECIPE_NOISE || operation->op == RECIPE_NOISE_1985;
    size_t compiled = (size_t)operation->operands - (operation->whole ? 1 : 0);
    for (size_t i = 1; i <= compiled; i++)
        if (!compile_element(compiler, list, i))
            return false;
    if (!operation->whole)
        return emit(compiler, operation->op, is_noise ? 1 : 0);
    size_t length = enter_element(compiler, compiled + 1);
    const json_t *last = json_array_get(list, compiled + 1);
    json_int_t value = json_integer_value(last);
    if (!json_is_integer(last) || value < 1 || value > operation->most)
        return pel_fail(PEL_ERROR_FORMAT, "expected a whole number in 1..%d", operation->most);
    leave(compiler, length);
    return emit(compiler, operation->op, (double)value);
}

static bool compile_list(struct compiler *compiler, const json_t *list) {
    const char *name = json_string_value(json_array_get(list, 0));
    if (!name)
        return pel_fail(PEL_ERROR_FORMAT, "expected [\"operation\", operands...]");
    const char *known[OPERATION_COUNT + 1] = {NULL};
    for (int i = 0; i < OPERATION_COUNT; i++) {
        const struct operation *operation = &operations[i];
        known[i] = operation->name;
        if (strcmp(name, operation->name) != 0)
            continue;
        if (operation->operands == VARIADIC)
            return compile_variadic(compiler, operation, list);
        if (json_array_size(list) != (size_t)operation->operands + 1)
            return pel_fail(PEL_ERROR_FORMAT, "expected [\"%s\", %s]", name, operation->form);
        return operation->op == RECIPE_MOVE ? compile_at(compiler, list)
                                            : compile_fixed(compiler, operation, list);
    }
    return fail_unknown("operation", name, known);
}

static bool compile(struct compiler *compiler, const json_t *json) {
    if (++compiler->depth > DEPTH_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "more than %d operations within each other", DEPTH_MAX);
    bool good;
    if (json_is_number(json))
        good = compile_number(compiler, json);
    else if (json_is_string(json))
        good = compile_name(compiler, json_string_value(json));
    else if (json_is_array(json))
        good = compile_list(compiler, json);
    else
        good = pel_fail(PEL_ERROR_FORMAT, "expected a number, a name or [\"operation\", ...]");
    compiler->depth--;
    return good;
}

// ---- Recipes -----------------------------------------------------------------------------------

static bool check_name(struct compiler *compiler, const char *name) {
    if (compiler->name_count == RECIPE_NAME_MAX)
        return pel_fail(PEL_ERROR_FORMAT, "more than %d definitions", RECIPE_NAME_MAX);
    for (int i = 0; variables[i]; i++)
        if (strcmp(name, variables[i]) == 0)
            return pel_fail(PEL_ERROR_FORMAT, "'%s' has a meaning already", name);
    return true;
}

// "define" is an object, in whose order its members are worked out.
static bool compile_definitions(struct compiler *compiler, const json_t *define) {
    size_t outer = enter(compiler, "define");
    if (!json_is_object(define))
        return pel_fail(PEL_ERROR_FORMAT, "expected an object of names and expressions");
    // jansson's iterators take a plain pointer but only read.
    for (void *entry = json_object_iter((json_t *)define); entry;
         entry = json_object_iter_next((json_t *)define, entry)) {
        const char *name = json_object_iter_key(entry);
        size_t inner = enter(compiler, name);
        if (!check_name(compiler, name) || !compile(compiler, json_object_iter_value(entry)) ||
            !emit(compiler, RECIPE_STORE, compiler->name_count))
            return false;
        compiler->names[compiler->name_count++] = name;
        leave(compiler, inner);
    }
    leave(compiler, outer);
    return true;
}

static bool check_keys(struct compiler *compiler, const json_t *json) {
    static const char *const recipe_keys[] = {"comment", "define", "value", NULL};
    if (!json_is_object(json))
        return pel_fail(PEL_ERROR_FORMAT, "expected an object with 'value'");
    for (void *entry = json_object_iter((json_t *)json); entry;
         entry = json_object_iter_next((json_t *)json, entry)) {
        const char *key = json_object_iter_key(entry);
        bool known = false;
        for (int i = 0; recipe_keys[i]; i++)
            known = known || strcmp(key, recipe_keys[i]) == 0;
        if (known)
            continue;
        enter(compiler, key);
        return fail_unknown("key", key, recipe_keys);
    }
    if (!json_object_get(json, "value"))
        return pel_fail(PEL_ERROR_FORMAT, "'value' is missing");
    return true;
}

bool pel_recipe_compile_json(struct recipe *program, const json_t *json,
                             char key[PEL_RECIPE_KEY_BYTES]) {
    struct compiler compiler = {.program = program, .key = key};
    key[0] = '\0';
    program->length = 0;
    if (!check_keys(&compiler, json))
        return false;
    const json_t *define = json_object_get(json, "define");
    if (define && !compile_definitions(&compiler, define))
        return false;
    enter(&compiler, "value");
    return compile(&compiler, json_object_get(json, "value"));
}
