// style.c - docs/picture.md, "Opacity by gradient".
#include "reference/style.h"

#include <math.h>

#include "base/math.h"
#include "reference/gradient.h"
#include "reference/shade.h"

static bool is_outlined(const struct pel_silhouette *silhouette) {
    return silhouette->base != 0 || silhouette->strength != 0 || silhouette->exponent != 0;
}

// The piecewise linear function of the gradient's length.
static double factor_of(const struct pel_instance *instance, double length) {
    const struct pel_gradient_point *points = instance->gradient_opacity;
    int count = instance->gradient_opacity_count;
    if (count == 0)
        return 1;
    if (length <= points[0].gradient)
        return points[0].factor;
    for (int n = 1; n < count; n++)
        if (length < points[n].gradient)
            return points[n - 1].factor + (points[n].factor - points[n - 1].factor) *
                                              (length - points[n - 1].gradient) /
                                              (points[n].gradient - points[n - 1].gradient);
    return points[count - 1].factor;
}

static double outline(const struct pel_silhouette *silhouette, double away) {
    if (!is_outlined(silhouette))
        return 1;
    return silhouette->base + silhouette->strength * pow(fmax(away, 0), silhouette->exponent);
}

// The length of the gradient in the world, in the file's unit per millimetre.
static double world_length(const struct reference_body *body, const double along[3]) {
    double gradient[3] = {0};
    for (int c = 0; c < 3; c++)
        for (int axis = 0; axis < 3; axis++)
            gradient[c] += body->voxel_from_world.m[axis][c] * along[axis];
    return pel_length(gradient);
}

double reference_style_factor(const struct reference_body *body, const struct reference_ray *ray,
                              const double p_voxel[3], double value, double error, double *change) {
    const struct pel_instance *instance = body->instance;
    if (change)
        *change = 0;
    if (instance->gradient_opacity_count == 0 && !is_outlined(&instance->silhouette))
        return 1;
    double along[3], normal[3], spread;
    reference_gradient(along, body, p_voxel, value, &spread);
    reference_normal(normal, body, p_voxel, value, NULL);
    double length = world_length(body, along);
    double away = pel_length(normal) - fabs(pel_dot(normal, ray->direction));
    double factor = factor_of(instance, length) * outline(&instance->silhouette, away);
    if (!change)
        return factor;
    const double errors[3] = {error, error, error};
    double off = world_length(body, errors), turn = length > 0 ? fmin(1, off / length) : 1;
    for (int n = 0; n < 9; n++) {
        double other = factor_of(instance, fmax(0, length + off * (n % 3 - 1))) *
                       outline(&instance->silhouette, fmin(1, away + turn * (n / 3 - 1)));
        *change = fmax(*change, fabs(other - factor));
    }
    return factor;
}

void reference_style(struct reference_medium *medium, const struct reference *reference,
                     const struct reference_body *body, const struct reference_ray *ray, double t,
                     const double p_voxel[3], double value) {
    medium->extinction *= reference_style_factor(body, ray, p_voxel, value, 0, NULL);
    if (body->instance->material.shading == PEL_SHADING_NONE)
        return;
    double normal[3];
    reference_normal(normal, body, p_voxel, value, NULL);
    struct reference_shade shade = reference_shade(reference, body, ray, t, normal);
    reference_shade_apply(medium, &shade);
}
