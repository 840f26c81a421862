// scene_interpolate.c - what is between two values of a scene's JSON.
#include "world/scene_interpolate.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/quaternion.h"

// ---- Poses -------------------------------------------------------------------------------------

// A rotation and where it leads, as one of the forms of a `transform` says it.
struct pose {
    double xyzw[4], translation[3];
    bool about_centre; // of the volume, which is not known here
};

static bool read_numbers(const json_t *list, size_t count, double numbers[]) {
    if (!json_is_array(list) || json_array_size(list) != count)
        return false;
    for (size_t i = 0; i < count; i++) {
        const json_t *number = json_array_get(list, i);
        if (!json_is_number(number))
            return false;
        numbers[i] = json_number_value(number);
    }
    return true;
}

// The same for a member that may be absent.
static bool read_member(const json_t *object, const char *key, size_t count, double numbers[]) {
    const json_t *list = json_object_get(object, key);
    return !list || read_numbers(list, count, numbers);
}

static bool read_matrix(struct pose *pose, const json_t *value) {
    struct pel_matrix matrix;
    if (json_array_size(value) != 4)
        return false;
    for (size_t row = 0; row < 4; row++)
        if (!read_numbers(json_array_get(value, row), 4, matrix.m[row]))
            return false;
    if (!pel_matrix_is_rigid(&matrix, 1e-3))
        return false;
    pel_quaternion_from_matrix(pose->xyzw, &matrix);
    for (int i = 0; i < 3; i++)
        pose->translation[i] = matrix.m[i][3];
    return true;
}

static bool read_axis(double axis[3], const json_t *value) {
    const char *name = json_string_value(value);
    if (!name)
        return read_numbers(value, 3, axis) && pel_normalize(axis);
    for (int i = 0; i < 3; i++)
        axis[i] = name[0] == 'x' + i;
    return strlen(name) == 1 && strchr("xyz", name[0]);
}

// Adds a rotation about a point, p' = R (p - about) + about, to the pose.
static bool read_rotation(struct pose *pose, const json_t *rotate) {
    double axis[3], about[3] = {0}, moved[3];
    const json_t *degrees = json_object_get(rotate, "degrees");
    const char *named = json_string_value(json_object_get(rotate, "about"));
    pose->about_centre = named != NULL;
    if (!read_axis(axis, json_object_get(rotate, "axis")) || !json_is_number(degrees) ||
        (!named && !read_member(rotate, "about", 3, about)))
        return false;
    const double none[3] = {0};
    pel_quaternion_from_axis(pose->xyzw, axis, json_number_value(degrees) * PEL_PI / 180);
    struct pel_matrix rotation = pel_matrix_from_quaternion(pose->xyzw, none);
    pel_matrix_direction(moved, &rotation, about);
    for (int i = 0; i < 3; i++)
        pose->translation[i] += about[i] - moved[i];
    return true;
}

// False for what is no pose, or one that only a file knows.
static bool read_pose(struct pose *pose, const json_t *value) {
    *pose = (struct pose){.xyzw = {0, 0, 0, 1}};
    if (json_is_array(value))
        return read_matrix(pose, value);
    const json_t *quaternion = json_object_get(value, "quaternion");
    const json_t *rotate = json_object_get(value, "rotate");
    if (quaternion) {
        double *q = pose->xyzw;
        if (!read_numbers(quaternion, 4, q) ||
            !read_member(value, "translation", 3, pose->translation))
            return false;
        return fabs(pel_dot(q, q) + q[3] * q[3] - 1) < 1e-2;
    }
    if (!rotate && !json_object_get(value, "translate"))
        return false;
    return read_member(value, "translate", 3, pose->translation) &&
           (!rotate || read_rotation(pose, rotate));
}

static json_t *write_pose(const struct pose *pose) {
    const double *q = pose->xyzw, *t = pose->translation;
    if (!pose->about_centre)
        return json_pack("{s:[f,f,f,f], s:[f,f,f]}", "quaternion", q[0], q[1], q[2], q[3],
                         "translation", t[0], t[1], t[2]);
    double sine = pel_length(q), degrees = 2 * atan2(sine, q[3]) * 180 / PEL_PI;
    bool turned = sine > 0;
    return json_pack("{s:{s:[f,f,f], s:f, s:s}, s:[f,f,f]}", "rotate", "axis",
                     turned ? q[0] / sine : 0, turned ? q[1] / sine : 0, turned ? q[2] / sine : 1,
                     "degrees", degrees, "about", "centre", "translate", t[0], t[1], t[2]);
}

// True when both say a rotation about one axis and one point, so that only the angle differs.
static bool same_axis(const json_t *a, const json_t *b) {
    const json_t *from = json_object_get(a, "rotate"), *to = json_object_get(b, "rotate");
    const json_t *about = json_object_get(from, "about"), *about_b = json_object_get(to, "about");
    return from && to && json_equal(json_object_get(from, "axis"), json_object_get(to, "axis")) &&
           (about == about_b || json_equal(about, about_b));
}

// Returns NULL when the values are not both poses that can be mixed.
static json_t *interpolate_poses(const json_t *a, const json_t *b, double share) {
    struct pose from, to, mixed;
    if (same_axis(a, b) || !read_pose(&from, a) || !read_pose(&to, b) ||
        from.about_centre != to.about_centre)
        return NULL;
    mixed.about_centre = from.about_centre;
    pel_quaternion_slerp(mixed.xyzw, from.xyzw, to.xyzw, share);
    for (int i = 0; i < 3; i++)
        mixed.translation[i] = (1 - share) * from.translation[i] + share * to.translation[i];
    return write_pose(&mixed);
}

// ---- Values ------------------------------------------------------------------------------------

static bool same_keys(const json_t *a, const json_t *b) {
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)a, key, value) if (!json_object_get(b, key)) return false;
    return json_object_size(a) == json_object_size(b);
}

static json_t *interpolate_lists(const json_t *a, const json_t *b, double share) {
    json_t *list = json_array();
    for (size_t i = 0; list && i < json_array_size(a); i++) {
        if (json_array_append_new(
                list, pel_interpolate(json_array_get(a, i), json_array_get(b, i), share)) != 0) {
            json_decref(list);
            list = NULL;
        }
    }
    return list;
}

static json_t *interpolate_objects(const json_t *a, const json_t *b, double share) {
    json_t *object = json_object(), *value;
    const char *key;
    json_object_foreach((json_t *)a, key, value) {
        json_t *mixed = pel_interpolate(value, json_object_get(b, key), share);
        if (json_object_set_new(object, key, mixed) != 0) {
            json_decref(object);
            return NULL;
        }
    }
    return object;
}

json_t *pel_interpolate(const json_t *a, const json_t *b, double share) {
    json_t *mixed = NULL;
    bool poses = (json_is_array(a) || json_is_object(a)) && share > 0 && share < 1;
    if (poses)
        mixed = interpolate_poses(a, b, share);
    if (mixed)
        return mixed;
    if (share <= 0 || share >= 1)
        mixed = json_deep_copy(share <= 0 ? a : b);
    else if (json_is_number(a) && json_is_number(b))
        mixed = json_real((1 - share) * json_number_value(a) + share * json_number_value(b));
    else if (json_is_array(a) && json_is_array(b) && json_array_size(a) == json_array_size(b))
        mixed = interpolate_lists(a, b, share);
    else if (json_is_object(a) && json_is_object(b) && same_keys(a, b))
        mixed = interpolate_objects(a, b, share);
    else
        mixed = json_deep_copy(a);
    if (!mixed)
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a value between two others");
    return mixed;
}
