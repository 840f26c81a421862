// scene_node.c - strict reading of JSON values, with errors that say where and what.
#include "world/scene_node.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/text.h"
#include "world/scene_override.h"

enum { KEY_BYTES = 256, PLACE_BYTES = 1024, VALUE_BYTES = 48 };
enum { LIST_NAMES = 24, LIST_SHOWN = 4 };

const struct pel_range pel_any_number = {.low = -PEL_COORDINATE_MAX, .high = PEL_COORDINATE_MAX};
const struct pel_range pel_positive_number = {.high = PEL_COORDINATE_MAX, .low_open = true};
const struct pel_range pel_unit_number = {.high = 1};

// ---- Places ------------------------------------------------------------------------------------

// The dotted path of a node: "volumes.0.name".
static void write_key(const struct pel_scene_node *node, size_t bytes, char key[]) {
    key[0] = '\0';
    if (!node->parent)
        return;
    write_key(node->parent, bytes, key);
    size_t used = strlen(key);
    const char *dot = used ? "." : "";
    if (node->key)
        snprintf(key + used, bytes - used, "%s%s", dot, node->key);
    else
        snprintf(key + used, bytes - used, "%s%zu", dot, node->index);
}

// The last override that satisfies `relation` with the key, since later ones win.
static const char *find_override(const struct pel_scene_document *document, const char *key,
                                 bool (*relation)(const char *override, const char *path)) {
    for (int i = document->override_count; i-- > 0;)
        if (relation(document->overrides[i], key))
            return document->overrides[i];
    return NULL;
}

static const char *override_of(const struct pel_scene_node *node) {
    char key[KEY_BYTES];
    write_key(node, sizeof key, key);
    return find_override(node->document, key, pel_scene_override_covers);
}

// Where a node is: "two.json:7:5: volumes.0.name", "--set volumes.0.name=3", or "" for a scene made
// in memory. True when it is in an override.
static bool write_place(const struct pel_scene_node *node, size_t bytes, char place[]) {
    const struct pel_scene_document *document = node->document;
    char key[KEY_BYTES];
    write_key(node, sizeof key, key);
    int line = 1, column = 1;
    const char *override = find_override(document, key, pel_scene_override_covers);
    bool written = document->text && pel_text_locate(document->text, key, &line, &column);
    if (!override && !written)
        override = find_override(document, key, pel_scene_override_touches);
    if (override) {
        size_t length = strcspn(override, "=");
        bool same = strncmp(override, key, length) == 0 && key[length] == '\0';
        snprintf(place, bytes, "--set %s%s%s", override, same ? "" : ": ", same ? "" : key);
    } else if (document->text) {
        snprintf(place, bytes, "%s:%d:%d%s%s", document->path, line, column, *key ? ": " : "", key);
    } else {
        place[0] = '\0';
    }
    return override != NULL;
}

bool pel_node_fail_in(const struct pel_scene_node *node) {
    char place[PLACE_BYTES];
    write_place(node, sizeof place, place);
    return *place ? pel_fail_in("%s", place) : false;
}

bool pel_node_fail(const struct pel_scene_node *node, const char *format, ...) {
    char message[PLACE_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    char place[PLACE_BYTES];
    bool override = write_place(node, sizeof place, place);
    pel_fail(override ? PEL_ERROR_ARGUMENT : PEL_ERROR_FORMAT, "%s%s%s", place, *place ? ": " : "",
             message);
    return false;
}

// ---- Values in sentences -----------------------------------------------------------------------

static const char *kind_of(const json_t *value) {
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "an object";
    case JSON_ARRAY:
        return "a list";
    case JSON_STRING:
        return "a text";
    case JSON_INTEGER:
    case JSON_REAL:
        return "a number";
    case JSON_TRUE:
    case JSON_FALSE:
        return "true or false";
    default:
        return "null";
    }
}

// A number or text as it is written, anything else by its kind.
static const char *describe(const json_t *value, char text[VALUE_BYTES]) {
    if (json_is_string(value))
        snprintf(text, VALUE_BYTES, "\"%.*s\"", VALUE_BYTES - 8, json_string_value(value));
    else if (json_is_number(value))
        snprintf(text, VALUE_BYTES, "%g", json_number_value(value));
    else if (json_is_boolean(value))
        snprintf(text, VALUE_BYTES, "%s", json_is_true(value) ? "true" : "false");
    else
        snprintf(text, VALUE_BYTES, "%s", kind_of(value));
    return text;
}

static bool fail_kind(const struct pel_scene_node *node, const char *wanted) {
    char text[VALUE_BYTES];
    return pel_node_fail(node, "must be %s, not %s", wanted, describe(node->value, text));
}

static bool check_range(const struct pel_scene_node *node, const struct pel_range *range,
                        double number) {
    bool low = range->low_open ? number > range->low : number >= range->low;
    bool high = range->high_open ? number < range->high : number <= range->high;
    if (low && high)
        return true;
    return pel_node_fail(node, "must be %s %g and %s %g, not %g",
                         range->low_open ? "above" : "at least", range->low,
                         range->high_open ? "below" : "at most", range->high, number);
}

static bool check_number(const struct pel_scene_node *node, const struct pel_range *range,
                         double *number) {
    if (!json_is_number(node->value))
        return fail_kind(node, "a number");
    double value = json_number_value(node->value);
    if (!check_range(node, range, value))
        return false;
    *number = value;
    return true;
}

// ---- Objects and lists -------------------------------------------------------------------------

bool pel_node_member(struct pel_scene_node *member, const struct pel_scene_node *object,
                     const char *key) {
    *member = (struct pel_scene_node){.document = object->document,
                                      .parent = object,
                                      .key = key,
                                      .value = json_object_get(object->value, key)};
    return member->value != NULL;
}

struct pel_scene_node pel_node_element(const struct pel_scene_node *array, size_t index) {
    return (struct pel_scene_node){.document = array->document,
                                   .parent = array,
                                   .index = index,
                                   .value = json_array_get(array->value, index)};
}

static bool is_known(const char *key, const char *const *keys) {
    for (; *keys; keys++)
        if (strcmp(key, *keys) == 0)
            return true;
    return false;
}

bool pel_node_check_object(const struct pel_scene_node *node, const char *const *keys) {
    if (!json_is_object(node->value))
        return fail_kind(node, "an object");
    const char *key;
    json_t *value;
    json_object_foreach(node->value, key, value) {
        if (is_known(key, keys))
            continue;
        struct pel_scene_node member;
        pel_node_member(&member, node, key);
        const char *nearest = pel_text_nearest(key, keys);
        if (nearest)
            return pel_node_fail(&member, "unknown key; did you mean '%s'", nearest);
        return pel_node_fail(&member, "unknown key");
    }
    const char *comment;
    return pel_node_get_text(node, "comment", &comment);
}

bool pel_node_check_list(const struct pel_scene_node *node, size_t least, size_t most) {
    if (!json_is_array(node->value))
        return fail_kind(node, "a list");
    size_t count = json_array_size(node->value);
    if (count >= least && count <= most)
        return true;
    if (least == most)
        return pel_node_fail(node, "must have %zu elements, not %zu", least, count);
    return pel_node_fail(node, "must have %zu to %zu elements, not %zu", least, most, count);
}

// The first name that a text is a part of.
static const char *find_part(const char *text, const char *const *names) {
    for (int i = 0; *text && names[i]; i++)
        if (strstr(names[i], text))
            return names[i];
    return NULL;
}

bool pel_node_check_name(const struct pel_scene_node *node, const char *const *names, int *which) {
    if (!json_is_string(node->value))
        return fail_kind(node, "a text");
    const char *text = json_string_value(node->value);
    for (int i = 0; names[i]; i++) {
        if (strcmp(text, names[i]) == 0) {
            *which = i;
            return true;
        }
    }
    // All names, unless that would be more than a person reads.
    char list[PLACE_BYTES / 2] = "";
    int count = pel_text_count(names), shown = count <= LIST_NAMES ? count : LIST_SHOWN;
    if (shown < count)
        snprintf(list, sizeof list, "one of %d names such as ", count);
    size_t used = strlen(list);
    pel_text_list(list + used, sizeof list - used, names, shown, " or ");
    const char *nearest = shown < count ? pel_text_nearest(text, names) : NULL;
    if (!nearest && shown < count)
        nearest = find_part(text, names);
    if (nearest)
        return pel_node_fail(node, "must be %s, not \"%.*s\"; did you mean '%s'", list, VALUE_BYTES,
                             text, nearest);
    return pel_node_fail(node, "must be %s, not \"%.*s\"", list, VALUE_BYTES, text);
}

bool pel_node_check_numbers(const struct pel_scene_node *node, size_t count,
                            const struct pel_range *range, double numbers[]) {
    if (!pel_node_check_list(node, count, count))
        return false;
    for (size_t i = 0; i < count; i++) {
        struct pel_scene_node element = pel_node_element(node, i);
        if (!check_number(&element, range, &numbers[i]))
            return false;
    }
    return true;
}

// ---- Members -----------------------------------------------------------------------------------

bool pel_node_get_bool(const struct pel_scene_node *object, const char *key, bool *value) {
    struct pel_scene_node node;
    if (!pel_node_member(&node, object, key))
        return true;
    if (!json_is_boolean(node.value))
        return fail_kind(&node, "true or false");
    *value = json_is_true(node.value);
    return true;
}

bool pel_node_get_integer(const struct pel_scene_node *object, const char *key, int low, int high,
                          int *value) {
    struct pel_scene_node node;
    if (!pel_node_member(&node, object, key))
        return true;
    double number = 0;
    if (!check_number(&node, &(struct pel_range){.low = low, .high = high}, &number))
        return false;
    if (number != floor(number))
        return fail_kind(&node, "a whole number");
    *value = (int)number;
    return true;
}

bool pel_node_get_number(const struct pel_scene_node *object, const char *key,
                         const struct pel_range *range, double *value) {
    struct pel_scene_node node;
    return !pel_node_member(&node, object, key) || check_number(&node, range, value);
}

bool pel_node_get_numbers(const struct pel_scene_node *object, const char *key, size_t count,
                          const struct pel_range *range, double values[]) {
    struct pel_scene_node node;
    return !pel_node_member(&node, object, key) ||
           pel_node_check_numbers(&node, count, range, values);
}

bool pel_node_get_text(const struct pel_scene_node *object, const char *key, const char **value) {
    struct pel_scene_node node;
    if (!pel_node_member(&node, object, key))
        return true;
    if (!json_is_string(node.value))
        return fail_kind(&node, "a text");
    *value = json_string_value(node.value);
    return true;
}

bool pel_node_get_name(const struct pel_scene_node *object, const char *key,
                       const char *const *names, int *which) {
    struct pel_scene_node node;
    return !pel_node_member(&node, object, key) || pel_node_check_name(&node, names, which);
}

char *pel_node_path(const struct pel_scene_node *node, const char *text) {
    if (override_of(node))
        return pel_copy_text(text);
    return pel_path_beside(node->document->path, text);
}
