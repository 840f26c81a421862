// fuzz_recipe.c - the compiler of hypertexture recipes: a kernel trusts its programs.
#include "support/fuzz.h"

#include <math.h>
#include <stdlib.h>

#include "world/recipe.h"

static void expect(bool holds) {
    if (!holds)
        abort();
}

// Follows the program as the kernel does, and looks at every index it would use.
static void check_program(const struct recipe *program) {
    int top = 0, place = 0, names = 0;
    expect(program->length > 0 && program->length <= RECIPE_CODE_MAX);
    for (int i = 0; i < program->length; i++) {
        int op = program->code[i].op;
        float value = program->code[i].value;
        expect(op >= RECIPE_CONSTANT && op <= RECIPE_WORLEY && isfinite(value));
        top -= recipe_operands(op);
        expect(top >= 0);
        if (op == RECIPE_STORE)
            expect(names < RECIPE_NAME_MAX && value == (float)names++);
        else if (op == RECIPE_MOVE)
            expect(++place <= RECIPE_PLACE_MAX);
        else if (op == RECIPE_RETURN)
            expect(--place >= 0);
        else
            expect(++top <= RECIPE_STACK_MAX);
        if (op == RECIPE_LOAD)
            expect(value >= 0 && value < (float)names);
        if (op >= RECIPE_NOISE)
            expect(value >= 1 && value <= RECIPE_OCTAVE_MAX);
    }
    expect(top == 1 && place == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    struct recipe program;
    if (pel_recipe_compile(&program, fuzz_file("input.json", data, size)))
        check_program(&program);
    else
        fuzz_expect_error();
    return 0;
}
