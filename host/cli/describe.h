// describe.h - what `pellucid info` says about one volume.
#ifndef PEL_CLI_DESCRIBE_H
#define PEL_CLI_DESCRIBE_H

#include <jansson.h>

#include "pellucid.h"

// As aligned lines on standard output, each beginning with `indent` spaces.
void describe_print(const struct pel_volume *volume, const struct pel_statistics *statistics,
                    int indent);

// As a JSON object.
json_t *describe_json(const struct pel_volume *volume, const struct pel_statistics *statistics);

// How the bricks of an instance cluster, as lines, and as a JSON array; status, and NULL on
// failure.
int describe_bricks(const struct pel_scene *scene, int instance, int indent);
json_t *describe_bricks_json(const struct pel_scene *scene, int instance);

#endif
