// script.h - events and camera paths from a file, for tests and demonstrations. docs/viewer.md has
// the format.
#ifndef PEL_VIEWER_SCRIPT_H
#define PEL_VIEWER_SCRIPT_H

#include <stddef.h>

#include "pellucid.h"
#include "viewer/event.h"

// One thing to do.
struct pel_script_step {
    enum {
        PEL_SCRIPT_EVENT,
        PEL_SCRIPT_CAMERA,     // glide to `camera` in `seconds`
        PEL_SCRIPT_VIEW,       // glide to the view named `text`
        PEL_SCRIPT_SCREENSHOT, // save the window as `text`
        PEL_SCRIPT_WAIT,       // does nothing
    } kind;
    double delay_s; // after the step before
    bool rest;      // and not before the picture is complete
    struct pel_event event;
    struct pel_camera camera; // members that the file does not name are zero
    double seconds;
    char *text; // owned by the script; an event's path is a copy
};

struct pel_script;

// Reads a script. NULL, with the reason in `sentence`, when it is no such thing.
struct pel_script *pel_script_load(const char *path, char *sentence, size_t bytes);
void pel_script_destroy(struct pel_script *script);

// The next step if its time has come, else NULL. `resting` says whether the picture is complete.
const struct pel_script_step *pel_script_next(struct pel_script *script, double now_s,
                                              bool resting);

// Nothing is left.
bool pel_script_is_over(const struct pel_script *script);

#endif
