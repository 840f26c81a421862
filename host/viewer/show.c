// show.c - what pictures become on their way to the windows.
//
// A comparison is made of two pictures that are kept, so that the line of a split and a flicker
// need no rendering. View 0 is the picture; 1 to 3 are slices, which the host renders.
#include "viewer/show.h"

#include <stdlib.h>
#include <string.h>

#include "viewer/screen.h"

static bool compares(const struct pel_state *state) {
    enum pel_compare_mode mode = state->compare.mode;
    return mode != PEL_COMPARE_NONE && mode != PEL_COMPARE_SLICES &&
           state->scene->instance_count > 1;
}

int pel_show_scene_count(const struct pel_state *state) {
    return compares(state) ? 2 : state->picture_count;
}

struct pel_scene *pel_show_scene(const struct pel_state *state, int number) {
    struct pel_scene *scene;
    if (compares(state)) {
        int last = state->scene->instance_count - 1;
        int side = state->sides[number] < last ? state->sides[number] : last;
        scene = pel_compare_side(state->scene, side);
        number = 0;
    } else {
        scene = pel_scene_copy(state->scene);
    }
    if (scene)
        pel_screen_fit_scene(state, number, scene);
    return scene;
}

// ---- Comparisons -------------------------------------------------------------------------------

static void show_comparison(struct pel_state *state) {
    const struct pel_worker_picture *kept = state->kept;
    const struct pel_worker_pixels *a = &kept->views[0], *b = &kept->views[1];
    if (kept->view_count < 2 || a->width != b->width || a->height != b->height)
        return;
    // Squares have the size they were given on the screen, however many pixels the picture has.
    struct pel_compare compare = state->compare;
    int cell_px = compare.cell_px > 0 ? compare.cell_px : 48;
    compare.cell_px = cell_px / kept->quality.divisor > 1 ? cell_px / kept->quality.divisor : 1;
    uint8_t *rgba = malloc((size_t)a->width * (size_t)a->height * 4);
    if (!rgba)
        return;
    pel_compare_pixels(&compare, a->width, a->height, a->rgba, b->rgba, state->now_ms / 1e3, rgba);
    pel_screen_upload(state, 0, a->width, a->height, rgba);
    free(rgba);
}

static void show_kept(struct pel_state *state) {
    if (!state->kept)
        return;
    if (compares(state)) {
        show_comparison(state);
        return;
    }
    for (int i = 0; i < state->kept->view_count && i < state->picture_count; i++) {
        const struct pel_worker_pixels *pixels = &state->kept->views[i];
        pel_screen_upload(state, i, pixels->width, pixels->height, pixels->rgba);
    }
}

void pel_show_take(struct pel_state *state, struct pel_worker_picture *picture) {
    pel_worker_picture_destroy(state->kept);
    state->kept = picture;
    show_kept(state);
}

void pel_show_finish(struct pel_state *state) {
    pel_worker_picture_destroy(state->kept);
    state->kept = NULL;
}

// ---- Slices ------------------------------------------------------------------------------------

bool pel_show_slice(const struct pel_state *state, int view, struct pel_slice *slice) {
    struct pel_bounds bounds;
    if (state->compare.mode != PEL_COMPARE_SLICES || view < 1 || view > 3 ||
        !pel_scene_bounds(state->scene, &bounds))
        return false;
    *slice = (struct pel_slice){.plane = (enum pel_slice_plane)(view - 1),
                                .width = state->views[view].place.width,
                                .height = state->views[view].place.height,
                                .windowed = state->slices_windowed};
    memcpy(slice->cross, state->cross, sizeof slice->cross);
    pel_slice_fit(slice, &bounds);
    return slice->width > 0 && slice->height > 0;
}

static void show_slices(struct pel_state *state) {
    for (int view = 1; view <= 3; view++) {
        struct pel_slice slice;
        if (!pel_show_slice(state, view, &slice))
            continue;
        uint8_t *rgba = malloc((size_t)slice.width * (size_t)slice.height * 4);
        if (!rgba)
            return;
        pel_slice_render(&slice, state->scene, -1, rgba);
        pel_screen_upload(state, view, slice.width, slice.height, rgba);
        free(rgba);
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
