// bakery.c - the hypertextures of a scene, baked before it is rendered.
#include "render/bakery.h"

#include "base/error.h"
#include "volume/hypertexture.h"
#include "world/hypertexture.h"

static struct pel_volume *take(struct pel_bakery *bakery, uint64_t serial) {
    for (int i = 0; i < bakery->count; i++)
        if (bakery->serials[i] == serial)
            return pel_volume_share(bakery->volumes[i]);
    return NULL;
}

static struct pel_volume *bake(struct pel_bakery *bakery, struct pel_device *device,
                               const struct pel_hypertexture *hypertexture) {
    struct pel_volume *volume =
        pel_bake(device, &bakery->kernel, hypertexture->recipe, &hypertexture->options);
    if (volume)
        volume->slope = pel_hypertexture_slope(volume->type);
    return volume;
}

static void forget(struct pel_bakery *bakery) {
    for (int i = 0; i < bakery->count; i++)
        pel_volume_destroy(bakery->volumes[i]);
    bakery->count = 0;
}

bool pel_bakery_show(struct pel_bakery *bakery, struct pel_device *device,
                     const struct pel_scene *scene, struct pel_scene *shown) {
    struct pel_bakery next = {.kernel = bakery->kernel};
    bool good = true;
    *shown = *scene;
    for (int i = 0; good && i < scene->volume_count; i++) {
        const struct pel_volume *volume = scene->volumes[i];
        if (!volume->hypertexture || volume->hypertexture->live)
            continue;
        struct pel_volume *baked = take(bakery, volume->serial);
        if (!baked)
            baked = bake(bakery, device, volume->hypertexture);
        good = baked || pel_fail_in("volume '%s'", volume->name);
        if (!good)
            break;
        next.serials[next.count] = volume->serial;
        next.volumes[next.count++] = shown->volumes[i] = baked;
    }
    next.kernel = bakery->kernel;
    forget(bakery);
    *bakery = next;
    if (!good)
        forget(bakery);
    return good;
}

void pel_bakery_finish(struct pel_bakery *bakery) {
    forget(bakery);
    pel_kernel_destroy(bakery->kernel);
    bakery->kernel = NULL;
}
