// reference.c - the loop over the samples of a ray, and over the pixels of a picture.
#include "reference/reference.h"

#include <stdlib.h>

#include "reference/clip.h"
#include "reference/mix.h"
#include "reference/model.h"
#include "reference/path.h"
#include "reference/style.h"
#include "reference/supersample.h"

// What body k has at t; false when it is absent.
static bool medium_at(struct reference_medium *medium, const struct reference *reference,
                      const struct reference_path *path, int k, double t) {
    const struct reference_body *body = &reference->bodies[k];
    double p_voxel[3];
    struct reference_sample sample;
    reference_point_at(p_voxel, &path->rays[k], t);
    if (!reference_sample_volume(&sample, body->volume, body->instance->filter, p_voxel))
        return false;
    *medium = reference_classify(body->instance, &body->table, &sample);
    medium->body = k;
    medium->priority = body->instance->priority;
    medium->step_mm = reference_sample_mm(reference, k);
    if (medium->extinction > 0)
        reference_style(medium, reference, body, &path->ray, t, p_voxel, sample.value);
    return true;
}

// The layer of a stop. `*taken` counts samples, absent ones too.
static void layer_at(double layer[4], const struct reference *reference,
                     const struct reference_path *path, const struct reference_stop *stop,
                     uint64_t *taken) {
    struct reference_medium media[PEL_VOLUME_MAX];
    int count = 0;
    for (int n = 0; n < stop->count; n++) {
        if (!reference_is_kept(reference, path, &reference->bodies[stop->bodies[n]], stop->t[n],
                               NULL))
            continue;
        ++*taken;
        if (!medium_at(&media[count], reference, path, stop->bodies[n], stop->t[n]))
            continue;
        media[count++].step_mm *= stop->steps;
    }
    reference_mix(layer, reference->scene->render.mixing, media, count, reference->body_count);
}

static void background_layer(double layer[4], const struct pel_scene *scene) {
    const double *background = scene->background;
    for (int c = 0; c < 3; c++)
        layer[c] = background[3] * background[c];
    layer[3] = background[3];
}

static struct pel_image *render(const struct pel_scene *scene, bool back_to_front) {
    struct pel_image *image = pel_image_create(scene->render.width, scene->render.height);
    if (!image)
        abort();
    struct reference *reference = reference_create(scene);
    float *pixel = image->rgba;
    for (int y = 0; y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            double rgba[4];
            if (back_to_front)
                reference_cast_back_to_front(reference, x, y, rgba);
            else
                reference_cast(reference, x, y, rgba, NULL);
            for (int c = 0; c < 4; c++)
                *pixel++ = (float)rgba[c];
        }
    }
    reference_destroy(reference);
    return image;
}

void reference_cast(const struct reference *reference, double x_px, double y_px, double rgba[4],
                    uint64_t *samples) {
    const struct pel_render_settings *settings = &reference->scene->render;
    uint64_t taken = 0;
    double layer[4];
    for (int c = 0; c < 4; c++)
        rgba[c] = 0;

    struct reference_path path;
    bool runs = reference_begin(&path, reference, x_px, y_px);
    if (runs && !reference_is_plain(reference)) {
        reference_gather(rgba, reference, &path, NULL, 0, &taken);
    } else if (runs) {
        struct reference_walk walk = {0};
        struct reference_stop stop;
        while (reference_next(&stop, &walk, reference, &path, 0)) {
            layer_at(layer, reference, &path, &stop, &taken);
            reference_compose(rgba, rgba, layer);
            if (rgba[3] > settings->termination && settings->termination != 1 &&
                settings->order == PEL_ORDER_FRONT_TO_BACK)
                break;
        }
    }

    background_layer(layer, reference->scene);
    reference_compose(rgba, rgba, layer);
    if (samples)
        *samples += taken;
}

void reference_cast_back_to_front(const struct reference *reference, double x_px, double y_px,
                                  double rgba[4]) {
    background_layer(rgba, reference->scene);
    struct reference_path path;
    if (!reference_begin(&path, reference, x_px, y_px))
        return;

    // Stops can only be counted forwards.
    struct reference_walk walk = {0};
    struct reference_stop stop, *stops = NULL;
    size_t count = 0;
    while (reference_next(&stop, &walk, reference, &path, 0)) {
        stops = realloc(stops, (count + 1) * sizeof *stops);
        if (!stops)
            abort();
        stops[count++] = stop;
    }
    uint64_t taken = 0;
    while (count-- > 0) {
        double layer[4];
        layer_at(layer, reference, &path, &stops[count], &taken);
        reference_compose(rgba, layer, rgba);
    }
    free(stops);
}

void reference_ray(const struct pel_scene *scene, double x_px, double y_px, double rgba[4],
                   uint64_t *samples) {
    struct reference *reference = reference_create(scene);
    reference_cast(reference, x_px, y_px, rgba, samples);
    reference_destroy(reference);
}

struct pel_image *reference_render(const struct pel_scene *scene) {
    return reference_is_simple(scene) ? render(scene, false) : reference_supersample(scene);
}

struct pel_image *reference_render_back_to_front(const struct pel_scene *scene) {
    return render(scene, true);
}
