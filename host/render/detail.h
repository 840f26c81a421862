// detail.h - the levels of detail of a scene's volumes, made before it is rendered.
#ifndef PEL_RENDER_DETAIL_H
#define PEL_RENDER_DETAIL_H

#include "pellucid.h"

// Coarser volumes, kept while the scene has those that they were made of. Zero-initialise.
struct pel_detail {
    int count;
    struct {
        uint64_t serial; // of the volume
        int level;
        struct pel_volume *volume; // owned
    } made[PEL_VOLUME_MAX * PEL_LOD_LEVEL_MAX];
    struct pel_lod_statistics statistics; // of the last scene
};

// Puts volumes of the levels that the scene asks for in the places of its own, fine enough for its
// camera and for a second eye's, which may be NULL; the scene borrows them, and everything else as
// before. False: ARGUMENT, MEMORY.
bool pel_detail_show(struct pel_detail *detail, struct pel_scene *shown,
                     const struct pel_camera *second);
void pel_detail_finish(struct pel_detail *detail);

#endif
