// hypertexture.h - inside the library: what a volume without voxels is worked out from.
#ifndef PEL_VOLUME_HYPERTEXTURE_H
#define PEL_VOLUME_HYPERTEXTURE_H

#include "pellucid.h"

struct pel_hypertexture {
    bool live;     // worked out at every sample; otherwise baked before the first picture
    char *recipe;  // owned; as pel_renderer_bake takes it
    void *program; // owned; a struct recipe, placed and seeded
    struct pel_volume *object;       // shared; NULL: there is none
    struct pel_bake_options options; // of baking; its object is the one above
};

void pel_hypertexture_destroy(struct pel_hypertexture *hypertexture);

#endif
