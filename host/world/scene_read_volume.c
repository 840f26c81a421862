// scene_read_volume.c - the `volumes` of a scene file, as far as they can be read without loading
// any of them; and written.
#include "world/scene_plan.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "transfer/transfer_file.h"
#include "world/scene.h"
#include "world/scene_write.h"

static const char *const volume_keys[] = {"comment",
                                          "file",
                                          "hypertexture",
                                          "generate",
                                          "raw",
                                          "time",
                                          "channel",
                                          "name",
                                          "visible",
                                          "spacing",
                                          "transform",
                                          "transfer",
                                          "density",
                                          "extent",
                                          "filter",
                                          "palette",
                                          "opacity_unit",
                                          "shading",
                                          "step",
                                          "step_mm",
                                          "model",
                                          "iso",
                                          "priority",
                                          "preintegration",
                                          "clip",
                                          "mask",
                                          "gradient",
                                          "gradient_opacity",
                                          "silhouette",
                                          "labels",
                                          NULL};

// In the order of their enums.
static const char *const extent_names[] = {"cell", "point", NULL};
static const char *const filter_names[] = {"linear", "nearest", "cubic-b-spline", "catmull-rom",
                                           NULL};

static bool read_palette(struct pel_volume_plan *plan, const struct pel_scene_node *volume) {
    struct pel_scene_node node;
    int which;
    if (!pel_node_member(&node, volume, "palette"))
        return true;
    const char *const *names = pel_transfer_presets();
    if (!pel_node_check_name(&node, names, &which))
        return false;
    plan->palette = names[which];
    return true;
}

bool pel_scene_find_instance(const struct pel_scene *scene, const struct pel_scene_node *node,
                             const char *name, int *instance) {
    const char *names[PEL_VOLUME_MAX + 1] = {NULL};
    int found = 0;
    for (int i = 0; i < scene->instance_count; i++) {
        names[i] = scene->instances[i].name;
        if (strcmp(names[i], name) != 0)
            continue;
        *instance = i;
        found++;
    }
    if (found == 1)
        return true;
    if (found > 1)
        return pel_node_fail(node, "%d volumes are named '%.64s'", found, name);
    const char *nearest = pel_text_nearest(name, names);
    if (nearest)
        return pel_node_fail(node, "no volume is named '%.64s'; did you mean '%s'", name, nearest);
    return pel_node_fail(node, "no volume is named '%.64s'", name);
}

static bool read_name(struct pel_instance *instance, const struct pel_volume_plan *plan) {
    struct pel_scene_node node;
    const char *name = plan->file   ? pel_path_leaf(plan->file)
                       : plan->kind ? plan->kind
                                    : "hypertexture";
    if (!pel_node_get_text(&plan->node, "name", &name))
        return false;
    bool given = pel_node_member(&node, &plan->node, "name");
    if (given && (!*name || strlen(name) >= sizeof instance->name))
        return pel_node_fail(&node, "must have 1 to %zu bytes, not %zu", sizeof instance->name - 1,
                             strlen(name));
    pel_instance_set_name(instance, name);
    return true;
}

// What volumes have that say nothing else: the scene's filter and gradient.
static bool read_usual(struct pel_instance *usual, const struct pel_scene_node *scene) {
    struct pel_scene_node render;
    int filter = PEL_FILTER_LINEAR;
    *usual = pel_instance_default();
    if (!pel_node_member(&render, scene, "render"))
        return true;
    bool good = pel_node_get_name(&render, "filter", filter_names, &filter) &&
                pel_scene_read_gradient(&usual->gradient, &render);
    usual->filter = (enum pel_filter)filter;
    return good;
}

static bool read_volume(struct pel_instance *instance, struct pel_volume_plan *plan,
                        const struct pel_instance *usual) {
    const struct pel_scene_node *node = &plan->node;
    const struct pel_range density_range = {.low = 0, .high = 1e6};
    struct pel_scene_node member;
    bool visible = true;
    int extent = PEL_EXTENT_CELL, filter = (int)usual->filter;
    *instance = *usual;
    if (!pel_node_check_object(node, volume_keys) || !pel_scene_read_source(plan, node) ||
        !read_name(instance, plan) || !pel_node_get_bool(node, "visible", &visible) ||
        !pel_node_get_numbers(node, "spacing", 3, &pel_positive_number, plan->spacing) ||
        !pel_scene_read_pose(&plan->pose, node) ||
        !pel_scene_read_transfer(&instance->transfer, node) || !read_palette(plan, node) ||
        !pel_node_get_number(node, "opacity_unit", &pel_positive_number, &plan->opacity_unit_mm) ||
        !pel_node_get_number(node, "density", &density_range, &instance->density) ||
        !pel_scene_read_step(node, &instance->step, &instance->step_mm) ||
        !pel_scene_read_model(instance, node) ||
        !pel_scene_read_material(&instance->material, node) ||
        !pel_scene_read_style(instance, node) ||
        !pel_scene_read_clips(node, false, &instance->clip_count, instance->clips) ||
        !pel_scene_read_mask(&instance->mask, node) ||
        !pel_node_get_number(node, "priority", &pel_any_number, &instance->priority) ||
        !pel_node_get_name(node, "extent", extent_names, &extent) ||
        !pel_node_get_name(node, "filter", filter_names, &filter))
        return false;
    plan->filter_given = pel_node_member(&member, node, "filter");
    instance->hidden = !visible;
    instance->extent = (enum pel_extent)extent;
    instance->filter = (enum pel_filter)filter;
    return true;
}

// A transfer function is written as it was resolved, so neither preset nor palette nor unit is
// needed beside it.
static void write_volume(struct pel_scene_writer *writer, json_t *volume,
                         const struct pel_instance *instance) {
    const struct pel_scene *scene = writer->scene;
    const struct pel_volume_source *source = &scene->sources[instance->volume];
    if (!source->file && !source->kind && !source->recipe && !writer->failed) {
        writer->failed = true;
        pel_fail(PEL_ERROR_ARGUMENT, "volume '%s' came from no file that a scene could name",
                 instance->name);
        return;
    }
    struct pel_instance usual = pel_instance_default();
    // Label maps are nearest unless they say otherwise, so theirs is always said.
    int usual_filter = scene->volumes[instance->volume]->labels ? -1 : (int)usual.filter;
    pel_write_text(writer, volume, "name", instance->name);
    pel_scene_write_source(writer, volume, source);
    pel_write_bool(writer, volume, "visible", !instance->hidden, true);
    pel_scene_write_pose(writer, volume, &instance->transform);
    pel_write_value(writer, volume, "transfer", pel_transfer_write(instance->transfer));
    pel_write_number(writer, volume, "density", instance->density, usual.density);
    pel_scene_write_clips(writer, volume, false, instance->clip_count, instance->clips);
    pel_scene_write_mask(writer, volume, &instance->mask);
    pel_write_number(writer, volume, "priority", instance->priority, usual.priority);
    pel_scene_write_model(writer, volume, instance);
    pel_scene_write_material(writer, volume, &instance->material);
    pel_scene_write_style(writer, volume, instance);
    pel_write_name(writer, volume, "extent", extent_names, instance->extent, usual.extent);
    pel_write_name(writer, volume, "filter", filter_names, instance->filter, usual_filter);
}

// An FSL matrix refers to another volume, which may come later in the list.
static bool read_fixed(const struct pel_scene *scene, struct pel_volume_plan *plan, int self) {
    struct pel_scene_node transform, node;
    struct pel_pose_plan *pose = &plan->pose;
    if (!pose->fixed_name)
        return true;
    pel_node_member(&transform, &plan->node, "transform");
    pel_node_member(&node, &transform, "fixed");
    if (!pel_scene_find_instance(scene, &node, pose->fixed_name, &pose->fixed))
        return false;
    return pose->fixed != self || pel_node_fail(&node, "'%s' is this volume", pose->fixed_name);
}

// Likewise what a hypertexture grows on. Hypertextures have no voxels to grow on.
static bool read_object(const struct pel_scene *scene, struct pel_scene_plan *plan, int self) {
    struct pel_scene_node hypertexture, node;
    struct pel_volume_plan *volume = &plan->volume[self];
    volume->object = -1;
    if (!volume->object_name)
        return true;
    pel_node_member(&hypertexture, &volume->node, "hypertexture");
    pel_node_member(&node, &hypertexture, "object");
    if (!pel_scene_find_instance(scene, &node, volume->object_name, &volume->object))
        return false;
    return !plan->volume[volume->object].recipe ||
           pel_node_fail(&node, "'%s' is a hypertexture itself", volume->object_name);
}

bool pel_scene_read_volumes(struct pel_scene *scene, struct pel_scene_plan *plan) {
    if (!pel_node_member(&plan->volumes, &plan->scene, "volumes"))
        return pel_node_fail(&plan->scene, "needs 'volumes'");
    if (!pel_node_check_list(&plan->volumes, 1, PEL_VOLUME_MAX))
        return false;
    struct pel_instance usual;
    if (!read_usual(&usual, &plan->scene))
        return false;
    size_t count = json_array_size(plan->volumes.value);
    for (size_t i = 0; i < count; i++) {
        plan->volume[i].node = pel_node_element(&plan->volumes, i);
        scene->instance_count = (int)i + 1;
        if (!read_volume(&scene->instances[i], &plan->volume[i], &usual))
            return false;
    }
    for (size_t i = 0; i < count; i++)
        if (!read_fixed(scene, &plan->volume[i], (int)i) || !read_object(scene, plan, (int)i) ||
            !pel_scene_find_mask(scene, plan, (int)i))
            return false;
    return pel_scene_check_masks(scene, plan);
}

void pel_scene_write_volumes(struct pel_scene_writer *writer, json_t *root) {
    json_t *volumes = json_array();
    pel_write_value(writer, root, "volumes", volumes);
    for (int i = 0; i < writer->scene->instance_count && !writer->failed; i++) {
        json_t *volume = json_object();
        json_array_append_new(volumes, volume);
        write_volume(writer, volume, &writer->scene->instances[i]);
    }
}

void pel_scene_plan_finish(struct pel_scene_plan *plan) {
    for (int i = 0; i < PEL_VOLUME_MAX; i++) {
        free(plan->volume[i].file);
        free(plan->volume[i].recipe);
        free(plan->volume[i].pose.file);
        pel_transfer_destroy(plan->volume[i].towards);
    }
}
