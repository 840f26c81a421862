// scene_camera.c - the camera of a scene file, read and written. A named view is fitted first;
// whatever else is given then replaces what the fit chose, so that `--set camera.fov=40` works on
// any scene.
#include "world/scene_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "camera/camera.h"
#include "world/scene.h"
#include "world/scene_write.h"

static const char *const camera_keys[] = {"comment", "view",  "fit", "eye",
                                          "target",  "up",    "fov", "orthographic",
                                          "height",  "shift", NULL};
static const char *const view_names[] = {"anterior", "posterior", "left",    "right",
                                         "superior", "inferior",  "oblique", NULL};

static const char *const default_view = "oblique";

static void replace(double values[], const double given[], int count) {
    for (int i = 0; i < count; i++)
        if (!isnan(given[i]))
            values[i] = given[i];
}

// `fit` names a volume, or "all" of them, or what is "visible" of all.
static bool read_fit(struct pel_camera_plan *plan, const struct pel_scene *scene) {
    struct pel_scene_node node;
    const char *name;
    if (!pel_node_member(&node, &plan->node, "fit"))
        return true;
    if (!pel_node_get_text(&plan->node, "fit", &name))
        return false;
    plan->fit_visible = strcmp(name, "visible") == 0;
    return plan->fit_visible || strcmp(name, "all") == 0 ||
           pel_scene_find_instance(scene, &node, name, &plan->fit);
}

bool pel_scene_read_camera(struct pel_camera_plan *plan, const struct pel_scene_node *root,
                           const struct pel_scene *scene) {
    *plan = (struct pel_camera_plan){
        .fit = -1,
        .given = {.eye = {NAN, NAN, NAN},
                  .target = {NAN, NAN, NAN},
                  .up = {NAN, NAN, NAN},
                  .fov_deg = NAN,
                  .height_mm = NAN,
                  .shift = {NAN, NAN}},
    };
    struct pel_scene_node *node = &plan->node;
    if (!pel_node_member(node, root, "camera")) {
        *node = *root;
        return true;
    }
    struct pel_camera *given = &plan->given;
    const struct pel_range angle_range = {
        .low = 0, .high = 180, .low_open = true, .high_open = true};
    int view = -1;
    if (!pel_node_check_object(node, camera_keys) ||
        !pel_node_get_name(node, "view", view_names, &view) ||
        !pel_node_get_numbers(node, "eye", 3, &pel_any_number, given->eye) ||
        !pel_node_get_numbers(node, "target", 3, &pel_any_number, given->target) ||
        !pel_node_get_numbers(node, "up", 3, &pel_any_number, given->up) ||
        !pel_node_get_number(node, "fov", &angle_range, &given->fov_deg) ||
        !pel_node_get_bool(node, "orthographic", &given->orthographic) ||
        !pel_node_get_number(node, "height", &pel_positive_number, &given->height_mm) ||
        !pel_node_get_numbers(node, "shift", 2, &pel_any_number, given->shift) ||
        !read_fit(plan, scene))
        return false;
    plan->view = view < 0 ? NULL : view_names[view];
    return true;
}

// A view and a fit are written as what they chose.
void pel_scene_write_camera(struct pel_scene_writer *writer, json_t *root) {
    const struct pel_camera *camera = &writer->scene->camera, *usual = &writer->usual->camera;
    json_t *object = pel_write_object(writer, root, "camera");
    pel_write_numbers(writer, object, "eye", 3, camera->eye);
    pel_write_numbers(writer, object, "target", 3, camera->target);
    if (memcmp(camera->up, usual->up, sizeof camera->up) != 0)
        pel_write_numbers(writer, object, "up", 3, camera->up);
    pel_write_number(writer, object, "fov", camera->fov_deg, usual->fov_deg);
    pel_write_bool(writer, object, "orthographic", camera->orthographic, false);
    pel_write_number(writer, object, "height", camera->height_mm, 0);
    if (camera->shift[0] != 0 || camera->shift[1] != 0)
        pel_write_numbers(writer, object, "shift", 2, camera->shift);
}

void pel_scene_write_viewpoint(struct pel_scene_writer *writer, json_t *object,
                               const struct pel_camera *camera) {
    pel_write_numbers(writer, object, "eye", 3, camera->eye);
    pel_write_numbers(writer, object, "target", 3, camera->target);
    pel_write_numbers(writer, object, "up", 3, camera->up);
    pel_write_value(writer, object, "fov", pel_write_make_number(camera->fov_deg));
    pel_write_value(writer, object, "orthographic", json_boolean(camera->orthographic));
    pel_write_number(writer, object, "height", camera->height_mm, 0);
    pel_write_numbers(writer, object, "shift", 2, camera->shift);
}

// Fits the camera to one instance, to all that are not hidden, or simply to the first when all are.
static bool fit_boxes(struct pel_scene *scene, const struct pel_camera_plan *plan, const char *view,
                      double aspect) {
    struct pel_bounds bounds;
    if (plan->fit >= 0)
        pel_instance_bounds(scene, plan->fit, &bounds);
    else if (!pel_scene_bounds(scene, &bounds))
        pel_instance_bounds(scene, 0, &bounds);
    return pel_camera_fit(&scene->camera, view, &bounds, aspect);
}

// Fits the camera to what can be seen of all instances that are not hidden.
static bool fit_visible(struct pel_scene *scene, const struct pel_camera_plan *plan,
                        const char *view, double aspect) {
    struct pel_points points = {0};
    bool good = true;
    for (int i = 0; good && i < scene->instance_count; i++)
        good = scene->instances[i].hidden || pel_instance_visible_hull(scene, i, &points);
    if (good && points.count == 0)
        good = fit_boxes(scene, plan, view, aspect);
    else if (good)
        good = pel_camera_fit_points(&scene->camera, view, points.count,
                                     (const double(*)[3])points.at, aspect);
    free(points.at);
    return good;
}

// Makes sure that the camera has axes. An up vector nobody chose gives way to anterior when the
// camera looks along it.
static bool check_axes(const struct pel_camera_plan *plan, struct pel_camera *camera) {
    double forward[3], right[3], up[3];
    if (pel_camera_basis(camera, forward, right, up))
        return true;
    if (isnan(plan->given.up[0])) {
        memcpy(camera->up, (double[]){0, 1, 0}, sizeof camera->up);
        if (pel_camera_basis(camera, forward, right, up))
            return true;
    }
    return pel_node_fail(&plan->node, "%s", pel_error_message());
}

bool pel_scene_place_camera(struct pel_scene *scene, const struct pel_camera_plan *plan) {
    struct pel_camera *camera = &scene->camera;
    const struct pel_camera *given = &plan->given;
    camera->orthographic = given->orthographic;
    replace(&camera->fov_deg, &given->fov_deg, 1);

    double aspect = (double)scene->render.width / scene->render.height;
    const char *view = plan->view ? plan->view : default_view;
    if (!(plan->fit_visible ? fit_visible : fit_boxes)(scene, plan, view, aspect))
        return pel_node_fail_in(&plan->node);

    // An explicit line of sight is upright in the world unless it says otherwise.
    if (!isnan(given->eye[0]) && !plan->view)
        memcpy(camera->up, (double[]){0, 0, 1}, sizeof camera->up);
    replace(camera->eye, given->eye, 3);
    replace(camera->target, given->target, 3);
    replace(camera->up, given->up, 3);
    replace(&camera->fov_deg, &given->fov_deg, 1);
    replace(&camera->height_mm, &given->height_mm, 1);
    replace(camera->shift, given->shift, 2);
    return check_axes(plan, camera);
}
