// show.c - what pictures become on their way to the windows.
//
// A comparison is made of two pictures that are kept, so that the line of a split and a flicker
// need no rendering. Slices are rendered by the host; their views follow those of the picture.
#include "viewer/show.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "viewer/screen.h"

static bool compares(const struct pel_state *state) {
    enum pel_compare_mode mode = state->compare.mode;
    return mode != PEL_COMPARE_NONE && mode != PEL_COMPARE_SLICES &&
           state->scene->instance_count > 1;
}

int pel_show_scene_count(const struct pel_state *state) {
    return state->picture_count * (compares(state) ? 2 : 1);
}

// All windows show one side, and then the other.
struct pel_scene *pel_show_scene(const struct pel_state *state, int number) {
    int last = state->scene->instance_count - 1, side = number / state->picture_count;
    int instance = state->sides[side] < last ? state->sides[side] : last;
    const struct pel_scene *shown = pel_film_shown(state);
    struct pel_scene *scene =
        compares(state) ? pel_compare_side(shown, instance) : pel_scene_copy(shown);
    if (scene)
        pel_screen_fit_scene(state, number % state->picture_count, scene);
    return scene;
}

// ---- Comparisons -------------------------------------------------------------------------------

// Squares and the line lie in the whole picture, and have the size they were given on the screen,
// however many pixels the pictures have.
static struct pel_compare compare_in_view(const struct pel_state *state,
                                          const struct pel_screen_view *view,
                                          const struct pel_pixels *pixels) {
    struct pel_compare compare = state->compare;
    const int shown[2] = {view->place.width, view->place.height};
    const int size[2] = {pixels->width, pixels->height};
    for (int axis = 0; axis < 2; axis++) {
        double scale = pixels->part[2 + axis] * size[axis] / shown[axis];
        compare.whole[axis] = (int)lround(view->whole[axis] * scale);
        compare.offset[axis] =
            (int)lround(view->offset[axis] * scale - pixels->part[axis] * size[axis]);
    }
    int cell_px = compare.cell_px > 0 ? compare.cell_px : 48;
    int divisor = state->kept->quality.divisor;
    compare.cell_px = cell_px / divisor > 1 ? cell_px / divisor : 1;
    return compare;
}

static void show_comparison(struct pel_state *state, int view) {
    const struct pel_picture *kept = state->kept;
    const struct pel_pixels *a = &kept->views[view], *b = &kept->views[state->picture_count + view];
    if (a->width != b->width || a->height != b->height)
        return;
    struct pel_compare compare = compare_in_view(state, &state->views[view], a);
    struct pel_pixels mixed = *a;
    mixed.rgba = malloc((size_t)a->width * (size_t)a->height * 4);
    if (!mixed.rgba)
        return;
    pel_compare_pixels(&compare, a->width, a->height, a->rgba, b->rgba, state->now_ms / 1e3,
                       mixed.rgba);
    pel_screen_upload(state, view, &mixed);
    free(mixed.rgba);
}

// A picture that was asked for before the windows or the comparison changed has other views.
static void show_kept(struct pel_state *state) {
    if (!state->kept || state->kept->view_count != pel_show_scene_count(state))
        return;
    for (int i = 0; i < state->picture_count; i++) {
        if (compares(state))
            show_comparison(state, i);
        else
            pel_screen_upload(state, i, &state->kept->views[i]);
    }
}

void pel_show_take(struct pel_state *state, struct pel_picture *picture) {
    pel_picture_destroy(state->kept);
    state->kept = picture;
    show_kept(state);
}

const char *pel_show_presented(const struct pel_state *state) {
    return state->lender ? state->shown.statistics.gl_reason : state->unshared;
}

void pel_show_finish(struct pel_state *state) {
    pel_picture_destroy(state->kept);
    state->kept = NULL;
}

// ---- Slices ------------------------------------------------------------------------------------

bool pel_show_slice(const struct pel_state *state, int view, struct pel_slice *slice) {
    const struct pel_screen_view *shown = &state->views[view];
    struct pel_bounds bounds;
    if (view < state->picture_count || view >= state->view_count ||
        !pel_scene_bounds(state->scene, &bounds))
        return false;
    *slice = (struct pel_slice){
        .plane = (enum pel_slice_plane)(shown->slot - 1),
        .width = shown->whole[0],
        .height = shown->whole[1],
        .part = {shown->offset[0], shown->offset[1], shown->place.width, shown->place.height},
        .windowed = state->slices_windowed};
    memcpy(slice->cross, state->cross, sizeof slice->cross);
    pel_slice_fit(slice, &bounds);
    return shown->place.width > 0 && shown->place.height > 0;
}

static void show_slices(struct pel_state *state) {
    for (int view = state->picture_count; view < state->view_count; view++) {
        struct pel_slice slice;
        if (!pel_show_slice(state, view, &slice))
            continue;
        struct pel_pixels pixels = {
            .width = slice.part[2], .height = slice.part[3], .part = {0, 0, 1, 1}};
        pixels.rgba = malloc((size_t)pixels.width * (size_t)pixels.height * 4);
        if (!pixels.rgba)
            return;
        pel_slice_render(&slice, state->scene, -1, pixels.rgba);
        pel_screen_upload(state, view, &pixels);
        free(pixels.rgba);
    }
    state->redraw = true;
}

void pel_show_update(struct pel_state *state) {
    if (state->compare.mode == PEL_COMPARE_SLICES && state->slices_old) {
        show_slices(state);
        state->slices_old = false;
    }
    bool again = state->compare_old;
    if (state->compare.mode == PEL_COMPARE_FLICKER) {
        double period_s = state->compare.period_s > 0 ? state->compare.period_s : 1;
        long turn = (long)(state->now_ms / 1e3 / (period_s / 2));
        again = again || turn != state->flicker_turn;
        state->flicker_turn = turn;
    }
    if (again && compares(state)) {
        show_kept(state);
        state->redraw = true;
    }
    state->compare_old = false;
}

void pel_show_set_mode(struct pel_state *state, enum pel_compare_mode mode) {
    bool needed = compares(state);
    struct pel_bounds bounds;
    if (mode == PEL_COMPARE_SLICES && !state->crossed && pel_scene_bounds(state->scene, &bounds)) {
        for (int i = 0; i < 3; i++)
            state->cross[i] = (bounds.low[i] + bounds.high[i]) / 2;
        state->crossed = true;
    }
    state->compare.mode = mode;
    state->compare_old = state->slices_old = true;
    // Of two pictures that were rendered already another comparison is made at once.
    if (pel_screen_layout(state) || !needed || !compares(state))
        pel_state_renew(state);
}
