// scene_read_style.c - `gradient`, `gradient_opacity` and `silhouette` of a volume, read and
// written.
#include "world/scene_plan.h"
#include "world/scene_write.h"

static const char *const silhouette_keys[] = {"comment", "base", "strength", "exponent", NULL};

// In the order of their enum.
static const char *const gradient_names[] = {"central", "sobel", "analytic", NULL};

static const struct pel_range gradient_range = {.low = 0, .high = 1e9};
static const struct pel_range factor_range = {.low = 0, .high = PEL_OPACITY_FACTOR_MAX};

static const struct pel_silhouette usual_silhouette = {.base = 1, .strength = 4, .exponent = 4};

// [low, high] is short for [[low, 0], [high, 1]].
static bool read_ramp(struct pel_instance *instance, const struct pel_scene_node *list) {
    double ends[2];
    if (!pel_node_check_numbers(list, 2, &gradient_range, ends))
        return false;
    if (ends[1] < ends[0])
        return pel_node_fail(list, "goes down from %g to %g", ends[0], ends[1]);
    instance->gradient_opacity_count = 2;
    instance->gradient_opacity[0] = (struct pel_gradient_point){ends[0], 0};
    instance->gradient_opacity[1] = (struct pel_gradient_point){ends[1], 1};
    return true;
}

static bool read_point(struct pel_gradient_point *point, const struct pel_scene_node *node) {
    double numbers[2];
    if (!pel_node_check_numbers(node, 2, &pel_any_number, numbers))
        return false;
    *point = (struct pel_gradient_point){numbers[0], numbers[1]};
    if (numbers[0] < gradient_range.low || numbers[0] > gradient_range.high)
        return pel_node_fail(node, "has a gradient of %g, outside %g..%g", numbers[0],
                             gradient_range.low, gradient_range.high);
    if (numbers[1] < factor_range.low || numbers[1] > factor_range.high)
        return pel_node_fail(node, "has a factor of %g, outside %g..%g", numbers[1],
                             factor_range.low, factor_range.high);
    return true;
}

static bool read_gradient_opacity(struct pel_instance *instance,
                                  const struct pel_scene_node *volume) {
    struct pel_scene_node list;
    if (!pel_node_member(&list, volume, "gradient_opacity"))
        return true;
    if (json_is_array(list.value) && json_is_number(json_array_get(list.value, 0)))
        return read_ramp(instance, &list);
    if (!pel_node_check_list(&list, 1, PEL_GRADIENT_POINT_MAX))
        return false;
    int count = (int)json_array_size(list.value);
    for (int n = 0; n < count; n++) {
        struct pel_scene_node node = pel_node_element(&list, (size_t)n);
        struct pel_gradient_point *point = &instance->gradient_opacity[n];
        if (!read_point(point, &node))
            return false;
        if (n > 0 && point->gradient < point[-1].gradient)
            return pel_node_fail(&node, "has %g behind %g, must be in ascending order",
                                 point->gradient, point[-1].gradient);
    }
    instance->gradient_opacity_count = count;
    return true;
}

static bool read_silhouette(struct pel_silhouette *silhouette,
                            const struct pel_scene_node *volume) {
    struct pel_scene_node node;
    const struct pel_range exponent_range = {.low = PEL_SILHOUETTE_EXPONENT_MIN,
                                             .high = PEL_SILHOUETTE_EXPONENT_MAX};
    if (!pel_node_member(&node, volume, "silhouette"))
        return true;
    *silhouette = usual_silhouette;
    return pel_node_check_object(&node, silhouette_keys) &&
           pel_node_get_number(&node, "base", &factor_range, &silhouette->base) &&
           pel_node_get_number(&node, "strength", &factor_range, &silhouette->strength) &&
           pel_node_get_number(&node, "exponent", &exponent_range, &silhouette->exponent);
}

bool pel_scene_read_gradient(enum pel_gradient *gradient, const struct pel_scene_node *object) {
    int which = (int)*gradient;
    bool good = pel_node_get_name(object, "gradient", gradient_names, &which);
    *gradient = (enum pel_gradient)which;
    return good;
}

bool pel_scene_read_style(struct pel_instance *instance, const struct pel_scene_node *volume) {
    return pel_scene_read_gradient(&instance->gradient, volume) &&
           read_gradient_opacity(instance, volume) &&
           read_silhouette(&instance->silhouette, volume);
}

void pel_scene_write_style(struct pel_scene_writer *writer, json_t *volume,
                           const struct pel_instance *instance) {
    pel_write_name(writer, volume, "gradient", gradient_names, (int)instance->gradient,
                   PEL_GRADIENT_CENTRAL);
    if (instance->gradient_opacity_count > 0) {
        json_t *list = json_array();
        for (int n = 0; n < instance->gradient_opacity_count; n++) {
            const struct pel_gradient_point *point = &instance->gradient_opacity[n];
            const double pair[2] = {point->gradient, point->factor};
            json_array_append_new(list, pel_write_make_numbers(2, pair));
        }
        pel_write_value(writer, volume, "gradient_opacity", list);
    }
    const struct pel_silhouette *silhouette = &instance->silhouette;
    if (silhouette->base == 0 && silhouette->strength == 0 && silhouette->exponent == 0)
        return;
    json_t *object = pel_write_object(writer, volume, "silhouette");
    pel_write_number(writer, object, "base", silhouette->base, usual_silhouette.base);
    pel_write_number(writer, object, "strength", silhouette->strength, usual_silhouette.strength);
    pel_write_number(writer, object, "exponent", silhouette->exponent, usual_silhouette.exponent);
}
