// scene_read_pose.c - the `transform` of a volume in a scene file: a 4x4 matrix, a quaternion, a
// rotation about an axis, or a file of another program. All must be rigid.
#include "world/scene_plan.h"

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "world/scene_write.h"

static const char *const quaternion_keys[] = {"comment", "quaternion", "translation", NULL};
static const char *const rotate_keys[] = {"comment", "rotate", "translate", NULL};
static const char *const rotation_keys[] = {"comment", "axis", "degrees", "about", NULL};
static const char *const file_keys[] = {"comment", "file", "fixed", NULL};

// For an object that is none of the above.
static const char *const transform_keys[] = {"comment", "file",      "fixed",       "quaternion",
                                             "rotate",  "translate", "translation", NULL};

static const char *const axis_names[] = {"x", "y", "z", NULL};
static const char *const about_names[] = {"centre", NULL};

// Matrices are written by programs with four digits and more.
static const double rigid_tolerance = 1e-3;

static bool read_matrix(struct pel_matrix *matrix, const struct pel_scene_node *node) {
    if (!pel_node_check_list(node, 4, 4))
        return false;
    for (size_t row = 0; row < 4; row++) {
        struct pel_scene_node element = pel_node_element(node, row);
        if (!pel_node_check_numbers(&element, 4, &pel_any_number, matrix->m[row]))
            return false;
    }
    const double *last = matrix->m[3];
    if (last[0] != 0 || last[1] != 0 || last[2] != 0 || last[3] != 1)
        return pel_node_fail(node, "the last row must be 0 0 0 1, not %g %g %g %g", last[0],
                             last[1], last[2], last[3]);
    double off = pel_matrix_deviation(matrix);
    if (!(off <= rigid_tolerance))
        return pel_node_fail(node, "is not rigid: its rows are off a rotation's by %.3g", off);
    if (pel_matrix_determinant(matrix) < 0)
        return pel_node_fail(node, "is not rigid: it mirrors");
    return true;
}

static bool read_quaternion(struct pel_matrix *matrix, const struct pel_scene_node *node) {
    struct pel_scene_node member;
    double xyzw[4], translation[3] = {0};
    if (!pel_node_check_object(node, quaternion_keys) ||
        !pel_node_get_numbers(node, "quaternion", 4, &pel_any_number, xyzw) ||
        !pel_node_get_numbers(node, "translation", 3, &pel_any_number, translation))
        return false;
    double length = sqrt(pel_dot(xyzw, xyzw) + xyzw[3] * xyzw[3]);
    if (!(fabs(length - 1) <= rigid_tolerance)) {
        pel_node_member(&member, node, "quaternion");
        return pel_node_fail(&member, "must have length 1, not %g", length);
    }
    *matrix = pel_matrix_from_quaternion(xyzw, translation);
    return true;
}

static bool read_axis(double axis[3], const struct pel_scene_node *rotation) {
    struct pel_scene_node node;
    if (!pel_node_member(&node, rotation, "axis"))
        return pel_node_fail(rotation, "needs 'axis'");
    if (!json_is_string(node.value)) {
        if (!pel_node_check_numbers(&node, 3, &pel_any_number, axis))
            return false;
        return pel_normalize(axis) || pel_node_fail(&node, "has no direction");
    }
    int which;
    if (!pel_node_check_name(&node, axis_names, &which))
        return false;
    for (int i = 0; i < 3; i++)
        axis[i] = i == which;
    return true;
}

static bool read_about(struct pel_pose_plan *pose, const struct pel_scene_node *rotation) {
    struct pel_scene_node node;
    int which;
    if (!pel_node_member(&node, rotation, "about"))
        return true;
    if (!json_is_string(node.value))
        return pel_node_check_numbers(&node, 3, &pel_any_number, pose->about);
    pose->about_centre = pel_node_check_name(&node, about_names, &which);
    return pose->about_centre;
}

static bool read_rotate(struct pel_pose_plan *pose, const struct pel_scene_node *node) {
    struct pel_scene_node rotation, degrees_node;
    double translation[3] = {0}, axis[3] = {0, 0, 1}, degrees = 0;
    if (!pel_node_check_object(node, rotate_keys) ||
        !pel_node_get_numbers(node, "translate", 3, &pel_any_number, translation))
        return false;
    if (pel_node_member(&rotation, node, "rotate")) {
        if (!pel_node_check_object(&rotation, rotation_keys) || !read_axis(axis, &rotation) ||
            !pel_node_get_number(&rotation, "degrees", &pel_any_number, &degrees) ||
            !read_about(pose, &rotation))
            return false;
        if (!pel_node_member(&degrees_node, &rotation, "degrees"))
            return pel_node_fail(&rotation, "needs 'degrees'");
    }
    double half = degrees * PEL_PI / 360;
    double xyzw[4] = {axis[0] * sin(half), axis[1] * sin(half), axis[2] * sin(half), cos(half)};
    pose->matrix = pel_matrix_from_quaternion(xyzw, translation);
    return true;
}

static bool read_file(struct pel_pose_plan *pose, const struct pel_scene_node *node) {
    struct pel_scene_node member;
    const char *file;
    if (!pel_node_check_object(node, file_keys) || !pel_node_get_text(node, "file", &file) ||
        !pel_node_get_text(node, "fixed", &pose->fixed_name))
        return false;
    pel_node_member(&member, node, "file");
    pose->file = pel_node_path(&member, file);
    return pose->file != NULL;
}

bool pel_scene_read_pose(struct pel_pose_plan *pose, const struct pel_scene_node *volume) {
    *pose = (struct pel_pose_plan){.matrix = pel_matrix_identity(), .fixed = -1};
    struct pel_scene_node node, member;
    if (!pel_node_member(&node, volume, "transform"))
        return true;
    if (json_is_array(node.value))
        return read_matrix(&pose->matrix, &node);
    if (!pel_node_check_object(&node, transform_keys))
        return false;
    if (pel_node_member(&member, &node, "file"))
        return read_file(pose, &node);
    if (pel_node_member(&member, &node, "quaternion"))
        return read_quaternion(&pose->matrix, &node);
    if (pel_node_member(&member, &node, "rotate") || pel_node_member(&member, &node, "translate"))
        return read_rotate(pose, &node);
    return pel_node_fail(&node, "needs 'file', 'quaternion', 'rotate' or 'translate'");
}

// Whatever was read, a matrix is written: it alone comes back to the last bit.
void pel_scene_write_pose(struct pel_scene_writer *writer, json_t *volume,
                          const struct pel_matrix *transform) {
    struct pel_matrix identity = pel_matrix_identity();
    if (memcmp(transform, &identity, sizeof identity) == 0)
        return;
    json_t *rows = json_array();
    for (int row = 0; row < 4; row++)
        json_array_append_new(rows, pel_write_make_numbers(4, transform->m[row]));
    pel_write_value(writer, volume, "transform", rows);
}
