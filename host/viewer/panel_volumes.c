// panel_volumes.c - the list of volumes, and what belongs to the selected one.
#include <stdio.h>
#include <string.h>

#include "viewer/names.h"
#include "viewer/panel.h"

static void draw_list(struct pel_state *state) {
    for (int i = 0; i < state->scene->instance_count; i++) {
        struct pel_instance *instance = &state->scene->instances[i];
        bool shown = !instance->hidden;
        pel_widget_push(i);
        if (pel_widget_check("##shown", &shown)) {
            instance->hidden = !shown;
            pel_state_begin_gesture(state);
            pel_panel_changed(state, shown ? "show" : "hide");
        }
        pel_widget_hint("show it");
        pel_widget_same_line();
        if (pel_widget_select(instance->name, i == state->selected, 0))
            state->selected = i;
        pel_widget_pop();
    }
}

static void draw_buttons(struct pel_state *state) {
    static const struct {
        const char *label, *hint;
        enum pel_action action;
    } buttons[] = {
        {"Solo", "show it alone, or all again (Shift + v)", PEL_ACTION_SOLO},
        {"Up", "earlier in the list (Page Up)", PEL_ACTION_EARLIER},
        {"Down", "later in the list (Page Down)", PEL_ACTION_LATER},
        {"Fit", "all of it in the picture (f)", PEL_ACTION_FIT},
        {"Remove", "take it out of the scene (Delete)", PEL_ACTION_REMOVE},
        {"Reload", "read the files that changed (r)", PEL_ACTION_RELOAD},
    };
    for (size_t i = 0; i < sizeof buttons / sizeof *buttons; i++) {
        if (i > 0)
            pel_widget_same_line();
        if (pel_widget_button(buttons[i].label)) {
            pel_state_begin_gesture(state);
            pel_command_do(state, buttons[i].action, 0);
        }
        pel_widget_hint(buttons[i].hint);
    }
    pel_widget_quiet_text("Drop files on the window to add volumes.");
}

static void draw_choices(struct pel_state *state, struct pel_instance *instance) {
    pel_panel_slide_log(state, "density", &instance->density, 0.01, 100, "%.3g");
    int filter = (int)instance->filter, shading = (int)instance->material.shading;
    if (pel_widget_choose("filter", pel_names_filter(), &filter)) {
        instance->filter = (enum pel_filter)filter;
        pel_panel_changed(state, "filter");
    }
    if (pel_widget_choose("shading", pel_names_shading(), &shading)) {
        if (instance->material.shading == PEL_SHADING_NONE)
            instance->material = pel_material_default((enum pel_shading)shading);
        instance->material.shading = (enum pel_shading)shading;
        pel_panel_changed(state, "shading");
    }
    int model = (int)instance->model;
    if (pel_widget_choose("model", pel_names_model(), &model)) {
        instance->model = (enum pel_model)model;
        pel_panel_changed(state, "optical model");
    }
    if (state->scene->render.mixing == PEL_MIX_PRIORITY)
        pel_panel_slide(state, "priority", &instance->priority, -10, 10, "%.1f");
    int mixing = (int)state->scene->render.mixing;
    if (pel_widget_choose("mixing (all)", pel_mixing_names(), &mixing)) {
        state->scene->render.mixing = (enum pel_mixing)mixing;
        pel_panel_changed(state, "mixing");
    }
}

// What `pellucid info` says, in short.
static void draw_information(const struct pel_state *state, const struct pel_instance *instance) {
    const struct pel_volume *volume = state->scene->volumes[instance->volume];
    const struct pel_statistics *statistics = &state->scene->statistics[instance->volume];
    const char *file = state->scene->sources[instance->volume].file;
    double spacing_mm[3];
    pel_volume_spacing(volume, spacing_mm);
    char text[768];
    snprintf(text, sizeof text,
             "%s\n%d x %d x %d voxels, %s\n%.4g x %.4g x %.4g mm, %s\n"
             "%g to %g %s, mean %.4g",
             file ? file : volume->name, volume->dims[0], volume->dims[1], volume->dims[2],
             pel_voxel_type_name(volume->type), spacing_mm[0], spacing_mm[1], spacing_mm[2],
             volume->space[0] ? volume->space : "no space named", statistics->min, statistics->max,
             volume->unit, statistics->mean);
    pel_widget_quiet_text(text);
}

void pel_panel_volumes(struct pel_state *state) {
    draw_list(state);
    draw_buttons(state);
    struct pel_instance *instance = &state->scene->instances[state->selected];
    draw_choices(state, instance);
    draw_information(state, instance);
}
