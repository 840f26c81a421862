// scene_source.h - what a scene was made of, kept so that it can be made anew at another frame.
#ifndef PEL_WORLD_SCENE_SOURCE_H
#define PEL_WORLD_SCENE_SOURCE_H

#include "world/scene_plan.h"

struct pel_scene_source {
    struct pel_scene_document document; // all it points to is owned
    json_t *root;                       // the JSON after the overrides, without values of a frame
    struct pel_scene_plan *plan;        // of the last frame, for where its volumes came from; the
                                        // JSON its nodes refer to is gone
};

// Copies a document whose overrides name volumes by index or by name, and applies them to a copy of
// `root`. NULL (ARGUMENT, MEMORY).
struct pel_scene_source *pel_scene_source_create(const struct pel_scene_document *document,
                                                 const json_t *root);
void pel_scene_source_destroy(struct pel_scene_source *source);

#endif
