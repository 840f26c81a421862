// scene_read_stereo.c - the `stereo` of a scene file, read and written: how two eyes see it.
#include "world/scene_plan.h"
#include "world/scene_write.h"

static const char *const stereo_keys[] = {"comment", "kind",   "separation", "convergence", "swap",
                                          "toe_in",  "matrix", "reproject",  NULL};
static const char *const length_names[] = {"automatic", NULL};

// A length, or "automatic", which is 0 in memory. *given tells them apart.
static bool read_length(const struct pel_scene_node *object, const char *key,
                        const struct pel_range *range, double *length_mm, bool *given) {
    struct pel_scene_node node;
    int which;
    if (!pel_node_member(&node, object, key))
        return true;
    *given = !json_is_string(node.value);
    *length_mm = 0;
    return *given ? pel_node_get_number(object, key, range, length_mm)
                  : pel_node_check_name(&node, length_names, &which);
}

static bool read_matrix(struct pel_stereo *stereo, const struct pel_scene_node *object) {
    struct pel_scene_node node;
    const struct pel_range range = {.low = -1000, .high = 1000};
    if (!pel_node_member(&node, object, "matrix"))
        return stereo->kind != PEL_STEREO_MATRIX ||
               pel_node_fail(object, "kind \"matrix\" needs 'matrix'");
    if (!pel_node_check_list(&node, 3, 3))
        return false;
    for (size_t row = 0; row < 3; row++) {
        struct pel_scene_node element = pel_node_element(&node, row);
        if (!pel_node_check_numbers(&element, 6, &range, stereo->matrix[row]))
            return false;
    }
    return true;
}

// Squeezed pictures are known to fit before anything is rendered.
static bool check_size(const struct pel_scene *scene, const struct pel_scene_node *object) {
    struct pel_scene_node node;
    enum pel_stereo_kind kind = scene->stereo.kind;
    bool odd_width = kind == PEL_STEREO_SIDE_BY_SIDE_HALF && scene->render.width % 2 != 0;
    bool odd_height = kind == PEL_STEREO_TOP_BOTTOM_HALF && scene->render.height % 2 != 0;
    if (!odd_width && !odd_height)
        return true;
    pel_node_member(&node, object, "kind");
    return pel_node_fail(&node, "%s needs an even %s, not %d", pel_stereo_names()[kind],
                         odd_width ? "width" : "height",
                         odd_width ? scene->render.width : scene->render.height);
}

bool pel_scene_read_stereo(struct pel_scene *scene, const struct pel_scene_node *root) {
    struct pel_scene_node node;
    struct pel_stereo *stereo = &scene->stereo;
    if (!pel_node_member(&node, root, "stereo"))
        return true;
    const struct pel_range separation_range = {.low = 0, .high = PEL_COORDINATE_MAX};
    int kind = PEL_STEREO_NONE;
    bool separated = false, converging = false;
    if (!pel_node_check_object(&node, stereo_keys) ||
        !pel_node_get_name(&node, "kind", pel_stereo_names(), &kind) ||
        !read_length(&node, "separation", &separation_range, &stereo->separation_mm, &separated) ||
        !read_length(&node, "convergence", &pel_positive_number, &stereo->convergence_mm,
                     &converging) ||
        !pel_node_get_bool(&node, "swap", &stereo->swap) ||
        !pel_node_get_bool(&node, "toe_in", &stereo->toe_in) ||
        !pel_node_get_bool(&node, "reproject", &stereo->reproject))
        return false;
    stereo->kind = (enum pel_stereo_kind)kind;
    stereo->flat = separated && stereo->separation_mm == 0;
    return read_matrix(stereo, &node) && check_size(scene, &node);
}

void pel_scene_write_stereo(struct pel_scene_writer *writer, json_t *root) {
    const struct pel_stereo *stereo = &writer->scene->stereo;
    bool matrix = false;
    for (int i = 0; i < 18; i++)
        matrix = matrix || stereo->matrix[i / 6][i % 6] != 0;
    json_t *object = pel_write_object(writer, root, "stereo");
    pel_write_name(writer, object, "kind", pel_stereo_names(), stereo->kind, PEL_STEREO_NONE);
    // A separation of 0 is written for flat stereo alone; in memory it means automatic.
    if (stereo->flat)
        pel_write_value(writer, object, "separation", json_integer(0));
    else
        pel_write_number(writer, object, "separation", stereo->separation_mm, 0);
    pel_write_number(writer, object, "convergence", stereo->convergence_mm, 0);
    pel_write_bool(writer, object, "swap", stereo->swap, false);
    pel_write_bool(writer, object, "toe_in", stereo->toe_in, false);
    pel_write_bool(writer, object, "reproject", stereo->reproject, false);
    if (matrix || stereo->kind == PEL_STEREO_MATRIX) {
        json_t *rows = json_array();
        for (int row = 0; row < 3; row++)
            json_array_append_new(rows, pel_write_make_numbers(6, stereo->matrix[row]));
        pel_write_value(writer, object, "matrix", rows);
    }
    if (json_object_size(object) == 0)
        json_object_del(root, "stereo");
}
