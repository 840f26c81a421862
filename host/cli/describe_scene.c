// describe_scene.c - what `pellucid info` says about a scene and how its volumes take part in it.
#include "cli/describe_scene.h"

#include <math.h>
#include <stdio.h>

#include "cli/describe.h"
#include "cli/report.h"

enum { VALUE_BYTES = 1024 };

static enum pel_model model_of(const struct pel_scene *scene, const struct pel_instance *instance) {
    enum pel_model model =
        instance->model == PEL_MODEL_DEFAULT ? scene->render.model : instance->model;
    return model == PEL_MODEL_DEFAULT ? PEL_MODEL_ABSORPTION : model;
}

// ---- Lines -------------------------------------------------------------------------------------

static void print_clips(const struct pel_clip *clips, int count, int indent) {
    for (int n = 0; n < count; n++) {
        const struct pel_clip *clip = &clips[n];
        bool box = clip->kind == PEL_CLIP_BOX;
        const double *vector = box ? clip->size : clip->normal;
        printf("%*s%-12s %s %s %.6g, %.6g, %.6g mm, %s %.6g, %.6g, %.6g%s; kept %s\n", indent, "",
               "clip", box ? "box" : "plane", box ? "around" : "through", clip->point[0],
               clip->point[1], clip->point[2], box ? "size" : "normal", vector[0], vector[1],
               vector[2], box ? " mm" : "", clip->outside ? "outside" : "inside");
    }
}

static void print_mask(const struct pel_scene *scene, const struct pel_mask *mask, int indent) {
    char values[VALUE_BYTES];
    if (mask->range_count == 0)
        return;
    pel_mask_write_values(mask, values, sizeof values);
    printf("%*s%-12s shown where '%s' is %s%s\n", indent, "", "mask",
           scene->instances[mask->instance].name, mask->inverted ? "not " : "", values);
}

static void print_instance(const struct pel_scene *scene, int number) {
    enum { INDENT = 4 };
    const struct pel_instance *instance = &scene->instances[number];
    printf("  %-12s %d '%s': %s%s\n", "volume", number, instance->name,
           scene->volumes[instance->volume]->name, instance->hidden ? ", hidden" : "");
    printf("%*s%-12s %s%s, density %.6g", INDENT, "", "model",
           pel_model_names()[model_of(scene, instance)],
           instance->preintegration ? ", pre-integrated" : "", instance->density);
    if (scene->render.mixing == PEL_MIX_PRIORITY || instance->priority != 0)
        printf(", priority %.6g", instance->priority);
    putchar('\n');
    print_clips(instance->clips, instance->clip_count, INDENT);
    print_mask(scene, &instance->mask, INDENT);
    describe_print(scene->volumes[instance->volume], &scene->statistics[instance->volume], INDENT);
}

// What a renderer with room for all volumes would skip by, and why.
static void print_skip(const struct pel_scene *scene) {
    enum pel_skip skip;
    char reason[PEL_SKIP_REASON_BYTES];
    if (scene->render.skip != PEL_SKIP_AUTO)
        printf("  %-12s %s, as asked for\n", "skipping", report_skip(scene->render.skip));
    else if (pel_scene_choose_skip(scene, &skip, reason))
        printf("  %-12s %s: %s\n", "skipping", report_skip(skip), reason);
}

void describe_scene(const struct pel_scene *scene) {
    const struct pel_camera *camera = &scene->camera;
    printf("  %-12s %d x %d pixels, mixing %s, step %.6g\n", "picture", scene->render.width,
           scene->render.height, pel_mixing_names()[scene->render.mixing], scene->render.step);
    printf("  %-12s from %.6g, %.6g, %.6g to %.6g, %.6g, %.6g mm\n", "camera", camera->eye[0],
           camera->eye[1], camera->eye[2], camera->target[0], camera->target[1], camera->target[2]);
    struct pel_bounds bounds;
    if (pel_scene_bounds(scene, &bounds))
        printf("  %-12s %.6g, %.6g, %.6g to %.6g, %.6g, %.6g mm\n", "bounds", bounds.low[0],
               bounds.low[1], bounds.low[2], bounds.high[0], bounds.high[1], bounds.high[2]);
    print_clips(scene->clips, scene->clip_count, 2);
    print_skip(scene);
    for (int i = 0; i < scene->instance_count; i++)
        print_instance(scene, i);
}

// ---- JSON --------------------------------------------------------------------------------------

static json_t *clips_json(const struct pel_clip *clips, int count) {
    json_t *list = json_array();
    for (int n = 0; n < count; n++) {
        const struct pel_clip *clip = &clips[n];
        bool box = clip->kind == PEL_CLIP_BOX;
        json_t *object = json_object();
        json_object_set_new(object, "kind", json_string(box ? "box" : "plane"));
        json_object_set_new(object, "keep", json_string(clip->outside ? "outside" : "inside"));
        json_object_set_new(object, box ? "centre" : "point", report_numbers(clip->point, 3));
        json_object_set_new(object, box ? "size" : "normal",
                            report_numbers(box ? clip->size : clip->normal, 3));
        json_array_append_new(list, object);
    }
    return list;
}

static json_t *mask_json(const struct pel_scene *scene, const struct pel_mask *mask) {
    char values[VALUE_BYTES];
    if (mask->range_count == 0)
        return json_null();
    pel_mask_write_values(mask, values, sizeof values);
    json_t *object = json_object();
    json_object_set_new(object, "volume", json_integer(mask->instance));
    json_object_set_new(object, "name", report_text(scene->instances[mask->instance].name));
    json_object_set_new(object, "values", json_string(values));
    json_object_set_new(object, "inverted", json_boolean(mask->inverted));
    return object;
}

static json_t *instance_json(const struct pel_scene *scene, const struct pel_instance *instance) {
    json_t *object =
        describe_json(scene->volumes[instance->volume], &scene->statistics[instance->volume]);
    json_object_set_new(object, "instance", report_text(instance->name));
    json_object_set_new(object, "hidden", json_boolean(instance->hidden));
    json_object_set_new(object, "model", json_string(pel_model_names()[model_of(scene, instance)]));
    json_object_set_new(object, "density", report_number(instance->density));
    json_object_set_new(object, "priority", report_number(instance->priority));
    json_object_set_new(object, "clips", clips_json(instance->clips, instance->clip_count));
    json_object_set_new(object, "mask", mask_json(scene, &instance->mask));
    return object;
}

json_t *describe_scene_json(const struct pel_scene *scene) {
    json_t *object = json_object();
    json_object_set_new(object, "width", json_integer(scene->render.width));
    json_object_set_new(object, "height", json_integer(scene->render.height));
    json_object_set_new(object, "mixing", json_string(pel_mixing_names()[scene->render.mixing]));
    json_object_set_new(object, "step", report_number(scene->render.step));
    json_object_set_new(object, "eye", report_numbers(scene->camera.eye, 3));
    json_object_set_new(object, "target", report_numbers(scene->camera.target, 3));
    enum pel_skip skip = scene->render.skip;
    char reason[PEL_SKIP_REASON_BYTES] = "";
    if (skip != PEL_SKIP_AUTO || pel_scene_choose_skip(scene, &skip, reason))
        json_object_set_new(object, "skip", json_string(report_skip(skip)));
    if (reason[0])
        json_object_set_new(object, "skip_reason", json_string(reason));
    json_object_set_new(object, "clips", clips_json(scene->clips, scene->clip_count));
    json_t *list = json_array();
    for (int i = 0; i < scene->instance_count; i++)
        json_array_append_new(list, instance_json(scene, &scene->instances[i]));
    json_object_set_new(object, "volumes", list);
    return object;
}
