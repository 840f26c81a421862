// reference.h - the slow, obvious ray caster that says what the right picture is.
//
// A transcription of docs/picture.md in plain C and double precision, one ray after the other,
// written for reading. Every kernel is compared with it, and it is compared with analytic truth in
// tests/unit/reference.c. It shares no code with the kernels or with the transfer module.
#ifndef PEL_TEST_REFERENCE_H
#define PEL_TEST_REFERENCE_H

#include "pellucid.h"

// A scene made ready for rays: tables, boxes and inverse matrices. Borrows the scene, which must
// not change or go meanwhile.
struct reference *reference_create(const struct pel_scene *scene);
void reference_destroy(struct reference *reference);

// The colour of the ray through (x, y), pixels as docs/picture.md counts them: whole numbers are
// pixel centres. `rgba` is premultiplied, background included. `*samples` grows by one for every
// instance at every sample it takes part in; it may be NULL.
void reference_cast(const struct reference *reference, double x_px, double y_px, double rgba[4],
                    uint64_t *samples);

// The same blended from the last sample to the first, which cannot end early: the scene's
// termination is not looked at.
void reference_cast_back_to_front(const struct reference *reference, double x_px, double y_px,
                                  double rgba[4]);

// What a renderer may get slightly wrong.
struct reference_errors {
    double rounding; // of positions and values, relative: about 1e-6 for floats
    double weight;   // of each interpolation weight: 2^-8 for texture hardware
    double value;    // of an interpolated value, in steps of an integer voxel type
};

// How far the colour of that ray may then be off, per channel, to first order. A sample so close to
// the end of a span, or to a face between voxels (`nearest`), that rounding decides about it counts
// with all it can change.
double reference_cast_bound(const struct reference *reference, double x_px, double y_px,
                            const struct reference_errors *errors);

// The same for pixel (x, y), all of its rays taken together.
double reference_pixel_bound(struct reference *reference, int x, int y,
                             const struct reference_errors *errors);

// One ray and whole pictures of a scene; the pictures belong to the caller (pel_image_destroy).
void reference_ray(const struct pel_scene *scene, double x_px, double y_px, double rgba[4],
                   uint64_t *samples);
struct pel_image *reference_render(const struct pel_scene *scene);
struct pel_image *reference_render_back_to_front(const struct pel_scene *scene);

#endif
