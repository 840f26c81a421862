// scene_read_transfer.c - the `transfer` of a volume in a scene file: a preset's name, the name of
// a file, or the function itself.
#include "world/scene_plan.h"

#include <stdlib.h>
#include <string.h>

#include "transfer/transfer_file.h"

// A preset's name has neither dot nor slash, a file's always has one.
static bool read_named(struct pel_transfer **transfer, const struct pel_scene_node *node) {
    const char *name = json_string_value(node->value);
    if (!strpbrk(name, "./")) {
        *transfer = pel_transfer_preset(name);
        return *transfer || pel_node_fail(node, "%s", pel_error_message());
    }
    char *path = pel_node_path(node, name);
    *transfer = path ? pel_transfer_load(path) : NULL;
    free(path);
    return *transfer || pel_node_fail_in(node);
}

bool pel_scene_read_transfer_value(struct pel_transfer **transfer,
                                   const struct pel_scene_node *node) {
    if (json_is_string(node->value))
        return read_named(transfer, node);
    const char *bad_key;
    *transfer = pel_transfer_parse(node->value, &bad_key);
    if (*transfer)
        return true;
    struct pel_scene_node bad = {.document = node->document, .parent = node, .key = bad_key};
    return pel_node_fail_in(*bad_key ? &bad : node);
}

bool pel_scene_read_transfer(struct pel_transfer **transfer, const struct pel_scene_node *volume) {
    struct pel_scene_node node;
    return !pel_node_member(&node, volume, "transfer") ||
           pel_scene_read_transfer_value(transfer, &node);
}
