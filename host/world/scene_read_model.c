// scene_read_model.c - how light is gathered, read and written: optical models, order and steps.
#include "world/scene_plan.h"

#include <math.h>

#include "world/scene_write.h"

static const char *const surface_keys[] = {"comment", "value", "colour", "opacity", NULL};

// In the order of their enums, from PEL_MODEL_ABSORPTION on.
static const char *const optical_model_names[] = {"absorption", "emission", "mip",    "minip",
                                                  "average",    "iso",      "thesis", NULL};
static const char *const order_names[] = {"front-to-back", "back-to-front", NULL};

static bool read_optical_model(enum pel_model *model, const struct pel_scene_node *object) {
    struct pel_scene_node node;
    int which = 0;
    if (!pel_node_member(&node, object, "model"))
        return true;
    if (!pel_node_check_name(&node, optical_model_names, &which))
        return false;
    *model = (enum pel_model)(PEL_MODEL_ABSORPTION + which);
    return true;
}

bool pel_scene_read_step(const struct pel_scene_node *object, double *step, double *step_mm) {
    const struct pel_range range = {.low = 0.001, .high = 1000};
    struct pel_scene_node voxels, millimetres;
    bool both = pel_node_member(&voxels, object, "step") &&
                pel_node_member(&millimetres, object, "step_mm");
    if (both)
        return pel_node_fail(&millimetres, "stands beside 'step', which says the same in voxels");
    return pel_node_get_number(object, "step", &range, step) &&
           pel_node_get_number(object, "step_mm", &pel_positive_number, step_mm);
}

static void write_optical_model(struct pel_scene_writer *writer, json_t *object,
                                enum pel_model model) {
    pel_write_name(writer, object, "model", optical_model_names, (int)model - PEL_MODEL_ABSORPTION,
                   -1);
}

// Millimetres overrule voxels in memory, too.
static void write_step(struct pel_scene_writer *writer, json_t *object, double step, double step_mm,
                       double usual) {
    pel_write_number(writer, object, "step", step_mm > 0 ? usual : step, usual);
    pel_write_number(writer, object, "step_mm", step_mm, 0);
}

bool pel_scene_read_march(struct pel_render_settings *render, const struct pel_scene_node *node) {
    int order = (int)render->order;
    double quality = 0;
    const struct pel_range depth_range = {.low = 0, .high = 1000};
    bool good = read_optical_model(&render->model, node) &&
                pel_node_get_name(node, "order", order_names, &order) &&
                pel_node_get_number(node, "emission_scale", &pel_positive_number,
                                    &render->emission_scale) &&
                pel_node_get_bool(node, "preintegration", &render->preintegration) &&
                pel_scene_read_quality(node, &quality) &&
                pel_node_get_number(node, "adaptive_step", &depth_range, &render->adaptive_step) &&
                pel_scene_read_step(node, &render->step, &render->step_mm);
    render->order = (enum pel_order)order;
    return good;
}

void pel_scene_write_march(struct pel_scene_writer *writer, json_t *object) {
    const struct pel_render_settings *render = &writer->scene->render;
    write_optical_model(writer, object, render->model);
    pel_write_name(writer, object, "order", order_names, render->order, PEL_ORDER_FRONT_TO_BACK);
    pel_write_number(writer, object, "emission_scale", render->emission_scale, 0);
    pel_write_bool(writer, object, "preintegration", render->preintegration, false);
    write_step(writer, object, render->step, render->step_mm, writer->usual->render.step);
    pel_write_number(writer, object, "adaptive_step", render->adaptive_step, 0);
}

// A value by itself, or an object.
static bool read_surface(struct pel_surface *surface, const struct pel_scene_node *node) {
    struct pel_scene_node member;
    surface->opacity = 1;
    if (json_is_number(node->value)) {
        surface->value = json_number_value(node->value);
        return fabs(surface->value) <= PEL_COORDINATE_MAX ||
               pel_node_fail(node, "must be at least %g and at most %g, not %g",
                             -PEL_COORDINATE_MAX, PEL_COORDINATE_MAX, surface->value);
    }
    if (!pel_node_check_object(node, surface_keys))
        return false;
    if (!pel_node_member(&member, node, "value"))
        return pel_node_fail(node, "needs 'value'");
    double rgba[4] = {0};
    surface->coloured = pel_node_member(&member, node, "colour");
    if (!pel_node_get_number(node, "value", &pel_any_number, &surface->value) ||
        !pel_node_get_number(node, "opacity", &pel_unit_number, &surface->opacity) ||
        !pel_scene_read_colour(rgba, node, "colour"))
        return false;
    for (int c = 0; c < 3; c++)
        surface->rgb[c] = rgba[c];
    return true;
}

bool pel_scene_read_model(struct pel_instance *instance, const struct pel_scene_node *volume) {
    struct pel_scene_node node;
    if (!read_optical_model(&instance->model, volume) ||
        !pel_node_get_bool(volume, "preintegration", &instance->preintegration))
        return false;
    if (!pel_node_member(&node, volume, "iso"))
        return true;
    instance->surface_count = 1;
    if (!json_is_array(node.value))
        return read_surface(&instance->surfaces[0], &node);
    if (!pel_node_check_list(&node, 1, PEL_SURFACE_MAX))
        return false;
    instance->surface_count = (int)json_array_size(node.value);
    for (int n = 0; n < instance->surface_count; n++) {
        struct pel_scene_node element = pel_node_element(&node, (size_t)n);
        if (!read_surface(&instance->surfaces[n], &element))
            return false;
    }
    return true;
}

void pel_scene_write_model(struct pel_scene_writer *writer, json_t *volume,
                           const struct pel_instance *instance) {
    write_optical_model(writer, volume, instance->model);
    write_step(writer, volume, instance->step, instance->step_mm, 0);
    pel_write_bool(writer, volume, "preintegration", instance->preintegration, false);
    if (instance->surface_count == 0)
        return;
    json_t *list = json_array();
    pel_write_value(writer, volume, "iso", list);
    for (int n = 0; n < instance->surface_count && !writer->failed; n++) {
        const struct pel_surface *surface = &instance->surfaces[n];
        json_t *object = json_object();
        json_array_append_new(list, object);
        pel_write_value(writer, object, "value", pel_write_make_number(surface->value));
        pel_write_number(writer, object, "opacity", surface->opacity, 1);
        if (surface->coloured)
            pel_write_colour(writer, object, "colour",
                             (double[4]){surface->rgb[0], surface->rgb[1], surface->rgb[2], 1},
                             false);
    }
}
