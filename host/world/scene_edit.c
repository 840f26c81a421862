// scene_edit.c - scenes made and changed by a program: volumes come, go and move.
//
// A failed change leaves the scene as it was: what can fail is done first. Instances name their
// volume by index, so taking out a volume renumbers them.
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "world/scene.h"
#include "world/scene_plan.h"

// Directions and the centre of voxel (0,0,0) stay, the distances between voxels are replaced.
static void replace_spacing(struct pel_volume *volume, const double spacing_mm[3]) {
    double old_mm[3];
    pel_volume_spacing(volume, old_mm);
    for (int row = 0; row < 3; row++)
        for (int axis = 0; axis < 3; axis++)
            volume->world_from_voxel.m[row][axis] *= spacing_mm[axis] / old_mm[axis];
}

struct pel_volume *pel_volume_source_open(const struct pel_volume_source *source) {
    if (source->recipe) {
        const struct pel_bake_options options = {.size = source->hypertexture.size,
                                                 .type = source->hypertexture.type,
                                                 .seed = source->hypertexture.seed,
                                                 .time = source->hypertexture.time,
                                                 .wrap = source->hypertexture.wrap,
                                                 .object = source->object};
        return pel_volume_hypertexture(source->recipe, &options, source->hypertexture.live);
    }
    if (!source->file && !source->kind) {
        pel_fail(PEL_ERROR_ARGUMENT, "the volume came from the program, not from a file");
        return NULL;
    }
    struct pel_volume *volume = source->file ? pel_volume_load(source->file, &source->load)
                                             : pel_volume_generate(source->kind, &source->generate);
    if (volume && source->spacing[0] > 0)
        replace_spacing(volume, source->spacing);
    return volume;
}

static bool check_instance(const struct pel_scene *scene, int instance) {
    return (instance >= 0 && instance < scene->instance_count) ||
           pel_fail(PEL_ERROR_ARGUMENT, "there is no volume %d among %d", instance,
                    scene->instance_count);
}

static bool check_room(const struct pel_scene *scene) {
    return (scene->instance_count < PEL_VOLUME_MAX && scene->volume_count < PEL_VOLUME_MAX) ||
           pel_fail(PEL_ERROR_ARGUMENT, "there are %d volumes already", PEL_VOLUME_MAX);
}

// A camera that nobody has set has its eye in its target.
static bool fit_first_view(struct pel_scene *scene) {
    struct pel_camera *camera = &scene->camera;
    struct pel_bounds bounds;
    if (memcmp(camera->eye, camera->target, sizeof camera->eye) != 0 ||
        !pel_scene_bounds(scene, &bounds))
        return true;
    double aspect = (double)scene->render.width / scene->render.height;
    return pel_camera_fit(camera, "oblique", &bounds, aspect);
}

// Takes a volume that no instance shows out of the scene.
static void drop_volume(struct pel_scene *scene, int volume) {
    pel_volume_destroy(scene->volumes[volume]);
    pel_volume_source_finish(&scene->sources[volume]);
    scene->volume_count--;
    for (int i = volume; i < scene->volume_count; i++) {
        scene->volumes[i] = scene->volumes[i + 1];
        scene->statistics[i] = scene->statistics[i + 1];
        scene->sources[i] = scene->sources[i + 1];
    }
    scene->volumes[scene->volume_count] = NULL;
    scene->sources[scene->volume_count] = (struct pel_volume_source){0};
    for (int i = 0; i < scene->instance_count; i++)
        scene->instances[i].volume -= scene->instances[i].volume > volume;
}

static bool is_shown(const struct pel_scene *scene, int volume) {
    for (int i = 0; i < scene->instance_count; i++)
        if (scene->instances[i].volume == volume)
            return true;
    return false;
}

int pel_scene_add_volume(struct pel_scene *scene, struct pel_volume *volume,
                         const struct pel_volume_source *source) {
    if (!check_room(scene))
        return -1;
    int index = scene->volume_count;
    struct pel_instance instance = pel_instance_default();
    if (source && !pel_volume_source_copy(&scene->sources[index], source))
        return -1;
    pel_volume_measure(volume, &scene->statistics[index]);
    instance.transfer = pel_scene_auto_transfer(volume, &scene->statistics[index], NULL);
    if (!instance.transfer) {
        pel_volume_source_finish(&scene->sources[index]);
        return -1;
    }
    pel_transfer_resolve(instance.transfer, &scene->statistics[index]);
    if (volume->labels)
        instance.filter = PEL_FILTER_NEAREST;
    pel_instance_set_name(&instance, volume->name);
    instance.volume = index;
    scene->volumes[scene->volume_count++] = pel_volume_share(volume);
    scene->instances[scene->instance_count++] = instance;
    if (fit_first_view(scene))
        return scene->instance_count - 1;
    scene->instance_count--;
    pel_instance_finish(&instance);
    drop_volume(scene, index);
    return -1;
}

int pel_scene_add_file(struct pel_scene *scene, const char *path,
                       const struct pel_load_options *options) {
    if (!check_room(scene))
        return -1;
    struct pel_volume_source source = {0};
    if (options)
        source.load = *options;
    struct pel_volume *volume = pel_volume_load(path, options);
    source.file = volume ? pel_copy_text(path) : NULL;
    int instance = source.file ? pel_scene_add_volume(scene, volume, &source) : -1;
    free(source.file);
    pel_volume_destroy(volume);
    return instance;
}

int pel_scene_add_copy(struct pel_scene *scene, int instance) {
    if (!check_instance(scene, instance) || !check_room(scene))
        return -1;
    struct pel_instance copy;
    if (!pel_instance_copy(&copy, &scene->instances[instance]))
        return -1;
    scene->instances[scene->instance_count++] = copy;
    return scene->instance_count - 1;
}

// Lets masks follow their volumes to new places in the list; one whose volume is gone (-1) is none.
static void renumber_masks(struct pel_scene *scene, const int places[PEL_VOLUME_MAX]) {
    for (int i = 0; i < scene->instance_count; i++) {
        struct pel_mask *mask = &scene->instances[i].mask;
        if (mask->range_count == 0)
            continue;
        mask->instance = places[mask->instance];
        if (mask->instance < 0)
            *mask = (struct pel_mask){0};
    }
}

bool pel_scene_remove(struct pel_scene *scene, int instance) {
    if (!check_instance(scene, instance))
        return false;
    if (scene->instance_count == 1)
        return pel_fail(PEL_ERROR_ARGUMENT, "the last volume cannot be removed");
    int volume = scene->instances[instance].volume, places[PEL_VOLUME_MAX];
    for (int i = 0; i < scene->instance_count; i++)
        places[i] = i == instance ? -1 : i - (i > instance);
    pel_instance_finish(&scene->instances[instance]);
    scene->instance_count--;
    for (int i = instance; i < scene->instance_count; i++)
        scene->instances[i] = scene->instances[i + 1];
    renumber_masks(scene, places);
    if (!is_shown(scene, volume))
        drop_volume(scene, volume);
    return true;
}

bool pel_scene_move(struct pel_scene *scene, int instance, int to) {
    if (!check_instance(scene, instance) || !check_instance(scene, to))
        return false;
    struct pel_instance moved = scene->instances[instance];
    int step = to > instance ? 1 : -1, places[PEL_VOLUME_MAX];
    for (int i = 0; i < scene->instance_count; i++)
        places[i] = i;
    for (int i = instance; i != to; i += step) {
        scene->instances[i] = scene->instances[i + step];
        places[i + step] = i;
    }
    scene->instances[to] = moved;
    places[instance] = to;
    renumber_masks(scene, places);
    return true;
}

bool pel_scene_reload(struct pel_scene *scene, int volume) {
    if (volume < 0 || volume >= scene->volume_count)
        return pel_fail(PEL_ERROR_ARGUMENT, "there is no volume %d among %d", volume,
                        scene->volume_count);
    struct pel_volume *fresh = pel_volume_source_open(&scene->sources[volume]);
    if (!fresh)
        return false;
    pel_volume_destroy(scene->volumes[volume]);
    scene->volumes[volume] = fresh;
    pel_volume_measure(fresh, &scene->statistics[volume]);
    return true;
}
