// scene_override.h - values given beside a scene file: "camera.fov=40".
#ifndef PEL_WORLD_SCENE_OVERRIDE_H
#define PEL_WORLD_SCENE_OVERRIDE_H

#include <stdbool.h>
#include <stddef.h>

#include <jansson.h>

// Puts the value of "KEY=VALUE" into the scene. KEY is a dotted path; `*` stands for all elements
// of an array, the index behind the last one appends, and objects on the way are made where they
// are missing. VALUE is JSON or a plain word; null removes what is there. Fails (ARGUMENT) when the
// path cannot be followed.
bool pel_scene_override(json_t *scene, const char *override);

// Puts a value at a dotted path, likewise.
bool pel_scene_put(json_t *scene, const char *path, const json_t *value);

// The path with volumes by their index where it has them by their name: "volumes.ct.density"
// becomes "volumes.1.density". Fails (ARGUMENT) when no volume has that name, or several do, or
// when it does not fit.
bool pel_scene_key_resolve(char *resolved, size_t bytes, const json_t *scene, const char *path);

// True when the value at `path` came from this override, or lies inside a value that did.
bool pel_scene_override_covers(const char *override, const char *path);

// True when `path` was given by this override, or something inside it was.
bool pel_scene_override_touches(const char *override, const char *path);

#endif
