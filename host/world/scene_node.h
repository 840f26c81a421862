// scene_node.h - one value of a scene's JSON together with where it stands, so that whoever reads
// it can say FILE:LINE:COLUMN: KEY: what is wrong.
//
// Nodes live on the stack of the functions that read them and point to their parents, so a node
// must not outlive the function that made its parent. The `get` functions read one member of an
// object: they return true and leave the result alone when the member is absent, and false (FORMAT,
// or ARGUMENT when the value came from an override) when it is not what it should be.
#ifndef PEL_WORLD_SCENE_NODE_H
#define PEL_WORLD_SCENE_NODE_H

#include <stdbool.h>
#include <stddef.h>

#include <jansson.h>

// Where a scene's JSON came from.
struct pel_scene_document {
    const char *path; // of the file; NULL when the scene was made in memory
    const char *text; // as the user wrote it; NULL likewise
    const char *const *overrides;
    int override_count;
};

struct pel_scene_node {
    const struct pel_scene_document *document;
    const struct pel_scene_node *parent; // NULL: the scene itself
    const char *key;                     // NULL: element `index` of an array
    size_t index;
    json_t *value; // borrowed
};

// The numbers that are allowed: low and high included, unless they are `open`.
struct pel_range {
    double low, high;
    bool low_open, high_open;
};

// The largest coordinate or length, in millimetres: devices compute in floats, and their squares
// must stay finite.
#define PEL_COORDINATE_MAX 1e9

extern const struct pel_range pel_any_number, pel_positive_number, pel_unit_number;

// Fails with a sentence about a node, or puts its place before a sentence that is there already.
// Both return false.
bool pel_node_fail(const struct pel_scene_node *node, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
bool pel_node_fail_in(const struct pel_scene_node *node);

// The member of an object (false when there is none), and an element of an array.
bool pel_node_member(struct pel_scene_node *member, const struct pel_scene_node *object,
                     const char *key);
struct pel_scene_node pel_node_element(const struct pel_scene_node *array, size_t index);

// Fails unless the node is an object all of whose keys are in `keys` (its last element is NULL), a
// list of least..most elements, or one of `names`.
bool pel_node_check_object(const struct pel_scene_node *node, const char *const *keys);
bool pel_node_check_list(const struct pel_scene_node *node, size_t least, size_t most);
bool pel_node_check_name(const struct pel_scene_node *node, const char *const *names, int *which);
bool pel_node_check_numbers(const struct pel_scene_node *node, size_t count,
                            const struct pel_range *range, double numbers[]);

bool pel_node_get_bool(const struct pel_scene_node *object, const char *key, bool *value);
bool pel_node_get_integer(const struct pel_scene_node *object, const char *key, int low, int high,
                          int *value);
bool pel_node_get_number(const struct pel_scene_node *object, const char *key,
                         const struct pel_range *range, double *value);
bool pel_node_get_numbers(const struct pel_scene_node *object, const char *key, size_t count,
                          const struct pel_range *range, double values[]);
bool pel_node_get_text(const struct pel_scene_node *object, const char *key, const char **value);
bool pel_node_get_name(const struct pel_scene_node *object, const char *key,
                       const char *const *names, int *which);

// The path a text node means: beside the scene file when it is written there, as it is otherwise.
// Memory to free(), or NULL (MEMORY).
char *pel_node_path(const struct pel_scene_node *node, const char *text);

#endif
