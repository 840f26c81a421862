// hand.h - what mouse and keyboard do to the picture.
#ifndef PEL_VIEWER_HAND_H
#define PEL_VIEWER_HAND_H

#include "viewer/state.h"

// An event that no panel took.
void pel_hand_react(struct pel_state *state, const struct pel_event *event);

// Time went on: keys that are held, and cameras on their way.
void pel_hand_tick(struct pel_state *state, double seconds);

// True while something goes on without new events.
bool pel_hand_is_busy(const struct pel_state *state);

#endif
