// path.c - docs/picture.md, "Boxes and spans" and "Samples".
#include "reference/path.h"

#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "reference/clip.h"
#include "reference/level.h"
#include "reference/pair.h"
#include "reference/reference.h"
#include "reference/stride.h"

static void init_body(struct reference_body *body, const struct pel_scene *scene,
                      const struct pel_instance *instance) {
    body->instance = instance;
    body->volume = scene->volumes[instance->volume];
    body->world_from_voxel =
        pel_matrix_multiply(&instance->transform, &body->volume->world_from_voxel);
    if (!pel_matrix_invert(&body->voxel_from_world, &body->world_from_voxel))
        abort();
    double margin = instance->extent == PEL_EXTENT_CELL ? 0.5 : 0;
    for (int c = 0; c < 3; c++) {
        body->low[c] = -margin;
        body->high[c] = body->volume->dims[c] - 1 + margin;
    }
    reference_table_init(&body->table, instance->transfer, body->volume);
    if (scene->render.adaptive_step > 0)
        reference_run_prepare(body);
    if (reference_is_preintegrated(scene, instance)) {
        const struct pel_statistics *values = &scene->statistics[instance->volume];
        body->pairs = reference_pairs_create();
        body->pair_range[0] = values->min;
        body->pair_range[1] = values->max > values->min ? values->max : values->min + 1;
    }
}

// What the body asks for: its own step before the scene's, millimetres before voxels.
static double step_of(const struct pel_scene *scene, const struct reference_body *body) {
    double step_mm = body->instance->step_mm, step = body->instance->step;
    if (step_mm == 0 && step == 0) {
        step_mm = scene->render.step_mm;
        step = scene->render.step;
    }
    return step_mm > 0 ? step_mm : step * reference_spacing(body);
}

static void include_corners(struct reference *reference, const struct reference_body *body) {
    for (int n = 0; n < 8; n++) {
        double corner[3];
        for (int c = 0; c < 3; c++)
            corner[c] = n >> c & 1 ? body->high[c] : body->low[c];
        pel_matrix_point(corner, &body->world_from_voxel, corner);
        for (int c = 0; c < 3; c++) {
            reference->low[c] = fmin(reference->low[c], corner[c]);
            reference->high[c] = fmax(reference->high[c], corner[c]);
        }
    }
}

struct reference *reference_create(const struct pel_scene *scene) {
    struct reference *reference = calloc(1, sizeof *reference);
    if (!reference)
        abort();
    struct pel_scene *coarse = reference_coarsen(scene);
    if (coarse)
        scene = coarse;
    *reference = (struct reference){
        .scene = scene,
        .coarse = coarse,
        .step_mm = INFINITY,
        .phase = NAN,
        .low = {INFINITY, INFINITY, INFINITY},
        .high = {-INFINITY, -INFINITY, -INFINITY},
    };
    for (int i = 0; i < scene->instance_count; i++) {
        if (scene->instances[i].hidden)
            continue;
        struct reference_body *body = &reference->bodies[reference->body_count++];
        init_body(body, scene, &scene->instances[i]);
        include_corners(reference, body);
        body->step_mm = step_of(scene, body);
        reference->step_mm = fmin(reference->step_mm, body->step_mm);
    }
    return reference;
}

void reference_destroy(struct reference *reference) {
    if (!reference)
        return;
    for (int k = 0; k < reference->body_count; k++) {
        reference_table_finish(&reference->bodies[k].table);
        free(reference->bodies[k].pairs);
        free(reference->bodies[k].runs);
    }
    reference_coarsen_finish(reference->coarse);
    free(reference);
}

double reference_spacing(const struct reference_body *body) {
    double least = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double column[3];
        for (int c = 0; c < 3; c++)
            column[c] = body->world_from_voxel.m[c][axis];
        least = fmin(least, pel_length(column));
    }
    return least;
}

bool reference_begin(struct reference_path *path, const struct reference *reference, double x_px,
                     double y_px) {
    const struct pel_scene *scene = reference->scene;
    struct reference_ray ray =
        reference_camera_ray(&scene->camera, scene->render.width, scene->render.height, x_px, y_px);
    path->ray = ray;
    path->phase = isnan(reference->phase) ? scene->render.phase : reference->phase;
    path->t_near = INFINITY;
    path->t_far = -INFINITY;
    for (int k = 0; k < reference->body_count; k++) {
        const struct reference_body *body = &reference->bodies[k];
        path->rays[k] = reference_map_ray(&body->voxel_from_world, &ray);
        path->spans[k] = reference_clip(&path->rays[k], body->low, body->high);
        if (path->spans[k].t_in < path->spans[k].t_out) {
            path->t_near = fmin(path->t_near, path->spans[k].t_in);
            path->t_far = fmax(path->t_far, path->spans[k].t_out);
        }
    }
    if (path->t_near >= path->t_far)
        return false;
    if (scene->render.origin == PEL_ORIGIN_BOUNDS)
        path->t_near = reference_clip(&ray, reference->low, reference->high).t_in;
    return true;
}

double reference_sample_t(const struct reference *reference, const struct reference_path *path,
                          double i) {
    return path->t_near + (i + path->phase) * reference->step_mm;
}

double reference_slack_mm(const struct reference *reference, double t, double rounding) {
    return rounding * (t + pel_length(reference->scene->camera.eye));
}

double reference_sample_mm(const struct reference *reference, int body) {
    bool own = reference->scene->render.mixing == PEL_MIX_ORDERED;
    return own ? reference->bodies[body].step_mm : reference->step_mm;
}

// All bodies in the middle of the run at sample walk->next of the common grid, which may be none.
static bool next_of_all(struct reference_stop *stop, struct reference_walk *walk,
                        const struct reference *reference, const struct reference_path *path,
                        double rounding) {
    double first = walk->next, t = reference_sample_t(reference, path, first);
    double slack_mm = reference_slack_mm(reference, t, rounding);
    if (t >= path->t_far + slack_mm)
        return false;
    stop->steps = reference_run(reference, path, first);
    walk->next += stop->steps;
    double middle = reference_sample_t(reference, path, first + (stop->steps - 1) / 2);
    for (int k = 0; k < reference->body_count; k++) {
        // Who has the first sample of a run has all of it.
        struct reference_span span =
            stop->steps > 1 ? reference_clip_span(reference, path, k) : path->spans[k];
        if (span.t_in >= span.t_out || t < span.t_in - slack_mm || t >= span.t_out + slack_mm)
            continue;
        stop->bodies[stop->count] = k;
        stop->t[stop->count++] = middle;
    }
    return true;
}

// Where the next sample of body k lies on its own grid, from its own entry on; INFINITY behind its
// last.
static double own_t(struct reference_walk *walk, const struct reference *reference,
                    const struct reference_path *path, int k, double rounding) {
    struct reference_span span = path->spans[k];
    if (span.t_in >= span.t_out)
        return INFINITY;
    bool bounds = reference->scene->render.origin == PEL_ORIGIN_BOUNDS;
    double start = bounds ? path->t_near : span.t_in;
    for (;; walk->nexts[k]++) {
        double t = start + (walk->nexts[k] + path->phase) * reference->bodies[k].step_mm;
        double slack_mm = reference_slack_mm(reference, t, rounding);
        if (t >= span.t_out + slack_mm)
            return INFINITY;
        if (t >= span.t_in - slack_mm)
            return t;
    }
}

// The bodies whose next samples lie in the nearest place, in 64ths of the common step.
static bool next_in_order(struct reference_stop *stop, struct reference_walk *walk,
                          const struct reference *reference, const struct reference_path *path,
                          double rounding) {
    double places[PEL_VOLUME_MAX], t[PEL_VOLUME_MAX], nearest = INFINITY;
    for (int k = 0; k < reference->body_count; k++) {
        t[k] = own_t(walk, reference, path, k, rounding);
        double steps = (t[k] - path->t_near) / reference->step_mm - path->phase;
        places[k] = rint(64 * steps);
        nearest = fmin(nearest, places[k]);
    }
    if (nearest == INFINITY)
        return false;
    for (int k = 0; k < reference->body_count; k++) {
        if (places[k] != nearest)
            continue;
        stop->bodies[stop->count] = k;
        stop->t[stop->count++] = t[k];
        walk->nexts[k]++;
    }
    return true;
}

bool reference_next(struct reference_stop *stop, struct reference_walk *walk,
                    const struct reference *reference, const struct reference_path *path,
                    double rounding) {
    stop->count = 0;
    stop->steps = 1;
    return reference->scene->render.mixing == PEL_MIX_ORDERED
               ? next_in_order(stop, walk, reference, path, rounding)
               : next_of_all(stop, walk, reference, path, rounding);
}
