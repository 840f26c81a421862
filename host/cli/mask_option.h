// mask_option.h - `--mask` of `pellucid render`.
#ifndef PEL_CLI_MASK_OPTION_H
#define PEL_CLI_MASK_OPTION_H

#include "cli/overrides.h"

// Gives a volume a mask, in place of the one it has in the scene. `text` is VOLUME=OTHER:VALUES or
// VOLUME!=OTHER:VALUES. False, with a message, when it is not of that form.
bool mask_option_add(struct overrides *overrides, const char *text);

#endif
