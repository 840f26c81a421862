// scenes.c - small scenes made in C, with volumes whose content is known in closed form.
#include "support/scenes.h"

#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "base/quaternion.h"
#include "support/test.h"

static void *allocate(size_t count, size_t bytes) {
    void *memory = calloc(count, bytes);
    if (!memory)
        abort();
    return memory;
}

// ---- Scenes ------------------------------------------------------------------------------------

struct pel_scene *scene_create(int width, int height) {
    struct pel_scene *scene = allocate(1, sizeof *scene);
    scene->camera = (struct pel_camera){
        .eye = {0, 0, 100},
        .up = {0, 1, 0},
        .fov_deg = 2 * atan(0.2) * 180 / PEL_PI,
        .height_mm = 40,
    };
    scene->render = (struct pel_render_settings){
        .width = width,
        .height = height,
        .step = 0.5,
        .phase = 0.5,
        .termination = 1,
    };
    return scene;
}

struct pel_instance *scene_add_again(struct pel_scene *scene, int volume,
                                     struct pel_transfer *transfer) {
    struct pel_instance *instance = &scene->instances[scene->instance_count++];
    *instance = (struct pel_instance){
        .volume = volume,
        .transform = pel_matrix_identity(),
        .density = 1,
        .transfer = transfer,
    };
    snprintf(instance->name, sizeof instance->name, "instance %d", scene->instance_count - 1);
    return instance;
}

struct pel_instance *scene_add(struct pel_scene *scene, struct pel_volume *volume,
                               struct pel_transfer *transfer) {
    pel_volume_measure(volume, &scene->statistics[scene->volume_count]);
    scene->volumes[scene->volume_count++] = volume;
    return scene_add_again(scene, scene->volume_count - 1, transfer);
}

void scene_view_parallel(struct pel_scene *scene, double height_mm) {
    scene->camera.orthographic = true;
    scene->camera.height_mm = height_mm;
}

// Moves clips that are in the world; the others go with their volumes.
static void move_clips(struct pel_clip *clips, int count, bool all,
                       const struct pel_matrix *transform) {
    for (int n = 0; n < count; n++) {
        struct pel_clip *clip = &clips[n];
        if (!all && !clip->in_world)
            continue;
        bool turned =
            clip->xyzw[0] != 0 || clip->xyzw[1] != 0 || clip->xyzw[2] != 0 || clip->xyzw[3] != 0;
        struct pel_matrix frame = pel_matrix_from_quaternion(
            turned ? clip->xyzw : (const double[]){0, 0, 0, 1}, clip->point);
        frame = pel_matrix_multiply(transform, &frame);
        pel_quaternion_from_matrix(clip->xyzw, &frame);
        pel_matrix_point(clip->point, transform, clip->point);
        pel_matrix_direction(clip->normal, transform, clip->normal);
    }
}

void scene_move(struct pel_scene *scene, const struct pel_matrix *transform) {
    struct pel_camera *camera = &scene->camera;
    pel_matrix_point(camera->eye, transform, camera->eye);
    pel_matrix_point(camera->target, transform, camera->target);
    pel_matrix_direction(camera->up, transform, camera->up);
    for (int n = 0; n < scene->light_count; n++) {
        struct pel_light *light = &scene->lights[n];
        pel_matrix_direction(light->direction, transform, light->direction);
        pel_matrix_point(light->position, transform, light->position);
    }
    for (int k = 0; k < scene->instance_count; k++) {
        struct pel_matrix *own = &scene->instances[k].transform;
        *own = pel_matrix_multiply(transform, own);
        move_clips(scene->instances[k].clips, scene->instances[k].clip_count, false, transform);
    }
    move_clips(scene->clips, scene->clip_count, true, transform);
}

void scene_permute(struct pel_scene *scene, const int order[]) {
    struct pel_instance old[PEL_VOLUME_MAX];
    int places[PEL_VOLUME_MAX];
    memcpy(old, scene->instances, sizeof old);
    for (int k = 0; k < scene->instance_count; k++)
        places[order[k]] = k;
    for (int k = 0; k < scene->instance_count; k++) {
        scene->instances[k] = old[order[k]];
        struct pel_mask *mask = &scene->instances[k].mask;
        if (mask->range_count > 0)
            mask->instance = places[mask->instance];
    }
}

bool scene_is_small(void) {
    return getenv("PELLUCID_TEST_SMALL") != NULL;
}

// ---- Volumes -----------------------------------------------------------------------------------

void scene_raw_range(enum pel_voxel_type type, double range[2]) {
    static const double ranges[][2] = {
        [PEL_VOXEL_U8] = {0, 255},     [PEL_VOXEL_I8] = {-100, 100},
        [PEL_VOXEL_U16] = {0, 40000},  [PEL_VOXEL_I16] = {-1000, 3000},
        [PEL_VOXEL_F32] = {-1.5, 2.5}, [PEL_VOXEL_RGB8] = {0, 255},
        [PEL_VOXEL_RGBA8] = {0, 255},
    };
    range[0] = ranges[type][0];
    range[1] = ranges[type][1];
}

static double whole(double value, double low, double high) {
    return fmin(fmax(floor(value + 0.5), low), high);
}

static void write_voxel(struct pel_volume *volume, size_t index, double raw) {
    uint8_t *bytes = volume->voxels;
    switch (volume->type) {
    case PEL_VOXEL_U8:
        bytes[index] = (uint8_t)whole(raw, 0, 255);
        break;
    case PEL_VOXEL_I8:
        ((int8_t *)volume->voxels)[index] = (int8_t)whole(raw, -128, 127);
        break;
    case PEL_VOXEL_U16:
        ((uint16_t *)volume->voxels)[index] = (uint16_t)whole(raw, 0, 65535);
        break;
    case PEL_VOXEL_I16:
        ((int16_t *)volume->voxels)[index] = (int16_t)whole(raw, -32768, 32767);
        break;
    case PEL_VOXEL_F32:
        ((float *)volume->voxels)[index] = (float)raw;
        break;
    case PEL_VOXEL_RGB8:
        bytes[3 * index] = (uint8_t)whole(raw, 0, 255);
        bytes[3 * index + 1] = (uint8_t)whole(255 - raw, 0, 255);
        bytes[3 * index + 2] = (uint8_t)whole(raw / 2 + 60, 0, 255);
        break;
    case PEL_VOXEL_RGBA8:
        bytes[4 * index] = (uint8_t)whole(255 - raw, 0, 255);
        bytes[4 * index + 1] = (uint8_t)whole(raw / 2 + 60, 0, 255);
        bytes[4 * index + 2] = (uint8_t)whole(raw, 0, 255);
        bytes[4 * index + 3] = (uint8_t)whole(raw, 0, 255);
        break;
    }
}

struct pel_volume *scene_volume(const int dims[3], enum pel_voxel_type type, scene_field field,
                                const void *user) {
    struct pel_volume *volume = pel_volume_create("field", dims, type);
    if (!volume)
        abort();
    size_t index = 0;
    for (int k = 0; k < dims[2]; k++)
        for (int j = 0; j < dims[1]; j++)
            for (int i = 0; i < dims[0]; i++)
                write_voxel(volume, index++, field((double[]){i, j, k}, user));
    scene_place(volume, (double[]){1, 1, 1}, (double[]){0, 0, 0, 1}, (double[]){0, 0, 0}, false);
    return volume;
}

static double constant_field(const double p_voxel[3], const void *user) {
    (void)p_voxel;
    return *(const double *)user;
}

struct pel_volume *scene_volume_constant(const int dims[3], enum pel_voxel_type type, double raw) {
    return scene_volume(dims, type, constant_field, &raw);
}

struct ramp {
    double first, slope;
};

static double ramp_field(const double p_voxel[3], const void *user) {
    const struct ramp *ramp = user;
    return ramp->first + ramp->slope * p_voxel[2];
}

struct pel_volume *scene_volume_ramp(const int dims[3], enum pel_voxel_type type,
                                     const double ends[2]) {
    struct ramp ramp = {ends[0], dims[2] > 1 ? (ends[1] - ends[0]) / (dims[2] - 1) : 0};
    return scene_volume(dims, type, ramp_field, &ramp);
}

enum { WAVE_COUNT = 7 };

struct waves {
    double middle, amplitude; // of their sum
    double frequency[WAVE_COUNT][3], phase[WAVE_COUNT];
};

static double waves_field(const double p_voxel[3], const void *user) {
    const struct waves *waves = user;
    double sum = 0;
    for (int n = 0; n < WAVE_COUNT; n++)
        sum += sin(pel_dot(waves->frequency[n], p_voxel) + waves->phase[n]);
    // Seven waves seldom add up to more than four.
    return waves->middle + waves->amplitude * fmax(-1, fmin(1, sum / 4));
}

struct pel_volume *scene_volume_waves(const int dims[3], enum pel_voxel_type type, uint64_t seed,
                                      double wavelength) {
    double range[2];
    scene_raw_range(type, range);
    struct waves waves = {
        .middle = (range[0] + range[1]) / 2,
        .amplitude = (range[1] - range[0]) / 2,
    };
    for (int n = 0; n < WAVE_COUNT; n++) {
        waves.phase[n] = 2 * PEL_PI * test_random(&seed);
        for (int c = 0; c < 3; c++)
            waves.frequency[n][c] =
                2 * PEL_PI / wavelength * (2 * test_random(&seed) - 1) / sqrt(3);
    }
    return scene_volume(dims, type, waves_field, &waves);
}

void scene_place(struct pel_volume *volume, const double spacing_mm[3], const double xyzw[4],
                 const double middle[3], bool mirrored) {
    struct pel_matrix centre = pel_matrix_identity();
    for (int c = 0; c < 3; c++)
        centre.m[c][3] = -(volume->dims[c] - 1) / 2.0;
    struct pel_matrix scale = pel_matrix_scaling(
        (double[]){mirrored ? -spacing_mm[0] : spacing_mm[0], spacing_mm[1], spacing_mm[2]});
    struct pel_matrix pose = pel_matrix_from_quaternion(xyzw, middle);
    struct pel_matrix scaled = pel_matrix_multiply(&scale, &centre);
    volume->world_from_voxel = pel_matrix_multiply(&pose, &scaled);
}

// ---- Scenes of waves ---------------------------------------------------------------------------

struct pel_scene *scene_tall(int width, int height) {
    struct pel_scene *scene = scene_create(width, height);
    struct pel_volume *volume = scene_volume_waves((int[]){9, 8, 24}, PEL_VOXEL_U8, 5, 8);
    scene_place(volume, (double[]){2, 2, 1.2}, (double[]){0.6, 0, 0, 0.8}, (double[]){0, 0, 0},
                false);
    scene_add(scene, volume, scene_transfer_gentle((double[]){0, 255}, 0.2, 3));
    return scene;
}

struct pel_scene *scene_waves(int width, int height) {
    struct pel_scene *scene = scene_create(width, height);
    double range[2];
    scene_raw_range(PEL_VOXEL_U8, range);
    scene_add(scene, scene_volume_waves((int[]){9, 8, 7}, PEL_VOXEL_U8, 3, 10),
              scene_transfer_gentle(range, 0.3, 5));
    return scene;
}

struct pel_scene *scene_stereo(enum pel_stereo_kind kind) {
    bool small = scene_is_small();
    struct pel_scene *scene = small ? scene_create(16, 12) : scene_create(64, 48);
    int size = small ? 8 : 16;
    double range[2];
    scene_raw_range(PEL_VOXEL_U8, range);
    scene_add(scene, scene_volume_waves((int[]){size, size, size}, PEL_VOXEL_U8, 7, 10),
              scene_transfer_gentle(range, 0.2, 7));
    scene->background[3] = 1;
    scene->stereo.kind = kind;
    return scene;
}

void scene_add_crossing(struct pel_scene *scene) {
    bool small = scene_is_small();
    for (int k = 0; k < 2; k++) {
        int dims[3] = {small ? 9 : 17, small ? 8 : 16, small ? 10 : 20};
        struct pel_volume *volume =
            scene_volume_waves(dims, PEL_VOXEL_U8, (uint64_t)(3 + k), small ? 7 : 13);
        scene_place(volume, (double[]){17.0 / dims[0], 16.0 / dims[1], 18.0 / dims[2]},
                    (double[]){0.1 * k, 0.2, -0.1, 1}, (double[]){k, -k, 0}, k);
        scene_add(scene, volume, scene_transfer_gentle((double[]){0, 255}, 0.3, (uint64_t)k))
            ->transform = pel_matrix_from_quaternion((double[]){0.2 - 0.3 * k, 0.1, 0.3, 1},
                                                     (double[]){-2 + 2 * k, 1 - k, 0.5});
    }
}

// ---- Transfer functions ------------------------------------------------------------------------

struct pel_transfer *scene_transfer(const double (*points)[5], int count) {
    struct pel_transfer *transfer = allocate(1, sizeof *transfer);
    *transfer = (struct pel_transfer){
        .colours = allocate((size_t)count, sizeof *transfer->colours),
        .opacities = allocate((size_t)count, sizeof *transfer->opacities),
        .colour_count = count,
        .opacity_count = count,
        .opacity_unit_mm = 1,
    };
    for (int i = 0; i < count; i++) {
        transfer->colours[i] =
            (struct pel_colour_point){points[i][0], {points[i][1], points[i][2], points[i][3]}};
        transfer->opacities[i] = (struct pel_opacity_point){points[i][0], points[i][4]};
    }
    return transfer;
}

struct pel_transfer *scene_transfer_constant(const double rgba[4]) {
    return scene_transfer((const double[][5]){{0, rgba[0], rgba[1], rgba[2], rgba[3]}}, 1);
}

struct pel_transfer *scene_transfer_gentle(const double range[2], double opacity, uint64_t seed) {
    enum { POINTS = 6 };
    double points[POINTS][5];
    for (int i = 0; i < POINTS; i++) {
        points[i][0] = range[0] + (range[1] - range[0]) * i / (POINTS - 1);
        for (int c = 0; c < 3; c++)
            points[i][1 + c] = test_random(&seed);
        points[i][4] = opacity * test_random(&seed);
    }
    return scene_transfer((const double(*)[5])points, POINTS);
}
