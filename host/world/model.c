// model.c - which optical model each volume has, and what the kernel must know of it.
//
// Absorption, thesis, surfaces and projections are layers on a ray, in any combination. Emission is
// not: it is integrated exactly, by another loop, and so it is a matter of the whole scene.
#include "world/model.h"

#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "world/narrow.h"

static const char *const model_names[] = {"default", "absorption", "emission", "mip", "minip",
                                          "average", "iso",        "thesis",   NULL};

static bool is_projection(enum pel_model model) {
    return model == PEL_MODEL_MIP || model == PEL_MODEL_MINIP || model == PEL_MODEL_AVERAGE;
}

enum pel_model pel_model_of(const struct pel_scene *scene, const struct pel_instance *instance) {
    if (instance->model != PEL_MODEL_DEFAULT)
        return instance->model;
    return scene->render.model != PEL_MODEL_DEFAULT ? scene->render.model : PEL_MODEL_ABSORPTION;
}

bool pel_model_is_preintegrated(const struct pel_scene *scene,
                                const struct pel_instance *instance) {
    return (scene->render.preintegration || instance->preintegration) &&
           pel_model_of(scene, instance) == PEL_MODEL_ABSORPTION;
}

static bool check_preintegration(const struct pel_scene *scene,
                                 const struct pel_instance *instance) {
    if (!pel_model_is_preintegrated(scene, instance))
        return true;
    enum pel_voxel_type type = scene->volumes[instance->volume]->type;
    if (type == PEL_VOXEL_RGB8 || type == PEL_VOXEL_RGBA8)
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "volume '%s': preintegration is of a transfer function's colours, and the "
                        "volume has its own",
                        instance->name);
    if (scene->render.order == PEL_ORDER_BACK_TO_FRONT)
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "volume '%s': preintegration goes from front to back only", instance->name);
    return true;
}

static bool check_surfaces(const struct pel_instance *instance) {
    if (instance->surface_count < 0 || instance->surface_count > PEL_SURFACE_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "volume '%s': %d surfaces, more than %d",
                        instance->name, instance->surface_count, PEL_SURFACE_MAX);
    for (int n = 0; n < instance->surface_count; n++) {
        const struct pel_surface *surface = &instance->surfaces[n];
        if (!isfinite(surface->value) || !(surface->opacity >= 0 && surface->opacity <= 1))
            return pel_fail(PEL_ERROR_ARGUMENT, "volume '%s': surface of value %g and opacity %g",
                            instance->name, surface->value, surface->opacity);
    }
    return true;
}

int pel_model_kernel(const struct pel_scene *scene) {
    int models = scene->render.order == PEL_ORDER_BACK_TO_FRONT ? MODELS_BACKWARD : 0;
    for (int k = 0; k < scene->instance_count; k++) {
        enum pel_model model = pel_model_of(scene, &scene->instances[k]);
        if (scene->instances[k].hidden)
            continue;
        if (model == PEL_MODEL_EMISSION)
            return MODELS_EMISSION;
        models |= pel_model_is_preintegrated(scene, &scene->instances[k]) ? MODELS_PREINTEGRATED
                  : model == PEL_MODEL_THESIS                             ? MODELS_THESIS
                  : model == PEL_MODEL_ISO                                ? MODELS_ISO
                  : is_projection(model)                                  ? MODELS_PROJECTION
                                                                          : 0;
    }
    return models;
}

bool pel_model_check(const struct pel_scene *scene) {
    const struct pel_render_settings *settings = &scene->render;
    if ((unsigned)settings->model > PEL_MODEL_THESIS ||
        (unsigned)settings->order > PEL_ORDER_BACK_TO_FRONT)
        return pel_fail(PEL_ERROR_ARGUMENT, "model %d, order %d", (int)settings->model,
                        (int)settings->order);
    if (!(settings->emission_scale >= 0) || !isfinite(settings->emission_scale))
        return pel_fail(PEL_ERROR_ARGUMENT, "emission scale %g, must be at least 0",
                        settings->emission_scale);
    if (settings->mixing == PEL_MIX_ORDERED && pel_model_kernel(scene) != 0)
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "mixing ordered is for volumes of model absorption, front to back and not "
                        "pre-integrated");
    const struct pel_instance *other = NULL;
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        if ((unsigned)instance->model > PEL_MODEL_THESIS)
            return pel_fail(PEL_ERROR_ARGUMENT, "volume '%s': model %d", instance->name,
                            (int)instance->model);
        if (instance->hidden)
            continue;
        enum pel_model model = pel_model_of(scene, instance);
        if (!check_surfaces(instance) || !check_preintegration(scene, instance))
            return false;
        if (is_projection(model) && settings->order == PEL_ORDER_BACK_TO_FRONT)
            return pel_fail(PEL_ERROR_ARGUMENT,
                            "volume '%s': model %s stands at a place that is known only front to "
                            "back",
                            instance->name, model_names[model]);
        if (other &&
            (model == PEL_MODEL_EMISSION) != (pel_model_of(scene, other) == PEL_MODEL_EMISSION))
            return pel_fail(PEL_ERROR_ARGUMENT,
                            "volumes '%s' and '%s': model emission is for all volumes or for none",
                            other->name, instance->name);
        other = instance;
    }
    return true;
}

bool pel_model_never_ends(const struct pel_scene *scene) {
    return pel_model_kernel(scene) & (MODELS_PROJECTION | MODELS_BACKWARD);
}

bool pel_model_skips_nothing(const struct pel_scene *scene) {
    int visible = 0, skipping = 0;
    for (int k = 0; k < scene->instance_count; k++) {
        enum pel_model model = pel_model_of(scene, &scene->instances[k]);
        visible += !scene->instances[k].hidden;
        skipping += !scene->instances[k].hidden && model != PEL_MODEL_AVERAGE &&
                    model != PEL_MODEL_EMISSION;
    }
    return visible > 0 && skipping == 0;
}

// The longest way through any visible volume, so that a picture of colours up to 1 stays below 1.
static double longest_way_mm(const struct pel_scene *scene) {
    double longest = 0;
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        if (instance->hidden)
            continue;
        const struct pel_volume *volume = scene->volumes[instance->volume];
        // The diagonals of an oblique box differ.
        for (int corner = 0; corner < 4; corner++) {
            double voxels[3], way[3];
            for (int axis = 0; axis < 3; axis++) {
                double dims = volume->dims[axis] - (instance->extent == PEL_EXTENT_POINT);
                voxels[axis] = axis < 2 && (corner >> axis & 1) ? -dims : dims;
            }
            pel_matrix_direction(way, &volume->world_from_voxel, voxels);
            longest = fmax(longest, pel_length(way));
        }
    }
    return longest > 0 ? longest : 1;
}

void pel_model_fill_rule(struct pel_strength_rule *rule, const struct pel_scene *scene,
                         const struct pel_instance *instance) {
    static const int numbers[] = {
        [PEL_MODEL_ABSORPTION] = MODEL_ABSORPTION,
        [PEL_MODEL_EMISSION] = MODEL_EMISSION,
        [PEL_MODEL_MIP] = MODEL_MIP,
        [PEL_MODEL_MINIP] = MODEL_MINIP,
        [PEL_MODEL_AVERAGE] = MODEL_AVERAGE,
        [PEL_MODEL_ISO] = MODEL_ISO,
        [PEL_MODEL_THESIS] = MODEL_THESIS,
    };
    rule->model = numbers[pel_model_of(scene, instance)];
    if (pel_model_is_preintegrated(scene, instance))
        rule->model = MODEL_PREINTEGRATED;
    rule->density = instance->density;
    rule->opacity_unit_mm = instance->transfer->opacity_unit_mm;
    if (rule->model == MODEL_EMISSION)
        rule->emission = scene->render.emission_scale > 0 ? scene->render.emission_scale
                                                          : 1 / longest_way_mm(scene);
}

// The surfaces in ascending order of what samples are.
static void fill_surfaces(struct part *part, const struct pel_instance *instance,
                          const struct pel_table *table, const struct pel_statistics *statistics) {
    struct pel_surface middle = {.value = (statistics->min + statistics->max) / 2, .opacity = 1};
    const struct pel_surface *surfaces = instance->surfaces;
    int count = instance->surface_count;
    if (count == 0) {
        surfaces = &middle;
        count = 1;
    }
    double entries = part->table_last / (table->high - table->low);
    float values[PEL_SURFACE_MAX];
    // Where all samples have one value there is no surface.
    for (int n = 0; n < count && part->table_scale != 0; n++) {
        const struct pel_surface *surface = &surfaces[n];
        double rgba[4];
        pel_transfer_evaluate(instance->transfer, surface->value, rgba);
        const double *rgb = surface->coloured ? surface->rgb : rgba;
        float value = (float)(((surface->value - table->low) * entries - part->table_bias) /
                              part->table_scale);
        int place = part->surface_count++;
        for (; place > 0 && values[place - 1] > value; place--) {
            values[place] = values[place - 1];
            part->surfaces[place] = part->surfaces[place - 1];
        }
        values[place] = value;
        part->surfaces[place] = pel_narrow(rgb, surface->opacity);
    }
    for (int n = part->surface_count; n < PEL_SURFACE_MAX; n++)
        values[n] = 0;
    part->surface_values = (float4){values[0], values[1], values[2], values[3]};
}

bool pel_model_fill_part(struct part *part, const struct pel_scene *scene,
                         const struct pel_instance *instance, const struct pel_table *table,
                         int slab_count) {
    enum pel_model model = pel_model_of(scene, instance);
    struct pel_strength_rule rule = {0};
    pel_model_fill_rule(&rule, scene, instance);
    part->model = rule.model;
    part->density = (float)instance->density;
    if (slab_count > 1 && (is_projection(model) || model == PEL_MODEL_ISO))
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "model %s needs the volume in one piece, and the device's memory takes it "
                        "in %d",
                        model_names[model], slab_count);
    if (model == PEL_MODEL_ISO)
        fill_surfaces(part, instance, table, &scene->statistics[instance->volume]);
    return true;
}

const char *const *pel_model_names(void) {
    return model_names;
}
