// live.c - recipes of volumes without voxels on the device.
//
// Recipes lie in constant memory, and only what changes of them, such as their time, travels. The
// values of the volumes they grow on are sent as floats once, whatever the recipes do.
#include "render/live.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "render/bake.h"
#include "volume/hypertexture.h"

static const struct pel_hypertexture *find_live(const struct pel_scene *scene,
                                                const struct pel_world *world, int number) {
    return scene->volumes[world->live[number]]->hypertexture;
}

// Sends the values of all objects, unless they are there from the last time. Tells recipes where.
static bool send_objects(struct pel_live *live, struct pel_device *device,
                         const struct pel_scene *scene, const struct pel_world *world,
                         struct recipe *recipes) {
    size_t values = 0;
    uint64_t serials[RECIPE_LIVE_MAX] = {0};
    for (int i = 0; i < world->live_count; i++) {
        const struct pel_volume *object = find_live(scene, world, i)->object;
        if (!object)
            continue;
        if (values > UINT32_MAX)
            return pel_fail(PEL_ERROR_DEVICE,
                            "the volumes that recipes grow on have more than %u voxels",
                            UINT32_MAX);
        serials[i] = object->serial;
        recipes[i].object_offset = (u32)values;
        values += pel_volume_voxel_count(object);
    }
    if (live->objects && memcmp(live->serials, serials, sizeof serials) == 0)
        return true;
    pel_buffer_destroy(live->objects);
    live->objects =
        pel_buffer_create(device, values * sizeof(float), "the volumes that recipes grow on");
    bool good = live->objects != NULL;
    for (int i = 0; good && i < world->live_count; i++)
        if (serials[i])
            good = pel_bake_send_object(live->objects, recipes[i].object_offset,
                                        find_live(scene, world, i)->object, &recipes[i]);
    memcpy(live->serials, serials, sizeof serials);
    if (good)
        return true;
    pel_buffer_destroy(live->objects);
    live->objects = NULL;
    return false;
}

bool pel_live_update(struct pel_live *live, struct pel_device *device,
                     const struct pel_scene *scene, const struct pel_world *world) {
    if (world->live_count == 0)
        return true;
    struct recipe *recipes = pel_allocate((size_t)world->live_count, sizeof *recipes);
    if (!recipes)
        return false;
    for (int i = 0; i < world->live_count; i++)
        memcpy(&recipes[i], find_live(scene, world, i)->program, sizeof *recipes);
    bool good = send_objects(live, device, scene, world, recipes) &&
                pel_mirror_update(&live->recipes, device, recipes,
                                  (size_t)world->live_count * sizeof *recipes, 0, "recipes", NULL);
    free(recipes);
    return good;
}

void pel_live_finish(struct pel_live *live) {
    pel_mirror_finish(&live->recipes);
    pel_buffer_destroy(live->objects);
    live->objects = NULL;
}
