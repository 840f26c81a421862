// remark.c - what a scene asks for in vain.
//
// Each setting is valid, and the picture is what docs/picture.md says. But whoever asks for shadows
// of volumes that are not shaded, or for a surface at a value that no voxel has, sees no difference
// or nothing, and is told why.
#include "world/remark.h"

#include <math.h>

#include "base/error.h"
#include "world/model.h"
#include "world/style.h"

// What the visible volumes are, all together.
struct census {
    int absorbing, preintegrated, lit, emitting;
    bool follows_gradient; // light, opacity or occlusion needs gradients
};

static const char *model_name(const struct pel_scene *scene, const struct pel_instance *instance) {
    return pel_model_names()[pel_model_of(scene, instance)];
}

// Media and surfaces are shaded, projections are not (docs/picture.md, "Optical models").
static bool is_lit(const struct pel_scene *scene, const struct pel_instance *instance) {
    enum pel_model model = pel_model_of(scene, instance);
    return instance->material.shading != PEL_SHADING_NONE &&
           (model == PEL_MODEL_ABSORPTION || model == PEL_MODEL_ISO);
}

static struct census count(const struct pel_scene *scene) {
    struct census census = {0};
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        if (instance->hidden)
            continue;
        enum pel_model model = pel_model_of(scene, instance);
        census.absorbing += model == PEL_MODEL_ABSORPTION;
        census.emitting += model == PEL_MODEL_EMISSION;
        census.preintegrated += pel_model_is_preintegrated(scene, instance);
        census.lit += is_lit(scene, instance);
        census.follows_gradient |= is_lit(scene, instance) || pel_style_is_on(instance);
    }
    return census;
}

// ---- A volume ----------------------------------------------------------------------------------

// Surfaces lie between two samples; splines may go beyond the values of voxels.
static void remark_surfaces(const struct pel_scene *scene, const struct pel_instance *instance) {
    const struct pel_statistics *values = &scene->statistics[instance->volume];
    if (instance->surface_count == 0)
        return;
    if (pel_model_of(scene, instance) != PEL_MODEL_ISO) {
        pel_warn("volume '%s': 'iso' says where its surfaces are, but its model is %s",
                 instance->name, model_name(scene, instance));
        return;
    }
    if (instance->filter == PEL_FILTER_CATMULL_ROM || values->count == 0 ||
        scene->volumes[instance->volume]->hypertexture)
        return;
    for (int n = 0; n < instance->surface_count; n++) {
        double value = instance->surfaces[n].value;
        if (!(value > values->min && value <= values->max))
            pel_warn("volume '%s': there is no surface at %g, as its values go from %g to %g",
                     instance->name, value, values->min, values->max);
    }
}

static void remark_mask(const struct pel_scene *scene, const struct pel_instance *instance) {
    const struct pel_mask *mask = &instance->mask;
    if (mask->range_count == 0)
        return;
    const struct pel_instance *other = &scene->instances[mask->instance];
    const struct pel_statistics *values = &scene->statistics[other->volume];
    if (scene->volumes[other->volume]->hypertexture)
        return;
    for (int n = 0; n < mask->range_count; n++)
        if (mask->ranges[n].low <= values->max && mask->ranges[n].high >= values->min)
            return;
    pel_warn("volume '%s': %s of it is shown, as no value of '%s', from %g to %g, is among those "
             "of its mask",
             instance->name, mask->inverted ? "all" : "nothing", other->name, values->min,
             values->max);
}

static void remark_volume(const struct pel_scene *scene, const struct pel_instance *instance) {
    enum pel_model model = pel_model_of(scene, instance);
    remark_surfaces(scene, instance);
    remark_mask(scene, instance);
    if (instance->material.shading != PEL_SHADING_NONE && !is_lit(scene, instance))
        pel_warn("volume '%s': model %s is not shaded", instance->name,
                 model_name(scene, instance));
    if (pel_style_is_on(instance) && model != PEL_MODEL_ABSORPTION)
        pel_warn("volume '%s': with model %s opacity does not follow the gradient", instance->name,
                 model_name(scene, instance));
    else if (pel_style_is_on(instance) && pel_model_is_preintegrated(scene, instance))
        pel_warn("volume '%s': pre-integrated, its opacity does not follow the gradient",
                 instance->name);
}

// ---- The scene ---------------------------------------------------------------------------------

static void remark_light(const struct pel_scene *scene, const struct census *census) {
    const struct pel_render_settings *settings = &scene->render;
    if (census->lit > 0)
        return;
    if (settings->shadows.on || settings->ambient_occlusion.on)
        pel_warn("%s shaded volumes only, and none is shaded",
                 settings->shadows.on ? "shadows fall on" : "ambient occlusion darkens");
    if (scene->light_count > 0)
        pel_warn("lights shine on shaded volumes only, and none is shaded");
    bool chosen = false;
    for (int k = 0; k < scene->instance_count; k++)
        chosen |= scene->instances[k].gradient != PEL_GRADIENT_CENTRAL;
    if (chosen && !census->follows_gradient)
        pel_warn("gradients are chosen, but neither light nor opacity follows one");
}

static void remark_models(const struct pel_scene *scene, const struct census *census) {
    const struct pel_render_settings *settings = &scene->render;
    bool preintegration = settings->preintegration;
    for (int k = 0; k < scene->instance_count; k++)
        preintegration |= !scene->instances[k].hidden && scene->instances[k].preintegration;
    if (preintegration && census->preintegrated == 0)
        pel_warn("only volumes of model absorption are pre-integrated, and there is none");
    if (settings->mixing > PEL_MIX_ORDERED && census->absorbing == 0)
        pel_warn("only volumes of model absorption are mixed by %s, and there is none",
                 pel_mixing_names()[settings->mixing]);
    if (settings->emission_scale > 0 && census->emitting == 0)
        pel_warn("an emission scale is of model emission, and no volume has that");
}

// True when nothing within the bounds is kept. Turned boxes are not looked at.
static bool leaves_nothing(const struct pel_clip *clip, const struct pel_bounds *bounds) {
    double least = 0, greatest = 0;
    bool apart = false;
    for (int axis = 0; axis < 3; axis++) {
        double low = bounds->low[axis] - clip->point[axis],
               high = bounds->high[axis] - clip->point[axis];
        apart |= low > clip->size[axis] / 2 || high < -clip->size[axis] / 2;
        least += fmin(clip->normal[axis] * low, clip->normal[axis] * high);
        greatest += fmax(clip->normal[axis] * low, clip->normal[axis] * high);
    }
    if (clip->kind == PEL_CLIP_PLANE)
        return clip->outside ? least >= 0 : greatest < 0;
    bool turned = clip->xyzw[0] != 0 || clip->xyzw[1] != 0 || clip->xyzw[2] != 0;
    return !clip->outside && !turned && apart;
}

static void remark_clips(const struct pel_scene *scene) {
    struct pel_bounds bounds;
    if (!pel_scene_bounds(scene, &bounds))
        return;
    for (int c = 0; c < scene->clip_count; c++)
        if (leaves_nothing(&scene->clips[c], &bounds)) {
            pel_warn("the scene's clips leave nothing of any volume");
            return;
        }
}

static void remark_picture(const struct pel_scene *scene) {
    const struct pel_supersampling *rays = &scene->render.supersampling;
    const struct pel_stereo *stereo = &scene->stereo;
    if (rays->adaptive > 0 && rays->n <= 1)
        pel_warn("adaptive supersampling chooses between one ray and n x n, and n is 1");
    if (stereo->kind == PEL_STEREO_NONE &&
        (stereo->separation_mm > 0 || stereo->convergence_mm > 0 || stereo->flat ||
         stereo->toe_in || stereo->reproject || stereo->swap))
        pel_warn("stereo has settings but no kind, so the picture is for one eye");
}

void pel_scene_remark(const struct pel_scene *scene) {
    // Other frames may use what this one does not.
    if (scene->timeline.frame_count > 0)
        return;
    struct census census = count(scene);
    for (int k = 0; k < scene->instance_count; k++)
        if (!scene->instances[k].hidden)
            remark_volume(scene, &scene->instances[k]);
    remark_light(scene, &census);
    remark_models(scene, &census);
    remark_clips(scene);
    remark_picture(scene);
}
