// scene_read_secondary.c - the `shadows` and `ambient_occlusion` of a scene file, read and written.
#include "world/scene_plan.h"
#include "world/scene_write.h"

static const char *const shadow_keys[] = {"comment", "length", "step", "strength", NULL};
static const char *const occlusion_keys[] = {"comment", "directions", "radius",
                                             "step",    "strength",   NULL};

static const struct pel_range step_range = {.low = PEL_SECONDARY_STEP_MIN,
                                            .high = PEL_SECONDARY_STEP_MAX};
static const struct pel_range strength_range = {.low = 0, .high = 1, .low_open = true};

// A member that is false, true or an object; with an object `*keys` is that.
static bool read_switch(bool *on, bool *has_keys, struct pel_scene_node *keys,
                        const struct pel_scene_node *render, const char *key) {
    *has_keys = false;
    if (!pel_node_member(keys, render, key))
        return true;
    *has_keys = json_is_object(keys->value);
    if (!*has_keys && !json_is_boolean(keys->value))
        return pel_node_fail(keys, "must be true, false or an object");
    *on = !json_is_false(keys->value);
    return true;
}

static bool read_shadows(struct pel_shadows *shadows, const struct pel_scene_node *render) {
    struct pel_scene_node node;
    bool has_keys;
    if (!read_switch(&shadows->on, &has_keys, &node, render, "shadows"))
        return false;
    return !has_keys ||
           (pel_node_check_object(&node, shadow_keys) &&
            pel_node_get_number(&node, "length", &pel_positive_number, &shadows->length_mm) &&
            pel_node_get_number(&node, "step", &step_range, &shadows->step) &&
            pel_node_get_number(&node, "strength", &strength_range, &shadows->strength));
}

static bool read_occlusion(struct pel_ambient_occlusion *occlusion,
                           const struct pel_scene_node *render) {
    struct pel_scene_node node;
    bool has_keys;
    if (!read_switch(&occlusion->on, &has_keys, &node, render, "ambient_occlusion"))
        return false;
    return !has_keys ||
           (pel_node_check_object(&node, occlusion_keys) &&
            pel_node_get_integer(&node, "directions", 1, PEL_OCCLUSION_DIRECTION_MAX,
                                 &occlusion->directions) &&
            pel_node_get_number(&node, "radius", &pel_positive_number, &occlusion->radius_mm) &&
            pel_node_get_number(&node, "step", &step_range, &occlusion->step) &&
            pel_node_get_number(&node, "strength", &strength_range, &occlusion->strength));
}

bool pel_scene_read_secondary(struct pel_render_settings *render,
                              const struct pel_scene_node *node) {
    return read_shadows(&render->shadows, node) && read_occlusion(&render->ambient_occlusion, node);
}

void pel_scene_write_secondary(struct pel_scene_writer *writer, json_t *render) {
    const struct pel_shadows *shadows = &writer->scene->render.shadows;
    const struct pel_ambient_occlusion *occlusion = &writer->scene->render.ambient_occlusion;
    if (shadows->on) {
        json_t *object = pel_write_object(writer, render, "shadows");
        pel_write_number(writer, object, "length", shadows->length_mm, 0);
        pel_write_number(writer, object, "step", shadows->step, 0);
        pel_write_number(writer, object, "strength", shadows->strength, 0);
    }
    if (occlusion->on) {
        json_t *object = pel_write_object(writer, render, "ambient_occlusion");
        pel_write_number(writer, object, "directions", occlusion->directions, 0);
        pel_write_number(writer, object, "radius", occlusion->radius_mm, 0);
        pel_write_number(writer, object, "step", occlusion->step, 0);
        pel_write_number(writer, object, "strength", occlusion->strength, 0);
    }
}
