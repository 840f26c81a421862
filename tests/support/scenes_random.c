// scenes_random.c - random scenes: anything a scene can hold, in any combination.
#include "support/scenes.h"

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "support/test.h"

static double between(uint64_t *seed, double low, double high) {
    return low + (high - low) * test_random(seed);
}

static int below(uint64_t *seed, int count) {
    return (int)(count * test_random(seed));
}

// Not uniform over the rotations, but every one may come.
static void random_quaternion(double xyzw[4], uint64_t *seed) {
    for (int c = 0; c < 4; c++)
        xyzw[c] = between(seed, -1, 1);
    xyzw[3] += 1e-3;
}

static struct pel_volume *random_volume(uint64_t *seed, bool small) {
    int dims[3];
    double spacing[3], xyzw[4], middle[3];
    for (int c = 0; c < 3; c++) {
        dims[c] = small ? 3 + below(seed, 6) : 4 + below(seed, 20);
        middle[c] = between(seed, -7, 7);
    }
    for (int c = 0; c < 3; c++)
        spacing[c] = between(seed, 10, 20) / dims[c];
    // Slices of a single layer exist.
    if (below(seed, 6) == 0)
        dims[below(seed, 3)] = 1;
    random_quaternion(xyzw, seed);

    enum pel_voxel_type type = (enum pel_voxel_type)below(seed, PEL_VOXEL_RGBA8 + 1);
    uint64_t waves_seed = *seed + 1;
    struct pel_volume *volume = scene_volume_waves(dims, type, waves_seed, between(seed, 9, 20));
    scene_place(volume, spacing, xyzw, middle, below(seed, 2));
    if (below(seed, 3) == 0) {
        volume->slope = between(seed, 0.1, 3) * (below(seed, 2) ? 1 : -1);
        volume->intercept = between(seed, -1000, 1000);
    }
    if (type == PEL_VOXEL_F32 && below(seed, 2)) {
        float *voxels = volume->voxels;
        for (int n = 0; n < 5; n++)
            voxels[below(seed, (int)pel_volume_voxel_count(volume))] = NAN;
    }
    return volume;
}

static struct pel_transfer *random_transfer(uint64_t *seed, const struct pel_volume *volume) {
    double raw[2];
    scene_raw_range(volume->type, raw);
    double ends[2] = {volume->slope * raw[0] + volume->intercept,
                      volume->slope * raw[1] + volume->intercept};
    double range[2] = {fmin(ends[0], ends[1]), fmax(ends[0], ends[1])};
    struct pel_transfer *transfer =
        scene_transfer_gentle(range, between(seed, 0.02, 0.25), *seed + 2);
    transfer->opacity_unit_mm = between(seed, 0.5, 2);
    transfer->nearest = below(seed, 4) == 0;
    if (below(seed, 4) == 0)
        transfer->table_entries = 64 + below(seed, 1000);
    return transfer;
}

static void random_instance(struct pel_instance *instance, uint64_t *seed) {
    double xyzw[4], offset[3];
    random_quaternion(xyzw, seed);
    for (int c = 0; c < 3; c++)
        offset[c] = between(seed, -3, 3);
    instance->transform = pel_matrix_from_quaternion(xyzw, offset);
    instance->density = between(seed, 0.3, 1.5);
    instance->extent = below(seed, 2) ? PEL_EXTENT_POINT : PEL_EXTENT_CELL;
    instance->filter = below(seed, 4) ? PEL_FILTER_LINEAR : PEL_FILTER_NEAREST;
    instance->hidden = below(seed, 6) == 0;
}

// Most cameras look on from outside, some stand in the middle of everything.
static void random_camera(struct pel_camera *camera, uint64_t *seed) {
    double distance = below(seed, 6) ? between(seed, 40, 90) : between(seed, 1, 8);
    double direction[3], up[3];
    for (int c = 0; c < 3; c++) {
        direction[c] = between(seed, -1, 1) + 1e-3;
        up[c] = between(seed, -1, 1);
        camera->target[c] = between(seed, -2, 2);
    }
    pel_normalize(direction);
    for (int c = 0; c < 3; c++)
        camera->eye[c] = camera->target[c] + distance * direction[c];
    memcpy(camera->up, up, sizeof up);
    camera->fov_deg = distance < 10 ? between(seed, 60, 120) : 2 * atan(16 / distance) * 57.3;
    camera->orthographic = below(seed, 4) == 0;
    camera->height_mm = between(seed, 25, 40);
    for (int c = 0; c < 2; c++)
        camera->shift[c] = below(seed, 3) ? 0 : between(seed, -0.3, 0.3);
}

static struct pel_clip random_clip(uint64_t *seed) {
    struct pel_clip clip = {.kind = below(seed, 2) ? PEL_CLIP_BOX : PEL_CLIP_PLANE,
                            .outside = below(seed, 2),
                            .in_world = below(seed, 2)};
    for (int c = 0; c < 3; c++) {
        clip.point[c] = between(seed, -5, 5);
        clip.normal[c] = between(seed, -1, 1) + 1e-3;
        clip.size[c] = between(seed, 4, 20);
    }
    random_quaternion(clip.xyzw, seed);
    return clip;
}

// Another volume's values between two of those that there may be.
static struct pel_mask random_mask(uint64_t *seed, const struct pel_scene *scene, int other) {
    const struct pel_volume *volume = scene->volumes[scene->instances[other].volume];
    struct pel_mask mask = {
        .instance = other, .range_count = 1 + below(seed, 2), .inverted = below(seed, 2)};
    double raw[2];
    scene_raw_range(volume->type, raw);
    for (int n = 0; n < mask.range_count; n++) {
        double ends[2];
        for (int i = 0; i < 2; i++)
            ends[i] = volume->slope * between(seed, raw[0], raw[1]) + volume->intercept;
        mask.ranges[n] = (struct pel_value_range){fmin(ends[0], ends[1]), fmax(ends[0], ends[1])};
    }
    return mask;
}

// Clips of volumes and of the scene, and masks that are never masked by what they mask.
static void add_cuts(struct pel_scene *scene, uint64_t *seed) {
    for (int k = 0; k < scene->instance_count; k++) {
        struct pel_instance *instance = &scene->instances[k];
        while (instance->clip_count < 2 && below(seed, 4) == 0)
            instance->clips[instance->clip_count++] = random_clip(seed);
        int behind = scene->instance_count - k - 1;
        if (behind > 0 && below(seed, 3) == 0)
            instance->mask = random_mask(seed, scene, k + 1 + below(seed, behind));
    }
    if (below(seed, 6) == 0)
        scene->clips[scene->clip_count++] = random_clip(seed);
}

struct pel_scene *scene_random(uint64_t seed, bool small) {
    // Seeds that follow each other should not make scenes that do.
    seed *= 0x9e3779b97f4a7c15u;
    struct pel_scene *scene = scene_create(small ? 16 : 48, small ? 12 : 36);
    random_camera(&scene->camera, &seed);

    int count = 1 + below(&seed, 5);
    for (int k = 0; k < count; k++) {
        struct pel_instance *instance;
        if (k > 0 && below(&seed, 4) == 0) {
            int volume = below(&seed, scene->volume_count);
            instance =
                scene_add_again(scene, volume, random_transfer(&seed, scene->volumes[volume]));
        } else {
            struct pel_volume *volume = random_volume(&seed, small);
            instance = scene_add(scene, volume, random_transfer(&seed, volume));
        }
        random_instance(instance, &seed);
    }

    for (int c = 0; c < 4; c++)
        scene->background[c] = below(&seed, 2) ? 0 : test_random(&seed);
    scene->render.mixing = (enum pel_mixing)below(&seed, PEL_MIX_DIFFERENCE + 1);
    scene->render.origin = below(&seed, 3) ? PEL_ORIGIN_VOLUMES : PEL_ORIGIN_BOUNDS;
    scene->render.step = between(&seed, small ? 0.7 : 0.3, 1.2);
    scene->render.phase = below(&seed, 2) ? 0.5 : between(&seed, 0, 1);
    scene->render.termination = below(&seed, 2) ? 1 : between(&seed, 0.6, 0.99);
    for (int k = 0; k < count; k++) {
        scene->instances[k].priority = below(&seed, 3);
        scene->instances[k].step = below(&seed, 4) ? 0 : between(&seed, 0.7, 1.5);
    }
    add_cuts(scene, &seed);
    if (scene->render.mixing != PEL_MIX_ORDERED && below(&seed, 3) == 0)
        scene->render.adaptive_step = between(&seed, 0.02, 0.3);
    return scene;
}
