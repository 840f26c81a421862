// scene_load.c - the second pass over a scene: loads its volumes, each distinct one once, and
// settles what depends on them.
#include "world/scene_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "transfer/blend.h"
#include "world/hypertexture.h"
#include "world/scene.h"

static bool same_text(const char *a, const char *b) {
    return a == b || (a && b && strcmp(a, b) == 0);
}

static bool same_triple(const double a[3], const double b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// "./a.nii" and "a.nii" are one file.
static bool same_file(const char *a, const char *b) {
    if (same_text(a, b) || !a || !b)
        return same_text(a, b);
    char *real_a = realpath(a, NULL), *real_b = realpath(b, NULL);
    bool same = real_a && same_text(real_a, real_b);
    free(real_a);
    free(real_b);
    return same;
}

static bool same_load_options(const struct pel_load_options *a, const struct pel_load_options *b) {
    return a->time == b->time && a->channel == b->channel &&
           a->split_channels == b->split_channels && a->labels == b->labels &&
           memcmp(a->raw.dims, b->raw.dims, sizeof a->raw.dims) == 0 &&
           a->raw.type == b->raw.type && same_triple(a->raw.spacing, b->raw.spacing) &&
           same_triple(a->raw.origin, b->raw.origin) && a->raw.offset == b->raw.offset &&
           a->raw.big_endian == b->raw.big_endian;
}

static bool same_hypertexture(const struct pel_volume_source *a,
                              const struct pel_volume_source *b) {
    return a->hypertexture.size == b->hypertexture.size &&
           a->hypertexture.type == b->hypertexture.type &&
           a->hypertexture.seed == b->hypertexture.seed &&
           a->hypertexture.time == b->hypertexture.time &&
           a->hypertexture.live == b->hypertexture.live &&
           a->hypertexture.wrap == b->hypertexture.wrap;
}

// The scene's volume of the same voxels in the same place, or -1.
static int find_volume(const struct pel_scene *scene, const struct pel_volume_source *wanted) {
    for (int i = 0; scene && i < scene->volume_count; i++) {
        const struct pel_volume_source *source = &scene->sources[i];
        const struct pel_generate_options *a = &source->generate, *b = &wanted->generate;
        if ((source->file || source->kind || source->recipe) &&
            same_text(source->recipe, wanted->recipe) && source->object == wanted->object &&
            same_hypertexture(source, wanted) && same_file(source->file, wanted->file) &&
            same_text(source->kind, wanted->kind) &&
            same_load_options(&source->load, &wanted->load) && a->size == b->size &&
            a->spacing_mm == b->spacing_mm && a->type == b->type && a->second == b->second &&
            same_triple(source->spacing, wanted->spacing))
            return i;
    }
    return -1;
}

// What the plan says of where voxels come from; borrows everything. What a hypertexture grows on is
// there already.
static struct pel_volume_source make_source(const struct pel_scene *scene,
                                            const struct pel_volume_plan *wanted) {
    struct pel_volume_source source = {.file = wanted->file,
                                       .load = wanted->load,
                                       .kind = wanted->kind,
                                       .generate = wanted->generate};
    memcpy(source.spacing, wanted->spacing, sizeof source.spacing);
    if (!wanted->recipe)
        return source;
    source.recipe = wanted->recipe;
    source.hypertexture.size = wanted->bake.size;
    source.hypertexture.type = wanted->bake.type;
    source.hypertexture.seed = wanted->bake.seed;
    source.hypertexture.time = wanted->bake.time;
    source.hypertexture.live = wanted->live;
    source.hypertexture.wrap = wanted->bake.wrap;
    if (wanted->object >= 0)
        source.object = scene->volumes[scene->instances[wanted->object].volume];
    return source;
}

// Loads the volume of one instance, or finds it among those already here or in the scene before.
static bool load_volume(struct pel_scene *scene, struct pel_scene_plan *plan, int instance,
                        const struct pel_scene *before) {
    struct pel_volume_plan *wanted = &plan->volume[instance];
    struct pel_volume_source source = make_source(scene, wanted);
    int *index = &scene->instances[instance].volume;
    *index = find_volume(scene, &source);
    if (*index >= 0)
        return true;
    int kept = find_volume(before, &source);
    struct pel_volume *volume =
        kept < 0 ? pel_volume_source_open(&source) : pel_volume_share(before->volumes[kept]);
    if (!volume)
        return pel_node_fail_in(&wanted->node);
    *index = scene->volume_count++;
    scene->volumes[*index] = volume;
    if (!pel_volume_source_copy(&scene->sources[*index], &source))
        return false;
    if (kept < 0)
        pel_volume_measure(volume, &scene->statistics[*index]);
    else
        scene->statistics[*index] = before->statistics[kept];
    return true;
}

// Moves the instance's transfer function on its way to another one.
static bool blend_transfer(struct pel_instance *instance, struct pel_volume_plan *plan,
                           const struct pel_statistics *statistics) {
    if (!plan->towards)
        return true;
    pel_transfer_resolve(plan->towards, statistics);
    struct pel_transfer *mixed =
        pel_transfer_blend(instance->transfer, plan->towards, plan->towards_share);
    if (!mixed)
        return false;
    pel_transfer_destroy(instance->transfer);
    instance->transfer = mixed;
    return true;
}

static bool settle_transfer(struct pel_scene *scene, struct pel_scene_plan *plan, int index) {
    struct pel_instance *instance = &scene->instances[index];
    struct pel_volume_plan *wanted = &plan->volume[index];
    const struct pel_volume *volume = scene->volumes[instance->volume];
    const struct pel_statistics *statistics = &scene->statistics[instance->volume];
    if (!instance->transfer) {
        instance->transfer = pel_scene_auto_transfer(volume, statistics, wanted->palette);
        if (!instance->transfer)
            return pel_node_fail_in(&wanted->node);
    }
    pel_transfer_resolve(instance->transfer, statistics);
    if (!blend_transfer(instance, wanted, statistics))
        return pel_node_fail_in(&wanted->node);
    if (wanted->opacity_unit_mm > 0)
        instance->transfer->opacity_unit_mm = wanted->opacity_unit_mm;
    if (volume->labels && !wanted->filter_given)
        instance->filter = PEL_FILTER_NEAREST;
    return true;
}

static bool settle_pose(struct pel_scene *scene, struct pel_scene_plan *plan, int index) {
    struct pel_instance *instance = &scene->instances[index];
    const struct pel_volume *volume = scene->volumes[instance->volume];
    const struct pel_volume_plan *wanted = &plan->volume[index];
    const struct pel_pose_plan *pose = &wanted->pose;
    if (pose->file) {
        const struct pel_volume *fixed =
            pose->fixed < 0 ? NULL : scene->volumes[scene->instances[pose->fixed].volume];
        if (pel_transform_load(&instance->transform, pose->file, volume, fixed))
            return true;
        struct pel_scene_node node;
        pel_node_member(&node, &wanted->node, "transform");
        return pel_node_fail_in(&node);
    }
    double about[3] = {pose->about[0], pose->about[1], pose->about[2]};
    if (pose->about_centre) {
        for (int axis = 0; axis < 3; axis++)
            about[axis] = (volume->dims[axis] - 1) / 2.0;
        pel_matrix_point(about, &volume->world_from_voxel, about);
    }
    // p' = M (p - about) + about = M p + (about - R about)
    double turned[3];
    pel_matrix_direction(turned, &pose->matrix, about);
    instance->transform = pose->matrix;
    for (int axis = 0; axis < 3; axis++)
        instance->transform.m[axis][3] += about[axis] - turned[axis];
    return true;
}

// A file's placement may be anything; devices need one that floats can hold.
static bool check_place(struct pel_scene *scene, struct pel_scene_plan *plan, int index) {
    struct pel_bounds bounds;
    pel_instance_bounds(scene, index, &bounds);
    for (int axis = 0; axis < 3; axis++) {
        double reach = fmax(-bounds.low[axis], bounds.high[axis]);
        if (!(reach <= PEL_COORDINATE_MAX && bounds.low[axis] <= bounds.high[axis]))
            return pel_node_fail(&plan->volume[index].node, "its box reaches to %g mm, beyond %g",
                                 reach, PEL_COORDINATE_MAX);
    }
    return true;
}

// A black picture is right for these scenes, but rarely what was wanted.
static void warn_unseen(const struct pel_scene *scene) {
    int visible = 0;
    for (int i = 0; i < scene->instance_count; i++) {
        const struct pel_instance *instance = &scene->instances[i];
        visible += !instance->hidden;
        if (!instance->hidden && scene->statistics[instance->volume].count == 0)
            pel_warn("%s: every voxel is absent (NaN or Inf), so nothing of it is seen",
                     instance->name);
    }
    if (visible == 0)
        pel_warn("all volumes are hidden, so the picture shows the background alone");
}

bool pel_scene_load_volumes(struct pel_scene *scene, struct pel_scene_plan *plan,
                            const struct pel_scene *before) {
    // Hypertextures last: what they grow on comes first.
    for (int i = 0; i < scene->instance_count; i++)
        if (!plan->volume[i].recipe && !load_volume(scene, plan, i, before))
            return false;
    for (int i = 0; i < scene->instance_count; i++)
        if (plan->volume[i].recipe && !load_volume(scene, plan, i, before))
            return false;
    for (int i = 0; i < scene->instance_count; i++)
        if (!settle_transfer(scene, plan, i) || !settle_pose(scene, plan, i) ||
            !check_place(scene, plan, i))
            return false;
    if (!before)
        warn_unseen(scene);
    return pel_scene_settle_quality(scene, plan);
}
