// command.h - what keys and buttons do, whichever of them asked for it.
#ifndef PEL_VIEWER_COMMAND_H
#define PEL_VIEWER_COMMAND_H

#include "viewer/keys.h"
#include "viewer/state.h"

// Does one action; `number` counts from 0 where an action has several keys.
void pel_command_do(struct pel_state *state, enum pel_action action, int number);

// The actions that change how things are rendered; false for the others.
bool pel_command_look(struct pel_state *state, enum pel_action action);

// Those that move volumes.
bool pel_command_pose(struct pel_state *state, enum pel_action action, int number);

// A volume's pose in numbers: how far its middle is from where its file puts it, and its turn as
// Rz Ry Rx, in degrees.
struct pel_pose {
    double move_mm[3], turn_deg[3];
};
struct pel_pose pel_command_get_pose(const struct pel_state *state);
void pel_command_set_pose(struct pel_state *state, const struct pel_pose *pose);

// Reads or writes the selected volume's transform, as the extension says; FSL's counts from the
// first other volume. What happened is a message in the window.
void pel_command_load_pose(struct pel_state *state, const char *path);
void pel_command_save_pose(struct pel_state *state, const char *path);

// Cuts all volumes: by a plane through their middle that faces the viewer, or by a box around the
// middle half. And takes the last cut back.
void pel_command_add_clip(struct pel_state *state, enum pel_clip_kind kind);
void pel_command_remove_clip(struct pel_state *state);

// The selected volume takes a preset, the number counting pel_transfer_presets.
void pel_command_preset(struct pel_state *state, int preset);

// Adds a volume, or takes a scene in place of the present one; failure is a message in the window.
void pel_command_open(struct pel_state *state, const char *path);

#endif
