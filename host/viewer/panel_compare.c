// panel_compare.c - ways to see whether two volumes lie in the same place.
#include "viewer/panel.h"
#include "viewer/show.h"

static void draw_sides(struct pel_state *state) {
    const char *names[PEL_VOLUME_MAX + 1] = {NULL};
    for (int i = 0; i < state->scene->instance_count; i++)
        names[i] = state->scene->instances[i].name;
    for (int side = 0; side < 2; side++) {
        int chosen = state->sides[side] < state->scene->instance_count ? state->sides[side] : 0;
        if (pel_widget_choose(side == 0 ? "a" : "b", names, &chosen)) {
            state->sides[side] = chosen;
            pel_state_renew(state);
        }
    }
}

void pel_panel_compare(struct pel_state *state) {
    struct pel_compare *compare = &state->compare;
    int mode = (int)compare->mode;
    if (pel_widget_choose("compare", pel_compare_names(), &mode))
        pel_show_set_mode(state, (enum pel_compare_mode)mode);
    if (mode == PEL_COMPARE_SLICES) {
        if (pel_widget_check("values as grey", &state->slices_windowed))
            state->slices_old = true;
        pel_widget_quiet_text("Drag in a slice: move the cross-hair. Wheel: to the next slice.");
        return;
    }
    if (mode == PEL_COMPARE_NONE)
        return;
    if (state->scene->instance_count < 2) {
        pel_widget_quiet_text("There is only one volume.");
        return;
    }
    draw_sides(state);
    bool changed = false;
    if (mode == PEL_COMPARE_BLEND)
        changed = pel_widget_slide("share of b", &compare->share, 0, 1, "%.2f");
    if (mode == PEL_COMPARE_CHECKERBOARD)
        changed = pel_widget_slide_int("squares", &compare->cell_px, 4, 256);
    if (mode == PEL_COMPARE_SPLIT) {
        changed = pel_widget_slide("line at", &compare->split, 0, 1, "%.2f");
        changed |= pel_widget_check("line runs across", &compare->across);
    }
    if (mode == PEL_COMPARE_FLICKER)
        changed = pel_widget_slide("seconds for both", &compare->period_s, 0.2, 4, "%.1f");
    if (mode == PEL_COMPARE_DIFFERENCE)
        pel_widget_quiet_text("Grey: equal. Cyan: a is brighter. Magenta: b is.");
    state->compare_old |= changed;
}
