// handles.h - things in the picture that a hand can take hold of: a gizmo that moves and turns a
// volume, and the faces of a box.
//
// What is drawn is what is hit: each handle is a line of pixels, and the pointer takes the nearest.
// A drag is worked out from where it began, never from event to event, so that nothing adds up and
// leading the pointer back leads the volume back.
#ifndef PEL_VIEWER_HANDLES_H
#define PEL_VIEWER_HANDLES_H

#include "viewer/view.h"

enum pel_handle {
    PEL_HANDLE_NONE,
    PEL_HANDLE_MOVE_X, // along one of the gizmo's axes
    PEL_HANDLE_MOVE_Y,
    PEL_HANDLE_MOVE_Z,
    PEL_HANDLE_PLANE_X, // in the plane that an axis is perpendicular to
    PEL_HANDLE_PLANE_Y,
    PEL_HANDLE_PLANE_Z,
    PEL_HANDLE_TURN_X, // about an axis
    PEL_HANDLE_TURN_Y,
    PEL_HANDLE_TURN_Z,
    PEL_HANDLE_MOVE_VIEW, // in the plane of the picture, by the middle
    PEL_HANDLE_TURN_VIEW, // about the line of sight, by the outer ring
    PEL_HANDLE_COUNT,
};

enum { PEL_HANDLE_POINTS = 65 };

struct pel_gizmo {
    double centre[3];  // of the volume's box, in the world
    double axes[3][3]; // unit vectors of the world
    double size_mm;    // of its arrows
    unsigned missing;  // bits of the handles that it has not
    struct pel_view view;
};

// The gizmo of an instance, with arrows of about `size_px`: along the world's axes, or along the
// volume's `own` ones. False when its centre is behind the eye.
bool pel_gizmo_make(struct pel_gizmo *gizmo, const struct pel_scene *scene, int instance,
                    const struct pel_view *view, double size_px, bool own);

// What to draw of a handle: a line through these pixels, closed where the last is the first.
// Returns their number; 0 where the handle is seen too much from its end to be of use.
int pel_gizmo_outline(const struct pel_gizmo *gizmo, enum pel_handle handle,
                      double pixels[PEL_HANDLE_POINTS][2]);

// The handle under the pointer, give or take `reach_px`.
enum pel_handle pel_gizmo_hit(const struct pel_gizmo *gizmo, const double pixel[2],
                              double reach_px);

// A drag in progress.
struct pel_handle_drag {
    struct pel_gizmo gizmo; // as it was when the drag began
    enum pel_handle handle;
    struct pel_matrix before; // the instance's transform then
    double pixel[2];          // where the pointer was
    double grip[3];           // what it held, in the world
    double amount;            // millimetres or degrees so far, for a read-out
};

// Begins a drag; false when the handle cannot be held there.
bool pel_handle_begin(struct pel_handle_drag *drag, const struct pel_gizmo *gizmo,
                      enum pel_handle handle, const double pixel[2],
                      const struct pel_matrix *transform);

// The instance's transform with the pointer at a pixel. A `snap` above 0 makes the amount a
// multiple of it. False, with nothing changed, where the pointer leads nowhere.
bool pel_handle_drag(struct pel_handle_drag *drag, const double pixel[2], double snap,
                     struct pel_matrix *transform);

// ---- Boxes -------------------------------------------------------------------------------------

// A box along its own axes, as clipping has it; face 2 a + 1 is the upper one of axis a.
struct pel_handle_box {
    struct pel_matrix world_from_box; // may scale
    double low[3], high[3];
};

// The middle of a face, in the world; and the face whose middle is under the pointer, or -1.
void pel_box_face(const struct pel_handle_box *box, int face, double point[3]);
int pel_box_hit(const struct pel_handle_box *box, const struct pel_view *view,
                const double pixel[2], double reach_px);

// The box as it was, with one face moved along its axis from one pixel to another, but not beyond
// the opposite face. False, with `moved` left alone, where the pointer leads nowhere.
bool pel_box_drag(struct pel_handle_box *moved, const struct pel_handle_box *before, int face,
                  const struct pel_view *view, const double from_px[2], const double to_px[2]);

// How far, in millimetres, a point moves along an axis (a unit vector) when the pointer leads it
// from one pixel to another; false where that cannot be told. For planes: along their normal.
bool pel_axis_drag(double *moved_mm, const double point[3], const double axis[3],
                   const struct pel_view *view, const double from_px[2], const double to_px[2]);

#endif
