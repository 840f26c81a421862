// view.c - rays of pixels, pixels of points.
#include "viewer/view.h"

#include "viewer/vector.h"

// Half the height of the picture: at distance 1 of a pin-hole camera, anywhere of a parallel one.
static double half_height(const struct pel_camera *camera) {
    return camera->orthographic ? camera->height_mm / 2 : tan(radians(camera->fov_deg) / 2);
}

bool pel_view_make(struct pel_view *view, const struct pel_camera *camera, int width, int height) {
    *view = (struct pel_view){.camera = *camera, .width = width, .height = height};
    vector_subtract(view->forward, camera->target, camera->eye);
    if (width < 1 || height < 1 || !vector_normalize(view->forward))
        return false;
    vector_cross(view->right, view->forward, camera->up);
    if (!vector_normalize(view->right))
        return false;
    vector_cross(view->up, view->right, view->forward);
    return true;
}

struct pel_view_ray pel_view_ray(const struct pel_view *view, const double pixel[2]) {
    const struct pel_camera *camera = &view->camera;
    double aspect = view->width / view->height, half = half_height(camera);
    double u = half * ((2 * pixel[0] / view->width - 1) * aspect + 2 * camera->shift[0]);
    double v = half * (1 - 2 * pixel[1] / view->height + 2 * camera->shift[1]);
    struct pel_view_ray ray;
    vector_set(ray.origin, camera->eye);
    vector_set(ray.direction, view->forward);
    double *moved = camera->orthographic ? ray.origin : ray.direction;
    vector_add_scaled(moved, moved, u, view->right);
    vector_add_scaled(moved, moved, v, view->up);
    vector_normalize(ray.direction);
    return ray;
}

bool pel_view_project(const struct pel_view *view, const double point[3], double pixel[2]) {
    const struct pel_camera *camera = &view->camera;
    double from_eye[3], aspect = view->width / view->height;
    vector_subtract(from_eye, point, camera->eye);
    double depth = vector_dot(from_eye, view->forward);
    double unit = half_height(camera) * (camera->orthographic ? 1 : depth);
    if (!(depth > 0) || !(unit > 0))
        return false;
    double u = vector_dot(from_eye, view->right) / unit, v = vector_dot(from_eye, view->up) / unit;
    pixel[0] = ((u - 2 * camera->shift[0]) / aspect + 1) / 2 * view->width;
    pixel[1] = (1 - v + 2 * camera->shift[1]) / 2 * view->height;
    return true;
}

double pel_view_mm_per_px(const struct pel_view *view, const double point[3]) {
    double from_eye[3], height = 2 * half_height(&view->camera) / view->height;
    vector_subtract(from_eye, point, view->camera.eye);
    return view->camera.orthographic ? height : height * vector_dot(from_eye, view->forward);
}

double pel_view_target_mm_per_px(const struct pel_view *view) {
    return pel_view_mm_per_px(view, view->camera.target);
}

bool pel_view_meet_plane(double meeting[3], const struct pel_view_ray *ray, const double point[3],
                         const double normal[3]) {
    double to_plane[3], along = vector_dot(ray->direction, normal);
    vector_subtract(to_plane, point, ray->origin);
    double t = vector_dot(to_plane, normal) / along;
    if (!isfinite(t) || t < 0)
        return false;
    vector_add_scaled(meeting, ray->origin, t, ray->direction);
    return true;
}

bool pel_view_nearest_on_axis(double *s, const struct pel_view_ray *ray, const double point[3],
                              const double axis[3]) {
    // Both lines are perpendicular to the shortest way between them: two equations for s and t.
    double between[3], cosine = vector_dot(ray->direction, axis);
    vector_subtract(between, ray->origin, point);
    double sine_squared = 1 - cosine * cosine;
    if (!(sine_squared > 1e-9))
        return false;
    *s = (vector_dot(between, axis) - cosine * vector_dot(between, ray->direction)) / sine_squared;
    return true;
}
