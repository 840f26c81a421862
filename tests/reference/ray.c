// ray.c - docs/picture.md, "Rays" and "Boxes and spans".
#include "reference/ray.h"

#include <math.h>

#include "base/math.h"

struct reference_ray reference_camera_ray(const struct pel_camera *camera, int width, int height,
                                          double x_px, double y_px) {
    double forward[3], right[3], up[3];
    for (int c = 0; c < 3; c++)
        forward[c] = camera->target[c] - camera->eye[c];
    pel_normalize(forward);
    pel_cross(right, forward, camera->up);
    pel_normalize(right);
    pel_cross(up, right, forward);

    double u = (2 * (x_px + 0.5) / width - 1) * width / height + 2 * camera->shift[0];
    double v = 1 - 2 * (y_px + 0.5) / height + 2 * camera->shift[1];

    struct reference_ray ray;
    double tangent = tan(camera->fov_deg * PEL_PI / 360);
    for (int c = 0; c < 3; c++) {
        double offset = u * right[c] + v * up[c];
        if (camera->orthographic) {
            ray.origin[c] = camera->eye[c] + camera->height_mm / 2 * offset;
            ray.direction[c] = forward[c];
        } else {
            ray.origin[c] = camera->eye[c];
            ray.direction[c] = forward[c] + tangent * offset;
        }
    }
    pel_normalize(ray.direction);
    return ray;
}

struct reference_ray reference_map_ray(const struct pel_matrix *matrix,
                                       const struct reference_ray *ray) {
    struct reference_ray mapped;
    pel_matrix_point(mapped.origin, matrix, ray->origin);
    pel_matrix_direction(mapped.direction, matrix, ray->direction);
    return mapped;
}

struct reference_span reference_clip(const struct reference_ray *ray, const double low[3],
                                     const double high[3]) {
    struct reference_span span = {0, INFINITY};
    for (int c = 0; c < 3; c++) {
        double origin = ray->origin[c], direction = ray->direction[c];
        if (direction == 0) {
            // Parallel to this slab: inside for good or never.
            if (origin < low[c] || origin >= high[c])
                span.t_out = 0;
            continue;
        }
        double t_low = (low[c] - origin) / direction;
        double t_high = (high[c] - origin) / direction;
        span.t_in = fmax(span.t_in, fmin(t_low, t_high));
        span.t_out = fmin(span.t_out, fmax(t_low, t_high));
    }
    return span;
}

void reference_point_at(double point[3], const struct reference_ray *ray, double t) {
    for (int c = 0; c < 3; c++)
        point[c] = ray->origin[c] + t * ray->direction[c];
}
