// screen.h - what is where in the windows, and drawing it.
//
// A scene without a wall has one window: panels, the picture beside them, slices beside that. A
// wall has a window for each of its regions, panels over the first one, and the windows show parts
// of one picture that are drawn and swapped together.
#ifndef PEL_VIEWER_SCREEN_H
#define PEL_VIEWER_SCREEN_H

#include "viewer/state.h"

// Opens and closes the windows that the options and the scene's wall ask for. False, with the
// reason in `sentence`.
bool pel_screen_open(struct pel_state *state, char *sentence, size_t bytes);
void pel_screen_close(struct pel_state *state);

// Lays out the views for the windows' present sizes. True when something moved.
bool pel_screen_layout(struct pel_state *state);

// Makes the scene that of one view: its size and region. Or that of the whole picture.
void pel_screen_fit_scene(const struct pel_state *state, int view, struct pel_scene *scene);
void pel_screen_fit_whole(const struct pel_state *state, struct pel_scene *scene);

// What renders the view of a request, borrowed from its scene; "" for what renders the rest.
const char *pel_screen_device(const struct pel_state *state, int number,
                              const struct pel_scene *scene);

// Hands the pixels of one view to the window it is in.
void pel_screen_upload(struct pel_state *state, int view, const struct pel_pixels *pixels);

// Draws all windows and shows them together.
void pel_screen_draw(struct pel_state *state);

// Names the windows after the scene's file, with a star while it is not what was saved.
void pel_screen_name(struct pel_state *state);

// Full screen and back: each window on the monitor it is on, one for each monitor.
void pel_screen_toggle_full_screen(struct pel_state *state);

// Saves what the windows show; those of a wall where they lie in the whole picture, with what the
// bezels hide in black. False with an error set.
bool pel_screen_save(struct pel_state *state, const char *path);

#endif
