// clip.c - docs/mixing.md, "Clipping" and "Masks".
#include "reference/clip.h"

#include <math.h>

#include "base/math.h"
#include "reference/mask.h"

// How deep inside p is, in the frame of the clip: below 0 it is outside.
static double depth_inside(const struct pel_clip *clip, const double p[3]) {
    double away[3] = {p[0] - clip->point[0], p[1] - clip->point[1], p[2] - clip->point[2]};
    if (clip->kind == PEL_CLIP_PLANE)
        return pel_dot(clip->normal, away) / pel_length(clip->normal);
    const double *q = clip->xyzw;
    bool turned = q[0] != 0 || q[1] != 0 || q[2] != 0 || q[3] != 0;
    const double none[4] = {0, 0, 0, 1}, zero[3] = {0};
    struct pel_matrix rotation = pel_matrix_from_quaternion(turned ? q : none, zero);
    double least = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double column[3] = {rotation.m[0][axis], rotation.m[1][axis], rotation.m[2][axis]};
        least = fmin(least, clip->size[axis] / 2 - fabs(pel_dot(column, away)));
    }
    return least;
}

bool reference_is_kept(const struct reference *reference, const struct reference_path *path,
                       const struct reference_body *body, double t, double *margin_mm) {
    const struct pel_scene *scene = reference->scene;
    const struct pel_instance *instance = body->instance;
    double p_world[3], p_before[3];
    reference_point_at(p_world, &path->ray, t);
    struct pel_matrix back;
    pel_matrix_invert(&back, &instance->transform);
    pel_matrix_point(p_before, &back, p_world);
    bool kept = reference_mask_keeps(scene, instance, p_world, margin_mm);
    for (int n = 0; n < scene->clip_count + instance->clip_count; n++) {
        bool own = n >= scene->clip_count;
        const struct pel_clip *clip =
            own ? &instance->clips[n - scene->clip_count] : &scene->clips[n];
        double depth = depth_inside(clip, own && !clip->in_world ? p_before : p_world);
        kept = kept && (clip->outside ? depth < 0 : depth >= 0);
        if (margin_mm)
            *margin_mm = fmin(*margin_mm, fabs(depth));
    }
    return kept;
}
