// sample.h - one volume's value and look at a place of the world, worked out on the host: for the
// read-outs under the pointer and for slices, where a device would answer too late.
//
// docs/picture.md, "Values" and "Classification", defines both. Transfer functions are evaluated
// themselves, not through a table, and other filters than nearest count as linear.
#ifndef PEL_VIEWER_SAMPLE_H
#define PEL_VIEWER_SAMPLE_H

#include "pellucid.h"

// An instance that is ready to be sampled; borrows the scene.
struct pel_sampler {
    const struct pel_instance *instance;
    const struct pel_volume *volume;
    struct pel_matrix world_from_voxel, voxel_from_world;
    double low, high[3]; // of its box, in voxels; `low` is that of all three axes
};

struct pel_sample {
    bool inside;       // of the volume's box; else all below is 0
    bool absent;       // a voxel is not there: the value is NaN, the rest 0
    double value;      // in the file's own unit
    double rgb[3];     // straight
    double opacity;    // as the transfer function says, over its unit of length
    double extinction; // per millimetre, density included
};

// False when the volume is flat, so that no place of the world is in it.
bool pel_sampler_make(struct pel_sampler *sampler, const struct pel_scene *scene, int instance);

struct pel_sample pel_sampler_take(const struct pel_sampler *sampler, const double world[3]);

// Where a ray is inside the volume's box, from `near` (at least 0) to `far`, in millimetres; false
// when it misses.
bool pel_sampler_span(const struct pel_sampler *sampler, const double origin[3],
                      const double direction[3], double *near, double *far);

// The smallest distance of its voxels, in millimetres.
double pel_sampler_spacing(const struct pel_sampler *sampler);

#endif
