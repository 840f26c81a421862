// describe_scene.h - what `pellucid info` says about a scene and how its volumes take part in it.
#ifndef PEL_CLI_DESCRIBE_SCENE_H
#define PEL_CLI_DESCRIBE_SCENE_H

#include <jansson.h>

#include "pellucid.h"

// As aligned lines on standard output.
void describe_scene(const struct pel_scene *scene);

// As a JSON object.
json_t *describe_scene_json(const struct pel_scene *scene);

#endif
