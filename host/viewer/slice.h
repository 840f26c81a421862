// slice.h - flat cuts through all volumes, rendered on the host.
//
// Slices look as radiologists have them: axial from below, with the patient's right at the left and
// anterior at the top; coronal from the front; sagittal from the patient's left, with anterior at
// the left. The cross-hair is a point of the world, so that all planes and the picture agree.
#ifndef PEL_VIEWER_SLICE_H
#define PEL_VIEWER_SLICE_H

#include "pellucid.h"

enum pel_slice_plane { PEL_SLICE_AXIAL, PEL_SLICE_CORONAL, PEL_SLICE_SAGITTAL };

struct pel_slice {
    enum pel_slice_plane plane;
    double cross[3];  // the cross-hair, in the world: the plane goes through it
    double middle[3]; // what is in the middle of the picture; its depth does not matter
    double mm_per_px;
    int width, height;
    int part[4];   // left and top edge, width and height of what is rendered; all zero: everything
    bool windowed; // values as grey, from the first to the last point of the transfer function,
                   // instead of its colours and opacity
};

// The names of the planes, in the order of the enum; the list ends with NULL.
const char *const *pel_slice_names(void);

// Shows all of the bounds.
void pel_slice_fit(struct pel_slice *slice, const struct pel_bounds *bounds);

// The way to the right, down, and out of the picture, towards the viewer.
void pel_slice_axes(const struct pel_slice *slice, double right[3], double down[3],
                    double towards[3]);

// From a pixel to the world, and from the world to the pixel it is seen in, whatever its depth.
void pel_slice_world(const struct pel_slice *slice, const double pixel[2], double world[3]);
void pel_slice_pixel(const struct pel_slice *slice, const double world[3], double pixel[2]);

// Renders visible volumes, or one `instance` alone if it is not -1, over the scene's background:
// 8-bit RGBA with straight alpha, rows from the top. By the transfer function a sample has its
// opacity, over its unit of length, times density; extinctions add, as in mixing "sum". Windowed,
// volumes have equal shares.
void pel_slice_render(const struct pel_slice *slice, const struct pel_scene *scene, int instance,
                      uint8_t *rgba);

#endif
