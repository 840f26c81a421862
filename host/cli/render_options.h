// render_options.h - the options of `pellucid render`. Most of them are shorthands for keys of the
// scene and become overrides; what concerns the device or the file stays here.
#ifndef PEL_CLI_RENDER_OPTIONS_H
#define PEL_CLI_RENDER_OPTIONS_H

#include "cli/overrides.h"
#include "pellucid.h"

struct render_options {
    char **inputs; // borrowed from the command line
    int input_count;
    const char *output; // NULL: not said
    struct overrides overrides;
    int clip_count; // of --clip so far
    struct pel_renderer_options renderer;
    const char *frames; // which ones; NULL: not said
    int frame;          // -1: not said
    bool probe;         // follow the ray of one pixel instead of making a picture
    int pixel[2];       // which
    bool json, quiet;
};

// Returns 0, or the exit status after a message. render_options_finish in both cases.
int render_options_parse(struct render_options *options, int argc, char **argv);
void render_options_finish(struct render_options *options);

#endif
