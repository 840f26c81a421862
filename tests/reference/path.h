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
    double (*pairs)[4];  // owned; of pairs of values, see pair.h. NaN: not worked out yet; or NULL
    double step_mm;      // that it asks for
    unsigned char *runs; // owned; of each cell, how long a run may be that begins there, 0: not
                         // worked out yet; or NULL
};

struct reference {
    const struct pel_scene *scene;
    struct pel_scene *coarse; // owned; what `scene` is where levels of detail are shown, or NULL
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

// The distance of the body's nearest voxels.
double reference_spacing(const struct reference_body *body);

// False when the ray meets nothing.
bool reference_begin(struct reference_path *path, const struct reference *reference, double x_px,
                     double y_px);

// Where sample i of the common grid lies. `i` is a whole number.
double reference_sample_t(const struct reference *reference, const struct reference_path *path,
                          double i);

// Where a ray has samples: which bodies take part, and where each does.
struct reference_stop {
    int count;
    int bodies[PEL_VOLUME_MAX];
    double t[PEL_VOLUME_MAX];
    double steps; // that a sample there stands for
};

// How far along its samples a ray is. Zero-initialise.
struct reference_walk {
    double next;                  // sample of the common grid
    double nexts[PEL_VOLUME_MAX]; // and, with mixing in order, of each body's
};

// The next place with samples of any body; false at the end. Bodies whose box ends within
// slack_mm(t) = rounding * (t + distance of the eye from the origin) take part, too.
bool reference_next(struct reference_stop *stop, struct reference_walk *walk,
                    const struct reference *reference, const struct reference_path *path,
                    double rounding);
double reference_slack_mm(const struct reference *reference, double t, double rounding);

// The length that a sample of the body stands for.
double reference_sample_mm(const struct reference *reference, int body);

#endif
