// panel_look.c - how the scene is seen: the camera, the background, lights, stereo.
#include <stdio.h>
#include <string.h>

#include "viewer/names.h"
#include "viewer/panel.h"

// ---- Camera and background ---------------------------------------------------------------------

static void draw_views(struct pel_state *state) {
    const char *const *names = pel_navigation_view_names();
    for (int i = 0; names[i]; i++) {
        if (i % 3 != 0)
            pel_widget_same_line();
        if (pel_widget_button(names[i])) {
            pel_state_begin_gesture(state);
            pel_command_do(state, PEL_ACTION_VIEW, i);
        }
    }
    if (pel_widget_button("begin"))
        pel_command_do(state, PEL_ACTION_RESET_VIEW, 0);
    for (int i = 0; i < 4; i++) {
        char label[16];
        snprintf(label, sizeof label, "%s %d", state->navigation.viewpoints[i].set ? "go" : "keep",
                 i + 1);
        pel_widget_same_line();
        if (pel_widget_button(label))
            pel_command_do(
                state, state->navigation.viewpoints[i].set ? PEL_ACTION_RECALL : PEL_ACTION_STORE,
                i);
    }
}

void pel_panel_look(struct pel_state *state) {
    struct pel_navigation *navigation = &state->navigation;
    draw_views(state);
    int mode = (int)navigation->mode;
    if (pel_widget_choose("hand", pel_navigation_mode_names(), &mode))
        navigation->mode = (enum pel_navigation_mode)mode;
    bool orthographic = navigation->camera.orthographic;
    if (pel_widget_check("parallel rays", &orthographic))
        pel_command_do(state, PEL_ACTION_ORTHOGRAPHIC, 0);
    double fov_deg = navigation->camera.fov_deg;
    if (!orthographic && pel_widget_slide("field of view", &fov_deg, 5, 120, "%.0f degrees")) {
        pel_navigation_set_fov(navigation, fov_deg);
        pel_state_move_camera(state);
    }
    pel_panel_settle(state);
    int model = (int)state->scene->render.model;
    if (pel_widget_choose("model (all)", pel_names_scene_model(), &model)) {
        state->scene->render.model = (enum pel_model)model;
        pel_panel_changed(state, "optical model");
    }
    if (pel_widget_colour("background", state->scene->background))
        pel_panel_changed(state, "background");
    pel_panel_settle(state);
}

// ---- Lights ------------------------------------------------------------------------------------

static void draw_light(struct pel_state *state, struct pel_light *light) {
    int kind = (int)light->kind;
    if (pel_widget_choose("light", pel_names_light(), &kind)) {
        light->kind = (enum pel_light_kind)kind;
        if (kind == PEL_LIGHT_DIRECTIONAL && light->direction[0] == 0 && light->direction[1] == 0 &&
            light->direction[2] == 0)
            light->direction[2] = -1;
        pel_panel_changed(state, "light");
    }
    if (pel_widget_colour("colour", light->colour))
        pel_panel_changed(state, "light");
    pel_panel_settle(state);
    pel_panel_slide(state, "intensity", &light->intensity, 0, 4, "%.2f");
    bool directional = light->kind == PEL_LIGHT_DIRECTIONAL;
    if (directional || light->kind == PEL_LIGHT_POINT) {
        double *place = directional ? light->direction : light->position, moved[3];
        memcpy(moved, place, sizeof moved);
        bool changed = pel_widget_drag3(directional ? "direction" : "position", moved,
                                        directional ? 0.01 : 1, "%.4g");
        // A direction has a length.
        if (changed && (!directional || moved[0] != 0 || moved[1] != 0 || moved[2] != 0)) {
            memcpy(place, moved, sizeof moved);
            pel_panel_changed(state, "light");
        }
        pel_panel_settle(state);
    }
}

void pel_panel_light(struct pel_state *state) {
    struct pel_scene *scene = state->scene;
    struct pel_material *material = &scene->instances[state->selected].material;
    if (material->shading == PEL_SHADING_NONE) {
        pel_widget_quiet_text("The selected volume is not shaded: l shades it.");
    } else {
        pel_panel_slide(state, "ambient", &material->ambient, 0, 1, "%.2f");
        pel_panel_slide(state, "diffuse", &material->diffuse, 0, 2, "%.2f");
        pel_panel_slide(state, "specular", &material->specular, 0, 2, "%.2f");
        pel_panel_slide_log(state, "shininess", &material->shininess, 1, 200, "%.0f");
        if (pel_widget_check("one side only", &material->one_sided))
            pel_panel_changed(state, "shading");
    }
    if (scene->light_count == 0)
        pel_widget_quiet_text("One white headlight.");
    for (int i = 0; i < scene->light_count; i++) {
        pel_widget_push(i);
        draw_light(state, &scene->lights[i]);
        pel_widget_pop();
    }
    if (scene->light_count < PEL_LIGHT_MAX && pel_widget_button("add a light")) {
        scene->lights[scene->light_count++] = (struct pel_light){.kind = PEL_LIGHT_DIRECTIONAL,
                                                                 .direction = {0, 0, -1},
                                                                 .colour = {1, 1, 1},
                                                                 .intensity = 1};
        pel_panel_changed(state, "add a light");
    }
    if (scene->light_count > 0) {
        pel_widget_same_line();
        if (pel_widget_button("remove the last")) {
            scene->light_count--;
            pel_panel_changed(state, "remove a light");
        }
    }
    if (pel_widget_check("shadows", &scene->render.shadows.on))
        pel_panel_changed(state, "shadows");
    pel_widget_same_line();
    if (pel_widget_check("ambient occlusion", &scene->render.ambient_occlusion.on))
        pel_panel_changed(state, "ambient occlusion");
}

// ---- Stereo ------------------------------------------------------------------------------------

static void draw_length(struct pel_state *state, const char *label, double *length_mm, double used,
                        double high) {
    bool automatic = *length_mm == 0;
    char check[64];
    snprintf(check, sizeof check, "automatic %s", label);
    if (pel_widget_check(check, &automatic)) {
        *length_mm = automatic ? 0 : used;
        pel_panel_changed(state, label);
    }
    if (!automatic)
        pel_panel_slide_log(state, label, length_mm, high / 1000, high, "%.4g mm");
}

void pel_panel_stereo(struct pel_state *state) {
    struct pel_stereo *stereo = &state->scene->stereo;
    int kind = (int)stereo->kind;
    if (pel_widget_choose("kind", pel_stereo_names(), &kind)) {
        stereo->kind = (enum pel_stereo_kind)kind;
        pel_panel_changed(state, "stereo");
    }
    if (stereo->kind == PEL_STEREO_NONE)
        return;
    struct pel_camera cameras[2];
    struct pel_stereo used;
    if (!pel_stereo_cameras(state->scene, cameras, &used)) {
        pel_widget_text(pel_error_message());
        return;
    }
    draw_length(state, "separation", &stereo->separation_mm, used.separation_mm, 200);
    draw_length(state, "convergence", &stereo->convergence_mm, used.convergence_mm, 5000);
    char text[96];
    snprintf(text, sizeof text, "eyes %.4g mm apart, converging at %.4g mm", used.separation_mm,
             used.convergence_mm);
    pel_widget_quiet_text(text);
    if (pel_widget_check("no separation at all", &stereo->flat))
        pel_panel_changed(state, "flat");
    if (pel_widget_check("exchange the eyes", &stereo->swap))
        pel_panel_changed(state, "exchange the eyes");
    if (pel_widget_check("turn the cameras inwards", &stereo->toe_in))
        pel_panel_changed(state, "toe-in");
    if (pel_widget_check("second eye from the first one's picture", &stereo->reproject))
        pel_panel_changed(state, "reprojection");
}
