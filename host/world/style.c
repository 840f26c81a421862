// style.c - opacity that follows the gradient, as kernels read it: docs/picture.md, "Opacity by
// gradient".
//
// The piecewise linear function of the gradient becomes a sum of ramps, one between each two of its
// points.
#include "world/style.h"

#include <math.h>

#include "base/error.h"

static bool check_point(const struct pel_instance *instance, int n) {
    const struct pel_gradient_point *point = &instance->gradient_opacity[n];
    if (!(point->gradient >= 0) || !isfinite(point->gradient))
        return pel_fail(PEL_ERROR_ARGUMENT, "gradient opacity at a gradient of %g",
                        point->gradient);
    if (!(point->factor >= 0 && point->factor <= PEL_OPACITY_FACTOR_MAX))
        return pel_fail(PEL_ERROR_ARGUMENT, "gradient opacity of %g, outside 0..%g", point->factor,
                        PEL_OPACITY_FACTOR_MAX);
    if (n > 0 && point->gradient < point[-1].gradient)
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "gradient opacity has %g behind %g, must be in ascending order",
                        point->gradient, point[-1].gradient);
    return true;
}

static bool fill_ramps(struct part *part, const struct pel_instance *instance, double range) {
    _Static_assert(GRADIENT_RAMPS == PEL_GRADIENT_POINT_MAX - 1, "a ramp between each two points");
    const struct pel_gradient_point *points = instance->gradient_opacity;
    int count = instance->gradient_opacity_count;
    if (count < 0 || count > PEL_GRADIENT_POINT_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "gradient opacity with %d points, outside 0..%d", count,
                        PEL_GRADIENT_POINT_MAX);
    part->silhouette.w = count > 0 ? (float)points[0].factor : 1;
    for (int n = 0; n < count; n++) {
        if (!check_point(instance, n))
            return false;
        if (n == 0)
            continue;
        // A step is a ramp too narrow to be seen.
        double width = fmax(points[n].gradient - points[n - 1].gradient, 1e-9 * range);
        part->ramps[n - 1] =
            (float4){(float)(points[n - 1].gradient / range), (float)(range / width),
                     (float)(points[n].factor - points[n - 1].factor), 0};
        part->ramp_count = n;
    }
    return true;
}

static bool fill_silhouette(struct part *part, const struct pel_silhouette *silhouette) {
    if (!(silhouette->base >= 0 && silhouette->base <= PEL_OPACITY_FACTOR_MAX) ||
        !(silhouette->strength >= 0 && silhouette->strength <= PEL_OPACITY_FACTOR_MAX))
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "a silhouette of base %g and strength %g, outside 0..%g", silhouette->base,
                        silhouette->strength, PEL_OPACITY_FACTOR_MAX);
    if (!(silhouette->exponent >= PEL_SILHOUETTE_EXPONENT_MIN &&
          silhouette->exponent <= PEL_SILHOUETTE_EXPONENT_MAX))
        return pel_fail(PEL_ERROR_ARGUMENT, "a silhouette of exponent %g, outside %g..%g",
                        silhouette->exponent, PEL_SILHOUETTE_EXPONENT_MIN,
                        PEL_SILHOUETTE_EXPONENT_MAX);
    part->silhouette.x = (float)silhouette->base;
    part->silhouette.y = (float)silhouette->strength;
    part->silhouette.z = (float)silhouette->exponent;
    return true;
}

static bool is_outlined(const struct pel_silhouette *silhouette) {
    return silhouette->base != 0 || silhouette->strength != 0 || silhouette->exponent != 0;
}

bool pel_style_is_on(const struct pel_instance *instance) {
    return is_outlined(&instance->silhouette) || instance->gradient_opacity_count != 0;
}

bool pel_style_needs_gradients(const struct pel_instance *instance) {
    return instance->material.shading != PEL_SHADING_NONE || pel_style_is_on(instance);
}

bool pel_style_fill_part(struct part *part, const struct pel_instance *instance, double range) {
    if ((unsigned)instance->gradient > PEL_GRADIENT_ANALYTIC)
        return pel_fail(PEL_ERROR_ARGUMENT, "gradient %d", (int)instance->gradient);
    // The numbers of shared/variant.h are in the order of the enum.
    part->gradient = (i32)instance->gradient;
    const struct pel_silhouette *silhouette = &instance->silhouette;
    part->styled = pel_style_is_on(instance);
    part->silhouette = (float4){1, 0, 1, 1};
    return fill_ramps(part, instance, range) &&
           (!is_outlined(silhouette) || fill_silhouette(part, silhouette));
}
