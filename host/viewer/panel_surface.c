// panel_surface.c - what the gradient of the selected volume's values does to its opacity, and its
// surfaces of given values.
#include "viewer/names.h"
#include "viewer/panel.h"

// ---- Gradients ---------------------------------------------------------------------------------

// A gradient of the volume's whole range over ten of its nearest voxels is steep.
static double steep_gradient(const struct pel_state *state, const struct pel_instance *instance) {
    const struct pel_statistics *statistics = &state->scene->statistics[instance->volume];
    double spacing_mm[3], nearest_mm;
    pel_volume_spacing(state->scene->volumes[instance->volume], spacing_mm);
    nearest_mm = spacing_mm[0];
    for (int i = 1; i < 3; i++)
        nearest_mm = spacing_mm[i] < nearest_mm ? spacing_mm[i] : nearest_mm;
    double range = statistics->max - statistics->min;
    return range > 0 && nearest_mm > 0 ? range / (10 * nearest_mm) : 1;
}

static void draw_gradient_opacity(struct pel_state *state, struct pel_instance *instance) {
    double steep = steep_gradient(state, instance);
    bool on = instance->gradient_opacity_count > 0;
    if (pel_widget_check("opacity follows the gradient", &on)) {
        instance->gradient_opacity_count = on ? 2 : 0;
        instance->gradient_opacity[0] = (struct pel_gradient_point){0, 0};
        instance->gradient_opacity[1] = (struct pel_gradient_point){steep, 1};
        pel_panel_changed(state, "gradient opacity");
    }
    int count = instance->gradient_opacity_count;
    for (int i = 0; i < count; i++) {
        struct pel_gradient_point *points = instance->gradient_opacity, *point = &points[i];
        double low = i > 0 ? points[i - 1].gradient : 0;
        double high = i + 1 < count ? points[i + 1].gradient : 10 * steep;
        pel_widget_push(i);
        pel_panel_slide(state, "gradient", &point->gradient, low, high, "%.4g per mm");
        pel_panel_slide(state, "factor", &point->factor, 0, 4, "%.2f");
        pel_widget_pop();
    }
    if (on && count < PEL_GRADIENT_POINT_MAX && pel_widget_button("one more")) {
        struct pel_gradient_point last = instance->gradient_opacity[count - 1];
        instance->gradient_opacity[count] =
            (struct pel_gradient_point){last.gradient + steep, last.factor};
        instance->gradient_opacity_count++;
        pel_panel_changed(state, "gradient opacity");
    }
}

static void draw_silhouette(struct pel_state *state, struct pel_instance *instance) {
    struct pel_silhouette *silhouette = &instance->silhouette;
    bool on = silhouette->base != 0 || silhouette->strength != 0 || silhouette->exponent != 0;
    if (pel_widget_check("silhouettes stand out", &on)) {
        *silhouette = on ? (struct pel_silhouette){0.2, 2, 4} : (struct pel_silhouette){0};
        pel_panel_changed(state, "silhouette");
    }
    if (!on)
        return;
    pel_panel_slide(state, "base", &silhouette->base, 0, 2, "%.2f");
    pel_panel_slide(state, "strength", &silhouette->strength, 0, 10, "%.2f");
    pel_panel_slide_log(state, "exponent", &silhouette->exponent, PEL_SILHOUETTE_EXPONENT_MIN, 32,
                        "%.2f");
}

// ---- Surfaces ----------------------------------------------------------------------------------

static bool shows_surfaces(const struct pel_state *state, const struct pel_instance *instance) {
    enum pel_model model = instance->model;
    return (model == PEL_MODEL_DEFAULT ? state->scene->render.model : model) == PEL_MODEL_ISO;
}

static void draw_surface(struct pel_state *state, struct pel_instance *instance, int number) {
    struct pel_surface *surface = &instance->surfaces[number];
    const struct pel_statistics *statistics = &state->scene->statistics[instance->volume];
    pel_panel_slide(state, "value", &surface->value, statistics->min, statistics->max, "%.5g");
    pel_panel_slide(state, "opaque", &surface->opacity, 0, 1, "%.2f");
    if (pel_widget_check("a colour of its own", &surface->coloured))
        pel_panel_changed(state, "surface");
    if (surface->coloured) {
        if (pel_widget_colour("colour", surface->rgb))
            pel_panel_changed(state, "surface");
        pel_panel_settle(state);
    }
}

static void draw_surfaces(struct pel_state *state, struct pel_instance *instance) {
    const struct pel_statistics *statistics = &state->scene->statistics[instance->volume];
    if (instance->surface_count == 0)
        pel_widget_quiet_text("One opaque surface of the middle value.");
    for (int i = 0; i < instance->surface_count; i++) {
        pel_widget_push(i);
        draw_surface(state, instance, i);
        pel_widget_pop();
    }
    if (instance->surface_count < PEL_SURFACE_MAX && pel_widget_button("add a surface")) {
        instance->surfaces[instance->surface_count++] = (struct pel_surface){
            .value = (statistics->min + statistics->max) / 2, .opacity = 1, .rgb = {1, 1, 1}};
        pel_panel_changed(state, "add a surface");
    }
    if (instance->surface_count > 0) {
        pel_widget_same_line();
        if (pel_widget_button("remove the last")) {
            instance->surface_count--;
            pel_panel_changed(state, "remove a surface");
        }
    }
}

void pel_panel_surface(struct pel_state *state) {
    struct pel_instance *instance = &state->scene->instances[state->selected];
    int gradient = (int)instance->gradient;
    if (pel_widget_choose("gradient", pel_names_gradient(), &gradient)) {
        instance->gradient = (enum pel_gradient)gradient;
        pel_panel_changed(state, "gradient");
    }
    draw_gradient_opacity(state, instance);
    draw_silhouette(state, instance);
    if (shows_surfaces(state, instance))
        draw_surfaces(state, instance);
    else
        pel_widget_quiet_text("Model iso shows surfaces of given values.");
}
