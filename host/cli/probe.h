// probe.h - what one ray of a picture meets, printed: `pellucid render --pixel X,Y`.
#ifndef PEL_CLI_PROBE_H
#define PEL_CLI_PROBE_H

#include "pellucid.h"

// Reads "X,Y" or fails with a message and ARGUMENT; 0 when it could be read.
int probe_parse(const char *text, int pixel[2]);

// Follows the ray of the pixel and prints its spans and samples as tables, or as JSON. Returns the
// exit status, after a message unless it is 0.
int probe_print(struct pel_renderer *renderer, const struct pel_scene *scene, const int pixel[2],
                bool json);

#endif
