// panels.h - what is drawn over and beside the pictures: panels on the left, read-outs and handles
// over the pictures, the list of keys. panel_main.c puts them together; panels_none.c is there in
// its place where there is no Dear ImGui, and the viewer then has keys only.
#ifndef PEL_VIEWER_PANELS_H
#define PEL_VIEWER_PANELS_H

#include "viewer/state.h"

// What the panels take of the window's width, in screen coordinates.
enum { PEL_PANELS_COLUMN = 330 };

// Whether there are any: the program may have been built without.
bool pel_panels_exist(void);

// For all windows.
bool pel_panels_start(struct pel_state *state);
void pel_panels_stop(struct pel_state *state);

// What the panels take of the first window's width, in pixels: on a wall nothing, as they lie over
// the picture.
int pel_panels_width(const struct pel_state *state);

// An event of the first window; true when the panels keep it.
bool pel_panels_take_event(const struct pel_event *event);

// Draws everything of one window, whose OpenGL context is current. `seconds` went by since the last
// time.
void pel_panels_draw(struct pel_state *state, int window, double seconds);

#endif
