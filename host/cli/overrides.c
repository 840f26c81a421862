// overrides.c - a growing list of "key=value" strings for pel_scene_load.
#include "cli/overrides.h"

#include <ctype.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

static void fail_memory(void) {
    exit(cli_fail(PEL_ERROR_MEMORY, "cannot allocate the options"));
}

// Takes `text`.
static void append(struct overrides *overrides, char *text) {
    size_t count = (size_t)overrides->count;
    char **texts = realloc(overrides->texts, (count + 1) * sizeof *texts);
    if (!texts || !text)
        fail_memory();
    texts[count] = text;
    overrides->texts = texts;
    overrides->count++;
}

void overrides_add(struct overrides *overrides, const char *key, const char *value) {
    char *text = NULL;
    if (asprintf(&text, "%s=%s", key, value) < 0)
        fail_memory();
    append(overrides, text);
}

void overrides_add_text(struct overrides *overrides, const char *key, const char *value) {
    json_t *string = json_string(value);
    char *quoted = string ? json_dumps(string, JSON_ENCODE_ANY) : NULL;
    // What is not UTF-8 cannot be quoted as JSON; the scene reader takes it as a word.
    overrides_add(overrides, key, quoted ? quoted : value);
    free(quoted);
    json_decref(string);
}

bool overrides_add_setting(struct overrides *overrides, const char *option, const char *text) {
    const char *equals = strchr(text, '=');
    if (!equals || equals == text) {
        cli_fail(PEL_ERROR_ARGUMENT, "%s: '%s' is not of the form key=value", option, text);
        return false;
    }
    append(overrides, strdup(text));
    return true;
}

// Where the "key=..." after the first comma begins: a comma followed by a letter. Numbers have none
// there.
static char *next_pair(char *text) {
    for (char *c = strchr(text, ','); c; c = strchr(c + 1, ','))
        if (isalpha((unsigned char)c[1]))
            return c;
    return NULL;
}

static bool add_pair(struct overrides *overrides, const char *option, const char *parent,
                     char *pair) {
    char *value = strchr(pair, '=');
    if (!value || value == pair || !value[1]) {
        cli_fail(PEL_ERROR_ARGUMENT, "%s: '%s' is not of the form key=value", option, pair);
        return false;
    }
    *value++ = '\0';
    bool list = strchr(value, ',') != NULL;
    char *text = NULL;
    if (asprintf(&text, list ? "%s.%s=[%s]" : "%s.%s=%s", parent, pair, value) < 0)
        fail_memory();
    append(overrides, text);
    return true;
}

bool overrides_add_pairs(struct overrides *overrides, const char *option, const char *parent,
                         const char *text) {
    char *copy = strdup(text);
    if (!copy)
        fail_memory();
    bool good = true;
    for (char *pair = copy, *next; good && pair; pair = next) {
        next = next_pair(pair);
        if (next)
            *next++ = '\0';
        good = add_pair(overrides, option, parent, pair);
    }
    free(copy);
    return good;
}

bool overrides_add_switch(struct overrides *overrides, const char *option, const char *key,
                          const char *text) {
    if (text && strchr(text, '=')) {
        overrides_add(overrides, key, "{}");
        return overrides_add_pairs(overrides, option, key, text);
    }
    if (text && strcmp(text, "on") != 0 && strcmp(text, "off") != 0) {
        cli_fail(PEL_ERROR_ARGUMENT, "%s: '%s' is not on, off or KEY=VALUE,...", option, text);
        return false;
    }
    bool off = text && strcmp(text, "off") == 0;
    overrides_add(overrides, key, off ? "false" : "true");
    return true;
}

void overrides_finish(struct overrides *overrides) {
    for (int i = 0; i < overrides->count; i++)
        free(overrides->texts[i]);
    free(overrides->texts);
    *overrides = (struct overrides){0};
}
