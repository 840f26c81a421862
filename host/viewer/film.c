// film.c - the scene's animation in the window.
#include "viewer/film.h"

#include <math.h>

#include "viewer/state.h"

static const double fps_default = 30;

const struct pel_scene *pel_film_shown(const struct pel_state *state) {
    return state->film.scene ? state->film.scene : state->scene;
}

// ---- Recording ---------------------------------------------------------------------------------

void pel_film_set(struct pel_state *state, const struct pel_keyframe *keyframes, int count,
                  double fps) {
    pel_film_leave(state, false);
    if (pel_scene_set_keyframes(state->scene, keyframes, count, fps))
        pel_state_change(state, "keyframes");
    else
        pel_state_say(state, "%s", pel_error_message());
}

static double fps_of(const struct pel_scene *scene) {
    return scene->timeline.fps > 0 ? scene->timeline.fps : fps_default;
}

void pel_film_keep(struct pel_state *state) {
    struct pel_keyframe keyframes[PEL_FILM_KEYFRAMES];
    pel_film_leave(state, true);
    int count = pel_scene_keyframes(state->scene, keyframes, PEL_FILM_KEYFRAMES - 1);
    if (count > PEL_FILM_KEYFRAMES - 1) {
        pel_state_say(state, "there are %d keyframes already", count);
        return;
    }
    double interval_s = state->film.interval_s > 0 ? state->film.interval_s : 1;
    double time_s = count > 0 ? keyframes[count - 1].time_s + interval_s : 0;
    keyframes[count] = (struct pel_keyframe){time_s, state->scene->camera};
    pel_state_say(state, "keyframe %d at %g s", count + 1, time_s);
    pel_film_set(state, keyframes, count + 1, fps_of(state->scene));
}

void pel_film_take_back(struct pel_state *state) {
    struct pel_keyframe keyframes[PEL_FILM_KEYFRAMES];
    int count = pel_scene_keyframes(state->scene, keyframes, PEL_FILM_KEYFRAMES);
    if (count == 0 || count > PEL_FILM_KEYFRAMES) {
        pel_state_say(state, "there is no keyframe to take back");
        return;
    }
    pel_state_say(state, "%d keyframe%s left", count - 1, count == 2 ? " is" : "s are");
    pel_film_set(state, keyframes, count - 1, fps_of(state->scene));
}

// ---- Stills ------------------------------------------------------------------------------------

static bool same_view(const struct pel_camera *a, const struct pel_camera *b) {
    double far_mm = 0, scale_mm = 1;
    for (int axis = 0; axis < 3; axis++) {
        far_mm = fmax(far_mm, fabs(a->eye[axis] - b->eye[axis]));
        far_mm = fmax(far_mm, fabs(a->target[axis] - b->target[axis]));
        far_mm = fmax(far_mm, fabs(a->up[axis] - b->up[axis]));
        scale_mm = fmax(scale_mm, fmax(fabs(a->eye[axis]), fabs(a->target[axis])));
    }
    return far_mm <= 1e-9 * scale_mm && a->orthographic == b->orthographic &&
           fabs(a->fov_deg - b->fov_deg) < 1e-9 && fabs(a->height_mm - b->height_mm) < 1e-9;
}

bool pel_film_settle(struct pel_scene *scene) {
    struct pel_timeline *timeline = &scene->timeline;
    if (timeline->frame_count == 0)
        return true;
    struct pel_scene *still = pel_scene_copy(scene);
    bool seen = still && pel_scene_set_frame(still, timeline->frame) &&
                same_view(&still->camera, &scene->camera);
    pel_scene_destroy(still);
    struct pel_keyframe keyframes[PEL_FILM_KEYFRAMES];
    int count = seen ? 0 : pel_scene_keyframes(scene, keyframes, PEL_FILM_KEYFRAMES);
    for (int i = 0; i < count && count <= PEL_FILM_KEYFRAMES && !seen; i++) {
        if (!same_view(&keyframes[i].camera, &scene->camera))
            continue;
        timeline->frame = keyframes[i].time_s * timeline->fps;
        seen = pel_scene_set_keyframes(scene, keyframes, count, timeline->fps);
    }
    return seen;
}

// ---- Playing -----------------------------------------------------------------------------------

// Puts a copy of the scene, as it is now, into the projector.
static bool load(struct pel_state *state) {
    if (state->film.scene)
        return true;
    if (state->scene->timeline.frame_count == 0) {
        pel_state_say(state, "there is no animation: g keeps the view as a keyframe");
        return false;
    }
    pel_navigation_begin(&state->navigation);
    struct pel_scene *scene = pel_scene_copy(state->scene);
    if (scene && pel_scene_rebase(scene)) {
        state->film.scene = scene;
        return true;
    }
    pel_state_say(state, "%s", pel_error_message());
    pel_scene_destroy(scene);
    return false;
}

static void show(struct pel_state *state) {
    if (!pel_scene_set_frame(state->film.scene, floor(state->film.frame))) {
        pel_state_say(state, "%s", pel_error_message());
        state->film.playing = false;
    }
    pel_state_renew(state);
}

void pel_film_seek(struct pel_state *state, double frame) {
    if (!load(state))
        return;
    double last = state->film.scene->timeline.frame_count - 1;
    state->film.frame = fmin(fmax(frame, 0), last);
    show(state);
}

void pel_film_toggle(struct pel_state *state) {
    if (!load(state))
        return;
    struct pel_film *film = &state->film;
    film->playing = !film->playing;
    if (film->playing && film->frame >= film->scene->timeline.frame_count - 1)
        film->frame = 0;
    show(state);
}

void pel_film_leave(struct pel_state *state, bool keep_camera) {
    struct pel_scene *scene = state->film.scene;
    if (!scene)
        return;
    state->film.scene = NULL;
    state->film.playing = false;
    pel_navigation_set(&state->navigation, keep_camera ? &scene->camera : &state->scene->camera);
    pel_scene_destroy(scene);
    if (keep_camera)
        pel_state_move_camera(state);
    else
        pel_state_renew(state);
}

void pel_film_tick(struct pel_state *state, double seconds) {
    struct pel_film *film = &state->film;
    if (!film->playing)
        return;
    int count = film->scene->timeline.frame_count;
    double before = floor(film->frame);
    film->frame += seconds * film->scene->timeline.fps;
    if (film->repeats)
        film->frame = fmod(film->frame, count);
    else if (film->frame >= count - 1) {
        film->frame = count - 1;
        film->playing = false;
    }
    if (floor(film->frame) != before || !film->playing)
        show(state);
}
