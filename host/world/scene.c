// scene.c - what every scene can do, whichever way it came about.
#include "world/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "base/memory.h"
#include "camera/camera.h"
#include "world/scene_source.h"

struct pel_scene *pel_scene_create(void) {
    struct pel_scene *scene = pel_allocate(1, sizeof *scene);
    if (!scene)
        return NULL;
    // The camera is fitted to the volumes once they are known.
    scene->camera = (struct pel_camera){.up = {0, 0, 1}, .fov_deg = PEL_CAMERA_FOV_DEFAULT_DEG};
    scene->background[3] = 1;
    scene->render = (struct pel_render_settings){.width = 1024,
                                                 .height = 768,
                                                 .mixing = PEL_MIX_SUM,
                                                 .step = 0.5,
                                                 .phase = 0.5,
                                                 .termination = 0.99,
                                                 .origin = PEL_ORIGIN_VOLUMES};
    scene->output.depth = 8;
    return scene;
}

struct pel_instance pel_instance_default(void) {
    return (struct pel_instance){.transform = pel_matrix_identity(),
                                 .density = 1,
                                 .extent = PEL_EXTENT_CELL,
                                 .filter = PEL_FILTER_LINEAR};
}

void pel_instance_set_name(struct pel_instance *instance, const char *name) {
    const char *whole = name && *name ? name : "volume";
    size_t length = strnlen(whole, sizeof instance->name - 1);
    while (length > 0 && ((unsigned char)whole[length] & 0xc0) == 0x80)
        length--;
    memset(instance->name, 0, sizeof instance->name);
    memcpy(instance->name, whole, length);
}

bool pel_instance_copy(struct pel_instance *copy, const struct pel_instance *instance) {
    *copy = *instance;
    copy->transfer = instance->transfer ? pel_transfer_copy(instance->transfer) : NULL;
    return copy->transfer || !instance->transfer;
}

void pel_instance_finish(struct pel_instance *instance) {
    pel_transfer_destroy(instance->transfer);
}

void pel_volume_source_finish(struct pel_volume_source *source) {
    free(source->file);
    free(source->recipe);
    pel_volume_destroy(source->object);
    *source = (struct pel_volume_source){0};
}

bool pel_volume_source_copy(struct pel_volume_source *copy,
                            const struct pel_volume_source *source) {
    *copy = *source;
    copy->file = source->file ? pel_copy_text(source->file) : NULL;
    copy->recipe = source->recipe ? pel_copy_text(source->recipe) : NULL;
    copy->object = source->object ? pel_volume_share(source->object) : NULL;
    if ((copy->file || !source->file) && (copy->recipe || !source->recipe))
        return true;
    pel_volume_source_finish(copy);
    return false;
}

void pel_scene_destroy(struct pel_scene *scene) {
    if (!scene)
        return;
    for (int i = 0; i < scene->volume_count; i++) {
        pel_volume_destroy(scene->volumes[i]);
        pel_volume_source_finish(&scene->sources[i]);
    }
    for (int i = 0; i < scene->instance_count; i++)
        pel_instance_finish(&scene->instances[i]);
    free(scene->text);
    pel_scene_source_destroy(scene->source);
    free(scene);
}

struct pel_scene *pel_scene_copy(const struct pel_scene *scene) {
    struct pel_scene *copy = pel_allocate(1, sizeof *copy);
    if (!copy)
        return NULL;
    // What is owned is counted as it is copied, so that the copy can be destroyed at any time.
    *copy = *scene;
    copy->volume_count = copy->instance_count = 0;
    copy->source = pel_scene_source_share(scene->source);
    copy->text = scene->text ? pel_copy_text(scene->text) : NULL;
    bool good = copy->text || !scene->text;
    while (good && copy->volume_count < scene->volume_count) {
        int index = copy->volume_count++;
        copy->volumes[index] = pel_volume_share(scene->volumes[index]);
        good = pel_volume_source_copy(&copy->sources[index], &scene->sources[index]);
    }
    while (good && copy->instance_count < scene->instance_count) {
        int index = copy->instance_count++;
        good = pel_instance_copy(&copy->instances[index], &scene->instances[index]);
    }
    if (good)
        return copy;
    pel_scene_destroy(copy);
    return NULL;
}

void pel_instance_bounds(const struct pel_scene *scene, int instance, struct pel_bounds *bounds) {
    const struct pel_instance *shown = &scene->instances[instance];
    const struct pel_volume *volume = scene->volumes[shown->volume];
    struct pel_matrix world_from_voxel =
        pel_matrix_multiply(&shown->transform, &volume->world_from_voxel);
    double beyond = shown->extent == PEL_EXTENT_CELL ? 0.5 : 0;
    *bounds =
        (struct pel_bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = corner >> axis & 1 ? volume->dims[axis] - 1 + beyond : -beyond;
        pel_matrix_point(point, &world_from_voxel, point);
        for (int axis = 0; axis < 3; axis++) {
            bounds->low[axis] = fmin(bounds->low[axis], point[axis]);
            bounds->high[axis] = fmax(bounds->high[axis], point[axis]);
        }
    }
}

bool pel_scene_bounds(const struct pel_scene *scene, struct pel_bounds *bounds) {
    bool any = false;
    for (int i = 0; i < scene->instance_count; i++) {
        if (scene->instances[i].hidden)
            continue;
        struct pel_bounds one;
        pel_instance_bounds(scene, i, &one);
        for (int axis = 0; axis < 3; axis++) {
            bounds->low[axis] = any ? fmin(bounds->low[axis], one.low[axis]) : one.low[axis];
            bounds->high[axis] = any ? fmax(bounds->high[axis], one.high[axis]) : one.high[axis];
        }
        any = true;
    }
    return any;
}
