// quality.c - one number for step, termination and supersampling (docs/picture.md, "Quality").
//
// Samples may lie the farther apart the less one of them can show: a thin fog bears steps that a
// shell of bone does not.
#include "world/scene_plan.h"

#include <math.h>
#include <string.h>

static const char *const quality_names[] = {"draft", "normal", "high", "best", NULL};
static const double quality_values[] = {0, 0.5, 0.75, 1};

// The optical depth of a voxel at which the step is as the quality says, and how far it goes from
// there either way.
static const double usual_depth = 0.25, most_stretch = 2;

// The greatest optical depth that a way of one voxel can have.
static double voxel_depth(const struct pel_scene *scene, const struct pel_instance *instance) {
    const struct pel_transfer *transfer = instance->transfer;
    double opacity = 0, spacing[3];
    for (int i = 0; i < transfer->opacity_count; i++)
        opacity = fmax(opacity, transfer->opacities[i].opacity);
    pel_volume_spacing(scene->volumes[instance->volume], spacing);
    return -log1p(-fmin(opacity, 1 - 0x1p-24)) / transfer->opacity_unit_mm * instance->density *
           fmin(spacing[0], fmin(spacing[1], spacing[2]));
}

static double instance_step(const struct pel_scene *scene, const struct pel_instance *instance,
                            double quality) {
    enum pel_model model =
        instance->model != PEL_MODEL_DEFAULT ? instance->model : scene->render.model;
    double stretch = 1;
    if (model == PEL_MODEL_DEFAULT || model == PEL_MODEL_ABSORPTION)
        stretch = sqrt(usual_depth / fmax(voxel_depth(scene, instance), 1e-9));
    return exp2(1 - 4 * quality) * fmin(fmax(stretch, 1 / most_stretch), most_stretch);
}

static double termination_of(double quality) {
    return 1 - 0.05 * pow(25, -quality);
}

static struct pel_supersampling supersampling_of(double quality, uint32_t seed) {
    struct pel_supersampling supersampling = {.seed = seed};
    if (quality >= 0.75)
        supersampling = (struct pel_supersampling){.n = 2, .adaptive = 0.04, .seed = seed};
    if (quality >= 1)
        supersampling = (struct pel_supersampling){.n = 3, .seed = seed};
    return supersampling;
}

static void set_steps(struct pel_scene *scene, double quality) {
    scene->render.step = exp2(1 - 4 * quality);
    scene->render.step_mm = 0;
    for (int k = 0; k < scene->instance_count; k++) {
        struct pel_instance *instance = &scene->instances[k];
        if (instance->step == 0 && instance->step_mm == 0)
            instance->step = instance_step(scene, instance, quality);
    }
}

void pel_scene_set_quality(struct pel_scene *scene, double quality) {
    quality = fmin(fmax(quality, 0), 1);
    set_steps(scene, quality);
    scene->render.termination = termination_of(quality);
    scene->render.supersampling = supersampling_of(quality, scene->render.supersampling.seed);
}

bool pel_scene_read_quality(const struct pel_scene_node *render, double *quality) {
    struct pel_scene_node node;
    int which;
    if (!pel_node_member(&node, render, "quality"))
        return true;
    if (!json_is_string(node.value))
        return pel_node_get_number(render, "quality", &pel_unit_number, quality);
    if (!pel_node_check_name(&node, quality_names, &which))
        return false;
    *quality = quality_values[which];
    return true;
}

bool pel_scene_settle_quality(struct pel_scene *scene, const struct pel_scene_plan *plan) {
    struct pel_scene_node render, member;
    double quality = -1;
    if (!pel_node_member(&render, &plan->scene, "render"))
        return true;
    if (!pel_scene_read_quality(&render, &quality))
        return false;
    if (quality < 0)
        return true;
    // What the scene says itself stays.
    if (!pel_node_member(&member, &render, "step") && !pel_node_member(&member, &render, "step_mm"))
        set_steps(scene, quality);
    if (!pel_node_member(&member, &render, "termination"))
        scene->render.termination = termination_of(quality);
    if (!pel_node_member(&member, &render, "supersampling"))
        scene->render.supersampling = supersampling_of(quality, 0);
    return true;
}
