// keys.c - every key and every mouse action.
#include "viewer/keys.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

// What a key does. Where a row of the help names several keys, they are bound one by one.
static const struct {
    enum pel_action action;
    int key, modifiers, number;
} bindings[] = {
    {PEL_ACTION_FORWARD, 'w', 0, 0},
    {PEL_ACTION_BACK, 's', 0, 0},
    {PEL_ACTION_LEFT, 'a', 0, 0},
    {PEL_ACTION_RIGHT, 'd', 0, 0},
    {PEL_ACTION_UP, ' ', 0, 0},
    {PEL_ACTION_DOWN, 'c', 0, 0},
    {PEL_ACTION_CLOSER, '+', 0, 0},
    {PEL_ACTION_CLOSER, '+', PEL_SHIFT, 0},
    {PEL_ACTION_CLOSER, '=', 0, 0},
    {PEL_ACTION_CLOSER, '=', PEL_SHIFT, 0},
    {PEL_ACTION_AWAY, '-', 0, 0},
    {PEL_ACTION_TURN_LEFT, PEL_KEY_LEFT, 0, 0},
    {PEL_ACTION_TURN_RIGHT, PEL_KEY_RIGHT, 0, 0},
    {PEL_ACTION_TURN_UP, PEL_KEY_UP, 0, 0},
    {PEL_ACTION_TURN_DOWN, PEL_KEY_DOWN, 0, 0},
    {PEL_ACTION_TILT_LEFT, 'q', 0, 0},
    {PEL_ACTION_TILT_RIGHT, 'e', 0, 0},
    {PEL_ACTION_VIEW, '1', 0, 0},
    {PEL_ACTION_VIEW, '2', 0, 1},
    {PEL_ACTION_VIEW, '3', 0, 2},
    {PEL_ACTION_VIEW, '4', 0, 3},
    {PEL_ACTION_VIEW, '5', 0, 4},
    {PEL_ACTION_VIEW, '6', 0, 5},
    {PEL_ACTION_RESET_VIEW, '0', 0, 0},
    {PEL_ACTION_RESET_VIEW, PEL_KEY_HOME, 0, 0},
    {PEL_ACTION_FIT, 'f', 0, 0},
    {PEL_ACTION_ORTHOGRAPHIC, 'o', 0, 0},
    {PEL_ACTION_NAVIGATION, 'n', 0, 0},
    {PEL_ACTION_RECALL, PEL_KEY_F1 + 4, 0, 0},
    {PEL_ACTION_RECALL, PEL_KEY_F1 + 5, 0, 1},
    {PEL_ACTION_RECALL, PEL_KEY_F1 + 6, 0, 2},
    {PEL_ACTION_RECALL, PEL_KEY_F1 + 7, 0, 3},
    {PEL_ACTION_STORE, PEL_KEY_F1 + 4, PEL_SHIFT, 0},
    {PEL_ACTION_STORE, PEL_KEY_F1 + 5, PEL_SHIFT, 1},
    {PEL_ACTION_STORE, PEL_KEY_F1 + 6, PEL_SHIFT, 2},
    {PEL_ACTION_STORE, PEL_KEY_F1 + 7, PEL_SHIFT, 3},
    {PEL_ACTION_SELECT_NEXT, PEL_KEY_TAB, 0, 0},
    {PEL_ACTION_SELECT_PREVIOUS, PEL_KEY_TAB, PEL_SHIFT, 0},
    {PEL_ACTION_HIDE, 'v', 0, 0},
    {PEL_ACTION_SOLO, 'v', PEL_SHIFT, 0},
    {PEL_ACTION_DENSER, ']', 0, 0},
    {PEL_ACTION_THINNER, '[', 0, 0},
    {PEL_ACTION_LATER, PEL_KEY_PAGE_DOWN, 0, 0},
    {PEL_ACTION_EARLIER, PEL_KEY_PAGE_UP, 0, 0},
    {PEL_ACTION_REMOVE, PEL_KEY_DELETE, 0, 0},
    {PEL_ACTION_RELOAD, 'r', 0, 0},
    {PEL_ACTION_PRESET, 't', 0, 0},
    {PEL_ACTION_PRESET_BACK, 't', PEL_SHIFT, 0},
    {PEL_ACTION_FILTER, 'i', 0, 0},
    {PEL_ACTION_SHADING, 'l', 0, 0},
    {PEL_ACTION_MIXING, 'm', 0, 0},
    {PEL_ACTION_CLIP, 'x', 0, 0},
    {PEL_ACTION_UNCLIP, 'x', PEL_SHIFT, 0},
    {PEL_ACTION_CLIP_HANDLES, 'h', PEL_SHIFT, 0},
    {PEL_ACTION_HANDLES, 'h', 0, 0},
    {PEL_ACTION_NUDGE, PEL_KEY_LEFT, PEL_CONTROL, 0},
    {PEL_ACTION_NUDGE, PEL_KEY_RIGHT, PEL_CONTROL, 1},
    {PEL_ACTION_NUDGE, PEL_KEY_UP, PEL_CONTROL, 2},
    {PEL_ACTION_NUDGE, PEL_KEY_DOWN, PEL_CONTROL, 3},
    {PEL_ACTION_NUDGE, PEL_KEY_PAGE_UP, PEL_CONTROL, 4},
    {PEL_ACTION_NUDGE, PEL_KEY_PAGE_DOWN, PEL_CONTROL, 5},
    {PEL_ACTION_NUDGE_TURN, PEL_KEY_LEFT, PEL_ALT, 0},
    {PEL_ACTION_NUDGE_TURN, PEL_KEY_RIGHT, PEL_ALT, 1},
    {PEL_ACTION_NUDGE_TURN, PEL_KEY_UP, PEL_ALT, 2},
    {PEL_ACTION_NUDGE_TURN, PEL_KEY_DOWN, PEL_ALT, 3},
    {PEL_ACTION_NUDGE_TURN, PEL_KEY_PAGE_UP, PEL_ALT, 4},
    {PEL_ACTION_NUDGE_TURN, PEL_KEY_PAGE_DOWN, PEL_ALT, 5},
    {PEL_ACTION_RESET_POSE, PEL_KEY_BACKSPACE, 0, 0},
    {PEL_ACTION_UNDO, 'z', PEL_CONTROL, 0},
    {PEL_ACTION_REDO, 'z', PEL_CONTROL | PEL_SHIFT, 0},
    {PEL_ACTION_REDO, 'y', PEL_CONTROL, 0},
    {PEL_ACTION_COMPARE, 'b', 0, 0},
    {PEL_ACTION_COMPARE_BACK, 'b', PEL_SHIFT, 0},
    {PEL_ACTION_STEREO, 'z', 0, 0},
    {PEL_ACTION_STEREO_BACK, 'z', PEL_SHIFT, 0},
    {PEL_ACTION_SWAP_EYES, 'y', 0, 0},
    {PEL_ACTION_REPROJECT, 'y', PEL_SHIFT, 0},
    {PEL_ACTION_NARROWER, ',', 0, 0},
    {PEL_ACTION_WIDER, '.', 0, 0},
    {PEL_ACTION_CONVERGE_NEARER, ',', PEL_SHIFT, 0},
    {PEL_ACTION_CONVERGE_FARTHER, '.', PEL_SHIFT, 0},
    {PEL_ACTION_SUPERSAMPLING, 'u', 0, 0},
    {PEL_ACTION_STEP, 'j', 0, 0},
    {PEL_ACTION_SKIP, 'k', 0, 0},
    {PEL_ACTION_KEYFRAME, 'g', 0, 0},
    {PEL_ACTION_KEYFRAME_BACK, 'g', PEL_SHIFT, 0},
    {PEL_ACTION_PLAY, 'p', 0, 0},
    {PEL_ACTION_LEAVE_FILM, 'p', PEL_SHIFT, 0},
    {PEL_ACTION_SAVE_SCENE, 's', PEL_CONTROL, 0},
    {PEL_ACTION_SAVE_PICTURE, 'p', PEL_CONTROL, 0},
    {PEL_ACTION_SAVE_PICTURE, PEL_KEY_F12, 0, 0},
    {PEL_ACTION_HELP, PEL_KEY_F1, 0, 0},
    {PEL_ACTION_PANELS, PEL_KEY_F1 + 1, 0, 0},
    {PEL_ACTION_READOUTS, PEL_KEY_F1 + 2, 0, 0},
    {PEL_ACTION_FULL_SCREEN, PEL_KEY_F1 + 10, 0, 0},
    {PEL_ACTION_ESCAPE, PEL_KEY_ESCAPE, 0, 0},
    {PEL_ACTION_QUIT, 'q', PEL_CONTROL, 0},
};

static const struct pel_key_row rows[] = {
    {"Mouse", "left drag", "turn: orbit, trackball, or the head when flying"},
    {NULL, "right drag", "move the picture"},
    {NULL, "middle drag", "up: closer; down: away"},
    {NULL, "wheel", "closer to what is under the pointer, and away"},
    {NULL, "Shift + left drag",
     "window and level of the selected volume: right is wider, up is lower"},
    {NULL, "Shift + right drag", "tilt the picture"},
    {NULL, "left drag on a handle",
     "move or turn the selected volume, or what cuts; by a face: resize a box"},
    {NULL, "Ctrl + left click",
     "look at the point under the pointer, and put the cross-hair there"},
    {NULL, "left drag on the split line", "move the line"},
    {NULL, "click on the orientation cube", "look from that side"},
    {NULL, "drop a file", "add a volume; a scene replaces what is there"},
    {"Camera", "w s", "forward, back"},
    {NULL, "a d", "left, right"},
    {NULL, "Space c", "up, down"},
    {NULL, "+ -", "closer, away"},
    {NULL, "arrows", "turn left, right, up, down"},
    {NULL, "q e", "tilt left, right"},
    {NULL, "1 2 3 4 5 6", "from anterior, posterior, left, right, superior, inferior"},
    {NULL, "0, Home", "back to where it began"},
    {NULL, "f", "all of the selected volume"},
    {NULL, "o", "perspective or parallel"},
    {NULL, "n", "orbit, trackball or fly"},
    {NULL, "F5 F6 F7 F8", "go to a stored viewpoint; with Shift: store it"},
    {"Volumes", "Tab", "select the next; with Shift: the one before"},
    {NULL, "v", "hide or show; with Shift: show it alone"},
    {NULL, "[ ]", "thinner, denser"},
    {NULL, "Page Up, Page Down", "earlier, later in the list"},
    {NULL, "Delete", "remove"},
    {NULL, "r", "read all files again that changed"},
    {NULL, "t", "next transfer function; with Shift: the one before"},
    {NULL, "i", "interpolation between voxels"},
    {NULL, "l", "shading"},
    {NULL, "m", "how overlapping volumes mix"},
    {NULL, "x", "cut by a plane that faces you; with Shift: take the last cut back"},
    {NULL, "Shift + h", "handles of the next cut, or of none"},
    {"Pose", "h", "handles"},
    {NULL, "Ctrl + arrows", "nudge right, left, up, down; with Page Up and Down: in depth"},
    {NULL, "Alt + arrows", "nudge round; with Page Up and Down: clockwise and back"},
    {NULL, "Backspace", "back to where its file puts it"},
    {"Editing", "Ctrl + z", "undo"},
    {NULL, "Ctrl + y, Ctrl + Shift + z", "redo"},
    {"Comparing", "b", "next way to compare; with Shift: the one before"},
    {"Stereo", "z", "next kind; with Shift: the one before"},
    {NULL, "y", "exchange the eyes"},
    {NULL, "Shift + y", "second eye from the first one's picture, or its own"},
    {NULL, ", .", "eyes nearer to each other, further apart"},
    {NULL, "Shift + , Shift + .", "convergence nearer, farther"},
    {"Quality", "u", "rays per pixel: 1, 4, 9, 16"},
    {NULL, "j", "step: 1, 0.5, 0.25 voxels"},
    {NULL, "k", "how empty space is skipped"},
    {"Animation", "g", "keep the view as a keyframe; with Shift: take the last one back"},
    {NULL, "p", "play, pause; with Shift: back to the scene"},
    {"Saving", "Ctrl + s", "the scene"},
    {NULL, "Ctrl + p, F12", "the picture"},
    {"Window", "F1", "this list"},
    {NULL, "F2", "panels"},
    {NULL, "F3", "read-outs"},
    {NULL, "F11", "full screen"},
    {NULL, "Escape", "close the list"},
    {NULL, "Ctrl + q", "quit"},
};

static const struct {
    const char *name;
    int key;
} names[] = {
    {"space", ' '},
    {"escape", PEL_KEY_ESCAPE},
    {"enter", PEL_KEY_ENTER},
    {"tab", PEL_KEY_TAB},
    {"backspace", PEL_KEY_BACKSPACE},
    {"insert", PEL_KEY_INSERT},
    {"delete", PEL_KEY_DELETE},
    {"left", PEL_KEY_LEFT},
    {"right", PEL_KEY_RIGHT},
    {"up", PEL_KEY_UP},
    {"down", PEL_KEY_DOWN},
    {"page-up", PEL_KEY_PAGE_UP},
    {"page-down", PEL_KEY_PAGE_DOWN},
    {"home", PEL_KEY_HOME},
    {"end", PEL_KEY_END},
};

enum pel_action pel_keys_find(int key, int modifiers, int *number) {
    for (size_t i = 0; i < sizeof bindings / sizeof *bindings; i++) {
        if (bindings[i].key == key && bindings[i].modifiers == modifiers) {
            *number = bindings[i].number;
            return bindings[i].action;
        }
    }
    return PEL_ACTION_NONE;
}

const struct pel_key_row *pel_keys_rows(int *count) {
    *count = sizeof rows / sizeof *rows;
    return rows;
}

void pel_keys_write(FILE *stream) {
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (rows[i].group)
            fprintf(stream, "%s| %s | |\n|---|---|\n", i ? "\n" : "", rows[i].group);
        fprintf(stream, "| %s | %s |\n", rows[i].keys, rows[i].help);
    }
}

int pel_keys_from_name(const char *name) {
    if (name[0] > ' ' && name[0] < 127 && !name[1])
        return name[0];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcasecmp(name, names[i].name) == 0)
            return names[i].key;
    int number = 0;
    for (const char *c = name + 1; (name[0] | 0x20) == 'f' && *c >= '0' && *c <= '9'; c++)
        number = 10 * number + (*c - '0');
    return number >= 1 && number <= 12 ? PEL_KEY_F1 + number - 1 : 0;
}
