// detail.c - the levels of detail of a scene's volumes, made before it is rendered.
//
// A level is a volume like any other, so what is sent to the device, what is skipped, and steps
// that count voxels follow it by themselves.
#include "render/detail.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "render/settings.h"
#include "volume/level.h"
#include "world/detail.h"

static void forget_others(struct pel_detail *detail, const struct pel_scene *scene) {
    int kept = 0;
    for (int i = 0; i < detail->count; i++) {
        bool needed = false;
        for (int v = 0; v < scene->volume_count; v++)
            needed |= scene->volumes[v]->serial == detail->made[i].serial;
        if (needed)
            detail->made[kept++] = detail->made[i];
        else
            pel_volume_destroy(detail->made[i].volume);
    }
    detail->count = kept;
}

// The level of a volume, made if there is none yet.
static struct pel_volume *take(struct pel_detail *detail, const struct pel_volume *source,
                               int level) {
    for (int i = 0; i < detail->count; i++)
        if (detail->made[i].serial == source->serial && detail->made[i].level == level)
            return detail->made[i].volume;
    struct pel_volume *volume = pel_volume_level(source, level);
    if (!volume) {
        pel_fail_in("volume '%s'", source->name);
        return NULL;
    }
    detail->made[detail->count].serial = source->serial;
    detail->made[detail->count].level = level;
    detail->made[detail->count++].volume = volume;
    return volume;
}

// The place of a volume in the scene's list, where it is put unless it is there.
static int place(struct pel_scene *shown, struct pel_volume *volume,
                 const struct pel_statistics *statistics) {
    for (int v = 0; v < shown->volume_count; v++)
        if (shown->volumes[v] == volume)
            return v;
    shown->volumes[shown->volume_count] = volume;
    shown->statistics[shown->volume_count] = *statistics;
    return shown->volume_count++;
}

// There are no more volumes than instances in the new list, so that it cannot overflow.
static bool replace(struct pel_detail *detail, const struct pel_scene *scene,
                    const struct pel_camera *second, struct pel_scene *shown) {
    shown->volume_count = 0;
    for (int k = 0; k < scene->instance_count; k++) {
        int v = scene->instances[k].volume, level = pel_detail_level(scene, second, k);
        struct pel_volume *volume = scene->volumes[v];
        if (level > 0)
            volume = take(detail, volume, level);
        if (!volume)
            return false;
        shown->instances[k].volume = place(shown, volume, &scene->statistics[v]);
        detail->statistics.levels[k] = level;
    }
    return true;
}

bool pel_detail_show(struct pel_detail *detail, struct pel_scene *shown,
                     const struct pel_camera *second) {
    memset(&detail->statistics, 0, sizeof detail->statistics);
    if (shown->render.lod == PEL_LOD_OFF) {
        pel_detail_finish(detail);
        return true;
    }
    // A level follows the camera and the picture's size, which nobody has looked at yet.
    if (!pel_settings_check(shown))
        return false;
    double start_ms = pel_clock_ms();
    struct pel_scene *scene = pel_allocate(1, sizeof *scene);
    if (!scene)
        return false;
    *scene = *shown;
    forget_others(detail, scene);
    bool good = replace(detail, scene, second, shown);
    free(scene);
    for (int v = 0; good && v < shown->volume_count; v++)
        detail->statistics.bytes += pel_volume_bytes(shown->volumes[v]);
    detail->statistics.ms = pel_clock_ms() - start_ms;
    return good;
}

void pel_detail_finish(struct pel_detail *detail) {
    for (int i = 0; i < detail->count; i++)
        pel_volume_destroy(detail->made[i].volume);
    detail->count = 0;
}
