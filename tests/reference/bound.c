// bound.c - what inexact positions and interpolation may do to a ray.
//
// With transmittance T, extinction e and colour c along the ray, C = integral of T e c. A change de
// of the extinction and dc of the colour change it by
//
//     dC = integral of de(s) (T(s) c(s) - integral behind s of T e c) ds + integral of T e dc
//
// Both terms in the brackets lie in [0, m T(s)] where m is the brightest colour, 1 but for shading,
// so |dC| <= integral of m T |de| + T e |dc|, and the same for the opacity with c = 1. Along the
// ray de and dc are taken as the greatest change over the values the sample may have had. What
// mixing makes of several media has no more than twice the sum of their changes, as minima, maxima,
// differences and means have none of their own; but where one medium hides the others and it is
// uncertain which, all that is there is.
#include "reference/reference.h"

#include <math.h>

#include "base/math.h"
#include "reference/model.h"
#include "reference/clip.h"
#include "reference/mix.h"
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
                     reference_shade_change(spot->reference, spot->body, normal, reach) +
                     reference_dimming_change(spot->reference, spot->body, &spot->path->ray,
                                              spot->t, normal, errors);
}

static double spacing_along(const struct reference_body *body, int axis) {
    const struct pel_matrix *matrix = &body->world_from_voxel;
    return pel_length((double[]){matrix->m[0][axis], matrix->m[1][axis], matrix->m[2][axis]});
}

// The brightest colour there may be, at least 1.
static double brightest(const struct reference *reference) {
    double greatest = 1;
    for (int k = 0; k < reference->body_count; k++)
        greatest = fmax(greatest, reference_shade_greatest(reference, &reference->bodies[k]));
    return greatest;
}

// What one body has at a stop, and what may be wrong about it: extinctions, per millimetre.
struct doubt {
    struct reference_medium medium;
    double wrong;
    double low, high; // between these its extinction is seen by a kernel, whose tables have entries
};

// A kernel reads tables of up to 4096 entries at the nearest one.
static void find_range(struct doubt *doubt, const struct reference_body *body,
                       const struct reference_sample *sample, double reach) {
    enum { STEPS = 4 };
    reach += (body->table.high - body->table.low) / 4095;
    for (int n = -STEPS; n <= STEPS; n++) {
        struct reference_sample moved = *sample;
        moved.value += reach * n / STEPS;
        struct reference_medium medium = reference_classify(body->instance, &body->table, &moved);
        doubt->low = fmin(doubt->low, medium.extinction);
        doubt->high = fmax(doubt->high, medium.extinction);
    }
}

static struct doubt doubt_body(const struct spot *spot, int k, const struct reference_span *span,
                               double slack_mm, const struct reference_errors *errors) {
    const struct reference_body *body = spot->body;
    const struct reference *reference = spot->reference;
    double p_voxel[3], reach_voxel = 0, t = spot->t;
    reference_point_at(p_voxel, &spot->path->rays[k], t);
    for (int axis = 0; axis < 3; axis++)
        reach_voxel = fmax(reach_voxel, slack_mm / spacing_along(body, axis));

    struct doubt doubt = {.low = 0};
    struct reference_sample sample;
    struct change change = {0};
    medium_at(&doubt.medium, spot, p_voxel);
    doubt.medium.body = k;
    doubt.medium.priority = body->instance->priority;
    doubt.medium.step_mm = reference_sample_mm(reference, k);
    doubt.low = doubt.high = doubt.medium.extinction;
    if (reference_sample_volume(&sample, body->volume, body->instance->filter, p_voxel)) {
        double reach = value_reach(body, sample.spread, sample.value, reach_voxel, errors);
        widen_by_value(&change, body, &sample, reach);
        find_range(&doubt, body, &sample, reach);
        // A volume's own colours are interpolated too, each over its whole range at most.
        if (sample.coloured)
            change.colour = fmax(change.colour, 3 * errors->weight + errors->value / 255);
        widen_by_shade(&change, spot, &sample, p_voxel, reach_voxel, errors);
    }
    widen_by_place(&change, spot, &doubt.medium, p_voxel, reach_voxel);
    doubt.low = fmax(0, fmin(doubt.low, doubt.medium.extinction - change.extinction));
    doubt.high = fmax(doubt.high, doubt.medium.extinction + change.extinction);
    doubt.wrong =
        change.extinction * brightest(reference) + doubt.medium.extinction * change.colour;
    if (fabs(t - span->t_in) <= slack_mm || fabs(t - span->t_out) <= slack_mm) {
        doubt.wrong += doubt.medium.extinction * brightest(reference);
        doubt.low = 0;
    }
    double margin_mm;
    bool kept = reference_is_kept(reference, spot->path, body, t, &margin_mm);
    if (margin_mm <= slack_mm) {
        doubt.wrong += doubt.medium.extinction * brightest(reference);
        doubt.low = 0;
    } else if (!kept) {
        doubt.wrong = doubt.low = doubt.high = 0;
    }
    if (!kept)
        doubt.medium.extinction = 0;
    return doubt;
}

// True when rounding decides about a sample at an end of a body that is up to a run away from t:
// then the runs there may be others, too.
static bool has_open_end(const struct reference *reference, const struct reference_path *path,
                         int k, double t, double slack_mm) {
    struct reference_span span = reference_clip_span(reference, path, k);
    for (int n = 0; n < 2; n++) {
        double end = n ? span.t_out : span.t_in;
        double number = (end - path->t_near) / reference->step_mm - path->phase;
        if (fabs(number - rint(number)) * reference->step_mm <= slack_mm &&
            fabs(end - t) <= 4 * reference->step_mm)
            return true;
    }
    return false;
}

// True when rounding decides which cell a sample up to a run away from t lies in, so that runs may
// be others there.
static bool has_open_cell(const struct reference *reference, const struct reference_path *path,
                          int k, double t, double slack_mm) {
    double number = rint((t - path->t_near) / reference->step_mm - path->phase);
    for (int n = -4; n <= 4; n++) {
        double p_voxel[3];
        reference_point_at(p_voxel, &path->rays[k],
                           reference_sample_t(reference, path, number + n));
        for (int c = 0; c < 3; c++) {
            double away = p_voxel[c] + 1 - 4 * rint((p_voxel[c] + 1) / 4);
            if (fabs(away) * spacing_along(&reference->bodies[k], c) <= slack_mm)
                return true;
        }
    }
    return false;
}

// What runs may have been others adds to doubts: what a run may vary by, once for each body.
static void doubt_runs(struct doubt *doubts, const struct reference *reference,
                       const struct reference_path *path, const struct reference_stop *stop,
                       double rounding) {
    double depth = reference->scene->render.adaptive_step;
    bool open = false;
    for (int n = 0; n < stop->count && depth > 0; n++) {
        double slack_mm = reference_slack_mm(reference, stop->t[n], rounding);
        open |= has_open_cell(reference, path, stop->bodies[n], stop->t[n], slack_mm);
        if (has_open_end(reference, path, stop->bodies[n], stop->t[n], slack_mm)) {
            doubts[n].wrong += doubts[n].medium.extinction * brightest(reference);
            doubts[n].low = 0;
        }
    }
    for (int n = 0; n < stop->count && open; n++)
        doubts[n].wrong += depth / doubts[n].medium.step_mm * brightest(reference);
}

// True when it is uncertain which of the media hides the others.
static bool is_contested(const struct doubt *doubts, int count, bool by_priority) {
    for (int a = 0; a < count; a++) {
        for (int b = 0; b < count; b++) {
            if (a == b || doubts[a].high == 0 || doubts[b].high == 0)
                continue;
            // Whether the more important one is there, or which is the greater.
            bool above = doubts[a].medium.priority > doubts[b].medium.priority ||
                         (doubts[a].medium.priority == doubts[b].medium.priority && a < b);
            if (by_priority ? above && doubts[a].low == 0
                            : doubts[a].high >= doubts[b].low && doubts[b].high >= doubts[a].low)
                return true;
        }
    }
    return false;
}

// What may be wrong, as an optical depth, about the media of one stop together.
static double mixed_wrong(const struct reference *reference, const struct doubt *doubts,
                          int count) {
    enum pel_mixing mixing = reference->scene->render.mixing;
    bool simple = mixing == PEL_MIX_SUM || mixing == PEL_MIX_OVER || mixing == PEL_MIX_ORDERED;
    double wrong = 0, greatest = 0;
    for (int n = 0; n < count; n++) {
        double step_mm = doubts[n].medium.step_mm;
        wrong += (simple ? 1 : 2) * doubts[n].wrong * step_mm;
        greatest = fmax(greatest, doubts[n].high * step_mm);
    }
    bool winner = mixing == PEL_MIX_MAX || mixing == PEL_MIX_PRIORITY;
    if (winner && is_contested(doubts, count, mixing == PEL_MIX_PRIORITY))
        wrong += greatest * brightest(reference);
    return wrong;
}

// The optical depth of the media of one stop together.
static double mixed_depth(const struct reference *reference, const struct doubt *doubts,
                          int count) {
    struct reference_medium media[PEL_VOLUME_MAX];
    double layer[4];
    for (int n = 0; n < count; n++)
        media[n] = doubts[n].medium;
    reference_mix(layer, reference->scene->render.mixing, media, count, reference->body_count);
    return -log1p(-fmin(layer[3], 1 - 1e-15));
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
    double bound = 0, depth = 0;
    struct reference_walk walk = {0};
    struct reference_stop stop;
    while (reference_next(&stop, &walk, reference, &path, errors->rounding)) {
        struct doubt doubts[PEL_VOLUME_MAX];
        for (int n = 0; n < stop.count; n++) {
            int k = stop.bodies[n];
            const struct spot spot = {reference, &path, &reference->bodies[k], stop.t[n]};
            double slack_mm = reference_slack_mm(reference, stop.t[n], errors->rounding);
            doubts[n] = doubt_body(&spot, k, &path.spans[k], slack_mm, errors);
            doubts[n].medium.step_mm *= stop.steps;
        }
        doubt_runs(doubts, reference, &path, &stop, errors->rounding);
        double transmittance = exp(-depth);
        double here = mixed_depth(reference, doubts, stop.count);

        // Whether the ray has ended here may be uncertain; once that it has is certain, it has.
        double beyond = 1 - transmittance - termination;
        if (termination < 1 && beyond > bound + errors->rounding)
            break;
        if (termination < 1 && beyond > -bound - errors->rounding)
            bound += brightest(reference) * transmittance * (1 - exp(-here));
        bound += transmittance * -expm1(-mixed_wrong(reference, doubts, stop.count));
        depth += here;
    }
    return bound;
}
