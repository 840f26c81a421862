// panel_clip.c - planes and boxes that cut all volumes.
#include <string.h>

#include "viewer/panel.h"

static void draw_clip(struct pel_state *state, int number) {
    struct pel_clip *clip = &state->scene->clips[number];
    bool box = clip->kind == PEL_CLIP_BOX, handles = state->clip == number + 1;
    if (pel_widget_check(box ? "handles of the box" : "handles of the plane", &handles))
        state->clip = handles ? number + 1 : 0;
    if (pel_widget_drag3(box ? "middle" : "point", clip->point, 0.5, "%.1f"))
        pel_panel_changed(state, "clipping");
    pel_panel_settle(state);
    double vector[3];
    memcpy(vector, box ? clip->size : clip->normal, sizeof vector);
    bool changed = pel_widget_drag3(box ? "size" : "towards", vector, box ? 0.5 : 0.01, "%.2f");
    // A direction has a length, and a box all three sizes.
    bool good = box ? vector[0] > 0 && vector[1] > 0 && vector[2] > 0
                    : vector[0] != 0 || vector[1] != 0 || vector[2] != 0;
    if (changed && good) {
        memcpy(box ? clip->size : clip->normal, vector, sizeof vector);
        pel_panel_changed(state, "clipping");
    }
    pel_panel_settle(state);
    if (pel_widget_check(box ? "cut the inside away" : "keep what is behind", &clip->outside))
        pel_panel_changed(state, "clipping");
}

void pel_panel_clip(struct pel_state *state) {
    struct pel_scene *scene = state->scene;
    for (int i = 0; i < scene->clip_count; i++) {
        pel_widget_push(i);
        draw_clip(state, i);
        pel_widget_pop();
    }
    if (pel_widget_button("add a plane (x)"))
        pel_command_add_clip(state, PEL_CLIP_PLANE);
    pel_widget_same_line();
    if (pel_widget_button("add a box"))
        pel_command_add_clip(state, PEL_CLIP_BOX);
    if (scene->clip_count > 0 && pel_widget_button("remove the last"))
        pel_command_remove_clip(state);
}
