// scene_read_mask.c - the `mask` of a volume of a scene file, read and written.
#include "world/scene_plan.h"

#include <math.h>
#include <string.h>

#include "world/mask.h"
#include "world/scene_write.h"

static const char *const mask_keys[] = {"comment",   "volume", "labels", "ranges",
                                        "threshold", "invert", NULL};

static bool add_range(struct pel_mask *mask, const struct pel_scene_node *node, double low,
                      double high) {
    if (mask->range_count == PEL_MASK_RANGE_MAX)
        return pel_node_fail(node, "makes more than %d labels and ranges", PEL_MASK_RANGE_MAX);
    mask->ranges[mask->range_count++] = (struct pel_value_range){low, high};
    return true;
}

static bool read_labels(struct pel_mask *mask, const struct pel_scene_node *object) {
    struct pel_scene_node node;
    double label;
    if (!pel_node_member(&node, object, "labels"))
        return true;
    if (!json_is_array(node.value))
        return pel_node_get_number(object, "labels", &pel_any_number, &label) &&
               add_range(mask, &node, label, label);
    if (!pel_node_check_list(&node, 1, PEL_MASK_RANGE_MAX))
        return false;
    for (size_t n = 0; n < json_array_size(node.value); n++) {
        struct pel_scene_node element = pel_node_element(&node, n);
        if (!json_is_number(element.value))
            return pel_node_fail(&element, "must be a label, a number");
        label = json_number_value(element.value);
        if (!add_range(mask, &element, label, label))
            return false;
    }
    return true;
}

static bool read_ranges(struct pel_mask *mask, const struct pel_scene_node *object) {
    struct pel_scene_node node;
    if (!pel_node_member(&node, object, "ranges"))
        return true;
    if (!pel_node_check_list(&node, 1, PEL_MASK_RANGE_MAX))
        return false;
    for (size_t n = 0; n < json_array_size(node.value); n++) {
        struct pel_scene_node element = pel_node_element(&node, n);
        double ends[2];
        if (!pel_node_check_numbers(&element, 2, &pel_any_number, ends))
            return false;
        if (ends[0] > ends[1])
            return pel_node_fail(&element, "ends at %g, below its beginning %g", ends[1], ends[0]);
        if (!add_range(mask, &element, ends[0], ends[1]))
            return false;
    }
    return true;
}

bool pel_scene_read_mask(struct pel_mask *mask, const struct pel_scene_node *volume) {
    struct pel_scene_node node, which, threshold;
    double least = 0;
    if (!pel_node_member(&node, volume, "mask"))
        return true;
    if (!pel_node_check_object(&node, mask_keys))
        return false;
    if (!pel_node_member(&which, &node, "volume"))
        return pel_node_fail(&node, "needs 'volume', the name or the index of another one");
    if (!read_labels(mask, &node) || !read_ranges(mask, &node) ||
        !pel_node_get_number(&node, "threshold", &pel_any_number, &least) ||
        !pel_node_get_bool(&node, "invert", &mask->inverted))
        return false;
    if (pel_node_member(&threshold, &node, "threshold") &&
        !add_range(mask, &threshold, least, INFINITY))
        return false;
    return mask->range_count > 0 || pel_node_fail(&node, "needs 'labels', 'ranges' or 'threshold'");
}

bool pel_scene_find_mask(struct pel_scene *scene, const struct pel_scene_plan *plan, int self) {
    struct pel_mask *mask = &scene->instances[self].mask;
    struct pel_scene_node object, node;
    if (mask->range_count == 0)
        return true;
    pel_node_member(&object, &plan->volume[self].node, "mask");
    pel_node_member(&node, &object, "volume");
    bool found =
        json_is_integer(node.value)
            ? pel_node_get_integer(&object, "volume", 0, scene->instance_count - 1, &mask->instance)
            : (json_is_string(node.value) ||
               pel_node_fail(&node, "must be the name or the index of a volume")) &&
                  pel_scene_find_instance(scene, &node, json_string_value(node.value),
                                          &mask->instance);
    return found && (mask->instance != self ||
                     pel_node_fail(&node, "'%s' is this volume", scene->instances[self].name));
}

bool pel_scene_check_masks(const struct pel_scene *scene, const struct pel_scene_plan *plan) {
    for (int i = 0; i < scene->instance_count; i++) {
        struct pel_scene_node node;
        if (!pel_mask_leads_back(scene, i))
            continue;
        pel_node_member(&node, &plan->volume[i].node, "mask");
        return pel_node_fail(&node, "'%s' is masked by this volume in turn",
                             scene->instances[scene->instances[i].mask.instance].name);
    }
    return true;
}

// ---- Writing -----------------------------------------------------------------------------------

// The name, if it is one volume's alone.
static json_t *make_reference(const struct pel_scene *scene, int instance) {
    const char *name = scene->instances[instance].name;
    int count = 0;
    for (int i = 0; i < scene->instance_count; i++)
        count += strcmp(scene->instances[i].name, name) == 0;
    return count == 1 ? json_string(name) : json_integer(instance);
}

void pel_scene_write_mask(struct pel_scene_writer *writer, json_t *volume,
                          const struct pel_mask *mask) {
    if (mask->range_count == 0)
        return;
    json_t *object = pel_write_object(writer, volume, "mask");
    json_t *labels = json_array(), *ranges = json_array();
    double threshold = INFINITY;
    pel_write_value(writer, object, "volume", make_reference(writer->scene, mask->instance));
    for (int n = 0; n < mask->range_count; n++) {
        // A program's ranges may have no ends; those of a file reach as far as numbers in it do.
        double low = fmax(mask->ranges[n].low, pel_any_number.low), high = mask->ranges[n].high;
        if (low == high)
            json_array_append_new(labels, pel_write_make_number(low));
        else if (high == INFINITY)
            threshold = fmin(threshold, low);
        else
            json_array_append_new(ranges, pel_write_make_numbers(2, (double[]){low, high}));
    }
    if (threshold < INFINITY)
        pel_write_value(writer, object, "threshold", pel_write_make_number(threshold));
    if (json_array_size(labels) > 0)
        pel_write_value(writer, object, "labels", json_incref(labels));
    if (json_array_size(ranges) > 0)
        pel_write_value(writer, object, "ranges", json_incref(ranges));
    json_decref(labels);
    json_decref(ranges);
    pel_write_bool(writer, object, "invert", mask->inverted, false);
}
