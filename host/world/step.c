// step.c - how far apart samples lie.
//
// A step is given in voxels, so that it follows the data, or in millimetres, so that it does not;
// for the scene, or for one volume where that knows better.
#include "world/step.h"

#include <math.h>

#include "base/error.h"

// The smallest distance of neighbouring voxels, along any axis.
static double finest_spacing(const struct pel_scene *scene, const struct pel_instance *instance) {
    double spacing[3];
    pel_volume_spacing(scene->volumes[instance->volume], spacing);
    return fmin(spacing[0], fmin(spacing[1], spacing[2]));
}

double pel_step_of_instance(const struct pel_scene *scene, const struct pel_instance *instance) {
    const struct pel_render_settings *settings = &scene->render;
    if (instance->step_mm > 0)
        return instance->step_mm;
    if (instance->step > 0)
        return instance->step * finest_spacing(scene, instance);
    if (settings->step_mm > 0)
        return settings->step_mm;
    return settings->step * finest_spacing(scene, instance);
}

double pel_step_of_scene(const struct pel_scene *scene) {
    double least = INFINITY;
    for (int k = 0; k < scene->instance_count; k++)
        if (!scene->instances[k].hidden)
            least = fmin(least, pel_step_of_instance(scene, &scene->instances[k]));
    return isfinite(least) ? least : scene->render.step;
}

bool pel_step_check(const struct pel_scene *scene) {
    const struct pel_render_settings *settings = &scene->render;
    if (!(settings->step > 0) || !isfinite(settings->step))
        return pel_fail(PEL_ERROR_ARGUMENT, "step of %g voxels, must be above 0", settings->step);
    if (!(settings->step_mm >= 0) || !isfinite(settings->step_mm))
        return pel_fail(PEL_ERROR_ARGUMENT, "step of %g mm, must be at least 0", settings->step_mm);
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        if (!(instance->step >= 0) || !isfinite(instance->step) || !(instance->step_mm >= 0) ||
            !isfinite(instance->step_mm))
            return pel_fail(PEL_ERROR_ARGUMENT,
                            "volume '%s': step of %g voxels or %g mm, must be at least 0",
                            instance->name, instance->step, instance->step_mm);
    }
    return true;
}
