// command.c - what keys and buttons do.
#include "viewer/command.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "viewer/screen.h"

// How long cameras take to another place.
static const double glide_s = 0.35;

static int count_names(const char *const *names) {
    int count = 0;
    while (names[count])
        count++;
    return count;
}

static struct pel_instance *selected(struct pel_state *state) {
    return &state->scene->instances[state->selected];
}

// ---- Camera ------------------------------------------------------------------------------------

static void look_from(struct pel_state *state, int number) {
    struct pel_bounds bounds;
    const char *name = pel_navigation_view_names()[number];
    if (pel_scene_bounds(state->scene, &bounds) &&
        pel_navigation_view(&state->navigation, name, &bounds, pel_state_aspect(state), glide_s))
        pel_state_move_camera(state);
}

static void fit_selected(struct pel_state *state) {
    struct pel_bounds bounds;
    pel_instance_bounds(state->scene, state->selected, &bounds);
    if (pel_navigation_fit(&state->navigation, &bounds, pel_state_aspect(state), glide_s))
        pel_state_move_camera(state);
}

static void toggle_orthographic(struct pel_state *state) {
    struct pel_bounds bounds;
    bool any = pel_scene_bounds(state->scene, &bounds);
    pel_navigation_toggle_orthographic(&state->navigation, any ? &bounds : NULL);
    pel_state_move_camera(state);
}

static void change_navigation(struct pel_state *state) {
    struct pel_navigation *navigation = &state->navigation;
    const char *const *names = pel_navigation_mode_names();
    navigation->mode = (navigation->mode + 1) % count_names(names);
    pel_state_say(state, "%s", names[navigation->mode]);
}

static bool move_camera(struct pel_state *state, enum pel_action action, int number) {
    switch (action) {
    case PEL_ACTION_VIEW:
        look_from(state, number);
        return true;
    case PEL_ACTION_RESET_VIEW:
        pel_navigation_reset(&state->navigation, glide_s);
        pel_state_move_camera(state);
        return true;
    case PEL_ACTION_FIT:
        fit_selected(state);
        return true;
    case PEL_ACTION_ORTHOGRAPHIC:
        toggle_orthographic(state);
        return true;
    case PEL_ACTION_NAVIGATION:
        change_navigation(state);
        return true;
    case PEL_ACTION_STORE:
        pel_navigation_store(&state->navigation, number);
        pel_state_say(state, "viewpoint %d stored", number + 1);
        return true;
    case PEL_ACTION_RECALL:
        if (pel_navigation_recall(&state->navigation, number, glide_s))
            pel_state_move_camera(state);
        else
            pel_state_say(state, "viewpoint %d is empty: Shift + F%d stores it", number + 1,
                          number + 5);
        return true;
    default:
        return false;
    }
}

// ---- Undo, files, the window -------------------------------------------------------------------

static void step_back(struct pel_state *state, bool back) {
    const char *name =
        back ? pel_history_undo_name(state->history) : pel_history_redo_name(state->history);
    if (!name) {
        pel_state_say(state, "nothing to %s", back ? "undo" : "redo");
        return;
    }
    char what[128];
    snprintf(what, sizeof what, "%s: %s", back ? "undone" : "redone", name);
    struct pel_scene *scene =
        back ? pel_history_undo(state->history) : pel_history_redo(state->history);
    if (scene)
        pel_state_set_scene(state, scene);
    pel_state_say(state, "%s", scene ? what : pel_error_message());
}

static void save_scene(struct pel_state *state) {
    if (!state->scene_path[0])
        snprintf(state->scene_path, sizeof state->scene_path, "scene.json");
    struct pel_scene *scene = pel_scene_copy(state->scene);
    bool good = scene != NULL, seen = true;
    if (good) {
        // The picture of the file is that of the window.
        pel_screen_fit_whole(state, scene);
        seen = pel_film_settle(scene);
        good = pel_scene_save(scene, state->scene_path);
    }
    if (good)
        pel_history_mark_saved(state->history);
    if (good && !seen)
        pel_state_say(state, "saved %s, which shows frame %g of its animation and not this view",
                      state->scene_path, scene->timeline.frame);
    else
        pel_state_say(state, "%s%s", good ? "saved " : "",
                      good ? state->scene_path : pel_error_message());
    pel_scene_destroy(scene);
}

// A name that is not taken yet.
static void choose_picture_name(char *path, size_t bytes) {
    int number = 0;
    do
        snprintf(path, bytes, "picture-%03d.png", ++number);
    while (access(path, F_OK) == 0 && number < 999);
}

// At the window's size, or at the one that the panel asks for.
static void save_picture(struct pel_state *state) {
    char path[64];
    choose_picture_name(path, sizeof path);
    struct pel_scene *scene = pel_scene_copy(state->scene);
    if (!scene) {
        pel_state_say(state, "%s", pel_error_message());
        return;
    }
    pel_screen_fit_whole(state, scene);
    if (state->save_size[0] > 0 && state->save_size[1] > 0) {
        scene->render.width = state->save_size[0];
        scene->render.height = state->save_size[1];
    }
    bool good = pel_worker_save(state->worker, scene, path);
    pel_state_say(state, "%s %s", good ? "saving" : "too many pictures wait to be saved:", path);
}

static bool use_film(struct pel_state *state, enum pel_action action) {
    switch (action) {
    case PEL_ACTION_KEYFRAME:
        pel_film_keep(state);
        return true;
    case PEL_ACTION_KEYFRAME_BACK:
        pel_film_take_back(state);
        return true;
    case PEL_ACTION_PLAY:
        pel_film_toggle(state);
        return true;
    case PEL_ACTION_LEAVE_FILM:
        pel_film_leave(state, false);
        return true;
    default:
        return false;
    }
}

static bool use_window(struct pel_state *state, enum pel_action action) {
    switch (action) {
    case PEL_ACTION_UNDO:
    case PEL_ACTION_REDO:
        step_back(state, action == PEL_ACTION_UNDO);
        return true;
    case PEL_ACTION_SAVE_SCENE:
        save_scene(state);
        return true;
    case PEL_ACTION_SAVE_PICTURE:
        save_picture(state);
        return true;
    case PEL_ACTION_HELP:
        state->help = !state->help;
        return true;
    case PEL_ACTION_PANELS:
        state->panels = !state->panels;
        if (pel_screen_layout(state))
            pel_state_renew(state);
        return true;
    case PEL_ACTION_READOUTS:
        state->readouts = !state->readouts;
        return true;
    case PEL_ACTION_FULL_SCREEN:
        pel_screen_toggle_full_screen(state);
        return true;
    case PEL_ACTION_ESCAPE:
        state->help = false;
        return true;
    case PEL_ACTION_QUIT:
        state->quit = true;
        return true;
    default:
        return false;
    }
}

// ---- Volumes -----------------------------------------------------------------------------------

static void select_other(struct pel_state *state, int by) {
    int count = state->scene->instance_count;
    state->selected = (state->selected + by + count) % count;
    pel_state_say(state, "%s", selected(state)->name);
}

static void toggle_hidden(struct pel_state *state) {
    selected(state)->hidden = !selected(state)->hidden;
    pel_state_change(state, selected(state)->hidden ? "hide" : "show");
}

// Shows the selected volume alone, or all if it is alone already.
static void toggle_solo(struct pel_state *state) {
    bool alone = !selected(state)->hidden;
    for (int i = 0; i < state->scene->instance_count; i++)
        alone = alone && (i == state->selected || state->scene->instances[i].hidden);
    for (int i = 0; i < state->scene->instance_count; i++)
        state->scene->instances[i].hidden = !alone && i != state->selected;
    pel_state_change(state, alone ? "show all" : "show one alone");
}

static void scale_density(struct pel_state *state, double by) {
    selected(state)->density *= by;
    pel_state_say(state, "%s: density %.3g", selected(state)->name, selected(state)->density);
    pel_state_change(state, "density");
}

static void move_in_list(struct pel_state *state, int by) {
    int to = state->selected + by;
    if (to < 0 || to >= state->scene->instance_count)
        return;
    if (!pel_scene_move(state->scene, state->selected, to)) {
        pel_state_say(state, "%s", pel_error_message());
        return;
    }
    state->selected = to;
    pel_state_change(state, "reorder");
}

static void remove_selected(struct pel_state *state) {
    char name[sizeof selected(state)->name];
    memcpy(name, selected(state)->name, sizeof name);
    if (!pel_scene_remove(state->scene, state->selected)) {
        pel_state_say(state, "%s", pel_error_message());
        return;
    }
    if (state->selected >= state->scene->instance_count)
        state->selected--;
    pel_state_change(state, "remove");
    pel_state_say(state, "removed %s", name);
}

static void reload(struct pel_state *state) {
    int count = 0;
    for (int i = 0; i < state->scene->volume_count; i++) {
        if (!state->scene->sources[i].file)
            continue;
        if (!pel_scene_reload(state->scene, i)) {
            pel_state_say(state, "%s", pel_error_message());
            return;
        }
        count++;
    }
    pel_state_change(state, "reload");
    pel_state_say(state, "read %d file%s again", count, count == 1 ? "" : "s");
}

static void toggle_shading(struct pel_state *state) {
    struct pel_instance *instance = selected(state);
    bool on = instance->material.shading == PEL_SHADING_NONE;
    if (on)
        instance->material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    else
        instance->material.shading = PEL_SHADING_NONE;
    pel_state_change(state, "shading");
}

static bool change_volume(struct pel_state *state, enum pel_action action) {
    switch (action) {
    case PEL_ACTION_SELECT_NEXT:
    case PEL_ACTION_SELECT_PREVIOUS:
        select_other(state, action == PEL_ACTION_SELECT_NEXT ? 1 : -1);
        return true;
    case PEL_ACTION_HIDE:
        toggle_hidden(state);
        return true;
    case PEL_ACTION_SOLO:
        toggle_solo(state);
        return true;
    case PEL_ACTION_DENSER:
    case PEL_ACTION_THINNER:
        scale_density(state, action == PEL_ACTION_DENSER ? 1.25 : 0.8);
        return true;
    case PEL_ACTION_LATER:
    case PEL_ACTION_EARLIER:
        move_in_list(state, action == PEL_ACTION_LATER ? 1 : -1);
        return true;
    case PEL_ACTION_REMOVE:
        remove_selected(state);
        return true;
    case PEL_ACTION_RELOAD:
        reload(state);
        return true;
    case PEL_ACTION_SHADING:
        toggle_shading(state);
        return true;
    default:
        return false;
    }
}

void pel_command_do(struct pel_state *state, enum pel_action action, int number) {
    if (!move_camera(state, action, number) && !use_window(state, action) &&
        !use_film(state, action) && !change_volume(state, action) &&
        !pel_command_pose(state, action, number))
        pel_command_look(state, action);
    state->redraw = true;
}

void pel_command_open(struct pel_state *state, const char *path) {
    size_t length = strlen(path);
    pel_state_begin_gesture(state);
    if (length > 5 && strcasecmp(path + length - 5, ".json") == 0) {
        struct pel_scene *scene = pel_scene_load(path, NULL, 0);
        if (scene) {
            pel_state_set_scene(state, scene);
            pel_state_change(state, "open a scene");
        }
        pel_state_say(state, "%s", scene ? path : pel_error_message());
        return;
    }
    int added = pel_scene_add_file(state->scene, path, NULL);
    if (added >= 0) {
        state->selected = added;
        pel_state_change(state, "add a volume");
    }
    pel_state_say(state, "%s", added >= 0 ? path : pel_error_message());
}
