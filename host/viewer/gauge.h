// gauge.h - where and how large: the scale bar and the orientation cube, as geometry in pixels.
#ifndef PEL_VIEWER_GAUGE_H
#define PEL_VIEWER_GAUGE_H

#include "viewer/view.h"

// A bar as long as a round number of millimetres: 1, 2 or 5 times a power of ten.
struct pel_scale_bar {
    double length_mm, length_px;
    char text[24]; // "20 mm", "5 um", "10 cm"
};

// The longest such bar of at most `most_px`, at the distance of the view's target; false when the
// view shows no size.
bool pel_scale_bar_make(struct pel_scale_bar *bar, const struct pel_view *view, double most_px);

// One face of the cube: the side of the patient that is seen there.
struct pel_cube_face {
    char letter;          // 'R' 'L' 'A' 'P' 'S' 'I'
    const char *view;     // the name of the view that looks at it
    double corners[4][2]; // pixels, in order round the face
    double centre[2];     //
    double right[2];      // where the letter's right is, in half edges: how it is slanted
    double down[2];       // and its lower side
    double brightness;    // 0..1: how much it faces the viewer
};

// The faces that are seen, those further back first. `centre_px` is where the cube is drawn and
// `size_px` its edge. Perspective plays no part. Returns how many there are, 1 to 3.
int pel_orientation_cube(struct pel_cube_face faces[3], const struct pel_view *view,
                         const double centre_px[2], double size_px);

// The face under the pointer; -1 when there is none.
int pel_orientation_cube_hit(const struct pel_cube_face *faces, int count, const double pixel[2]);

#endif
