// scene_override.h - values given beside a scene file: "camera.fov=40".
#ifndef PEL_WORLD_SCENE_OVERRIDE_H
#define PEL_WORLD_SCENE_OVERRIDE_H

#include <stdbool.h>

#include <jansson.h>

// Puts the value of "KEY=VALUE" into the scene. KEY is a dotted path; `*` stands for all elements
// of an array, the index behind the last one appends, and objects on the way are made where they
// are missing. VALUE is JSON or a plain word; null removes what is there. Fails (ARGUMENT) when the
// path cannot be followed.
bool pel_scene_override(json_t *scene, const char *override);

// True when the value at `path` came from this override, or lies inside a value that did.
bool pel_scene_override_covers(const char *override, const char *path);

// True when `path` was given by this override, or something inside it was.
bool pel_scene_override_touches(const char *override, const char *path);

#endif
