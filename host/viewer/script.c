// script.c - events and camera paths from a file.
//
// A script is {"steps": [...]}; each step is an object with one verb and what belongs to it. Verbs
// that take time, such as a drag, become several steps when the file is read, so that playing is
// only a matter of waiting.
#include "viewer/script.h"

#include <errno.h>
#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/keys.h"

struct pel_script {
    struct pel_script_step *steps; // owned
    int count, capacity, at;
    double done_s; // when the step before was done
    bool started;
};

// What reading needs.
struct reader {
    struct pel_script *script;
    int number; // of the step in the file
    char *sentence;
    size_t bytes;
};

static bool fail(struct reader *reader, const char *format, ...) PEL_PRINTF(2, 3);
static bool fail(struct reader *reader, const char *format, ...) {
    int length = snprintf(reader->sentence, reader->bytes, "step %d: ", reader->number);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reader->sentence + length, reader->bytes - (size_t)length, format, arguments);
    va_end(arguments);
    return false;
}

static struct pel_script_step *append(struct reader *reader) {
    struct pel_script *script = reader->script;
    if (script->count == script->capacity) {
        int capacity = script->capacity ? 2 * script->capacity : 64;
        struct pel_script_step *steps =
            realloc(script->steps, (size_t)capacity * sizeof *script->steps);
        if (!steps) {
            fail(reader, "cannot allocate the script");
            return NULL;
        }
        script->steps = steps;
        script->capacity = capacity;
    }
    struct pel_script_step *step = &script->steps[script->count++];
    *step = (struct pel_script_step){.kind = PEL_SCRIPT_WAIT};
    return step;
}

static bool append_event(struct reader *reader, const struct pel_event *event, double delay_s) {
    struct pel_script_step *step = append(reader);
    if (!step)
        return false;
    step->kind = PEL_SCRIPT_EVENT;
    step->event = *event;
    step->delay_s = delay_s;
    return true;
}

static bool append_text(struct reader *reader, int kind, const json_t *value) {
    struct pel_script_step *step = append(reader);
    if (!step || !json_is_string(value))
        return step && fail(reader, "a text is needed");
    step->kind = kind;
    step->text = strdup(json_string_value(value));
    return step->text || fail(reader, "cannot allocate the script");
}

// ---- Values ------------------------------------------------------------------------------------

static bool read_numbers(struct reader *reader, const json_t *list, const char *what, int count,
                         double *numbers) {
    if (json_array_size(list) != (size_t)count)
        return fail(reader, "%s: %d numbers are needed", what, count);
    for (int i = 0; i < count; i++) {
        const json_t *number = json_array_get(list, (size_t)i);
        if (!json_is_number(number))
            return fail(reader, "%s: %d numbers are needed", what, count);
        numbers[i] = json_number_value(number);
    }
    return true;
}

// "ctrl+shift+z": modifiers, and the rest. Returns what comes after them.
static const char *read_modifiers(const char *text, int *modifiers) {
    static const struct {
        const char *prefix;
        int bit;
    } known[] = {{"shift+", PEL_SHIFT}, {"ctrl+", PEL_CONTROL}, {"alt+", PEL_ALT}};
    *modifiers = 0;
    for (bool found = true; found;) {
        found = false;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
            size_t length = strlen(known[i].prefix);
            if (strncmp(text, known[i].prefix, length) == 0 && text[length]) {
                *modifiers |= known[i].bit;
                text += length;
                found = true;
            }
        }
    }
    return text;
}

// "left", or "shift+right".
static bool read_button(struct reader *reader, const json_t *value, struct pel_event *event) {
    static const char *const names[] = {"left", "right", "middle"};
    const char *text = json_is_string(value) ? json_string_value(value) : "left";
    const char *name = read_modifiers(text, &event->modifiers);
    for (int i = 0; i < 3; i++) {
        if (strcmp(name, names[i]) == 0) {
            event->button = i;
            return true;
        }
    }
    return fail(reader, "no button '%.32s'; there are left, right and middle", name);
}

// ---- Verbs -------------------------------------------------------------------------------------

// {"key": "ctrl+z", "seconds": how long it is held}
static bool read_key(struct reader *reader, const json_t *value, const json_t *step) {
    if (!json_is_string(value))
        return fail(reader, "key: a text such as \"ctrl+z\" is needed");
    struct pel_event event = {.kind = PEL_EVENT_KEY, .down = true};
    const char *name = read_modifiers(json_string_value(value), &event.modifiers);
    event.key = pel_keys_from_name(name);
    if (!event.key)
        return fail(reader, "no key '%.32s'", name);
    if (!append_event(reader, &event, 0))
        return false;
    event.down = false;
    return append_event(reader, &event, json_number_value(json_object_get(step, "seconds")));
}

// {"type": "text"}: as if it was typed into a panel.
static bool read_type(struct reader *reader, const json_t *value, const json_t *step) {
    (void)step;
    if (!json_is_string(value))
        return fail(reader, "type: a text is needed");
    for (const char *c = json_string_value(value); *c; c++) {
        const struct pel_event event = {.kind = PEL_EVENT_TEXT, .text = (unsigned char)*c};
        if (!append_event(reader, &event, 0))
            return false;
    }
    return true;
}

// {"move": [x, y]}
static bool read_move(struct reader *reader, const json_t *value, const json_t *step) {
    (void)step;
    double at[2];
    if (!read_numbers(reader, value, "move", 2, at))
        return false;
    const struct pel_event event = {.kind = PEL_EVENT_POINTER, .x = at[0], .y = at[1]};
    return append_event(reader, &event, 0);
}

// {"click": [x, y], "button": "left"}
static bool read_click(struct reader *reader, const json_t *value, const json_t *step) {
    double at[2];
    struct pel_event event = {.kind = PEL_EVENT_BUTTON};
    if (!read_numbers(reader, value, "click", 2, at) ||
        !read_button(reader, json_object_get(step, "button"), &event) ||
        !read_move(reader, value, step))
        return false;
    event.x = at[0], event.y = at[1];
    // A panel sees where the pointer is before it is pressed.
    for (int i = 0; i < 2; i++) {
        event.down = i == 0;
        if (!append_event(reader, &event, 0.05))
            return false;
    }
    return true;
}

// {"drag": [x, y, x, y], "button": "left", "seconds": 0.2}
static bool read_drag(struct reader *reader, const json_t *value, const json_t *step) {
    enum { MOVES = 12 };
    double ends[4], seconds = 0.2;
    struct pel_event event = {.kind = PEL_EVENT_POINTER};
    if (!read_numbers(reader, value, "drag", 4, ends) ||
        !read_button(reader, json_object_get(step, "button"), &event))
        return false;
    if (json_is_number(json_object_get(step, "seconds")))
        seconds = json_number_value(json_object_get(step, "seconds"));
    event.x = ends[0], event.y = ends[1];
    if (!append_event(reader, &event, 0))
        return false;
    event.kind = PEL_EVENT_BUTTON;
    event.down = true;
    if (!append_event(reader, &event, 0.05))
        return false;
    event.kind = PEL_EVENT_POINTER;
    for (int i = 1; i <= MOVES; i++) {
        event.x = ends[0] + (ends[2] - ends[0]) * i / MOVES;
        event.y = ends[1] + (ends[3] - ends[1]) * i / MOVES;
        if (!append_event(reader, &event, seconds / MOVES))
            return false;
    }
    event.kind = PEL_EVENT_BUTTON;
    event.down = false;
    return append_event(reader, &event, 0.05);
}

// {"wheel": notches}: where the pointer is.
static bool read_wheel(struct reader *reader, const json_t *value, const json_t *step) {
    double at[2];
    if (!json_is_number(value) || !read_numbers(reader, json_object_get(step, "at"), "at", 2, at))
        return fail(reader, "wheel: a number is needed, and the place \"at\": [x, y]");
    const struct pel_event event = {
        .kind = PEL_EVENT_WHEEL, .wheel = json_number_value(value), .x = at[0], .y = at[1]};
    return append_event(reader, &event, 0);
}

// {"drop": "file"}
static bool read_drop(struct reader *reader, const json_t *value, const json_t *step) {
    (void)step;
    if (!append_text(reader, PEL_SCRIPT_EVENT, value))
        return false;
    reader->script->steps[reader->script->count - 1].event.kind = PEL_EVENT_DROP;
    return true;
}

// {"wait": seconds} or {"wait": "rest"}
static bool read_wait(struct reader *reader, const json_t *value, const json_t *step) {
    (void)step;
    bool rest = json_is_string(value) && strcmp(json_string_value(value), "rest") == 0;
    if (!rest && !(json_is_number(value) && json_number_value(value) >= 0))
        return fail(reader, "wait: seconds, or \"rest\"");
    struct pel_script_step *waiting = append(reader);
    if (!waiting)
        return false;
    waiting->rest = rest;
    waiting->delay_s = rest ? 0 : json_number_value(value);
    return true;
}

// {"camera": {"eye": [...], "target": [...], "up": [...], "fov": 30}, "seconds": 1}
static bool read_camera(struct reader *reader, const json_t *value, const json_t *step) {
    struct pel_camera camera = {.up = {0, 0, 1}};
    const json_t *up = json_object_get(value, "up"), *fov = json_object_get(value, "fov");
    if (!read_numbers(reader, json_object_get(value, "eye"), "camera.eye", 3, camera.eye) ||
        !read_numbers(reader, json_object_get(value, "target"), "camera.target", 3,
                      camera.target) ||
        (up && !read_numbers(reader, up, "camera.up", 3, camera.up)))
        return false;
    camera.fov_deg = json_number_value(fov);
    struct pel_script_step *glide = append(reader);
    if (!glide)
        return false;
    glide->kind = PEL_SCRIPT_CAMERA;
    glide->camera = camera;
    glide->seconds = json_number_value(json_object_get(step, "seconds"));
    return true;
}

// {"view": "anterior", "seconds": 1}
static bool read_view(struct reader *reader, const json_t *value, const json_t *step) {
    if (!append_text(reader, PEL_SCRIPT_VIEW, value))
        return false;
    reader->script->steps[reader->script->count - 1].seconds =
        json_number_value(json_object_get(step, "seconds"));
    return true;
}

// {"screenshot": "file.png"}
static bool read_screenshot(struct reader *reader, const json_t *value, const json_t *step) {
    (void)step;
    return append_text(reader, PEL_SCRIPT_SCREENSHOT, value);
}

static const struct {
    const char *name;
    bool (*read)(struct reader *reader, const json_t *value, const json_t *step);
} verbs[] = {
    {"key", read_key},
    {"type", read_type},
    {"move", read_move},
    {"click", read_click},
    {"drag", read_drag},
    {"wheel", read_wheel},
    {"drop", read_drop},
    {"wait", read_wait},
    {"camera", read_camera},
    {"view", read_view},
    {"screenshot", read_screenshot},
};

// What a step may have besides its verb.
static bool is_companion(const char *key) {
    return strcmp(key, "button") == 0 || strcmp(key, "seconds") == 0 || strcmp(key, "at") == 0 ||
           strcmp(key, "comment") == 0;
}

static bool read_step(struct reader *reader, const json_t *step) {
    const char *key;
    json_t *value;
    int found = -1;
    json_object_foreach((json_t *)step, key, value) {
        int verb = -1;
        for (size_t i = 0; i < sizeof verbs / sizeof *verbs; i++)
            if (strcmp(key, verbs[i].name) == 0)
                verb = (int)i;
        if (verb < 0 && !is_companion(key))
            return fail(reader, "unknown key '%.32s'", key);
        if (verb >= 0 && found >= 0)
            return fail(reader, "'%s' and '%s' are two steps", verbs[found].name, key);
        found = verb >= 0 ? verb : found;
    }
    if (found < 0)
        return fail(reader, "there is nothing to do");
    return verbs[found].read(reader, json_object_get(step, verbs[found].name), step);
}

// ---- Scripts -----------------------------------------------------------------------------------

void pel_script_destroy(struct pel_script *script) {
    if (!script)
        return;
    for (int i = 0; i < script->count; i++)
        free(script->steps[i].text);
    free(script->steps);
    free(script);
}

struct pel_script *pel_script_load(const char *path, char *sentence, size_t bytes) {
    json_error_t error;
    json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    const json_t *steps = json_object_get(root, "steps");
    struct pel_script *script = calloc(1, sizeof *script);
    char reason[256] = "";
    struct reader reader = {script, 0, reason, sizeof reason};
    bool good = script != NULL;
    if (!root && error.line < 1)
        snprintf(reason, sizeof reason, "%s", strerror(errno));
    else if (!root)
        snprintf(reason, sizeof reason, "line %d: %s", error.line, error.text);
    else if (!json_is_array(steps))
        snprintf(reason, sizeof reason, "a script is {\"steps\": [...]}");
    good = good && !reason[0];
    for (size_t i = 0; good && i < json_array_size(steps); i++) {
        reader.number = (int)i + 1;
        good = read_step(&reader, json_array_get(steps, i));
    }
    json_decref(root);
    if (good)
        return script;
    snprintf(sentence, bytes, "%s: %s", path, reason[0] ? reason : "cannot allocate the script");
    pel_script_destroy(script);
    return NULL;
}

bool pel_script_is_over(const struct pel_script *script) {
    return script->at == script->count;
}

const struct pel_script_step *pel_script_next(struct pel_script *script, double now_s,
                                              bool resting) {
    if (!script->started) {
        script->started = true;
        script->done_s = now_s;
    }
    if (pel_script_is_over(script))
        return NULL;
    const struct pel_script_step *step = &script->steps[script->at];
    if ((step->rest && !resting) || now_s < script->done_s + step->delay_s)
        return NULL;
    // A late step does not hurry the next one.
    script->done_s = now_s;
    script->at++;
    return step;
}
