// clip.c - docs/mixing.md, "Clipping" and "Masks".
#include "reference/clip.h"

#include <math.h>

#include "base/math.h"
#include "reference/mask.h"

// Turns the axes of a clip's box to those of its frame.
static struct pel_matrix axes_of(const struct pel_clip *clip) {
    const double *q = clip->xyzw;
    bool turned = q[0] != 0 || q[1] != 0 || q[2] != 0 || q[3] != 0;
    const double none[4] = {0, 0, 0, 1}, zero[3] = {0};
    return pel_matrix_from_quaternion(turned ? q : none, zero);
}

// How far p is from the middle of a box along one of its axes; of a plane, how far before it.
static double height_along(const struct pel_clip *clip, int axis, const double p[3]) {
    double away[3] = {p[0] - clip->point[0], p[1] - clip->point[1], p[2] - clip->point[2]};
    if (clip->kind == PEL_CLIP_PLANE)
        return pel_dot(clip->normal, away) / pel_length(clip->normal);
    struct pel_matrix rotation = axes_of(clip);
    double column[3] = {rotation.m[0][axis], rotation.m[1][axis], rotation.m[2][axis]};
    return pel_dot(column, away);
}

// How deep inside p is, in the frame of the clip: below 0 it is outside.
static double depth_inside(const struct pel_clip *clip, const double p[3]) {
    if (clip->kind == PEL_CLIP_PLANE)
        return height_along(clip, 0, p);
    double least = INFINITY;
    for (int axis = 0; axis < 3; axis++)
        least = fmin(least, clip->size[axis] / 2 - fabs(height_along(clip, axis, p)));
    return least;
}

// Clip n of those of the scene and the body, and the place at t along the ray in its frame.
static const struct pel_clip *find_clip(double p[3], const struct reference *reference,
                                        const struct reference_path *path,
                                        const struct reference_body *body, int n, double t) {
    bool own = n >= reference->scene->clip_count;
    const struct pel_clip *clip = own ? &body->instance->clips[n - reference->scene->clip_count]
                                      : &reference->scene->clips[n];
    reference_point_at(p, &path->ray, t);
    if (own && !clip->in_world) {
        struct pel_matrix back;
        pel_matrix_invert(&back, &body->instance->transform);
        pel_matrix_point(p, &back, p);
    }
    return clip;
}

bool reference_is_kept(const struct reference *reference, const struct reference_path *path,
                       const struct reference_body *body, double t, double *margin_mm) {
    const struct pel_instance *instance = body->instance;
    double p_world[3];
    reference_point_at(p_world, &path->ray, t);
    bool kept = reference_mask_keeps(reference->scene, instance, p_world, margin_mm);
    for (int n = 0; n < reference->scene->clip_count + instance->clip_count; n++) {
        double p[3];
        const struct pel_clip *clip = find_clip(p, reference, path, body, n, t);
        double depth = depth_inside(clip, p);
        kept = kept && (clip->outside ? depth < 0 : depth >= 0);
        if (margin_mm)
            *margin_mm = fmin(*margin_mm, fabs(depth));
    }
    return kept;
}

int reference_clip_places(double places[REFERENCE_CLIP_PLACES], const struct reference *reference,
                          const struct reference_path *path, const struct reference_body *body) {
    int count = 0, clip_count = reference->scene->clip_count + body->instance->clip_count;
    for (int n = 0; n < clip_count; n++) {
        double start[3], on[3];
        const struct pel_clip *clip = find_clip(start, reference, path, body, n, 0);
        find_clip(on, reference, path, body, n, 1);
        // Along a ray heights are linear.
        for (int axis = 0; axis < (clip->kind == PEL_CLIP_PLANE ? 1 : 3); axis++) {
            double height = height_along(clip, axis, start);
            double speed = height_along(clip, axis, on) - height;
            double end = clip->kind == PEL_CLIP_PLANE ? 0 : clip->size[axis] / 2;
            if (speed == 0)
                continue;
            places[count++] = (-end - height) / speed;
            places[count++] = (end - height) / speed;
        }
    }
    return count;
}
