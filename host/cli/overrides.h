// overrides.h - a growing list of "key=value" strings for pel_scene_load.
#ifndef PEL_CLI_OVERRIDES_H
#define PEL_CLI_OVERRIDES_H

#include "pellucid.h"

// Starts as {0}; overrides_finish frees what it holds.
struct overrides {
    char **texts; // owned, and each of them
    int count;
};

// Appends "key=value". The value is taken as it is (JSON or a plain word), or as text whatever it
// looks like: a file may be called "7" or "null". Both end the program when memory runs out.
void overrides_add(struct overrides *overrides, const char *key, const char *value);
void overrides_add_text(struct overrides *overrides, const char *key, const char *value);

// Appends "key=value" as it stands, or fails with a message about `option` when it is not of that
// form.
bool overrides_add_setting(struct overrides *overrides, const char *option, const char *text);

// Appends "key=value,key=value", the keys being members of `parent`, with values that may be
// numbers with commas between them: "eye=0,-400,0,fov=30". False, with a message about `option`,
// when it is not of that form.
bool overrides_add_pairs(struct overrides *overrides, const char *option, const char *parent,
                         const char *text);

// Appends a key that is true, false or an object, from "on", "off", pairs as above, or NULL for on.
// False, with a message about `option`, for anything else.
bool overrides_add_switch(struct overrides *overrides, const char *option, const char *key,
                          const char *text);

void overrides_finish(struct overrides *overrides);

#endif
