// shade.c - docs/picture.md, "Shading".
#include "reference/shade.h"

#include <math.h>

#include "base/math.h"
#include "reference/gradient.h"
#include "reference/secondary.h"

// The length of a gradient, in ranges of the table per voxel, where normals fade out.
static const double softness = 0x1p-16;

static struct pel_material material_of(const struct reference_body *body) {
    struct pel_material material = body->instance->material;
    if (material.ambient == 0 && material.diffuse == 0 && material.specular == 0 &&
        material.shininess == 0) {
        material.ambient = 0.1;
        material.diffuse = 0.7;
        material.specular = 0.2;
        material.shininess = 10;
    }
    return material;
}

// The colour of light n times its intensity. A scene without lights has a white headlight.
static double lamp_colour(const struct pel_scene *scene, int n, int c) {
    return scene->light_count > 0 ? scene->lights[n].colour[c] * scene->lights[n].intensity : 1;
}

static int lamp_count(const struct pel_scene *scene) {
    return scene->light_count > 0 ? scene->light_count : 1;
}

// The gradient in ranges of the table per voxel, in world directions.
static void find_gradient(double gradient[3], const struct reference_body *body,
                          const double p_voxel[3], double value, double *spread) {
    double along[3];
    reference_gradient(along, body, p_voxel, value, spread);
    double range = body->table.high - body->table.low;
    double scale = range > 0 ? reference_spacing(body) / range : 0;
    // A gradient is a row: it goes the other way, by the transpose.
    for (int c = 0; c < 3; c++) {
        gradient[c] = 0;
        for (int axis = 0; axis < 3; axis++)
            gradient[c] += scale * body->voxel_from_world.m[axis][c] * along[axis];
    }
}

void reference_normal(double normal[3], const struct reference_body *body, const double p_voxel[3],
                      double value, double *spread) {
    double gradient[3], own_spread;
    find_gradient(gradient, body, p_voxel, value, spread ? spread : &own_spread);
    double length = sqrt(pel_dot(gradient, gradient) + softness * softness);
    for (int c = 0; c < 3; c++)
        normal[c] = -gradient[c] / length;
}

// The unit vector to light n, from t along the ray.
static void find_light(double l[3], const struct pel_scene *scene, int n,
                       const struct reference_ray *ray, double t) {
    const struct pel_light *light = &scene->lights[n];
    double p_world[3];
    reference_point_at(p_world, ray, t);
    for (int c = 0; c < 3; c++) {
        if (scene->light_count == 0 || light->kind == PEL_LIGHT_HEADLIGHT)
            l[c] = -ray->direction[c];
        else if (light->kind == PEL_LIGHT_CAMERA)
            l[c] = scene->camera.eye[c] - scene->camera.target[c];
        else if (light->kind == PEL_LIGHT_DIRECTIONAL)
            l[c] = -light->direction[c];
        else
            l[c] = light->position[c] - p_world[c];
    }
    pel_normalize(l);
}

static double highlight(const struct pel_material *material, const double n[3], const double l[3],
                        const double v[3]) {
    if (material->shading == PEL_SHADING_PHONG) {
        double cosine = 2 * pel_dot(n, l) * pel_dot(n, v) - pel_dot(n, n) * pel_dot(l, v);
        return pow(fmax(cosine, 0), material->shininess);
    }
    double h[3] = {l[0] + v[0], l[1] + v[1], l[2] + v[2]};
    if (!pel_normalize(h))
        return 0; // the light is opposite the viewer
    double cosine = pel_dot(n, h);
    return pow(material->one_sided ? fmax(cosine, 0) : fabs(cosine), material->shininess);
}

// What shadows and ambient occlusion leave of the light at t along the ray.
static struct reference_dimming dim(const struct reference *reference,
                                    const struct reference_body *body,
                                    const struct reference_ray *ray, double t,
                                    const double normal[3], const struct reference_errors *errors,
                                    double sign) {
    double towards[PEL_LIGHT_MAX][3];
    for (int n = 0; n < lamp_count(reference->scene); n++)
        find_light(towards[n], reference->scene, n, ray, t);
    return reference_dimming(reference, body, ray, t, normal, (const double(*)[3])towards, errors,
                             sign);
}

struct reference_shade reference_shade(const struct reference *reference,
                                       const struct reference_body *body,
                                       const struct reference_ray *ray, double t,
                                       const double normal[3]) {
    struct reference_shade shade = {{1, 1, 1}, {0, 0, 0}};
    const struct pel_material material = material_of(body);
    if (material.shading == PEL_SHADING_NONE)
        return shade;
    const struct pel_scene *scene = reference->scene;
    const double v[3] = {-ray->direction[0], -ray->direction[1], -ray->direction[2]};
    for (int c = 0; c < 3; c++)
        shade.matt[c] = material.ambient;
    struct reference_dimming dimming = dim(reference, body, ray, t, normal, NULL, 0);
    for (int n = 0; n < lamp_count(scene); n++) {
        double l[3];
        find_light(l, scene, n, ray, t);
        double facing = pel_dot(normal, l);
        if (material.one_sided && facing <= 0)
            continue;
        for (int c = 0; c < 3; c++) {
            double colour = lamp_colour(scene, n, c) * dimming.lights[n];
            shade.matt[c] += colour * material.diffuse * fabs(facing);
            shade.gloss[c] += colour * material.specular * highlight(&material, normal, l, v);
        }
    }
    for (int c = 0; c < 3; c++)
        shade.matt[c] *= dimming.around;
    return shade;
}

void reference_shade_apply(struct reference_medium *medium, const struct reference_shade *shade) {
    for (int c = 0; c < 3; c++)
        medium->rgb[c] = medium->rgb[c] * shade->matt[c] + shade->gloss[c];
}

static double greatest_light(const struct pel_scene *scene) {
    double greatest = 0;
    for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (int n = 0; n < lamp_count(scene); n++)
            sum += lamp_colour(scene, n, c);
        greatest = fmax(greatest, sum);
    }
    return greatest;
}

// A gradient off by d changes the normal by at most d over the lesser length of the two, the
// diffuse term by as much, and the highlight by its exponent times as much (Phong: four times).
double reference_shade_change(const struct reference *reference, const struct reference_body *body,
                              const double normal[3], double error) {
    const struct pel_material material = material_of(body);
    double range = body->table.high - body->table.low;
    if (material.shading == PEL_SHADING_NONE || range <= 0)
        return 0;
    double off = sqrt(3) * error / range;
    // |normal| = g / sqrt(g^2 + s^2), solved for g.
    double squared = fmin(pel_dot(normal, normal), 1 - 1e-12);
    double length = softness * sqrt(squared / (1 - squared));
    double turn = fmin(2, off / fmax(softness, length - off));
    double sharpness = material.shininess * (material.shading == PEL_SHADING_PHONG ? 4 : 1);
    return greatest_light(reference->scene) *
           (material.diffuse * fmin(1, turn) + material.specular * fmin(1, sharpness * turn));
}

double reference_dimming_change(const struct reference *reference,
                                const struct reference_body *body, const struct reference_ray *ray,
                                double t, const double normal[3],
                                const struct reference_errors *errors) {
    const struct pel_render_settings *render = &reference->scene->render;
    if (!render->shadows.on && !render->ambient_occlusion.on)
        return 0;
    struct reference_dimming right = dim(reference, body, ray, t, normal, NULL, 0);
    double change = 0;
    for (int sign = -1; sign <= 1; sign += 2) {
        struct reference_dimming wrong = dim(reference, body, ray, t, normal, errors, sign);
        change = fmax(change, fabs(wrong.around - right.around));
        for (int n = 0; n < lamp_count(reference->scene); n++)
            change = fmax(change, fabs(wrong.lights[n] - right.lights[n]));
    }
    return 1.5 * change * reference_shade_greatest(reference, body);
}

double reference_shade_greatest(const struct reference *reference,
                                const struct reference_body *body) {
    const struct pel_material material = material_of(body);
    if (material.shading == PEL_SHADING_NONE)
        return 1;
    return material.ambient +
           greatest_light(reference->scene) * (material.diffuse + material.specular);
}
