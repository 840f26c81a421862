// pick.h - what is under the pointer.
#ifndef PEL_VIEWER_PICK_H
#define PEL_VIEWER_PICK_H

#include "viewer/sample.h"
#include "viewer/view.h"

// A ray begins to be seen once it has gathered this much opacity: half a step of an 8-bit picture.
#define PEL_PICK_OPACITY (0.5 / 255)

struct pel_pick {
    bool hit;           // something is visible there; else all below is 0
    int instance;       // what gave most of the opacity there
    double position[3]; // of the first visible sample, in the world
    double distance_mm; // from where the ray begins
    // Every volume at that place, by instance; hidden ones are looked at, too.
    int count;
    struct pel_sample values[PEL_VOLUME_MAX];
};

// Follows the ray through a pixel of the scene's picture until it is visible: each visible volume
// adds its opacity, as docs/picture.md has it for model absorption; an isosurface is visible where
// the ray meets it; and if neither happens, a volume of model mip, minip or average is visible
// where its value is the greatest. Samples are half a voxel apart, but no more than a few thousand.
void pel_pick(struct pel_pick *pick, const struct pel_scene *scene, const struct pel_view *view,
              const double pixel[2]);

// What all volumes are at a place: fills `values` and `count`.
void pel_pick_values(struct pel_pick *pick, const struct pel_scene *scene,
                     const double position[3]);

#endif
