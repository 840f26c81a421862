// command_look.c - keys that change how things are rendered: transfer functions, filter, mixing,
// stereo, quality.
#include <stdio.h>
#include <string.h>

#include "viewer/command.h"
#include "viewer/names.h"
#include "viewer/show.h"
#include "viewer/transfer_edit.h"

// The choice after (or before) this one, round and round.
static int next(int choice, int by, const char *const *names) {
    int count = pel_names_count(names);
    return (choice + by + count) % count;
}

void pel_command_preset(struct pel_state *state, int preset) {
    struct pel_instance *instance = &state->scene->instances[state->selected];
    const struct pel_statistics *statistics = &state->scene->statistics[instance->volume];
    const char *name = pel_transfer_presets()[preset];
    state->preset = preset;
    double low, high;
    pel_transfer_window(instance->transfer, &low, &high);
    struct pel_transfer *transfer =
        pel_transfer_fit_preset(name, statistics, low, high, instance->transfer);
    if (!transfer) {
        pel_state_say(state, "%s", pel_error_message());
        return;
    }
    pel_transfer_destroy(instance->transfer);
    instance->transfer = transfer;
    pel_state_say(state, "%s: %s", instance->name, name);
    pel_state_change(state, "transfer function");
}

static void change_filter(struct pel_state *state) {
    struct pel_instance *instance = &state->scene->instances[state->selected];
    int filter = next((int)instance->filter, 1, pel_names_filter());
    instance->filter = (enum pel_filter)filter;
    pel_state_say(state, "%s: %s", instance->name, pel_names_filter()[filter]);
    pel_state_change(state, "filter");
}

static void change_mixing(struct pel_state *state) {
    int mixing = next((int)state->scene->render.mixing, 1, pel_mixing_names());
    state->scene->render.mixing = (enum pel_mixing)mixing;
    pel_state_say(state, "volumes mix by %s", pel_mixing_names()[mixing]);
    pel_state_change(state, "mixing");
}

static bool change_volume_look(struct pel_state *state, enum pel_action action) {
    switch (action) {
    case PEL_ACTION_PRESET:
    case PEL_ACTION_PRESET_BACK:
        pel_command_preset(state, next(state->preset, action == PEL_ACTION_PRESET ? 1 : -1,
                                       pel_transfer_presets()));
        return true;
    case PEL_ACTION_FILTER:
        change_filter(state);
        return true;
    case PEL_ACTION_MIXING:
        change_mixing(state);
        return true;
    default:
        return false;
    }
}

// ---- Stereo ------------------------------------------------------------------------------------

static void change_stereo(struct pel_state *state, int by) {
    int kind = next((int)state->scene->stereo.kind, by, pel_stereo_names());
    state->scene->stereo.kind = (enum pel_stereo_kind)kind;
    pel_state_say(state, "stereo: %s", pel_stereo_names()[kind]);
    pel_state_change(state, "stereo");
}

// From the length that is used, which may have been chosen automatically.
static void scale_length(struct pel_state *state, bool separation, double by) {
    struct pel_camera cameras[2];
    struct pel_stereo used, *stereo = &state->scene->stereo;
    if (stereo->kind == PEL_STEREO_NONE || !pel_stereo_cameras(state->scene, cameras, &used)) {
        pel_state_say(state, "there is no stereo: z begins it");
        return;
    }
    double *length_mm = separation ? &stereo->separation_mm : &stereo->convergence_mm;
    *length_mm = by * (separation ? used.separation_mm : used.convergence_mm);
    pel_state_say(state, "%s %.4g mm", separation ? "separation" : "convergence", *length_mm);
    pel_state_change(state, separation ? "separation" : "convergence");
}

static bool change_eyes(struct pel_state *state, enum pel_action action) {
    switch (action) {
    case PEL_ACTION_STEREO:
    case PEL_ACTION_STEREO_BACK:
        change_stereo(state, action == PEL_ACTION_STEREO ? 1 : -1);
        return true;
    case PEL_ACTION_SWAP_EYES:
        state->scene->stereo.swap = !state->scene->stereo.swap;
        pel_state_change(state, "exchange the eyes");
        return true;
    case PEL_ACTION_REPROJECT:
        state->scene->stereo.reproject = !state->scene->stereo.reproject;
        pel_state_say(state, state->scene->stereo.reproject
                                 ? "the second eye comes from the first one's picture"
                                 : "both eyes are rendered");
        pel_state_change(state, "reprojection");
        return true;
    case PEL_ACTION_NARROWER:
    case PEL_ACTION_WIDER:
        scale_length(state, true, action == PEL_ACTION_WIDER ? 1.1 : 1 / 1.1);
        return true;
    case PEL_ACTION_CONVERGE_NEARER:
    case PEL_ACTION_CONVERGE_FARTHER:
        scale_length(state, false, action == PEL_ACTION_CONVERGE_FARTHER ? 1.05 : 1 / 1.05);
        return true;
    default:
        return false;
    }
}

// ---- Quality -----------------------------------------------------------------------------------

static bool change_quality(struct pel_state *state, enum pel_action action) {
    struct pel_render_settings *render = &state->scene->render;
    int n = render->supersampling.n > 1 ? render->supersampling.n : 1;
    switch (action) {
    case PEL_ACTION_SUPERSAMPLING:
        n = n < 4 ? n + 1 : 1;
        render->supersampling.n = n;
        pel_state_say(state, "%d x %d rays a pixel", n, n);
        pel_state_change(state, "supersampling");
        return true;
    case PEL_ACTION_STEP:
        render->step_mm = 0;
        render->step = render->step > 0.75 ? 0.5 : render->step > 0.375 ? 0.25 : 1;
        pel_state_say(state, "step %g voxels", render->step);
        pel_state_change(state, "step");
        return true;
    case PEL_ACTION_SKIP:
        render->skip = (enum pel_skip)next((int)render->skip, 1, pel_names_skip());
        pel_state_say(state, "skip: %s", pel_names_skip()[render->skip]);
        pel_state_change(state, "skip");
        return true;
    default:
        return false;
    }
}

void pel_command_add_clip(struct pel_state *state, enum pel_clip_kind kind) {
    struct pel_scene *scene = state->scene;
    struct pel_bounds bounds;
    struct pel_view view;
    if (scene->clip_count >= PEL_CLIP_MAX || !pel_scene_bounds(scene, &bounds) ||
        !pel_state_view(state, 0, &view)) {
        pel_state_say(state, "no more cuts: %d of %d are there", scene->clip_count, PEL_CLIP_MAX);
        return;
    }
    struct pel_clip clip = {.kind = kind, .in_world = true};
    for (int i = 0; i < 3; i++) {
        clip.point[i] = (bounds.low[i] + bounds.high[i]) / 2;
        clip.normal[i] = view.forward[i];
        clip.size[i] = (bounds.high[i] - bounds.low[i]) / 2;
    }
    scene->clips[scene->clip_count++] = clip;
    state->clip = scene->clip_count;
    pel_state_change(state, "add a cut");
}

void pel_command_remove_clip(struct pel_state *state) {
    if (state->scene->clip_count == 0)
        return;
    state->scene->clip_count--;
    if (state->clip > state->scene->clip_count)
        state->clip = state->scene->clip_count;
    pel_state_change(state, "remove a cut");
}

static bool change_cuts(struct pel_state *state, enum pel_action action) {
    if (action == PEL_ACTION_CLIP)
        pel_command_add_clip(state, PEL_CLIP_PLANE);
    else if (action == PEL_ACTION_UNCLIP)
        pel_command_remove_clip(state);
    else if (action == PEL_ACTION_CLIP_HANDLES)
        state->clip = (state->clip + 1) % (state->scene->clip_count + 1);
    return action == PEL_ACTION_CLIP || action == PEL_ACTION_UNCLIP ||
           action == PEL_ACTION_CLIP_HANDLES;
}

static bool change_comparison(struct pel_state *state, enum pel_action action) {
    if (action != PEL_ACTION_COMPARE && action != PEL_ACTION_COMPARE_BACK)
        return false;
    int mode =
        next((int)state->compare.mode, action == PEL_ACTION_COMPARE ? 1 : -1, pel_compare_names());
    pel_show_set_mode(state, (enum pel_compare_mode)mode);
    pel_state_say(state, "compare: %s", pel_compare_names()[mode]);
    return true;
}

bool pel_command_look(struct pel_state *state, enum pel_action action) {
    return change_volume_look(state, action) || change_eyes(state, action) ||
           change_comparison(state, action) || change_cuts(state, action) ||
           change_quality(state, action);
}
