// clip_option.h - `--clip` of `pellucid render`.
#ifndef PEL_CLI_CLIP_OPTION_H
#define PEL_CLI_CLIP_OPTION_H

#include "cli/overrides.h"

// Adds one more clip to those of the command line, which take the place of the scene's own. `text`
// is "x<10", "box=X0:X1,Y0:Y1,Z0:Z1" or "cut=...". False, with a message, when it is not.
bool clip_option_add(struct overrides *overrides, int *count, const char *text);

#endif
