// clip.c - clip planes and boxes as kernels read them (docs/mixing.md, "Clipping").
#include "world/clip.h"

#include <math.h>

#include "base/error.h"
#include "base/math.h"

static bool is_finite(const double *values, int count) {
    for (int i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

static bool check_clip(const struct pel_clip *clip) {
    if ((unsigned)clip->kind > PEL_CLIP_BOX || !is_finite(clip->point, 3))
        return pel_fail(PEL_ERROR_ARGUMENT, "kind %d at %g %g %g", (int)clip->kind, clip->point[0],
                        clip->point[1], clip->point[2]);
    double normal[3] = {clip->normal[0], clip->normal[1], clip->normal[2]};
    if (clip->kind == PEL_CLIP_PLANE && !pel_normalize(normal))
        return pel_fail(PEL_ERROR_ARGUMENT, "the normal %g %g %g has no direction", normal[0],
                        normal[1], normal[2]);
    const double *size = clip->size;
    if (clip->kind == PEL_CLIP_BOX &&
        !(size[0] > 0 && size[1] > 0 && size[2] > 0 && is_finite(size, 3)))
        return pel_fail(PEL_ERROR_ARGUMENT, "a box of %g x %g x %g mm", size[0], size[1], size[2]);
    if (!is_finite(clip->xyzw, 4))
        return pel_fail(PEL_ERROR_ARGUMENT, "a rotation is not finite");
    return true;
}

static bool check_clips(const struct pel_clip *clips, int count) {
    if (count < 0 || count > PEL_CLIP_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "%d clips, outside 0..%d", count, PEL_CLIP_MAX);
    for (int n = 0; n < count; n++)
        if (!check_clip(&clips[n]))
            return pel_fail_in("clip %d", n);
    return true;
}

bool pel_clip_check(const struct pel_scene *scene) {
    if (!check_clips(scene->clips, scene->clip_count))
        return false;
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        if (!check_clips(instance->clips, instance->clip_count))
            return pel_fail_in("volume '%s'", instance->name);
    }
    return true;
}

// The frame of a clip's coordinates in the world, its middle at `point`.
static struct pel_matrix find_frame(const struct pel_clip *clip, const struct pel_matrix *moved) {
    const double *xyzw = clip->xyzw;
    bool turned = xyzw[0] != 0 || xyzw[1] != 0 || xyzw[2] != 0 || xyzw[3] != 0;
    struct pel_matrix frame =
        pel_matrix_from_quaternion(turned ? xyzw : (const double[]){0, 0, 0, 1}, clip->point);
    return clip->in_world ? frame : pel_matrix_multiply(moved, &frame);
}

static void add_row(struct pel_world *world, const double normal[3], double scale,
                    const struct pel_matrix *frame, const double centre[3]) {
    double offset = 0;
    for (int c = 0; c < 3; c++)
        offset -= scale * normal[c] * (frame->m[c][3] - centre[c]);
    world->bytes.cuts[world->cut_count++] =
        (float4){(float)(scale * normal[0]), (float)(scale * normal[1]), (float)(scale * normal[2]),
                 (float)offset};
}

static void add_clip(struct pel_world *world, const struct pel_clip *clip,
                     const struct pel_matrix *moved, const double centre[3]) {
    struct pel_matrix frame = find_frame(clip, moved);
    if (clip->kind == PEL_CLIP_PLANE) {
        double normal[3] = {clip->normal[0], clip->normal[1], clip->normal[2]};
        if (!clip->in_world)
            pel_matrix_direction(normal, moved, normal);
        pel_normalize(normal);
        add_row(world, normal, clip->outside ? -1 : 1, &frame, centre);
        return;
    }
    for (int axis = 0; axis < 3; axis++) {
        double along[3] = {frame.m[0][axis], frame.m[1][axis], frame.m[2][axis]};
        add_row(world, along, 2 / clip->size[axis], &frame, centre);
    }
}

// One kind after the other, in the order in which kernels look for them.
enum kind { PLANES, BOXES, HOLES, KINDS };

static enum kind kind_of(const struct pel_clip *clip) {
    return clip->kind == PEL_CLIP_PLANE ? PLANES : clip->outside ? HOLES : BOXES;
}

void pel_clip_fill_part(struct pel_world *world, struct part *part, const struct pel_scene *scene,
                        const struct pel_instance *instance, const double centre[3]) {
    struct pel_matrix still = pel_matrix_identity();
    int counts[KINDS] = {0};
    part->cuts = world->cut_count;
    for (enum kind kind = PLANES; kind < KINDS; kind++) {
        for (int n = 0; n < scene->clip_count + instance->clip_count; n++) {
            bool own = n >= scene->clip_count;
            const struct pel_clip *clip =
                own ? &instance->clips[n - scene->clip_count] : &scene->clips[n];
            if (kind_of(clip) != kind)
                continue;
            add_clip(world, clip, own ? &instance->transform : &still, centre);
            counts[kind]++;
        }
    }
    part->plane_count = counts[PLANES];
    part->box_count = counts[BOXES];
    part->hole_count = counts[HOLES];
    world->clipped |= counts[PLANES] + counts[BOXES] + counts[HOLES] > 0;
}
