// history.c - a row of scenes, oldest first; `present` is where in it the user is.
#include "viewer/history.h"

#include <stdlib.h>
#include <string.h>

// What was done to the scene before to make this one.
struct step {
    struct pel_scene *scene;
    char name[64];
    uint64_t merge;
};

struct pel_history {
    struct step *steps;
    int capacity, count, present;
    int saved; // the step that is on disk; -1 when it is none of these
};

static void drop(struct pel_history *history, int first, int count) {
    for (int i = first; i < first + count; i++)
        pel_scene_destroy(history->steps[i].scene);
    int behind = history->count - first - count;
    memmove(&history->steps[first], &history->steps[first + count],
            (size_t)behind * sizeof *history->steps);
    history->count -= count;
    if (history->saved >= first)
        history->saved = history->saved < first + count ? -1 : history->saved - count;
}

struct pel_history *pel_history_create(const struct pel_scene *scene, int steps_max) {
    struct pel_history *history = calloc(1, sizeof *history);
    if (!history)
        return NULL;
    // One more than there are steps between them, and one that is made before the oldest goes.
    history->capacity = (steps_max > 1 ? steps_max : 1) + 1;
    history->steps = calloc((size_t)history->capacity + 1, sizeof *history->steps);
    struct pel_scene *copy = history->steps ? pel_scene_copy(scene) : NULL;
    if (!copy) {
        pel_history_destroy(history);
        return NULL;
    }
    history->steps[0].scene = copy;
    history->count = 1;
    return history;
}

void pel_history_destroy(struct pel_history *history) {
    if (!history)
        return;
    for (int i = 0; i < history->count; i++)
        pel_scene_destroy(history->steps[i].scene);
    free(history->steps);
    free(history);
}

bool pel_history_record(struct pel_history *history, const struct pel_scene *scene,
                        const char *what, uint64_t merge) {
    struct pel_scene *copy = pel_scene_copy(scene);
    if (!copy)
        return false;
    int behind = history->count - history->present - 1;
    struct step *top = &history->steps[history->present];
    if (merge && behind == 0 && top->merge == merge) {
        pel_scene_destroy(top->scene);
        top->scene = copy;
        if (history->saved == history->present)
            history->saved = -1;
        return true;
    }
    drop(history, history->present + 1, behind);
    struct step *step = &history->steps[history->count];
    *step = (struct step){.scene = copy, .merge = merge};
    strncpy(step->name, what, sizeof step->name - 1);
    history->count++;
    if (history->count > history->capacity)
        drop(history, 0, 1);
    history->present = history->count - 1;
    return true;
}

void pel_history_settle(struct pel_history *history) {
    history->steps[history->present].merge = 0;
}

static struct pel_scene *go(struct pel_history *history, int to) {
    if (to < 0 || to >= history->count)
        return NULL;
    struct pel_scene *copy = pel_scene_copy(history->steps[to].scene);
    if (!copy)
        return NULL;
    pel_history_settle(history);
    history->present = to;
    pel_history_settle(history);
    return copy;
}

struct pel_scene *pel_history_undo(struct pel_history *history) {
    return go(history, history->present - 1);
}

struct pel_scene *pel_history_redo(struct pel_history *history) {
    return go(history, history->present + 1);
}

const char *pel_history_undo_name(const struct pel_history *history) {
    return history->present > 0 ? history->steps[history->present].name : NULL;
}

const char *pel_history_redo_name(const struct pel_history *history) {
    bool any = history->present + 1 < history->count;
    return any ? history->steps[history->present + 1].name : NULL;
}

void pel_history_mark_saved(struct pel_history *history) {
    history->saved = history->present;
    pel_history_settle(history);
}

bool pel_history_is_saved(const struct pel_history *history) {
    return history->saved == history->present;
}
