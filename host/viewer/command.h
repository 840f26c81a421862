// command.h - what keys and buttons do, whichever of them asked for it.
#ifndef PEL_VIEWER_COMMAND_H
#define PEL_VIEWER_COMMAND_H

#include "viewer/keys.h"
#include "viewer/state.h"

// Does one action; `number` counts from 0 where an action has several keys.
void pel_command_do(struct pel_state *state, enum pel_action action, int number);

// Adds a volume, or takes a scene in place of the present one; failure is a message in the window.
void pel_command_open(struct pel_state *state, const char *path);

#endif
