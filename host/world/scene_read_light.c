// scene_read_light.c - the `lights` of a scene file and the `shading` of a volume, read and
// written.
#include "world/scene_plan.h"
#include "world/scene_write.h"

static const char *const light_keys[] = {"comment", "kind",      "direction", "position",
                                         "colour",  "intensity", NULL};
static const char *const shading_keys[] = {"comment",  "model",     "ambient",   "diffuse",
                                           "specular", "shininess", "two_sided", NULL};

// In the order of their enums; the first model is none at all.
static const char *const light_names[] = {"headlight", "camera", "directional", "point", NULL};
static const char *const model_names[] = {"blinn-phong", "phong", NULL};

static const struct pel_range amount_range = {.low = 0, .high = PEL_LIGHT_AMOUNT_MAX};
static const struct pel_range coordinate_range = {.low = -PEL_COORDINATE_MAX,
                                                  .high = PEL_COORDINATE_MAX};

// Where a light shines from or to is needed for the kinds that have a use for it, and refused for
// the others.
static bool read_place(double place[3], const struct pel_scene_node *node, const char *key,
                       bool wanted) {
    struct pel_scene_node member;
    bool given = pel_node_member(&member, node, key);
    if (wanted && !given)
        return pel_node_fail(node, "needs '%s'", key);
    if (given && !wanted)
        return pel_node_fail(&member, "is of no use to this kind of light");
    return pel_node_get_numbers(node, key, 3, &coordinate_range, place);
}

static bool read_light(struct pel_light *light, const struct pel_scene_node *node) {
    int kind = PEL_LIGHT_HEADLIGHT;
    double rgba[4] = {1, 1, 1, 1};
    *light = (struct pel_light){.intensity = 1};
    if (!pel_node_check_object(node, light_keys) ||
        !pel_node_get_name(node, "kind", light_names, &kind) ||
        !read_place(light->direction, node, "direction", kind == PEL_LIGHT_DIRECTIONAL) ||
        !read_place(light->position, node, "position", kind == PEL_LIGHT_POINT) ||
        !pel_scene_read_colour(rgba, node, "colour") ||
        !pel_node_get_number(node, "intensity", &amount_range, &light->intensity))
        return false;
    const double *along = light->direction;
    struct pel_scene_node direction;
    if (kind == PEL_LIGHT_DIRECTIONAL && along[0] == 0 && along[1] == 0 && along[2] == 0) {
        pel_node_member(&direction, node, "direction");
        return pel_node_fail(&direction, "has no length");
    }
    light->kind = (enum pel_light_kind)kind;
    for (int c = 0; c < 3; c++)
        light->colour[c] = rgba[c];
    return true;
}

bool pel_scene_read_lights(struct pel_scene *scene, const struct pel_scene_node *node) {
    struct pel_scene_node lights;
    if (!pel_node_member(&lights, node, "lights"))
        return true;
    if (!pel_node_check_list(&lights, 1, PEL_LIGHT_MAX))
        return false;
    scene->light_count = (int)json_array_size(lights.value);
    for (int n = 0; n < scene->light_count; n++) {
        struct pel_scene_node light = pel_node_element(&lights, (size_t)n);
        if (!read_light(&scene->lights[n], &light))
            return false;
    }
    return true;
}

static void write_light(struct pel_scene_writer *writer, json_t *object,
                        const struct pel_light *light) {
    const double *colour = light->colour;
    pel_write_name(writer, object, "kind", light_names, light->kind, PEL_LIGHT_HEADLIGHT);
    if (light->kind == PEL_LIGHT_DIRECTIONAL)
        pel_write_numbers(writer, object, "direction", 3, light->direction);
    if (light->kind == PEL_LIGHT_POINT)
        pel_write_numbers(writer, object, "position", 3, light->position);
    if (colour[0] != 1 || colour[1] != 1 || colour[2] != 1)
        pel_write_colour(writer, object, "colour", (double[4]){colour[0], colour[1], colour[2], 1},
                         false);
    pel_write_number(writer, object, "intensity", light->intensity, 1);
}

void pel_scene_write_lights(struct pel_scene_writer *writer, json_t *root) {
    if (writer->scene->light_count == 0)
        return;
    json_t *lights = json_array();
    pel_write_value(writer, root, "lights", lights);
    for (int n = 0; n < writer->scene->light_count && !writer->failed; n++) {
        json_t *light = json_object();
        json_array_append_new(lights, light);
        write_light(writer, light, &writer->scene->lights[n]);
    }
}

bool pel_scene_read_material(struct pel_material *material, const struct pel_scene_node *volume) {
    struct pel_scene_node node;
    const struct pel_range shininess_range = {.low = 1, .high = PEL_SHININESS_MAX};
    if (!pel_node_member(&node, volume, "shading") || json_is_false(node.value))
        return true;
    *material = pel_material_default(PEL_SHADING_BLINN_PHONG);
    if (json_is_true(node.value))
        return true;
    if (!json_is_object(node.value))
        return pel_node_fail(&node, "must be true, false or an object");
    int model = 0;
    bool two_sided = true;
    if (!pel_node_check_object(&node, shading_keys) ||
        !pel_node_get_name(&node, "model", model_names, &model) ||
        !pel_node_get_number(&node, "ambient", &amount_range, &material->ambient) ||
        !pel_node_get_number(&node, "diffuse", &amount_range, &material->diffuse) ||
        !pel_node_get_number(&node, "specular", &amount_range, &material->specular) ||
        !pel_node_get_number(&node, "shininess", &shininess_range, &material->shininess) ||
        !pel_node_get_bool(&node, "two_sided", &two_sided))
        return false;
    material->shading = (enum pel_shading)(PEL_SHADING_BLINN_PHONG + model);
    material->one_sided = !two_sided;
    return true;
}

void pel_scene_write_material(struct pel_scene_writer *writer, json_t *volume,
                              const struct pel_material *material) {
    if (material->shading == PEL_SHADING_NONE)
        return;
    struct pel_material usual = pel_material_default(material->shading);
    // Four zeros in memory are the usual numbers.
    bool numbers = material->ambient != 0 || material->diffuse != 0 || material->specular != 0 ||
                   material->shininess != 0;
    json_t *object = pel_write_object(writer, volume, "shading");
    pel_write_name(writer, object, "model", model_names,
                   (int)material->shading - PEL_SHADING_BLINN_PHONG, 0);
    if (numbers) {
        pel_write_number(writer, object, "ambient", material->ambient, usual.ambient);
        pel_write_number(writer, object, "diffuse", material->diffuse, usual.diffuse);
        pel_write_number(writer, object, "specular", material->specular, usual.specular);
        pel_write_number(writer, object, "shininess", material->shininess, usual.shininess);
    }
    pel_write_bool(writer, object, "two_sided", !material->one_sided, true);
}
