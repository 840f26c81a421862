// clip_handles.h - planes and boxes that cut, as things to take hold of: a gizmo that moves and
// turns them, and the faces of a box. A drag is worked out from where it began (handles.h).
#ifndef PEL_VIEWER_CLIP_HANDLES_H
#define PEL_VIEWER_CLIP_HANDLES_H

#include "viewer/handles.h"

// The gizmo of a clip, with arrows of about `size_px`. That of a plane moves it along its normal,
// the blue arrow, turns it about its point, and its middle pushes it. False when that is behind the
// eye.
bool pel_clip_gizmo(struct pel_gizmo *gizmo, const struct pel_clip *clip,
                    const struct pel_view *view, double size_px);

// The clip as it was, moved and turned as a drag says whose `before` was the identity.
void pel_clip_move(struct pel_clip *moved, const struct pel_clip *before,
                   const struct pel_matrix *transform);

// A plane as it was, pushed by its middle from one pixel to another along its normal, be it seen
// from its end or not: upwards is away from the viewer.
void pel_clip_push(struct pel_clip *moved, const struct pel_clip *before,
                   const struct pel_view *view, const double from_px[2], const double to_px[2]);

// The box of a clip, and the clip with another box.
struct pel_handle_box pel_clip_box(const struct pel_clip *clip);
void pel_clip_set_box(struct pel_clip *clip, const struct pel_handle_box *box);

enum { PEL_CLIP_LINES = 12 };

// What to draw of a clip: the edges of a box, or of a square in a plane that reaches `size_mm` from
// its point. Returns the number of lines, from one point of the world to another.
int pel_clip_outline(const struct pel_clip *clip, double size_mm,
                     double lines[PEL_CLIP_LINES][2][3]);

#endif
