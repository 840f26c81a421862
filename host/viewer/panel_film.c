// panel_film.c - the scene's animation: its keyframes, and playing it.
#include <stdio.h>

#include "viewer/panel.h"

// A keyframe stays between its neighbours.
static const double least_s = 0.01;

static void draw_player(struct pel_state *state) {
    const struct pel_timeline *timeline = &state->scene->timeline;
    struct pel_film *film = &state->film;
    if (timeline->frame_count == 0)
        return;
    if (pel_widget_button(film->playing ? "pause (p)" : "play (p)"))
        pel_film_toggle(state);
    pel_widget_same_line();
    if (pel_widget_button_if(film->scene != NULL, "leave (Shift + p)"))
        pel_film_leave(state, false);
    pel_widget_same_line();
    pel_widget_check("repeat", &film->repeats);
    int frame = (int)film->frame;
    if (pel_widget_slide_int("frame", &frame, 0, timeline->frame_count - 1)) {
        film->playing = false;
        pel_film_seek(state, frame);
    }
}

static void draw_keyframes(struct pel_state *state) {
    struct pel_keyframe keyframes[PEL_FILM_KEYFRAMES];
    int count = pel_scene_keyframes(state->scene, keyframes, PEL_FILM_KEYFRAMES);
    double fps = state->scene->timeline.fps;
    if (count > PEL_FILM_KEYFRAMES)
        return;
    if (count == 0 && state->scene->timeline.frame_count > 0)
        pel_widget_quiet_text("The camera has no keyframes of its own.");
    for (int i = 0; i < count; i++) {
        double low = i > 0 ? keyframes[i - 1].time_s + least_s : 0;
        double high = i + 1 < count ? keyframes[i + 1].time_s - least_s : keyframes[i].time_s + 10;
        pel_widget_push(i);
        bool moved = pel_widget_slide("##time", &keyframes[i].time_s, low, high, "%.2f s");
        pel_panel_settle(state);
        pel_widget_same_line();
        if (pel_widget_button("look")) {
            pel_film_leave(state, false);
            pel_navigation_go(&state->navigation, &keyframes[i].camera, 0.35);
            pel_state_move_camera(state);
        }
        pel_widget_pop();
        if (moved)
            pel_film_set(state, keyframes, count, fps);
    }
    if (count > 0) {
        bool changed = pel_widget_slide("frames/s", &fps, 1, 60, "%.0f");
        pel_panel_settle(state);
        if (changed)
            pel_film_set(state, keyframes, count, fps);
    }
}

void pel_panel_film(struct pel_state *state) {
    if (pel_widget_button("keep this view (g)"))
        pel_command_do(state, PEL_ACTION_KEYFRAME, 0);
    pel_widget_same_line();
    if (pel_widget_button("take the last back"))
        pel_command_do(state, PEL_ACTION_KEYFRAME_BACK, 0);
    double interval_s = state->film.interval_s > 0 ? state->film.interval_s : 1;
    if (pel_widget_slide("seconds between", &interval_s, 0.1, 10, "%.1f"))
        state->film.interval_s = interval_s;
    draw_keyframes(state);
    draw_player(state);
}
