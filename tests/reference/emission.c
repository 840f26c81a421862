// emission.c - docs/picture.md, "Emission".
//
// The ray is cut wherever it crosses a face of a voxel, of the mask's, too, or a clip; the middle
// of a piece tells whose it is and whether it is shown.
#include "reference/model.h"

#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "reference/clip.h"

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Places along a ray.
struct cuts {
    double t_in, t_out; // between these
    double *t;
    int count;
};

static void add_cut(struct cuts *cuts, double t) {
    if (!(t > cuts->t_in && t < cuts->t_out))
        return;
    double *grown = realloc(cuts->t, (size_t)(cuts->count + 1) * sizeof *grown);
    if (!grown)
        abort();
    cuts->t = grown;
    cuts->t[cuts->count++] = t;
}

// Where the ray, in the volume's voxel coordinates, crosses faces of voxels, and the ends of a box
// of extent `point`.
static void add_faces(struct cuts *cuts, const int dims[3], const struct reference_ray *ray) {
    for (int axis = 0; axis < 3; axis++)
        for (int half = -1; half < 2 * dims[axis] && ray->direction[axis] != 0; half++)
            if (half % 2 != 0 || half == 0 || half == 2 * (dims[axis] - 1))
                add_cut(cuts, (0.5 * half - ray->origin[axis]) / ray->direction[axis]);
}

// Where the body, or whether it is shown, may change along the ray, in ascending order. The caller
// frees them.
static struct cuts find_cuts(const struct reference *reference, const struct reference_path *path,
                             int k) {
    const struct reference_body *body = &reference->bodies[k];
    const struct pel_mask *mask = &body->instance->mask;
    struct cuts cuts = {-INFINITY, INFINITY, NULL, 0};
    add_cut(&cuts, path->spans[k].t_in);
    add_cut(&cuts, path->spans[k].t_out);
    cuts.t_in = path->spans[k].t_in;
    cuts.t_out = path->spans[k].t_out;
    add_faces(&cuts, body->volume->dims, &path->rays[k]);
    if (mask->range_count > 0) {
        const struct pel_instance *other = &reference->scene->instances[mask->instance];
        const struct pel_volume *volume = reference->scene->volumes[other->volume];
        struct pel_matrix world_from_voxel =
                              pel_matrix_multiply(&other->transform, &volume->world_from_voxel),
                          voxel_from_world;
        if (!pel_matrix_invert(&voxel_from_world, &world_from_voxel))
            abort();
        struct reference_ray ray = reference_map_ray(&voxel_from_world, &path->ray);
        add_faces(&cuts, volume->dims, &ray);
    }
    double places[REFERENCE_CLIP_PLACES];
    int count = reference_clip_places(places, reference, path, body);
    for (int n = 0; n < count; n++)
        add_cut(&cuts, places[n]);
    qsort(cuts.t, (size_t)cuts.count, sizeof *cuts.t, by_size);
    return cuts;
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
        struct cuts cuts = find_cuts(reference, path, k);
        for (int n = 0; n + 1 < cuts.count; n++) {
            double p_voxel[3], colour[4], middle = (cuts.t[n] + cuts.t[n + 1]) / 2;
            struct reference_sample sample;
            reference_point_at(p_voxel, &path->rays[k], middle);
            if (!reference_is_kept(reference, path, body, middle, NULL) ||
                !reference_sample_volume(&sample, body->volume, PEL_FILTER_NEAREST, p_voxel))
                continue;
            reference_table_look_up(colour, &body->table, sample.value);
            for (int c = 0; c < 3; c++)
                rgba[c] += scale * body->instance->density * (cuts.t[n + 1] - cuts.t[n]) *
                           (sample.coloured ? sample.rgb[c] : colour[c]);
        }
        free(cuts.t);
    }
}
