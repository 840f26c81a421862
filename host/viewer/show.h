// show.h - what pictures become on their way to the windows: comparisons of two volumes, and slices
// beside the picture.
#ifndef PEL_VIEWER_SHOW_H
#define PEL_VIEWER_SHOW_H

#include "viewer/state.h"

// How many scenes the worker has to render for what is shown, and each of them; the caller owns it.
// NULL: memory ran out.
int pel_show_scene_count(const struct pel_state *state);
struct pel_scene *pel_show_scene(const struct pel_state *state, int number);

// Why the newest picture's pixels came through the host's memory; "" when they came through a
// buffer that OpenCL shares with OpenGL.
const char *pel_show_presented(const struct pel_state *state);

// Takes a picture of all of them over, and hands what is shown to the windows.
void pel_show_take(struct pel_state *state, struct pel_picture *picture);

// Time went on, or what is compared changed: brings the windows up to date.
void pel_show_update(struct pel_state *state);
void pel_show_finish(struct pel_state *state);

// Another way to compare, or other volumes.
void pel_show_set_mode(struct pel_state *state, enum pel_compare_mode mode);

// The slice that a view shows, or a part of; false for the picture itself.
bool pel_show_slice(const struct pel_state *state, int view, struct pel_slice *slice);

#endif
