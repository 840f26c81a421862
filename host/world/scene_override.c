// scene_override.c - changes a scene's JSON before it is checked.
#include "world/scene_override.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "pellucid.h"

// Scenes are shallow; a path with more steps than this is nonsense.
enum { DEPTH_MAX = 32 };

// Length of the first step of a path, which ends at a dot, at '=' or at the end.
static size_t step_length(const char *path) {
    return strcspn(path, ".=");
}

static bool step_is(const char *path, const char *name) {
    return step_length(path) == strlen(name) && strncmp(path, name, strlen(name)) == 0;
}

static bool is_index(const char *path) {
    size_t length = step_length(path);
    return length > 0 && length < 9 && strspn(path, "0123456789") == length;
}

static bool assign(json_t *container, const char *path, json_t *value, int depth);

// Follows or ends the path at one place, whose present value (or NULL) is `child`. `*made` is the
// value to put there, a new reference, or NULL when what is there stays.
static bool assign_child(json_t *child, const char *rest, json_t *value, int depth, json_t **made) {
    *made = NULL;
    if (!*rest) {
        *made = json_deep_copy(value);
        return *made || pel_fail(PEL_ERROR_MEMORY, "cannot allocate a value");
    }
    if (child)
        return assign(child, rest, value, depth + 1);
    *made = is_index(rest) ? json_array() : json_object();
    if (!*made)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate a value");
    if (assign(*made, rest, value, depth + 1))
        return true;
    json_decref(*made);
    *made = NULL;
    return false;
}

static bool assign_element(json_t *array, const char *path, json_t *value, int depth) {
    size_t length = step_length(path), count = json_array_size(array);
    const char *rest = path + length + (path[length] == '.');
    size_t first = 0, last = count;
    if (!step_is(path, "*")) {
        if (!is_index(path))
            return pel_fail(PEL_ERROR_ARGUMENT, "'%.*s' is not an index of a list", (int)length,
                            path);
        first = strtoul(path, NULL, 10);
        last = first + 1;
        if (first > count || (first == count && json_is_null(value)))
            return pel_fail(PEL_ERROR_ARGUMENT, "no element %zu in a list of %zu", first, count);
    }
    // Backwards, so that removing an element does not move those still to come.
    for (size_t i = last; i-- > first;) {
        json_t *made;
        if (!*rest && json_is_null(value)) {
            json_array_remove(array, i);
            continue;
        }
        if (!assign_child(json_array_get(array, i), rest, value, depth, &made))
            return false;
        if (made && (i < count ? json_array_set_new(array, i, made)
                               : json_array_append_new(array, made)) != 0)
            return pel_fail(PEL_ERROR_MEMORY, "cannot allocate a value");
    }
    return true;
}

static bool assign_member(json_t *object, const char *path, json_t *value, int depth) {
    size_t length = step_length(path);
    if (length == 0)
        return pel_fail(PEL_ERROR_ARGUMENT, "a step of the key is empty");
    char *key = pel_allocate(length + 1, 1);
    if (!key)
        return false;
    memcpy(key, path, length);
    const char *rest = path + length + (path[length] == '.');
    bool good = true;
    if (!*rest && json_is_null(value)) {
        json_object_del(object, key);
    } else {
        json_t *made;
        good = assign_child(json_object_get(object, key), rest, value, depth, &made);
        if (good && made && json_object_set_new(object, key, made) != 0)
            good = pel_fail(PEL_ERROR_ARGUMENT, "'%s' is not valid UTF-8", key);
    }
    free(key);
    return good;
}

static bool assign(json_t *container, const char *path, json_t *value, int depth) {
    if (depth > DEPTH_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "the key has more than %d steps", DEPTH_MAX);
    if (json_is_array(container))
        return assign_element(container, path, value, depth);
    if (json_is_object(container))
        return assign_member(container, path, value, depth);
    return pel_fail(PEL_ERROR_ARGUMENT, "'%s' would be inside a plain value", path);
}

// JSON, or else a plain word. What starts like a list, an object or a quoted string must be one.
static json_t *read_value(const char *text) {
    json_error_t error;
    json_t *value = json_loads(text, JSON_DECODE_ANY | JSON_REJECT_DUPLICATES, &error);
    if (value)
        return value;
    if (*text && strchr("{[\"", *text)) {
        pel_fail(PEL_ERROR_ARGUMENT, "%s", error.text);
        return NULL;
    }
    value = json_string(text);
    if (!value)
        pel_fail(PEL_ERROR_ARGUMENT, "the value is not valid UTF-8");
    return value;
}

// Compares step by step and leaves behind in both what remains when the shorter one has ended;
// false when they part before.
static bool walk_together(const char **override, const char **path) {
    while (**override && **override != '=' && **path) {
        size_t override_length = step_length(*override), path_length = strcspn(*path, ".");
        bool wild = step_is(*override, "*") && strspn(*path, "0123456789") == path_length;
        if (!wild &&
            (override_length != path_length || strncmp(*override, *path, path_length) != 0))
            return false;
        *override += override_length;
        *override += **override == '.';
        *path += path_length;
        *path += **path == '.';
    }
    return true;
}

bool pel_scene_override_covers(const char *override, const char *path) {
    return walk_together(&override, &path) && *override == '=';
}

bool pel_scene_override_touches(const char *override, const char *path) {
    return walk_together(&override, &path) && (*override == '=' || !*path);
}

bool pel_scene_put(json_t *scene, const char *path, const json_t *value) {
    return assign(scene, path, (json_t *)value, 0);
}

// The index of the one volume whose `name` is the first step of a path; -1 with a sentence.
static int find_volume(const json_t *volumes, const char *path) {
    int found = -1, count = 0;
    const char *names[PEL_VOLUME_MAX + 1] = {NULL};
    for (size_t i = 0; i < json_array_size(volumes) && i < PEL_VOLUME_MAX; i++) {
        const char *name = json_string_value(json_object_get(json_array_get(volumes, i), "name"));
        names[i] = name ? name : "";
        if (!name || !step_is(path, name))
            continue;
        found = (int)i;
        count++;
    }
    if (count == 1)
        return found;
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)step_length(path), path);
    const char *nearest = pel_text_nearest(word, names);
    if (count > 1)
        pel_fail(PEL_ERROR_ARGUMENT, "%d volumes are named '%s'", count, word);
    else if (nearest && *nearest)
        pel_fail(PEL_ERROR_ARGUMENT, "no volume is named '%s'; did you mean '%s'", word, nearest);
    else
        pel_fail(PEL_ERROR_ARGUMENT, "no volume is named '%s'", word);
    return -1;
}

bool pel_scene_key_resolve(char *resolved, size_t bytes, const json_t *scene, const char *path) {
    const char *stem = "volumes.", *rest = path + strlen(stem);
    int length;
    if (strncmp(path, stem, strlen(stem)) != 0 || is_index(rest) || step_is(rest, "*")) {
        length = snprintf(resolved, bytes, "%s", path);
    } else {
        int index = find_volume(json_object_get(scene, "volumes"), rest);
        if (index < 0)
            return false;
        length = snprintf(resolved, bytes, "%s%d%s", stem, index, rest + step_length(rest));
    }
    return (size_t)length < bytes ||
           pel_fail(PEL_ERROR_ARGUMENT, "the key has more than %zu bytes", bytes - 1);
}

bool pel_scene_override(json_t *scene, const char *override) {
    const char *equals = strchr(override, '=');
    if (!equals || equals == override)
        return pel_fail(PEL_ERROR_ARGUMENT, "--set %s: must be KEY=VALUE", override);
    json_t *value = read_value(equals + 1);
    char *path = value ? strndup(override, (size_t)(equals - override)) : NULL;
    if (value && !path)
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a key");
    bool good = path && assign(scene, path, value, 0);
    free(path);
    json_decref(value);
    return good || pel_fail_in("--set %s", override);
}
