// state.c - what the viewer knows.
#include "viewer/state.h"

#include <stdarg.h>
#include <stdio.h>

void pel_state_renew(struct pel_state *state) {
    state->version++;
    state->picked = false;
    state->changed_ms = pel_clock_ms();
    state->redraw = true;
}

void pel_state_change(struct pel_state *state, const char *what) {
    // What is worked on is the scene.
    pel_film_leave(state, false);
    state->slices_old = true;
    if (!pel_history_record(state->history, state->scene, what, state->gesture))
        pel_state_say(state, "this cannot be undone: %s", pel_error_message());
    pel_state_renew(state);
}

void pel_state_begin_gesture(struct pel_state *state) {
    pel_history_settle(state->history);
    state->gesture++;
}

void pel_state_move_camera(struct pel_state *state) {
    bool slices_old = state->slices_old;
    state->scene->camera = state->navigation.camera;
    pel_state_change(state, "move the camera");
    // Slices do not depend on it.
    state->slices_old = slices_old;
}

void pel_state_set_scene(struct pel_state *state, struct pel_scene *scene) {
    pel_film_leave(state, false);
    pel_scene_destroy(state->scene);
    state->scene = scene;
    if (state->selected >= scene->instance_count)
        state->selected = scene->instance_count - 1;
    pel_navigation_set(&state->navigation, &scene->camera);
    state->slices_old = true;
    pel_state_renew(state);
}

bool pel_state_view(const struct pel_state *state, int number, struct pel_view *view) {
    const int *whole = state->views[number].whole;
    return pel_view_make(view, &pel_film_shown(state)->camera, whole[0], whole[1]);
}

bool pel_state_gizmo(const struct pel_state *state, struct pel_gizmo *gizmo) {
    struct pel_view view;
    return state->handles && state->with_panels && pel_state_view(state, 0, &view) &&
           pel_gizmo_make(gizmo, state->scene, state->selected, &view, 90 * state->windows[0].scale,
                          false);
}

bool pel_state_clip_gizmo(const struct pel_state *state, struct pel_gizmo *gizmo) {
    struct pel_view view;
    return state->with_panels && state->clip > 0 && state->clip <= state->scene->clip_count &&
           pel_state_view(state, 0, &view) &&
           pel_clip_gizmo(gizmo, &state->scene->clips[state->clip - 1], &view,
                          70 * state->windows[0].scale);
}

int pel_state_picture_in(const struct pel_state *state, int window) {
    for (int i = 0; i < state->picture_count; i++)
        if (state->views[i].window == window)
            return i;
    return -1;
}

int pel_state_cube(const struct pel_state *state, struct pel_cube_face faces[3]) {
    int last = state->picture_count - 1;
    const struct pel_rectangle *place = &state->views[last].place;
    double edge_px = 44 * state->windows[0].scale;
    const double centre[2] = {place->x + place->width - 1.1 * edge_px,
                              place->y + place->height - 1.1 * edge_px};
    struct pel_view view;
    if (!state->readouts || !state->with_panels || !pel_state_view(state, last, &view))
        return 0;
    return pel_orientation_cube(faces, &view, centre, edge_px);
}

double pel_state_aspect(const struct pel_state *state) {
    const int *whole = state->views[0].whole;
    return whole[1] > 0 ? (double)whole[0] / whole[1] : 1;
}

void pel_state_say(struct pel_state *state, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(state->message, sizeof state->message, format, arguments);
    va_end(arguments);
    state->message_ms = pel_clock_ms();
    state->redraw = true;
}
