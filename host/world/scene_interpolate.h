// scene_interpolate.h - what is between two values of a scene's JSON.
#ifndef PEL_WORLD_SCENE_INTERPOLATE_H
#define PEL_WORLD_SCENE_INTERPOLATE_H

#include <jansson.h>

// The value at `share` (0..1) of the way from `a` to `b`, a new reference; NULL (MEMORY).
// - Numbers change linearly, lists of one length and objects with the same keys member by member.
// - Poses turn by slerp and move linearly: 4x4 matrices, objects with a `quaternion`, and those
//   with a `rotate` whose axes or centres differ. With one axis, `degrees` is a number like any
//   other, so that 0 to 720 are two turns.
// - Everything else, texts for example, stays `a` until `b` is reached.
// At the ends the result is a copy of `a` or `b`.
json_t *pel_interpolate(const json_t *a, const json_t *b, double share);

#endif
