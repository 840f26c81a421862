// hand.c - what mouse and keyboard do to the picture.
#include "viewer/hand.h"

#include <math.h>
#include <string.h>

#include "viewer/command.h"
#include "viewer/keys.h"
#include "viewer/show.h"
#include "viewer/transfer_edit.h"

// While a key is held: distances of the target, and degrees, each second.
static const double move_per_s = 0.5, turn_deg_per_s = 60, closer_per_s = 0.7;

// How far from a handle the pointer may be to take it.
static const double reach_px = 8;

// A key that was only touched still does something.
static const double touch_s = 0.05;

static int find_view(const struct pel_state *state, int window, double x, double y) {
    for (int i = 0; i < state->view_count; i++) {
        const struct pel_rectangle *place = &state->views[i].place;
        if (state->views[i].window == window && x >= place->x && x < place->x + place->width &&
            y >= place->y && y < place->y + place->height)
            return i;
    }
    return -1;
}

// In pixels of the picture that the view is, or is a part of.
static void place_in_view(const struct pel_state *state, int view, const struct pel_event *event,
                          double px[2]) {
    const struct pel_screen_view *shown = &state->views[view];
    px[0] = event->x - shown->place.x + shown->offset[0];
    px[1] = event->y - shown->place.y + shown->offset[1];
}

// ---- The mouse ---------------------------------------------------------------------------------

// The handle of what cuts under the pointer, if there is one: faces of a box before its gizmo.
static enum pel_drag take_clip(struct pel_state *state) {
    struct pel_gizmo gizmo;
    struct pel_matrix as_it_is = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    double reach = reach_px * state->windows[0].scale;
    if (state->drag_view >= state->picture_count || !pel_state_clip_gizmo(state, &gizmo))
        return PEL_DRAG_NONE;
    state->clip_before = state->scene->clips[state->clip - 1];
    if (state->clip_before.kind == PEL_CLIP_BOX) {
        struct pel_handle_box box = pel_clip_box(&state->clip_before);
        state->face = pel_box_hit(&box, &gizmo.view, state->drag_px, reach);
        if (state->face >= 0)
            return PEL_DRAG_FACE;
    }
    enum pel_handle handle = pel_gizmo_hit(&gizmo, state->drag_px, reach);
    bool taken = handle != PEL_HANDLE_NONE &&
                 pel_handle_begin(&state->handle_drag, &gizmo, handle, state->drag_px, &as_it_is);
    return taken ? PEL_DRAG_CLIP : PEL_DRAG_NONE;
}

// The selected volume's handle under the pointer, if there is one.
static bool take_handle(struct pel_state *state) {
    struct pel_gizmo gizmo;
    if (state->drag_view >= state->picture_count || !pel_state_gizmo(state, &gizmo))
        return false;
    enum pel_handle handle =
        pel_gizmo_hit(&gizmo, state->drag_px, reach_px * state->windows[0].scale);
    const struct pel_instance *instance = &state->scene->instances[state->selected];
    return handle != PEL_HANDLE_NONE && pel_handle_begin(&state->handle_drag, &gizmo, handle,
                                                         state->drag_px, &instance->transform);
}

static bool begin_levels(struct pel_state *state) {
    pel_transfer_destroy(state->levels_before);
    state->levels_before = pel_transfer_copy(state->scene->instances[state->selected].transfer);
    if (!state->levels_before)
        pel_state_say(state, "%s", pel_error_message());
    return state->levels_before != NULL;
}

// The point under the pointer becomes what the camera turns about.
static void look_at_pointer(struct pel_state *state) {
    struct pel_view view;
    struct pel_pick pick;
    if (!pel_state_view(state, state->drag_view, &view))
        return;
    pel_pick(&pick, state->scene, &view, state->drag_px);
    if (!pick.hit) {
        pel_state_say(state, "there is nothing under the pointer");
        return;
    }
    struct pel_camera camera = state->navigation.camera;
    for (int i = 0; i < 3; i++) {
        camera.eye[i] += pick.position[i] - camera.target[i];
        camera.target[i] = pick.position[i];
        state->cross[i] = pick.position[i];
    }
    state->crossed = state->slices_old = true;
    state->selected = pick.instance;
    pel_navigation_go(&state->navigation, &camera, 0.3);
    pel_state_move_camera(state);
}

// The cross-hair goes to the pointer, which is in a slice.
static void move_cross(struct pel_state *state, const double at_px[2]) {
    struct pel_slice slice;
    if (!pel_show_slice(state, state->drag_view, &slice))
        return;
    pel_slice_world(&slice, at_px, state->cross);
    state->slices_old = state->redraw = true;
}

static bool is_on_split(const struct pel_state *state) {
    const struct pel_compare *compare = &state->compare;
    double line_px = compare->split * state->views[0].whole[compare->across];
    double at_px = state->drag_px[compare->across];
    return compare->mode == PEL_COMPARE_SPLIT &&
           fabs(line_px - at_px) < reach_px * state->windows[0].scale;
}

static void move_split(struct pel_state *state, const double at_px[2]) {
    double size_px = state->views[0].whole[state->compare.across];
    state->compare.split = fmin(fmax(at_px[state->compare.across] / size_px, 0), 1);
    state->compare_old = true;
}

// A face of the orientation cube under the pointer shows what is seen from there.
static bool take_cube(struct pel_state *state, const struct pel_event *event) {
    struct pel_cube_face faces[3];
    bool there = event->window == state->views[state->picture_count - 1].window;
    int count = there ? pel_state_cube(state, faces) : 0;
    int face = pel_orientation_cube_hit(faces, count, (double[]){event->x, event->y});
    const char *const *names = pel_navigation_view_names();
    for (int i = 0; face >= 0 && names[i]; i++)
        if (strcmp(names[i], faces[face].view) == 0)
            pel_command_do(state, PEL_ACTION_VIEW, i);
    return face >= 0;
}

static void begin_left_drag(struct pel_state *state, const struct pel_event *event) {
    int modifiers = event->modifiers;
    if (take_cube(state, event))
        return;
    if (state->views[state->drag_view].slot > 0) {
        state->drag = PEL_DRAG_CROSS;
        move_cross(state, state->drag_px);
    } else if (is_on_split(state)) {
        state->drag = PEL_DRAG_SPLIT;
    } else if (modifiers & PEL_CONTROL) {
        look_at_pointer(state);
    } else if (modifiers & PEL_SHIFT) {
        state->drag = begin_levels(state) ? PEL_DRAG_LEVELS : PEL_DRAG_NONE;
    } else {
        state->drag = take_clip(state);
        if (state->drag == PEL_DRAG_NONE)
            state->drag = take_handle(state) ? PEL_DRAG_HANDLE : PEL_DRAG_TURN;
    }
}

static void begin_drag(struct pel_state *state, const struct pel_event *event) {
    int view = find_view(state, event->window, event->x, event->y);
    if (view < 0)
        return;
    bool shift = event->modifiers & PEL_SHIFT;
    pel_state_begin_gesture(state);
    pel_film_leave(state, true);
    state->drag_view = view;
    place_in_view(state, view, event, state->drag_px);
    for (int i = 0; i < 2; i++)
        state->drag_from_px[i] = state->drag_px[i];
    pel_navigation_begin(&state->navigation);
    switch (event->button) {
    case PEL_BUTTON_LEFT:
        begin_left_drag(state, event);
        break;
    case PEL_BUTTON_RIGHT:
        state->drag = shift ? PEL_DRAG_TILT : PEL_DRAG_PAN;
        break;
    default:
        state->drag = PEL_DRAG_ZOOM;
        break;
    }
}

static bool is_turning(const struct pel_state *state) {
    return state->handle_drag.handle >= PEL_HANDLE_TURN_X &&
           state->handle_drag.handle != PEL_HANDLE_MOVE_VIEW;
}

// With Control by whole millimetres, and by five degrees.
static double snap_of(const struct pel_state *state, int modifiers) {
    return modifiers & PEL_CONTROL ? (is_turning(state) ? 5 : 1) : 0;
}

static void drag_handle(struct pel_state *state, const double to_px[2], int modifiers) {
    struct pel_instance *instance = &state->scene->instances[state->selected];
    bool turns = is_turning(state);
    if (!pel_handle_drag(&state->handle_drag, to_px, snap_of(state, modifiers),
                         &instance->transform))
        return;
    pel_state_say(state, "%s: %.3g %s", instance->name, state->handle_drag.amount,
                  turns ? "degrees" : "mm");
    pel_state_change(state, turns ? "turn a volume" : "move a volume");
}

static void drag_clip(struct pel_state *state, const double to_px[2], int modifiers) {
    struct pel_clip *clip = &state->scene->clips[state->clip - 1];
    struct pel_matrix transform;
    struct pel_view view;
    if (state->drag == PEL_DRAG_FACE) {
        struct pel_handle_box before = pel_clip_box(&state->clip_before), box;
        if (!pel_state_view(state, 0, &view) ||
            !pel_box_drag(&box, &before, state->face, &view, state->drag_from_px, to_px))
            return;
        pel_clip_set_box(clip, &box);
        pel_state_say(state, "box of %.4g x %.4g x %.4g mm", clip->size[0], clip->size[1],
                      clip->size[2]);
    } else if (clip->kind == PEL_CLIP_PLANE && state->handle_drag.handle == PEL_HANDLE_MOVE_VIEW) {
        pel_clip_push(clip, &state->clip_before, &state->handle_drag.gizmo.view,
                      state->drag_from_px, to_px);
    } else {
        if (!pel_handle_drag(&state->handle_drag, to_px, snap_of(state, modifiers), &transform))
            return;
        pel_clip_move(clip, &state->clip_before, &transform);
        pel_state_say(state, "cut: %.3g %s", state->handle_drag.amount,
                      is_turning(state) ? "degrees" : "mm");
    }
    pel_state_change(state, "clipping");
}

// To the right the window gets wider, upwards the level lower, so that more is seen.
static void drag_levels(struct pel_state *state, const double to_px[2]) {
    const int *whole = state->views[state->drag_view].whole;
    struct pel_instance *instance = &state->scene->instances[state->selected];
    struct pel_transfer *transfer = pel_transfer_copy(state->levels_before);
    if (!transfer)
        return;
    double right = (to_px[0] - state->drag_from_px[0]) / whole[0];
    double down = (to_px[1] - state->drag_from_px[1]) / whole[1];
    const struct pel_statistics *statistics = &state->scene->statistics[instance->volume];
    double low, high;
    pel_transfer_window(transfer, &low, &high);
    pel_transfer_drag_window(&low, &high, statistics, 2 * right, -down);
    pel_transfer_set_window(transfer, low, high);
    pel_transfer_destroy(instance->transfer);
    instance->transfer = transfer;
    pel_state_change(state, "window and level");
}

static void drag(struct pel_state *state, const struct pel_event *event) {
    double to_px[2];
    const int *size = state->views[state->drag_view].whole;
    place_in_view(state, state->drag_view, event, to_px);
    switch (state->drag) {
    case PEL_DRAG_TURN:
        pel_navigation_rotate(&state->navigation, size, state->drag_px, to_px);
        break;
    case PEL_DRAG_PAN:
        pel_navigation_pan(&state->navigation, size, state->drag_px, to_px);
        break;
    case PEL_DRAG_ZOOM:
        pel_navigation_zoom(&state->navigation, size, state->drag_px, to_px);
        break;
    case PEL_DRAG_TILT:
        pel_navigation_roll(&state->navigation, size, state->drag_px, to_px);
        break;
    case PEL_DRAG_HANDLE:
        drag_handle(state, to_px, event->modifiers);
        return;
    case PEL_DRAG_CLIP:
    case PEL_DRAG_FACE:
        drag_clip(state, to_px, event->modifiers);
        return;
    case PEL_DRAG_LEVELS:
        drag_levels(state, to_px);
        return;
    case PEL_DRAG_CROSS:
        move_cross(state, to_px);
        return;
    case PEL_DRAG_SPLIT:
        move_split(state, to_px);
        return;
    default:
        return;
    }
    pel_state_move_camera(state);
    for (int i = 0; i < 2; i++)
        state->drag_px[i] = to_px[i];
}

static void wheel(struct pel_state *state, const struct pel_event *event) {
    int view = find_view(state, event->window, event->x, event->y);
    if (view < 0)
        return;
    double at_px[2];
    const int *size = state->views[view].whole;
    place_in_view(state, view, event, at_px);
    struct pel_slice slice;
    if (pel_show_slice(state, view, &slice)) {
        double right[3], down[3], towards[3];
        pel_slice_axes(&slice, right, down, towards);
        for (int i = 0; i < 3; i++)
            state->cross[i] += event->wheel * slice.mm_per_px * 2 * towards[i];
        state->slices_old = state->redraw = true;
        return;
    }
    pel_film_leave(state, true);
    pel_navigation_wheel(&state->navigation, size, at_px, event->wheel);
    pel_state_move_camera(state);
}

// ---- The keyboard ------------------------------------------------------------------------------

static double direction(uint32_t held, enum pel_action plus, enum pel_action minus) {
    return (held >> plus & 1) - (double)(held >> minus & 1);
}

// Does what the held keys do in that time.
static void move(struct pel_state *state, uint32_t held, double seconds) {
    struct pel_navigation *navigation = &state->navigation;
    double along[3] = {direction(held, PEL_ACTION_RIGHT, PEL_ACTION_LEFT),
                       direction(held, PEL_ACTION_UP, PEL_ACTION_DOWN),
                       direction(held, PEL_ACTION_FORWARD, PEL_ACTION_BACK)};
    double right = direction(held, PEL_ACTION_TURN_RIGHT, PEL_ACTION_TURN_LEFT);
    double up = direction(held, PEL_ACTION_TURN_UP, PEL_ACTION_TURN_DOWN);
    double tilt = direction(held, PEL_ACTION_TILT_RIGHT, PEL_ACTION_TILT_LEFT);
    double closer = direction(held, PEL_ACTION_CLOSER, PEL_ACTION_AWAY);
    for (int i = 0; i < 3; i++)
        along[i] *= move_per_s * seconds;
    if (along[0] != 0 || along[1] != 0 || along[2] != 0)
        pel_navigation_move(navigation, along);
    if (right != 0 || up != 0)
        pel_navigation_turn(navigation, right * turn_deg_per_s * seconds,
                            up * turn_deg_per_s * seconds);
    if (tilt != 0)
        pel_navigation_tilt(navigation, tilt * turn_deg_per_s * seconds);
    if (closer != 0) {
        // A drag upwards over the height goes closer by a factor of e.
        const double from_px[2] = {0, 100},
                     to_px[2] = {0, 100 - 100 * closer * closer_per_s * seconds};
        pel_navigation_zoom(navigation, (const int[2]){100, 100}, from_px, to_px);
    }
    pel_state_move_camera(state);
}

static void press(struct pel_state *state, const struct pel_event *event) {
    int number = 0;
    enum pel_action action = pel_keys_find(event->key, event->modifiers, &number);
    if (action == PEL_ACTION_NONE)
        return;
    if (action >= PEL_ACTION_VIEW) {
        if (!event->repeat)
            pel_state_begin_gesture(state);
        pel_command_do(state, action, number);
        return;
    }
    if (event->repeat || state->held >> action & 1)
        return;
    if (!state->held)
        pel_state_begin_gesture(state);
    pel_film_leave(state, true);
    pel_navigation_begin(&state->navigation);
    state->held |= 1u << action;
    move(state, 1u << action, touch_s);
}

// Whatever is held with it now, the key is up.
static void release(struct pel_state *state, const struct pel_event *event) {
    for (int modifiers = 0; modifiers < 8; modifiers++) {
        int number;
        enum pel_action action = pel_keys_find(event->key, modifiers, &number);
        if (action != PEL_ACTION_NONE && action < PEL_ACTION_VIEW)
            state->held &= ~(1u << action);
    }
}

// ---- Both --------------------------------------------------------------------------------------

bool pel_hand_is_busy(const struct pel_state *state) {
    return state->held || state->navigation.duration_s > 0 || state->film.playing;
}

void pel_hand_tick(struct pel_state *state, double seconds) {
    if (state->held)
        move(state, state->held, fmin(seconds, 0.1));
    if (pel_navigation_tick(&state->navigation, seconds))
        pel_state_move_camera(state);
    pel_film_tick(state, seconds);
}

void pel_hand_react(struct pel_state *state, const struct pel_event *event) {
    switch (event->kind) {
    case PEL_EVENT_POINTER:
        if (state->drag != PEL_DRAG_NONE)
            drag(state, event);
        break;
    case PEL_EVENT_BUTTON:
        if (event->down && state->drag == PEL_DRAG_NONE)
            begin_drag(state, event);
        else if (!event->down)
            state->drag = PEL_DRAG_NONE;
        break;
    case PEL_EVENT_WHEEL:
        wheel(state, event);
        break;
    case PEL_EVENT_KEY:
        if (event->down)
            press(state, event);
        else
            release(state, event);
        break;
    default:
        break;
    }
}
