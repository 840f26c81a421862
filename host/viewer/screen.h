// screen.h - what is where in the windows, and drawing it.
#ifndef PEL_VIEWER_SCREEN_H
#define PEL_VIEWER_SCREEN_H

#include "viewer/state.h"

// Opens and closes the windows that the options ask for. False, with the reason in `sentence`.
bool pel_screen_open(struct pel_state *state, char *sentence, size_t bytes);
void pel_screen_close(struct pel_state *state);

// Lays out the views for the windows' present sizes. True when something moved.
bool pel_screen_layout(struct pel_state *state);

// Makes the scene that of one view: its size, and its camera.
void pel_screen_fit_scene(const struct pel_state *state, int view, struct pel_scene *scene);

// Hands the pixels of one view, 8-bit RGBA, to the window it is in.
void pel_screen_upload(struct pel_state *state, int view, int width, int height,
                       const uint8_t *rgba);

// Draws all windows and shows them together.
void pel_screen_draw(struct pel_state *state);

// Saves what the windows show, side by side if there are several. False with an error set.
bool pel_screen_save(struct pel_state *state, const char *path);

#endif
