// path.h - a scene made ready for rays, and where the samples of a ray lie.
#ifndef PEL_TEST_REFERENCE_PATH_H
#define PEL_TEST_REFERENCE_PATH_H

#include "reference/classify.h"
#include "reference/ray.h"

// A visible instance.
struct reference_body {
    const struct pel_instance *instance;
    const struct pel_volume *volume;
    struct pel_matrix world_from_voxel, voxel_from_world;
    double low[3], high[3]; // the box, in voxel coordinates
    struct reference_table table;
    double pair_range[2];
    double (*pairs)[4]; // owned; of pairs of values, see pair.h. NaN: not worked out yet; or NULL
};

struct reference {
    const struct pel_scene *scene;
    int body_count;
    struct reference_body bodies[PEL_VOLUME_MAX];
    double step_mm;
    double phase;           // of the next rays; NaN: the scene's
    double low[3], high[3]; // world bounds of all boxes
};

// One ray on its way: what it meets, and where its samples lie.
struct reference_path {
    struct reference_ray ray;                  // in the world
    struct reference_ray rays[PEL_VOLUME_MAX]; // in the voxel coordinates of each body
    struct reference_span spans[PEL_VOLUME_MAX];
    double phase;
    double t_near, t_far; // no sample lies at t_far or beyond
};

// False when the ray meets nothing.
bool reference_begin(struct reference_path *path, const struct reference *reference, double x_px,
                     double y_px);

// Where sample i lies. `i` is a whole number.
double reference_sample_t(const struct reference *reference, const struct reference_path *path,
                          double i);

#endif
