// bound.c - what inexact positions and interpolation may do to a ray.
//
// With transmittance T, extinction e and colour c along the ray, C = integral of T e c. A change de
// of the extinction and dc of the colour change it by
//
//     dC = integral of de(s) (T(s) c(s) - integral behind s of T e c) ds + integral of T e dc
//
// Both terms in the brackets lie in [0, m T(s)] where m is the brightest colour, 1 but for shading,
// so |dC| <= integral of m T |de| + T e |dc|, and the same for the opacity with c = 1. Along the
// ray de and dc are taken as the greatest change over the values the sample may have had.
#include "reference/reference.h"

#include <math.h>

#include "base/math.h"
#include "reference/model.h"
#include "reference/path.h"
#include "reference/shade.h"
#include "reference/style.h"

struct change {
    double extinction, colour;
};

static void widen(struct change *change, const struct reference_medium *a,
                  const struct reference_medium *b) {
    change->extinction = fmax(change->extinction, fabs(a->extinction - b->extinction));
    for (int c = 0; c < 3; c++)
        change->colour = fmax(change->colour, fabs(a->rgb[c] - b->rgb[c]));
}

// Sample t of a ray, as body k has it.
struct spot {
    const struct reference *reference;
    const struct reference_path *path;
    const struct reference_body *body;
    double t;
};

// What is near the spot, as it is shaded there. False when it is absent.
static bool medium_at(struct reference_medium *medium, const struct spot *spot,
                      const double p_voxel[3]) {
    const struct reference_body *body = spot->body;
    struct reference_sample sample;
    *medium = (struct reference_medium){0};
    if (!reference_sample_volume(&sample, body->volume, body->instance->filter, p_voxel))
        return false;
    *medium = reference_classify(body->instance, &body->table, &sample);
    reference_style(medium, spot->reference, body, &spot->path->ray, spot->t, p_voxel,
                    sample.value);
    return true;
}

// The value may have been up to `reach` more or less. Looked at in a few places between, as tables
// are piecewise linear.
static void widen_by_value(struct change *change, const struct reference_body *body,
                           const struct reference_sample *sample, double reach) {
    enum { STEPS = 4 };
    struct reference_medium medium = reference_classify(body->instance, &body->table, sample);
    for (int n = -STEPS; n <= STEPS; n++) {
        struct reference_sample moved = *sample;
        moved.value += reach * n / STEPS;
        struct reference_medium other = reference_classify(body->instance, &body->table, &moved);
        widen(change, &medium, &other);
    }
}

// The place may have been up to `reach_voxel` off along each axis: for `nearest`, another voxel.
static void widen_by_place(struct change *change, const struct spot *spot,
                           const struct reference_medium *medium, const double p_voxel[3],
                           double reach_voxel) {
    for (int n = 0; n < 6; n++) {
        double moved[3] = {p_voxel[0], p_voxel[1], p_voxel[2]};
        moved[n % 3] += n < 3 ? reach_voxel : -reach_voxel;
        struct reference_medium other;
        medium_at(&other, spot, moved);
        widen(change, medium, &other);
    }
}

// How far an interpolated value may be off where one in each weight makes `spread`.
static double value_reach(const struct reference_body *body, double spread, double value,
                          double reach_voxel, const struct reference_errors *errors) {
    return (errors->weight + reach_voxel) * spread +
           (body->volume->type == PEL_VOXEL_F32 ? 0 : errors->value * fabs(body->volume->slope)) +
           errors->rounding * fabs(value);
}

// The samples of the gradient may have been off, too.
static void widen_by_shade(struct change *change, const struct spot *spot,
                           const struct reference_sample *sample, const double p_voxel[3],
                           double reach_voxel, const struct reference_errors *errors) {
    double normal[3], spread, factor_change;
    reference_normal(normal, spot->body, p_voxel, sample->value, &spread);
    double reach =
        value_reach(spot->body, spread, fabs(sample->value) + spread, reach_voxel, errors);
    double factor = reference_style_factor(spot->body, &spot->path->ray, p_voxel, sample->value,
                                           reach, &factor_change);
    struct reference_medium plain =
        reference_classify(spot->body->instance, &spot->body->table, sample);
    change->extinction = change->extinction * factor + plain.extinction * factor_change;
    if (spot->body->instance->material.shading == PEL_SHADING_NONE)
        return;
    change->colour = change->colour * reference_shade_greatest(spot->reference, spot->body) +
                     reference_shade_change(spot->reference, spot->body, normal, reach);
}

static double spacing_along(const struct reference_body *body, int axis) {
    const struct pel_matrix *matrix = &body->world_from_voxel;
    return pel_length((double[]){matrix->m[0][axis], matrix->m[1][axis], matrix->m[2][axis]});
}

static double rounding_mm(const struct reference *reference, double t,
                          const struct reference_errors *errors) {
    return errors->rounding * (t + pel_length(reference->scene->camera.eye));
}

// The brightest colour there may be, at least 1.
static double brightest(const struct reference *reference) {
    double greatest = 1;
    for (int k = 0; k < reference->body_count; k++)
        greatest = fmax(greatest, reference_shade_greatest(reference, &reference->bodies[k]));
    return greatest;
}

// Adds what body k has at t to `*extinction`, and what may be wrong about it, per millimetre, to
// `*wrong`.
static void add_body(double *extinction, double *wrong, const struct reference *reference,
                     const struct reference_path *path, int k, double t,
                     const struct reference_errors *errors) {
    const struct reference_body *body = &reference->bodies[k];
    struct reference_span span = path->spans[k];
    double slack_mm = rounding_mm(reference, t, errors);
    if (span.t_in >= span.t_out || t < span.t_in - slack_mm || t >= span.t_out + slack_mm)
        return;

    double p_voxel[3], reach_voxel = 0;
    reference_point_at(p_voxel, &path->rays[k], t);
    for (int axis = 0; axis < 3; axis++)
        reach_voxel = fmax(reach_voxel, slack_mm / spacing_along(body, axis));

    const struct spot spot = {reference, path, body, t};
    struct reference_sample sample;
    struct reference_medium medium;
    struct change change = {0};
    medium_at(&medium, &spot, p_voxel);
    if (reference_sample_volume(&sample, body->volume, body->instance->filter, p_voxel)) {
        double reach = value_reach(body, sample.spread, sample.value, reach_voxel, errors);
        widen_by_value(&change, body, &sample, reach);
        // A volume's own colours are interpolated too, each over its whole range at most.
        if (sample.coloured)
            change.colour = fmax(change.colour, 3 * errors->weight + errors->value / 255);
        widen_by_shade(&change, &spot, &sample, p_voxel, reach_voxel, errors);
    }
    widen_by_place(&change, &spot, &medium, p_voxel, reach_voxel);

    *extinction += medium.extinction;
    *wrong += change.extinction * brightest(reference) + medium.extinction * change.colour;
    if (fabs(t - span.t_in) <= slack_mm || fabs(t - span.t_out) <= slack_mm)
        *wrong += medium.extinction * brightest(reference);
}

// Where light is gathered in other ways: how far it goes when all values are off one way or the
// other, and half as much again.
static double model_bound(const struct reference *reference, const struct reference_path *path,
                          const struct reference_errors *errors) {
    double right[4], wrong[4], bound = 0;
    uint64_t taken = 0;
    reference_gather(right, reference, path, NULL, 0, &taken);
    for (int sign = -1; sign <= 1; sign += 2) {
        reference_gather(wrong, reference, path, errors, sign, &taken);
        for (int c = 0; c < 4; c++)
            bound = fmax(bound, 1.5 * fabs(wrong[c] - right[c]));
    }
    return bound;
}

double reference_cast_bound(const struct reference *reference, double x_px, double y_px,
                            const struct reference_errors *errors) {
    struct reference_path path;
    if (!reference_begin(&path, reference, x_px, y_px))
        return 0;

    if (!reference_is_plain(reference))
        return model_bound(reference, &path, errors);
    double termination = reference->scene->render.termination;
    double bound = 0, depth = 0, t = 0;
    for (double i = 0; t = reference_sample_t(reference, &path, i),
                t < path.t_far + rounding_mm(reference, t, errors);
         i++) {
        double extinction = 0, wrong = 0, transmittance = exp(-depth);
        for (int k = 0; k < reference->body_count; k++)
            add_body(&extinction, &wrong, reference, &path, k, t, errors);

        // Whether the ray has ended here may be uncertain; once that it has is certain, it has.
        double beyond = 1 - transmittance - termination;
        if (termination < 1 && beyond > bound + errors->rounding)
            break;
        if (termination < 1 && beyond > -bound - errors->rounding)
            bound +=
                brightest(reference) * transmittance * (1 - exp(-extinction * reference->step_mm));
        bound += transmittance * -expm1(-wrong * reference->step_mm);
        depth += extinction * reference->step_mm;
    }
    return bound;
}
