// model.c - docs/picture.md, "Optical models".
//
// Every sample becomes layers, and every projection one more. When the ray is at its end they are
// put in order and together.
#include "reference/model.h"

#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "reference/clip.h"
#include "reference/mix.h"
#include "reference/pair.h"
#include "reference/stride.h"
#include "reference/style.h"

// What lies at one sample, in front of what comes after it in this order.
enum rank { PROJECTIONS, SURFACES, MEDIA };

struct layer {
    double at; // the number of the sample
    enum rank rank;
    int body;
    double rgba[4]; // premultiplied
};

// What is known of a body so far.
struct progress {
    bool known;         // there was a present sample before this one
    double t, value;    // of that
    double best, count; // of a projection: its value or the sum of values, and of how many
    double at, rgb[3];  // where it stands, and its own colour, likewise a sum
    bool coloured;
};

struct gathering {
    const struct reference *reference;
    const struct reference_path *path;
    const struct reference_errors *errors;
    double sign;
    struct progress bodies[PEL_VOLUME_MAX];
    struct layer *layers; // owned
    int count;
};

static bool is_projection(enum pel_model model) {
    return model == PEL_MODEL_MIP || model == PEL_MODEL_MINIP || model == PEL_MODEL_AVERAGE;
}

static double *add_layer(struct gathering *gathering, double at, enum rank rank, int body) {
    gathering->layers =
        realloc(gathering->layers, (size_t)(gathering->count + 1) * sizeof *gathering->layers);
    if (!gathering->layers)
        abort();
    struct layer *layer = &gathering->layers[gathering->count++];
    *layer = (struct layer){.at = at, .rank = rank, .body = body};
    return layer->rgba;
}

static int by_place(const void *a, const void *b) {
    const struct layer *x = a, *y = b;
    if (x->at != y->at)
        return x->at < y->at ? -1 : 1;
    if (x->rank != y->rank)
        return (int)x->rank - (int)y->rank;
    return x->body - y->body;
}

// The sample of body k at t; false when it is absent or the ray is not in the body.
static bool sample_at(struct reference_sample *sample, double p_voxel[3],
                      const struct gathering *gathering, int k, double t) {
    const struct reference_body *body = &gathering->reference->bodies[k];
    const struct reference_errors *errors = gathering->errors;
    reference_point_at(p_voxel, &gathering->path->rays[k], t);
    if (!reference_sample_volume(sample, body->volume, body->instance->filter, p_voxel))
        return false;
    if (errors)
        sample->value +=
            gathering->sign *
            ((errors->weight + errors->rounding * 64) * sample->spread +
             (body->volume->type == PEL_VOXEL_F32 ? 0 : errors->value) * fabs(body->volume->slope));
    return true;
}

static void shade(struct reference_medium *medium, const struct gathering *gathering, int k,
                  double t, const double p_voxel[3], double value) {
    reference_style(medium, gathering->reference, &gathering->reference->bodies[k],
                    &gathering->path->ray, t, p_voxel, value);
}

// ---- Surfaces ----------------------------------------------------------------------------------

static double meet(const struct gathering *gathering, int k, double near, double far, double value,
                   double near_value) {
    for (int n = 0; n < 50; n++) {
        double middle = (near + far) / 2, p_voxel[3];
        struct reference_sample sample;
        if (!sample_at(&sample, p_voxel, gathering, k, middle))
            break;
        if ((sample.value < value) == (near_value < value))
            near = middle;
        else
            far = middle;
    }
    return (near + far) / 2;
}

// The surface of one value between the body's last sample and the one at t, behind those in `own`.
static void add_surface(double own[4], const struct gathering *gathering, int k, double t,
                        double value, const struct pel_surface *surface) {
    const struct reference_body *body = &gathering->reference->bodies[k];
    const struct progress *last = &gathering->bodies[k];
    if ((last->value < surface->value) == (value < surface->value))
        return;
    double t_met = meet(gathering, k, last->t, t, surface->value, last->value), p_voxel[3], rgba[4];
    struct reference_medium medium;
    pel_transfer_evaluate(body->instance->transfer, surface->value, rgba);
    for (int c = 0; c < 3; c++)
        medium.rgb[c] = surface->coloured ? surface->rgb[c] : rgba[c];
    reference_point_at(p_voxel, &gathering->path->rays[k], t_met);
    shade(&medium, gathering, k, t_met, p_voxel, surface->value);
    double layer[4] = {surface->opacity * medium.rgb[0], surface->opacity * medium.rgb[1],
                       surface->opacity * medium.rgb[2], surface->opacity};
    reference_compose(own, own, layer);
}

static int by_value(const void *a, const void *b) {
    double x = ((const struct pel_surface *)a)->value, y = ((const struct pel_surface *)b)->value;
    return (x > y) - (x < y);
}

static void gather_surfaces(struct gathering *gathering, int k, double i, double t, double value) {
    const struct reference_body *body = &gathering->reference->bodies[k];
    const struct pel_statistics *statistics =
        &gathering->reference->scene->statistics[body->instance->volume];
    struct pel_surface surfaces[PEL_SURFACE_MAX] = {
        {.value = (statistics->min + statistics->max) / 2, .opacity = 1}};
    int count = body->instance->surface_count;
    for (int n = 0; n < count; n++)
        surfaces[n] = body->instance->surfaces[n];
    if (count == 0)
        count = 1;
    qsort(surfaces, (size_t)count, sizeof *surfaces, by_value);
    double own[4] = {0};
    bool rising = value > gathering->bodies[k].value;
    for (int n = 0; n < count; n++)
        add_surface(own, gathering, k, t, value, &surfaces[rising ? n : count - 1 - n]);
    if (own[3] > 0)
        reference_compose(add_layer(gathering, i, SURFACES, k), own, (double[4]){0});
}

// ---- Projections -------------------------------------------------------------------------------

static void gather_projection(struct progress *progress, enum pel_model model, double i,
                              const struct reference_sample *sample) {
    bool mean = model == PEL_MODEL_AVERAGE, first = progress->count == 0;
    bool beyond =
        model == PEL_MODEL_MIP ? sample->value > progress->best : sample->value < progress->best;
    if (first || (!mean && beyond))
        progress->at = i;
    if (!mean && (first || beyond))
        progress->best = progress->count = progress->rgb[0] = progress->rgb[1] = progress->rgb[2] =
            0;
    if (!mean && !first && !beyond)
        return;
    progress->best += sample->value;
    progress->count++;
    progress->coloured = sample->coloured;
    for (int c = 0; c < 3; c++)
        progress->rgb[c] += sample->rgb[c];
}

static void add_projections(struct gathering *gathering) {
    for (int k = 0; k < gathering->reference->body_count; k++) {
        const struct progress *progress = &gathering->bodies[k];
        if (!is_projection(reference_model_of(gathering->reference, k)) || progress->count == 0)
            continue;
        double rgba[4];
        reference_table_look_up(rgba, &gathering->reference->bodies[k].table,
                                progress->best / progress->count);
        double *layer = add_layer(gathering, progress->at, PROJECTIONS, k);
        for (int c = 0; c < 3; c++)
            layer[c] =
                rgba[3] * (progress->coloured ? progress->rgb[c] / progress->count : rgba[c]);
        layer[3] = rgba[3];
    }
}

// ---- Media -------------------------------------------------------------------------------------

static void add_thesis(double layer[4], const struct gathering *gathering, int k,
                       const struct reference_sample *sample) {
    const struct reference_body *body = &gathering->reference->bodies[k];
    double rgba[4], density = body->instance->density;
    reference_table_look_up(rgba, &body->table, sample->value);
    double opacity = fmin(density * rgba[3], 1);
    bool backwards = gathering->reference->scene->render.order == PEL_ORDER_BACK_TO_FRONT;
    double own[4] = {0, 0, 0, opacity};
    for (int c = 0; c < 3; c++)
        own[c] = (backwards ? opacity : density) * (sample->coloured ? sample->rgb[c] : rgba[c]);
    reference_compose(layer, layer, own);
}

static void gather_sample(struct gathering *gathering, double i, double t, double steps,
                          uint64_t *taken) {
    const struct reference *reference = gathering->reference;
    const enum pel_mixing mixing = reference->scene->render.mixing;
    struct reference_medium media[PEL_VOLUME_MAX];
    int count = 0, total = 0; // media here, and in the scene so far
    double layer[4] = {0};
    for (int k = 0; k < reference->body_count; k++) {
        const struct reference_body *body = &reference->bodies[k];
        struct progress *progress = &gathering->bodies[k];
        enum pel_model model = reference_model_of(reference, k);
        struct reference_sample sample;
        double p_voxel[3];
        total += model == PEL_MODEL_ABSORPTION;
        // Who has the first sample of a run has all of it.
        struct reference_span span = steps > 1 ? reference_clip_span(reference, gathering->path, k)
                                               : gathering->path->spans[k];
        double first = reference_sample_t(reference, gathering->path, i);
        if (first < span.t_in || first >= span.t_out)
            continue;
        if (!reference_is_kept(reference, gathering->path, body, t, NULL)) {
            progress->known = false;
            continue;
        }
        ++*taken;
        bool present = sample_at(&sample, p_voxel, gathering, k, t);
        if (present && model == PEL_MODEL_ISO && progress->known)
            gather_surfaces(gathering, k, i, t, sample.value);
        if (present && is_projection(model))
            gather_projection(progress, model, i, &sample);
        if (present && model == PEL_MODEL_THESIS)
            add_thesis(layer, gathering, k, &sample);
        if (present && model == PEL_MODEL_ABSORPTION) {
            double before = progress->known ? progress->value : sample.value;
            media[count] = body->pairs
                               ? reference_pair(body, before, sample.value, reference->step_mm)
                               : reference_classify(body->instance, &body->table, &sample);
            media[count].body = total - 1;
            media[count].priority = body->instance->priority;
            media[count].step_mm = steps * reference->step_mm;
            if (media[count].extinction > 0)
                shade(&media[count], gathering, k, t, p_voxel, sample.value);
            count++;
        }
        progress->known = present;
        progress->t = t;
        progress->value = present ? sample.value : 0;
    }
    double mixed[4];
    reference_mix(mixed, mixing, media, count, total);
    reference_compose(add_layer(gathering, i, MEDIA, 0), layer, mixed);
}

enum pel_model reference_model_of(const struct reference *reference, int k) {
    enum pel_model own = reference->bodies[k].instance->model;
    enum pel_model scene = reference->scene->render.model;
    return own != PEL_MODEL_DEFAULT     ? own
           : scene != PEL_MODEL_DEFAULT ? scene
                                        : PEL_MODEL_ABSORPTION;
}

bool reference_is_plain(const struct reference *reference) {
    for (int k = 0; k < reference->body_count; k++)
        if (reference_model_of(reference, k) != PEL_MODEL_ABSORPTION || reference->bodies[k].pairs)
            return false;
    return true;
}

void reference_gather(double rgba[4], const struct reference *reference,
                      const struct reference_path *path, const struct reference_errors *errors,
                      double sign, uint64_t *taken) {
    if (reference->body_count > 0 && reference_model_of(reference, 0) == PEL_MODEL_EMISSION) {
        reference_emit(rgba, reference, path);
        return;
    }
    struct gathering gathering = {
        .reference = reference, .path = path, .errors = errors, .sign = sign};
    double termination = reference->scene->render.termination, so_far[4] = {0};
    bool ends = termination < 1 && reference->scene->render.order == PEL_ORDER_FRONT_TO_BACK;
    for (int k = 0; k < reference->body_count; k++)
        ends = ends && !is_projection(reference_model_of(reference, k));
    double steps;
    for (double i = 0; reference_sample_t(reference, path, i) < path->t_far; i += steps) {
        int first = gathering.count;
        steps = reference_run(reference, path, i);
        double t = reference_sample_t(reference, path, i + (steps - 1) / 2);
        gather_sample(&gathering, i, t, steps, taken);
        for (int n = first; n < gathering.count; n++)
            reference_compose(so_far, so_far, gathering.layers[n].rgba);
        if (ends && so_far[3] > termination)
            break;
    }
    add_projections(&gathering);
    for (int c = 0; c < 4; c++)
        rgba[c] = 0;
    if (gathering.count > 0)
        qsort(gathering.layers, (size_t)gathering.count, sizeof *gathering.layers, by_place);
    for (int n = 0; n < gathering.count; n++)
        reference_compose(rgba, rgba, gathering.layers[n].rgba);
    free(gathering.layers);
}
