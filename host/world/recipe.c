// recipe.c - hypertexture recipes by name, from files, and as text.
#include "world/recipe.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "world/recipe_compile.h"
#include "world/recipe_table.h"

enum { FILE_LIMIT = 1 << 20 };

// `source` is what the text is called in messages.
static bool compile_text(struct recipe *program, const char *text, size_t bytes,
                         const char *source) {
    json_error_t error;
    json_t *json = json_loadb(text, bytes, JSON_REJECT_DUPLICATES | JSON_DECODE_ANY, &error);
    if (!json)
        return pel_fail(PEL_ERROR_FORMAT, "%s:%d:%d: %s", source, error.line, error.column,
                        error.text);
    char key[PEL_RECIPE_KEY_BYTES];
    bool good = pel_recipe_compile_json(program, json, key);
    json_decref(json);
    if (good)
        return true;
    int line, column;
    pel_text_locate(text, key, &line, &column);
    return pel_fail_in("%s:%d:%d%s%s", source, line, column, *key ? ": " : "", key);
}

static bool compile_file(struct recipe *program, const char *path) {
    size_t bytes;
    char *text = pel_file_read(path, FILE_LIMIT, &bytes);
    bool good = text && compile_text(program, text, bytes, path);
    free(text);
    return good;
}

static bool compile_preset(struct recipe *program, const char *name) {
    const char *const *names = pel_recipe_presets();
    for (const struct pel_recipe_file *file = pel_recipe_table; file->name; file++) {
        size_t length = strlen(name);
        if (strncmp(file->name, name, length) == 0 && strcmp(file->name + length, ".json") == 0)
            return compile_text(program, file->text, strlen(file->text), file->name);
    }
    const char *nearest = pel_text_nearest(name, names);
    if (nearest)
        return pel_fail(PEL_ERROR_ARGUMENT, "no recipe '%s'; did you mean '%s'", name, nearest);
    char list[256];
    pel_text_list(list, sizeof list, names, pel_text_count(names), " and ");
    return pel_fail(PEL_ERROR_ARGUMENT, "no recipe '%s'; there are %s, and files, *.json", name,
                    list);
}

bool pel_recipe_compile(struct recipe *program, const char *recipe) {
    if (recipe[strspn(recipe, " \t\r\n")] == '{')
        return compile_text(program, recipe, strlen(recipe), "recipe");
    if (strchr(recipe, '/') || pel_path_has_extension(recipe, ".json"))
        return compile_file(program, recipe);
    return compile_preset(program, recipe);
}

bool pel_recipe_needs_object(const struct recipe *program) {
    for (int i = 0; i < program->length; i++)
        if (program->code[i].op == RECIPE_OBJECT || program->code[i].op == RECIPE_OBJECT_VALUE)
            return true;
    return false;
}

const char *const *pel_recipe_presets(void) {
    static const char *const names[] = {"noisy-sphere", "fireball",    "marble",
                                        "tribble",      "eroded-cube", "cloud",
                                        "wood",         "smoke",       NULL};
    return names;
}
