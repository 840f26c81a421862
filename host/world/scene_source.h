// scene_source.h - what a scene was made of, kept so that it can be made anew at another frame.
#ifndef PEL_WORLD_SCENE_SOURCE_H
#define PEL_WORLD_SCENE_SOURCE_H

#include "world/scene_node.h"

// Never changes, so that copies of a scene share it.
struct pel_scene_source {
    struct pel_scene_document document; // all it points to is owned
    json_t *root;                       // the JSON after the overrides
    int shares;                         // how many more there are to own it
};

// Copies a document whose overrides name volumes by index or by name, and applies them to a copy of
// `root`. NULL (ARGUMENT, MEMORY).
struct pel_scene_source *pel_scene_source_create(const struct pel_scene_document *document,
                                                 const json_t *root);
void pel_scene_source_destroy(struct pel_scene_source *source);

// The same source, with one more to own it. NULL stays NULL.
struct pel_scene_source *pel_scene_source_share(struct pel_scene_source *source);

#endif
