// secondary.c - docs/picture.md, "Shadows and ambient occlusion".
#include "reference/secondary.h"

#include <math.h>

#include "base/math.h"
#include "reference/clip.h"
#include "reference/mix.h"
#include "reference/model.h"
#include "reference/pair.h"
#include "reference/style.h"
#include "shared/pattern.h"

// A ray on its way through all bodies, and what it met last in each.
struct way {
    const struct reference *reference;
    struct reference_path path;
    double step_mm;
    const struct reference_errors *errors;
    double sign;
    bool known[PEL_VOLUME_MAX];
    double value[PEL_VOLUME_MAX];
};

// The value of body k at t; false when it is not there.
static bool value_at(double *value, double p_voxel[3], const struct way *way, int k, double t) {
    const struct reference_body *body = &way->reference->bodies[k];
    const struct reference_errors *errors = way->errors;
    struct reference_sample sample;
    if (t < way->path.spans[k].t_in || t >= way->path.spans[k].t_out ||
        !reference_is_kept(way->reference, &way->path, body, t, NULL))
        return false;
    reference_point_at(p_voxel, &way->path.rays[k], t);
    if (!reference_sample_volume(&sample, body->volume, body->instance->filter, p_voxel))
        return false;
    *value = sample.value;
    if (errors)
        *value += way->sign * ((errors->weight + errors->rounding * 64) * sample.spread +
                               (body->volume->type == PEL_VOXEL_F32 ? 0 : errors->value) *
                                   fabs(body->volume->slope));
    return true;
}

// What the surfaces of body k between its last value and this one let through.
static double pass_surfaces(const struct way *way, int k, double value) {
    const struct pel_instance *instance = way->reference->bodies[k].instance;
    const struct pel_statistics *range = &way->reference->scene->statistics[instance->volume];
    struct pel_surface usual = {.value = (range->min + range->max) / 2, .opacity = 1};
    double clear = 1;
    if (!way->known[k])
        return clear;
    for (int n = 0; n < (instance->surface_count ? instance->surface_count : 1); n++) {
        const struct pel_surface *surface =
            instance->surface_count ? &instance->surfaces[n] : &usual;
        if ((way->value[k] < surface->value) != (value < surface->value))
            clear *= 1 - surface->opacity;
    }
    return clear;
}

// What body k is made of where it has that value.
static struct reference_medium medium_of(const struct way *way, int k, const double p_voxel[3],
                                         double value) {
    const struct reference_body *body = &way->reference->bodies[k];
    const struct reference_sample sample = {.value = value};
    struct reference_medium medium =
        body->pairs ? reference_pair(body, value, value, way->reference->step_mm)
                    : reference_classify(body->instance, &body->table, &sample);
    medium.priority = body->instance->priority;
    medium.step_mm = way->step_mm;
    if (medium.extinction > 0 && !body->pairs)
        medium.extinction *= reference_style_factor(body, &way->path.ray, p_voxel, value, 0, NULL);
    return medium;
}

// What all bodies let through at a sample.
static double pass(struct way *way, double t) {
    struct reference_medium media[PEL_VOLUME_MAX];
    int count = 0, total = 0;
    double clear = 1, layer[4];
    for (int k = 0; k < way->reference->body_count; k++) {
        enum pel_model model = reference_model_of(way->reference, k);
        double value = 0, p_voxel[3];
        total += model == PEL_MODEL_ABSORPTION;
        bool present = value_at(&value, p_voxel, way, k, t);
        if (present && model == PEL_MODEL_ISO)
            clear *= pass_surfaces(way, k, value);
        if (present && model == PEL_MODEL_ABSORPTION) {
            media[count] = medium_of(way, k, p_voxel, value);
            media[count++].body = total - 1;
        }
        way->known[k] = present;
        way->value[k] = value;
    }
    reference_mix(layer, way->reference->scene->render.mixing, media, count, total);
    return clear * (1 - layer[3]);
}

double reference_light_through(const struct reference *reference, const struct reference_ray *ray,
                               double end, double step_mm, const struct reference_errors *errors,
                               double sign) {
    struct way way = {.reference = reference,
                      .path = {.ray = *ray},
                      .step_mm = step_mm,
                      .errors = errors,
                      .sign = sign};
    double last = 0, clear = 1;
    for (int k = 0; k < reference->body_count; k++) {
        const struct reference_body *body = &reference->bodies[k];
        way.path.rays[k] = reference_map_ray(&body->voxel_from_world, ray);
        way.path.spans[k] = reference_clip(&way.path.rays[k], body->low, body->high);
        if (way.path.spans[k].t_in < way.path.spans[k].t_out)
            last = fmax(last, way.path.spans[k].t_out);
    }
    double t;
    for (int j = 0; t = (j + 0.5) * step_mm, t < fmin(last, end) && clear > 1e-9; j++)
        clear *= pass(&way, t);
    return clear;
}

static double draw(uint32_t seed, uint32_t number) {
    return ldexp(pattern_draw(pattern_key(seed, 0, 0), DRAW_TURN + number) & 0xffffff, -24);
}

void reference_direction(double direction[3], uint32_t seed, int k, int count) {
    double u = draw(seed, 0), a = 2 * PEL_PI * draw(seed, 1), b = 2 * PEL_PI * draw(seed, 2);
    double q[3] = {sqrt(1 - u) * sin(a), sqrt(1 - u) * cos(a), sqrt(u) * sin(b)};
    double w = sqrt(u) * cos(b), golden = PEL_PI * (3 - sqrt(5));
    double height = 1 - (k + 0.5) / count, radius = sqrt(1 - height * height);
    double v[3] = {radius * cos(golden * k), radius * sin(golden * k), height};
    // v + 2 q x (q x v + w v), the rotation by the quaternion (q, w).
    double inner[3], outer[3];
    pel_cross(inner, q, v);
    for (int c = 0; c < 3; c++)
        inner[c] += w * v[c];
    pel_cross(outer, q, inner);
    for (int c = 0; c < 3; c++)
        direction[c] = v[c] + 2 * outer[c];
}

// How far away light n is from t along the ray.
static double distance_to_light(const struct pel_scene *scene, int n,
                                const struct reference_ray *ray, double t) {
    enum pel_light_kind kind = scene->light_count ? scene->lights[n].kind : PEL_LIGHT_HEADLIGHT;
    double p[3], away[3];
    if (kind == PEL_LIGHT_HEADLIGHT)
        return t;
    if (kind != PEL_LIGHT_POINT)
        return INFINITY;
    reference_point_at(p, ray, t);
    for (int c = 0; c < 3; c++)
        away[c] = scene->lights[n].position[c] - p[c];
    return pel_length(away);
}

// The place that the rays of t along a ray begin at, and the axis that they lie around.
static void find_origin(struct reference_ray *origin, double axis[3],
                        const struct reference_body *body, const struct reference_ray *ray,
                        double t, const double normal[3]) {
    double side = pel_dot(normal, ray->direction) > 0 ? -1 : 1;
    for (int c = 0; c < 3; c++)
        axis[c] = side * normal[c] - ray->direction[c] / 1024;
    pel_normalize(axis);
    reference_point_at(origin->origin, ray, t);
    for (int c = 0; c < 3; c++)
        origin->origin[c] += reference_spacing(body) * axis[c];
}

static double openness(const struct reference *reference, struct reference_ray *ray,
                       const double axis[3], const struct reference_errors *errors, double sign) {
    const struct pel_render_settings *render = &reference->scene->render;
    const struct pel_ambient_occlusion *settings = &render->ambient_occlusion;
    double diagonal[3], light = 0, weights = 0;
    for (int c = 0; c < 3; c++)
        diagonal[c] = reference->high[c] - reference->low[c];
    double radius = settings->radius_mm > 0 ? settings->radius_mm : pel_length(diagonal) / 10;
    double step_mm = (settings->step > 0 ? settings->step : 2) * reference->step_mm;
    int count = settings->directions > 0 ? settings->directions : 16;
    for (int k = 0; k < count; k++) {
        double direction[3];
        reference_direction(direction, render->supersampling.seed, k, count);
        double cosine = pel_dot(direction, axis);
        for (int c = 0; c < 3; c++)
            ray->direction[c] = cosine < 0 ? -direction[c] : direction[c];
        light +=
            fabs(cosine) * reference_light_through(reference, ray, radius, step_mm, errors, sign);
        weights += fabs(cosine);
    }
    return light / weights;
}

struct reference_dimming reference_dimming(const struct reference *reference,
                                           const struct reference_body *body,
                                           const struct reference_ray *ray, double t,
                                           const double normal[3], const double (*towards)[3],
                                           const struct reference_errors *errors, double sign) {
    const struct pel_scene *scene = reference->scene;
    const struct pel_shadows *shadows = &scene->render.shadows;
    const struct pel_ambient_occlusion *occlusion = &scene->render.ambient_occlusion;
    struct reference_dimming dimming = {.around = 1};
    struct reference_ray own;
    double axis[3];
    find_origin(&own, axis, body, ray, t, normal);
    for (int n = 0; n < (scene->light_count ? scene->light_count : 1); n++) {
        dimming.lights[n] = 1;
        if (!shadows->on)
            continue;
        for (int c = 0; c < 3; c++)
            own.direction[c] = towards[n][c];
        double end = distance_to_light(scene, n, ray, t);
        if (shadows->length_mm > 0)
            end = fmin(end, shadows->length_mm);
        double step_mm = (shadows->step > 0 ? shadows->step : 2) * reference->step_mm;
        double through = reference_light_through(reference, &own, end, step_mm, errors, sign);
        dimming.lights[n] -= (shadows->strength > 0 ? shadows->strength : 1) * (1 - through);
    }
    if (occlusion->on)
        dimming.around -= (occlusion->strength > 0 ? occlusion->strength : 1) *
                          (1 - openness(reference, &own, axis, errors, sign));
    return dimming;
}
