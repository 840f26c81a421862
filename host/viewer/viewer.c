// viewer.c - the viewer's event loop.
//
// Each turn takes the events that came, changes the scene, gives the worker a copy when something
// changed, shows the newest picture, and sleeps until there is something to do. The loop never
// waits for a picture.
#include "viewer/viewer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/command.h"
#include "viewer/hand.h"
#include "viewer/latency.h"
#include "viewer/panels.h"
#include "viewer/screen.h"
#include "viewer/script.h"
#include "viewer/show.h"
#include "viewer/state.h"

// What has not changed for this long is at rest.
static const double rest_ms = 150;

// Between two pictures of a long frame's progress.
static const double progress_ms = 100;

// That can be undone.
enum { STEPS = 200 };

static enum pel_error fail(char *sentence, size_t bytes, enum pel_error code, const char *what) {
    if (what)
        snprintf(sentence, bytes, "%s", what);
    return code;
}

// ---- Rendering ---------------------------------------------------------------------------------

static double target_ms(const struct pel_state *state) {
    return 1e3 / (state->options->rate > 0 ? state->options->rate : 30);
}

// Gives the worker the scene as it is now, once for each view.
static void send(struct pel_state *state, bool moving) {
    int count = pel_show_scene_count(state);
    struct pel_request request = {.id = state->version,
                                  .moving = moving,
                                  .compared = count > state->picture_count,
                                  .target_ms = target_ms(state)};
    for (int i = 0; i < count; i++) {
        request.scenes[i] = pel_show_scene(state, i);
        if (!request.scenes[i]) {
            pel_state_say(state, "%s", pel_error_message());
            break;
        }
        request.devices[i] = pel_screen_device(state, i, request.scenes[i]);
        request.view_count++;
    }
    if (request.view_count == count)
        pel_worker_submit(state->worker, &request);
    else
        pel_request_finish(&request);
    state->sent = state->version;
    state->sent_moving = moving;
}

// Asks for what is not on its way yet: a quick picture of what changed, or all of it at rest.
static void ask_for_picture(struct pel_state *state) {
    bool rests = state->now_ms - state->changed_ms >= rest_ms;
    if (state->version != state->sent)
        send(state, state->shown_count > 0);
    else if (state->sent_moving && rests)
        send(state, false);
}

static void take_picture(struct pel_state *state) {
    struct pel_picture *picture = pel_worker_take(state->worker);
    if (!picture)
        return;
    state->shown = *picture;
    pel_show_take(state, picture);
    state->shown_count++;
    state->shared_count += pel_show_presented(state)[0] == '\0';
    state->redraw = true;
}

static void ask_worker(struct pel_state *state) {
    pel_worker_ask(state->worker, &state->status);
    if (state->saved_count != state->status.saved_count)
        pel_state_say(state, "%s", state->status.saved);
    state->saved_count = state->status.saved_count;
}

// ---- Events ------------------------------------------------------------------------------------

// The panels let go of what began in the picture, and the other way round.
static bool is_for_panels(struct pel_state *state, const struct pel_event *event) {
    if (!state->with_panels || event->window != 0)
        return false;
    state->redraw = true;
    return pel_panels_take_event(event) && state->drag == PEL_DRAG_NONE &&
           !(event->kind == PEL_EVENT_KEY && !event->down);
}

static void react(struct pel_state *state, const struct pel_event *event) {
    if (event->kind == PEL_EVENT_POINTER) {
        state->pointer_px[0] = event->x;
        state->pointer_px[1] = event->y;
        state->pointer_window = event->window;
        state->picked = false;
        state->redraw = true;
    }
    if (is_for_panels(state, event))
        return;
    switch (event->kind) {
    case PEL_EVENT_CLOSE:
        state->quit = true;
        break;
    case PEL_EVENT_SIZE:
        if (pel_screen_layout(state))
            pel_state_renew(state);
        state->redraw = true;
        break;
    case PEL_EVENT_DROP:
        if (event->path)
            pel_command_open(state, event->path);
        break;
    default:
        pel_hand_react(state, event);
        break;
    }
}

// Panels see one button or key a picture, or they would miss those that are quickly up again.
static void react_to_all(struct pel_state *state) {
    struct pel_event event;
    bool more = true;
    while (more && pel_event_take(&state->queue, &event)) {
        react(state, &event);
        free(event.path);
        more = event.kind != PEL_EVENT_BUTTON && event.kind != PEL_EVENT_KEY;
        // And they learn where the pointer is before it is pressed.
        if (event.kind == PEL_EVENT_POINTER && state->queue.count > 0 &&
            state->queue.events[state->queue.first].kind == PEL_EVENT_BUTTON)
            more = false;
    }
}

// ---- Scripts -----------------------------------------------------------------------------------

static bool is_resting(const struct pel_state *state) {
    if (state->version != state->sent || state->sent_moving || state->queue.count > 0 ||
        pel_hand_is_busy(state) || state->drag != PEL_DRAG_NONE)
        return false;
    return state->status.sentence[0] ||
           (!state->status.busy && state->shown.final && state->shown.id == state->version);
}

static void do_step(struct pel_state *state, const struct pel_script_step *step) {
    struct pel_bounds bounds;
    struct pel_camera camera = step->camera;
    struct pel_event event = step->event;
    switch (step->kind) {
    case PEL_SCRIPT_EVENT:
        event.path = step->text ? strdup(step->text) : NULL;
        if (!pel_event_push(&state->queue, &event))
            free(event.path);
        break;
    case PEL_SCRIPT_CAMERA:
        if (camera.fov_deg == 0)
            camera.fov_deg = state->navigation.camera.fov_deg;
        pel_navigation_go(&state->navigation, &camera, step->seconds);
        pel_state_move_camera(state);
        break;
    case PEL_SCRIPT_VIEW:
        if (!pel_scene_bounds(state->scene, &bounds) ||
            !pel_navigation_view(&state->navigation, step->text, &bounds, pel_state_aspect(state),
                                 step->seconds))
            pel_state_say(state, "no view '%s'", step->text);
        pel_state_move_camera(state);
        break;
    case PEL_SCRIPT_SCREENSHOT:
        if (!pel_screen_save(state, step->text))
            pel_state_say(state, "%s", pel_error_message());
        break;
    default:
        break;
    }
}

// Does what is due. A screenshot shows what was drawn, so no step follows another unseen.
static void play_script(struct pel_state *state) {
    const struct pel_script_step *step =
        state->script ? pel_script_next(state->script, state->now_ms / 1e3, is_resting(state))
                      : NULL;
    if (step)
        do_step(state, step);
}

// ---- The loop ----------------------------------------------------------------------------------

static double wait_seconds(const struct pel_state *state) {
    if (state->redraw || state->queue.count > 0)
        return 0;
    if (state->compare.mode == PEL_COMPARE_FLICKER)
        return 0.02;
    if (pel_hand_is_busy(state) || state->latency ||
        (state->script && !pel_script_is_over(state->script)))
        return 0.005;
    if (state->version != state->sent || state->sent_moving)
        return 0.02;
    return state->status.busy ? 0.1 : 0.5;
}

static bool is_over(const struct pel_state *state) {
    const struct pel_viewer_options *options = state->options;
    // The last picture is complete, even if the hand was quicker.
    if (state->quit)
        return !options->screenshot || is_resting(state);
    if (state->latency)
        return pel_latency_is_over(state->latency);
    if (options->frames > 0 && state->shown_count >= options->frames)
        return true;
    if (state->script && !pel_script_is_over(state->script))
        return false;
    return options->screenshot && options->frames == 0 && is_resting(state);
}

// So many pictures are shown that the same one is rendered again where nobody asks for another.
static bool is_again_due(const struct pel_state *state) {
    return state->options->frames > 0 && !state->quit && is_resting(state) &&
           (!state->script || pel_script_is_over(state->script));
}

// A long frame's progress is drawn from time to time; drawing costs what rendering could use.
static bool is_progress_due(const struct pel_state *state, bool was_busy) {
    bool ended = was_busy && !state->status.busy;
    return ended || (state->status.busy && state->now_ms - state->drawn_ms >= progress_ms);
}

static enum pel_error loop(struct pel_state *state, char *sentence, size_t bytes) {
    while (!is_over(state)) {
        pel_window_wait(wait_seconds(state));
        double now_ms = pel_clock_ms();
        pel_hand_tick(state, (now_ms - state->now_ms) / 1e3);
        state->now_ms = now_ms;
        if (state->latency)
            pel_latency_begin_turn(state->latency, state);
        play_script(state);
        react_to_all(state);
        if (is_again_due(state))
            pel_state_renew(state);
        ask_for_picture(state);
        take_picture(state);
        pel_show_update(state);
        pel_screen_name(state);
        bool was_busy = state->status.busy;
        ask_worker(state);
        if (state->redraw || is_progress_due(state, was_busy))
            pel_screen_draw(state);
        state->redraw = false;
        if (state->latency)
            pel_latency_end_turn(state->latency, state);
    }
    if (state->latency)
        pel_latency_report(state->latency, state, state->options->latency);
    struct pel_viewer_report *report = state->options->report;
    if (report) {
        *report = (struct pel_viewer_report){state->shown_count, state->shared_count, ""};
        snprintf(report->reason, sizeof report->reason, "%s", pel_show_presented(state));
    }
    const char *path = state->options->screenshot;
    if (path && !pel_screen_save(state, path))
        return fail(sentence, bytes, pel_error_code(), pel_error_message());
    return PEL_OK;
}

static enum pel_error start(struct pel_state *state, char *sentence, size_t bytes) {
    state->panels = state->readouts = pel_panels_exist() && !state->options->bare;
    char reason[256];
    if (!pel_window_start(reason, sizeof reason) ||
        !pel_screen_open(state, reason, sizeof reason)) {
        snprintf(sentence, bytes, "%s; 'pellucid render' makes pictures without a display", reason);
        return PEL_ERROR_DEVICE;
    }
    state->scene = pel_scene_copy(state->options->scene);
    state->history = state->scene ? pel_history_create(state->scene, STEPS) : NULL;
    if (!state->history)
        return fail(sentence, bytes, PEL_ERROR_MEMORY, "cannot allocate the scene");
    pel_navigation_start(&state->navigation, &state->scene->camera);
    if (state->options->scene_path)
        snprintf(state->scene_path, sizeof state->scene_path, "%s", state->options->scene_path);
    state->sides[1] = 1;
    state->compare.share = state->compare.split = 0.5;
    state->compare.cell_px = 48;
    state->compare.period_s = 1;
    state->opacity_point = state->colour_point = -1;
    state->now_ms = pel_clock_ms();
    if (state->options->script) {
        state->script = pel_script_load(state->options->script, sentence, bytes);
        if (!state->script)
            return PEL_ERROR_FORMAT;
    }
    state->worker = pel_worker_create(&state->options->renderer, state->lender, pel_window_wake);
    if (!state->worker)
        return fail(sentence, bytes, PEL_ERROR_MEMORY, "cannot start the rendering thread");
    if (state->options->latency)
        state->latency = pel_latency_create(state->options->latency->inputs);
    if (state->options->latency && !state->latency)
        return fail(sentence, bytes, PEL_ERROR_MEMORY, "cannot allocate the measurement");
    pel_screen_layout(state);
    pel_state_renew(state);
    return PEL_OK;
}

enum pel_error pel_viewer_run(const struct pel_viewer_options *options, char *sentence,
                              size_t bytes) {
    struct pel_state *state = calloc(1, sizeof *state);
    if (!state)
        return fail(sentence, bytes, PEL_ERROR_MEMORY, "cannot allocate the viewer");
    state->options = options;
    enum pel_error code = start(state, sentence, bytes);
    if (!code)
        code = loop(state, sentence, bytes);
    pel_worker_destroy(state->worker);
    pel_show_finish(state);
    pel_scene_destroy(state->film.scene);
    pel_screen_close(state);
    pel_window_stop();
    pel_event_finish(&state->queue);
    pel_history_destroy(state->history);
    pel_latency_destroy(state->latency);
    pel_script_destroy(state->script);
    pel_transfer_destroy(state->levels_before);
    pel_scene_destroy(state->scene);
    free(state);
    return code;
}
