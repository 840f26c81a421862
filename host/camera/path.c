// path.c - cameras on their way between others.
#include "camera/path.h"

#include "base/math.h"
#include "base/quaternion.h"
#include "camera/camera.h"

static double mix(double a, double b, double share) {
    return (1 - share) * a + share * b;
}

// The rotation from the world's axes to the camera's right, up and backward ones.
static bool read_axes(double xyzw[4], const struct pel_camera *camera) {
    struct pel_matrix axes = pel_matrix_identity();
    double forward[3], right[3], up[3];
    if (!pel_camera_basis(camera, forward, right, up))
        return false;
    for (int i = 0; i < 3; i++) {
        axes.m[i][0] = right[i];
        axes.m[i][1] = up[i];
        axes.m[i][2] = -forward[i];
    }
    pel_quaternion_from_matrix(xyzw, &axes);
    return true;
}

static double distance(const struct pel_camera *camera) {
    double way[3];
    for (int i = 0; i < 3; i++)
        way[i] = camera->eye[i] - camera->target[i];
    return pel_length(way);
}

bool pel_camera_between(struct pel_camera *camera, const struct pel_camera *a,
                        const struct pel_camera *b, double share) {
    double from[4], to[4], axes[4];
    const double none[3] = {0};
    if (!read_axes(from, a) || !read_axes(to, b))
        return false;
    pel_quaternion_slerp(axes, from, to, share);
    struct pel_matrix turned = pel_matrix_from_quaternion(axes, none);
    double away = mix(distance(a), distance(b), share);
    struct pel_camera between = *a;
    for (int i = 0; i < 3; i++) {
        between.target[i] = mix(a->target[i], b->target[i], share);
        between.eye[i] = between.target[i] + away * turned.m[i][2];
        between.up[i] = turned.m[i][1];
    }
    between.fov_deg = mix(a->fov_deg, b->fov_deg, share);
    between.height_mm = mix(a->height_mm, b->height_mm, share);
    for (int i = 0; i < 2; i++)
        between.shift[i] = mix(a->shift[i], b->shift[i], share);
    *camera = between;
    return true;
}

void pel_camera_orbit(struct pel_camera *camera, const double axis[3], double radians) {
    double xyzw[4], away[3];
    const double none[3] = {0};
    pel_quaternion_from_axis(xyzw, axis, radians);
    struct pel_matrix rotation = pel_matrix_from_quaternion(xyzw, none);
    for (int i = 0; i < 3; i++)
        away[i] = camera->eye[i] - camera->target[i];
    pel_matrix_direction(away, &rotation, away);
    for (int i = 0; i < 3; i++)
        camera->eye[i] = camera->target[i] + away[i];
    pel_matrix_direction(camera->up, &rotation, camera->up);
}
