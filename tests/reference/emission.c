// emission.c - docs/picture.md, "Emission".
//
// The ray is cut wherever it crosses a face of a voxel; the middle of a piece tells whose it is.
#include "reference/model.h"

#include <math.h>
#include <stdlib.h>

#include "base/math.h"

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// All places between the ends of the span where the ray crosses a face, and the ends themselves,
// in ascending order. The caller frees them.
static double *find_faces(int *count, const struct reference_body *body,
                          const struct reference_ray *ray, struct reference_span span) {
    const int *dims = body->volume->dims;
    double *faces = malloc((size_t)(dims[0] + dims[1] + dims[2] + 5) * sizeof *faces);
    if (!faces)
        abort();
    *count = 0;
    faces[(*count)++] = span.t_in;
    faces[(*count)++] = span.t_out;
    for (int axis = 0; axis < 3; axis++) {
        for (int n = 0; n <= dims[axis] && ray->direction[axis] != 0; n++) {
            double t = (n - 0.5 - ray->origin[axis]) / ray->direction[axis];
            if (t > span.t_in && t < span.t_out)
                faces[(*count)++] = t;
        }
    }
    qsort(faces, (size_t)*count, sizeof *faces, by_size);
    return faces;
}

static double longest_way(const struct reference *reference) {
    double longest = 0;
    for (int k = 0; k < reference->body_count; k++) {
        const struct reference_body *body = &reference->bodies[k];
        double corners[8][3];
        for (int n = 0; n < 8; n++) {
            for (int c = 0; c < 3; c++)
                corners[n][c] = n >> c & 1 ? body->high[c] : body->low[c];
            pel_matrix_point(corners[n], &body->world_from_voxel, corners[n]);
            for (int m = 0; m < n; m++) {
                double way[3];
                for (int c = 0; c < 3; c++)
                    way[c] = corners[n][c] - corners[m][c];
                longest = fmax(longest, pel_length(way));
            }
        }
    }
    return longest;
}

void reference_emit(double rgba[4], const struct reference *reference,
                    const struct reference_path *path) {
    double scale = reference->scene->render.emission_scale;
    if (scale == 0)
        scale = 1 / longest_way(reference);
    for (int c = 0; c < 4; c++)
        rgba[c] = 0;
    for (int k = 0; k < reference->body_count; k++) {
        const struct reference_body *body = &reference->bodies[k];
        if (path->spans[k].t_in >= path->spans[k].t_out)
            continue;
        int count;
        double *faces = find_faces(&count, body, &path->rays[k], path->spans[k]);
        for (int n = 0; n + 1 < count; n++) {
            double p_voxel[3], colour[4];
            struct reference_sample sample;
            reference_point_at(p_voxel, &path->rays[k], (faces[n] + faces[n + 1]) / 2);
            if (!reference_sample_volume(&sample, body->volume, PEL_FILTER_NEAREST, p_voxel))
                continue;
            reference_table_look_up(colour, &body->table, sample.value);
            for (int c = 0; c < 3; c++)
                rgba[c] += scale * body->instance->density * (faces[n + 1] - faces[n]) *
                           (sample.coloured ? sample.rgb[c] : colour[c]);
        }
        free(faces);
    }
}
