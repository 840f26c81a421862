// bakery.h - the hypertextures of a scene, baked before it is rendered.
#ifndef PEL_RENDER_BAKERY_H
#define PEL_RENDER_BAKERY_H

#include "pellucid.h"
#include "render/bake.h"

// Baked volumes, kept from frame to frame. Zero-initialise.
struct pel_bakery {
    struct pel_kernel *kernel; // of pel_bake
    int count;
    uint64_t serials[PEL_VOLUME_MAX]; // of the volumes they stand for
    struct pel_volume *volumes[PEL_VOLUME_MAX];
};

// Fills *shown with the scene, in which baked volumes stand in for hypertextures that are to be
// baked; it borrows everything. Those that the scene no longer has are forgotten. False as
// pel_renderer_bake fails.
bool pel_bakery_show(struct pel_bakery *bakery, struct pel_device *device,
                     const struct pel_scene *scene, struct pel_scene *shown);
void pel_bakery_finish(struct pel_bakery *bakery);

#endif
