// panel.h - the parts of the panels, for panel_main.c. Each draws its widgets where the last one
// ended, and changes the scene as the hand says.
#ifndef PEL_VIEWER_PANEL_H
#define PEL_VIEWER_PANEL_H

#include "viewer/command.h"
#include "viewer/widget.h"

void pel_panel_volumes(struct pel_state *state);
void pel_panel_transfer(struct pel_state *state);
void pel_panel_compare(struct pel_state *state);
void pel_panel_clip(struct pel_state *state);
void pel_panel_pose(struct pel_state *state);
void pel_panel_look(struct pel_state *state);
void pel_panel_light(struct pel_state *state);
void pel_panel_surface(struct pel_state *state);
void pel_panel_stereo(struct pel_state *state);
void pel_panel_film(struct pel_state *state);
void pel_panel_quality(struct pel_state *state);
void pel_panel_statistics(struct pel_state *state);
void pel_panel_file(struct pel_state *state);

// Over the pictures of one window.
void pel_panel_overlay(struct pel_state *state, int window);

// ---- For all of them ---------------------------------------------------------------------------

// The scene was changed by the widget before, perhaps in the middle of a drag.
void pel_panel_changed(struct pel_state *state, const char *what);

// Call after a widget that may be dragged: the next change is a step of its own once it is let go.
void pel_panel_settle(struct pel_state *state);

// A slider for a member of the scene, with both of the above.
void pel_panel_slide(struct pel_state *state, const char *label, double *value, double low,
                     double high, const char *format);
void pel_panel_slide_log(struct pel_state *state, const char *label, double *value, double low,
                         double high, const char *format);

#endif
