// panel_volumes.c - the list of volumes, and what belongs to the selected one.
#include <math.h>
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

// Whether a volume may be the mask of another: neither itself nor masked by that one.
static bool may_mask(const struct pel_scene *scene, int mask, int instance) {
    for (int steps = 0; steps < scene->instance_count; steps++) {
        if (mask == instance)
            return false;
        if (scene->instances[mask].mask.range_count == 0)
            return true;
        mask = scene->instances[mask].mask.instance;
    }
    return false;
}

// A label map selects by all its labels at first, another volume by its upper half of values.
static void set_mask(struct pel_state *state, struct pel_instance *instance, int mask) {
    instance->mask = (struct pel_mask){0};
    if (mask >= 0) {
        int volume = state->scene->instances[mask].volume;
        const struct pel_statistics *statistics = &state->scene->statistics[volume];
        double middle = (statistics->min + statistics->max) / 2;
        instance->mask.instance = mask;
        instance->mask.range_count = 1;
        instance->mask.ranges[0] =
            (struct pel_value_range){state->scene->volumes[volume]->labels ? 1 : middle, INFINITY};
    }
    pel_panel_changed(state, "mask");
}

static void draw_mask_values(struct pel_state *state, struct pel_instance *instance) {
    // What is being typed stays until the mask changes, or another one is shown.
    char written[sizeof state->mask_written];
    pel_mask_write_values(&instance->mask, written, sizeof written);
    if (strcmp(written, state->mask_written) != 0) {
        strcpy(state->mask_written, written);
        strcpy(state->mask_text, written);
    }
    pel_widget_edit("values", state->mask_text, sizeof state->mask_text);
    pel_widget_hint("labels, ranges such as 3..5, and >=0.5, with commas between them");
    if (pel_widget_button("select these")) {
        if (pel_mask_read_values(&instance->mask, state->mask_text))
            pel_panel_changed(state, "mask");
        else
            pel_state_say(state, "%s", pel_error_message());
    }
    pel_widget_same_line();
    if (pel_widget_check("elsewhere", &instance->mask.inverted))
        pel_panel_changed(state, "mask");
    pel_widget_hint("show the volume where none of these values is");
}

// Which other volume decides where this one is shown. With one volume there is none to choose.
static void draw_mask(struct pel_state *state, struct pel_instance *instance) {
    const struct pel_scene *scene = state->scene;
    const char *names[PEL_VOLUME_MAX + 1] = {"everywhere"};
    int masks[PEL_VOLUME_MAX] = {-1}, count = 1, chosen = 0;
    for (int k = 0; k < scene->instance_count; k++) {
        if (!may_mask(scene, k, state->selected))
            continue;
        if (instance->mask.range_count > 0 && instance->mask.instance == k)
            chosen = count;
        names[count] = scene->instances[k].name;
        masks[count++] = k;
    }
    if (scene->instance_count < 2)
        return;
    if (pel_widget_choose("shown where", names, &chosen))
        set_mask(state, instance, masks[chosen]);
    pel_widget_hint("where another volume has some values, such as labels");
    if (instance->mask.range_count > 0)
        draw_mask_values(state, instance);
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
             "%g to %g%s%s, mean %.4g",
             file ? file : volume->name, volume->dims[0], volume->dims[1], volume->dims[2],
             pel_voxel_type_name(volume->type), spacing_mm[0], spacing_mm[1], spacing_mm[2],
             volume->space[0] ? volume->space : "no space named", statistics->min, statistics->max,
             volume->unit[0] ? " " : "", volume->unit, statistics->mean);
    pel_widget_quiet_text(text);
}

void pel_panel_volumes(struct pel_state *state) {
    draw_list(state);
    draw_buttons(state);
    struct pel_instance *instance = &state->scene->instances[state->selected];
    draw_choices(state, instance);
    draw_mask(state, instance);
    draw_information(state, instance);
}
