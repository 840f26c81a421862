// keys.h - every key and every mouse action, in one table: what is done, what F1 shows, what
// `pellucid view --keys` prints and docs/viewer.md repeats.
#ifndef PEL_VIEWER_KEYS_H
#define PEL_VIEWER_KEYS_H

#include <stdbool.h>
#include <stdio.h>

#include "viewer/event.h"

enum pel_action {
    PEL_ACTION_NONE,
    // These go on as long as the key is held; all of them come before PEL_ACTION_VIEW.
    PEL_ACTION_FORWARD,
    PEL_ACTION_BACK,
    PEL_ACTION_LEFT,
    PEL_ACTION_RIGHT,
    PEL_ACTION_UP,
    PEL_ACTION_DOWN,
    PEL_ACTION_CLOSER,
    PEL_ACTION_AWAY,
    PEL_ACTION_TURN_LEFT,
    PEL_ACTION_TURN_RIGHT,
    PEL_ACTION_TURN_UP,
    PEL_ACTION_TURN_DOWN,
    PEL_ACTION_TILT_LEFT,
    PEL_ACTION_TILT_RIGHT,
    // One after the other for the views, viewpoints and directions that the keys count.
    PEL_ACTION_VIEW,
    PEL_ACTION_RESET_VIEW,
    PEL_ACTION_FIT,
    PEL_ACTION_ORTHOGRAPHIC,
    PEL_ACTION_NAVIGATION,
    PEL_ACTION_RECALL,
    PEL_ACTION_STORE,
    PEL_ACTION_SELECT_NEXT,
    PEL_ACTION_SELECT_PREVIOUS,
    PEL_ACTION_HIDE,
    PEL_ACTION_SOLO,
    PEL_ACTION_DENSER,
    PEL_ACTION_THINNER,
    PEL_ACTION_LATER,
    PEL_ACTION_EARLIER,
    PEL_ACTION_REMOVE,
    PEL_ACTION_RELOAD,
    PEL_ACTION_PRESET,
    PEL_ACTION_PRESET_BACK,
    PEL_ACTION_FILTER,
    PEL_ACTION_SHADING,
    PEL_ACTION_MIXING,
    PEL_ACTION_CLIP,
    PEL_ACTION_UNCLIP,
    PEL_ACTION_CLIP_HANDLES,
    PEL_ACTION_HANDLES,
    PEL_ACTION_NUDGE,
    PEL_ACTION_NUDGE_TURN,
    PEL_ACTION_RESET_POSE,
    PEL_ACTION_UNDO,
    PEL_ACTION_REDO,
    PEL_ACTION_COMPARE,
    PEL_ACTION_COMPARE_BACK,
    PEL_ACTION_STEREO,
    PEL_ACTION_STEREO_BACK,
    PEL_ACTION_SWAP_EYES,
    PEL_ACTION_REPROJECT,
    PEL_ACTION_NARROWER,
    PEL_ACTION_WIDER,
    PEL_ACTION_CONVERGE_NEARER,
    PEL_ACTION_CONVERGE_FARTHER,
    PEL_ACTION_SUPERSAMPLING,
    PEL_ACTION_STEP,
    PEL_ACTION_SKIP,
    PEL_ACTION_KEYFRAME,
    PEL_ACTION_KEYFRAME_BACK,
    PEL_ACTION_PLAY,
    PEL_ACTION_LEAVE_FILM,
    PEL_ACTION_SAVE_SCENE,
    PEL_ACTION_SAVE_PICTURE,
    PEL_ACTION_HELP,
    PEL_ACTION_PANELS,
    PEL_ACTION_READOUTS,
    PEL_ACTION_FULL_SCREEN,
    PEL_ACTION_ESCAPE,
    PEL_ACTION_QUIT,
    PEL_ACTION_COUNT,
};

// One line of the table.
struct pel_key_row {
    const char *group; // the first of a group has its title, the others NULL
    const char *keys;  // as it is shown
    const char *help;
};

// What a key does; `number` counts from 0 where several keys share an action.
enum pel_action pel_keys_find(int key, int modifiers, int *number);

// All rows, in the order they are shown.
const struct pel_key_row *pel_keys_rows(int *count);

// Writes the table as Markdown.
void pel_keys_write(FILE *stream);

// The key of that name, as scripts spell it: a character, or "space", "escape", "page-up", "f1" and
// so on; 0 for another.
int pel_keys_from_name(const char *name);

#endif
