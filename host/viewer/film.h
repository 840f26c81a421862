// film.h - the scene's animation in the window: viewpoints are kept as keyframes, and played.
//
// Keyframes are the scene's own ("animation" in its file), so they are saved, undone and rendered
// with it. What is played is a copy of the scene, frame after frame as `pellucid render --frames`
// makes them; frames that would come too late are left out.
#ifndef PEL_VIEWER_FILM_H
#define PEL_VIEWER_FILM_H

#include "pellucid.h"

enum { PEL_FILM_KEYFRAMES = 256 };

struct pel_state;

// Starts as {0}.
struct pel_film {
    struct pel_scene *scene; // owned: the frame that is shown; NULL = the scene itself is
    bool playing, repeats;   //
    double frame;            // that is due; whole ones are shown
    double interval_s;       // from one kept viewpoint to the next; 0 = 1
};

// What is shown: a frame of the film, or the scene.
const struct pel_scene *pel_film_shown(const struct pel_state *state);

// Keeps the camera as the last keyframe; takes the last one back; replaces all of them.
void pel_film_keep(struct pel_state *state);
void pel_film_take_back(struct pel_state *state);
void pel_film_set(struct pel_state *state, const struct pel_keyframe *keyframes, int count,
                  double fps);

// Sees to it that a still of the scene, which shows a frame of its animation, is seen by its
// camera: true when the frame is, or when a keyframe is that becomes the frame.
bool pel_film_settle(struct pel_scene *scene);

// Begins to play where the film is, from its begin when it is at its end, and pauses.
void pel_film_toggle(struct pel_state *state);

// Shows one frame.
void pel_film_seek(struct pel_state *state, double frame);

// Back to the scene, seen by its own camera or, for a hand that takes hold of the picture, by the
// film's.
void pel_film_leave(struct pel_state *state, bool keep_camera);

// Time went on.
void pel_film_tick(struct pel_state *state, double seconds);

#endif
