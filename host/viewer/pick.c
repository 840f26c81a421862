// pick.c - what is under the pointer: a plain march on the host, over one ray.
#include "viewer/pick.h"

#include "viewer/vector.h"

enum { SAMPLES_MAX = 4096 };

// The visible volumes that a ray meets.
struct crossing {
    struct pel_sampler sampler;
    int instance;
    enum pel_model model;
    double near, far;
    double middle; // of the volume's values: where its surface is if it has none of its own
    double last;   // value of the sample before, NaN at the first
    // What a projection shows, the greatest, the least or the first value, and where; NaN before.
    double shown, shown_t;
};

struct march {
    struct crossing crossings[PEL_VOLUME_MAX];
    int count;
    double near, far, step;
};

static void prepare(struct march *march, const struct pel_scene *scene,
                    const struct pel_view_ray *ray) {
    *march = (struct march){.near = INFINITY, .step = INFINITY};
    for (int i = 0; i < scene->instance_count; i++) {
        struct crossing *crossing = &march->crossings[march->count];
        const struct pel_instance *instance = &scene->instances[i];
        if (instance->hidden || !pel_sampler_make(&crossing->sampler, scene, i) ||
            !pel_sampler_span(&crossing->sampler, ray->origin, ray->direction, &crossing->near,
                              &crossing->far))
            continue;
        const struct pel_statistics *statistics = &scene->statistics[instance->volume];
        crossing->instance = i;
        crossing->middle = (statistics->min + statistics->max) / 2;
        crossing->last = crossing->shown_t = NAN;
        crossing->model =
            instance->model == PEL_MODEL_DEFAULT ? scene->render.model : instance->model;
        march->near = fmin(march->near, crossing->near);
        march->far = fmax(march->far, crossing->far);
        march->step = fmin(march->step, pel_sampler_spacing(&crossing->sampler) / 2);
        march->count++;
    }
    march->step = fmax(march->step, (march->far - march->near) / SAMPLES_MAX);
}

// True when a surface lies between the last sample and this.
static bool meets_surface(const struct crossing *crossing, double value) {
    const struct pel_instance *instance = crossing->sampler.instance;
    for (int n = 0; n < (instance->surface_count > 0 ? instance->surface_count : 1); n++) {
        double at = instance->surface_count > 0 ? instance->surfaces[n].value : crossing->middle;
        if ((crossing->last < at) != (value < at) && !isnan(crossing->last))
            return true;
    }
    return false;
}

// How much opacity a volume adds at one sample.
static double opacity_of(struct crossing *crossing, const struct march *march, double t,
                         const double position[3]) {
    if (t < crossing->near || t >= crossing->far)
        return 0;
    struct pel_sample sample = pel_sampler_take(&crossing->sampler, position);
    if (!sample.inside || sample.absent) {
        crossing->last = NAN;
        return 0;
    }
    double better = crossing->model == PEL_MODEL_MINIP ? crossing->shown - sample.value
                    : crossing->model == PEL_MODEL_MIP ? sample.value - crossing->shown
                                                       : 0;
    if (isnan(crossing->shown_t) || better > 0) {
        crossing->shown = sample.value;
        crossing->shown_t = t;
    }
    bool surface = meets_surface(crossing, sample.value);
    crossing->last = sample.value;
    switch (crossing->model) {
    case PEL_MODEL_ISO:
        return surface;
    case PEL_MODEL_MIP:
    case PEL_MODEL_MINIP:
    case PEL_MODEL_AVERAGE:
        return 0;
    default:
        return -expm1(-sample.extinction * march->step);
    }
}

static void finish(struct pel_pick *pick, const struct pel_scene *scene,
                   const struct pel_view_ray *ray, int instance, double t) {
    pick->hit = true;
    pick->instance = instance;
    pick->distance_mm = t;
    vector_add_scaled(pick->position, ray->origin, t, ray->direction);
    pel_pick_values(pick, scene, pick->position);
}

// The place of the volumes that show one of the ray's only.
static void pick_projection(struct pel_pick *pick, const struct pel_scene *scene,
                            const struct march *march, const struct pel_view_ray *ray) {
    for (int k = 0; k < march->count; k++) {
        const struct crossing *crossing = &march->crossings[k];
        bool projects = crossing->model == PEL_MODEL_MIP || crossing->model == PEL_MODEL_MINIP ||
                        crossing->model == PEL_MODEL_AVERAGE;
        double rgba[4];
        if (!projects || isnan(crossing->shown_t))
            continue;
        pel_transfer_evaluate(crossing->sampler.instance->transfer, crossing->shown, rgba);
        if (rgba[3] > PEL_PICK_OPACITY) {
            finish(pick, scene, ray, crossing->instance, crossing->shown_t);
            return;
        }
    }
}

void pel_pick(struct pel_pick *pick, const struct pel_scene *scene, const struct pel_view *view,
              const double pixel[2]) {
    *pick = (struct pel_pick){0};
    struct pel_view_ray ray = pel_view_ray(view, pixel);
    struct march march;
    prepare(&march, scene, &ray);
    double through = 1;
    for (int i = 0; march.near + (i + 0.5) * march.step < march.far; i++) {
        double t = march.near + (i + 0.5) * march.step, position[3], most = 0;
        int instance = 0;
        vector_add_scaled(position, ray.origin, t, ray.direction);
        for (int k = 0; k < march.count; k++) {
            double opacity = opacity_of(&march.crossings[k], &march, t, position);
            through *= 1 - opacity;
            if (opacity > most) {
                most = opacity;
                instance = march.crossings[k].instance;
            }
        }
        if (1 - through > PEL_PICK_OPACITY) {
            finish(pick, scene, &ray, instance, t);
            return;
        }
    }
    pick_projection(pick, scene, &march, &ray);
}

void pel_pick_values(struct pel_pick *pick, const struct pel_scene *scene,
                     const double position[3]) {
    struct pel_sampler sampler;
    pick->count = scene->instance_count;
    for (int i = 0; i < scene->instance_count; i++)
        pick->values[i] = pel_sampler_make(&sampler, scene, i)
                              ? pel_sampler_take(&sampler, position)
                              : (struct pel_sample){0};
}
