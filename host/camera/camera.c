// camera.c - a camera's axes, and cameras that show all of a box or of some points.
#include "camera/camera.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/text.h"

// The share of the picture's half height and half width that what is fitted reaches.
static const double filled = 0.95;

// Where the eye is, seen from the target, and what is up there. RAS: x right, y anterior, z
// superior. From below anterior is up, as radiologists look at axial slices.
static const struct {
    double eye[3], up[3];
} views[] = {
    {{0, 1, 0}, {0, 0, 1}},         // anterior
    {{0, -1, 0}, {0, 0, 1}},        // posterior
    {{-1, 0, 0}, {0, 0, 1}},        // left
    {{1, 0, 0}, {0, 0, 1}},         // right
    {{0, 0, 1}, {0, 1, 0}},         // superior
    {{0, 0, -1}, {0, 1, 0}},        // inferior
    {{0.55, 0.75, 0.4}, {0, 0, 1}}, // oblique: from anterior, right, and a little above
};

static const char *const view_names[] = {"anterior", "posterior", "left",    "right",
                                         "superior", "inferior",  "oblique", NULL};

static int find_view(const char *name) {
    for (int i = 0; view_names[i]; i++)
        if (strcmp(name, view_names[i]) == 0)
            return i;
    const char *nearest = pel_text_nearest(name, view_names);
    char list[128];
    pel_text_list(list, sizeof list, view_names, pel_text_count(view_names), " and ");
    if (nearest)
        pel_fail(PEL_ERROR_ARGUMENT, "no view '%.32s'; did you mean '%s'", name, nearest);
    else
        pel_fail(PEL_ERROR_ARGUMENT, "no view '%.32s'; there are %s", name, list);
    return -1;
}

// What must be known of points to show them: seen from their middle, how far the eye must at least
// be for them to be in a perspective picture of these half extents at distance 1, how far for them
// to lie before the eye, and the half extents of an orthographic one.
struct fit {
    double middle[3]; // in the world
    double distance, front, half_width, half_height, half_depth;
};

// The middle is that of the points' extents along the axes, so that they reach as far to the left
// as to the right, and those of a box its own.
static void find_middle(struct fit *fit, size_t count, const double (*points)[3],
                        const double axes[3][3]) {
    double half[3];
    memset(fit->middle, 0, sizeof fit->middle);
    for (int axis = 0; axis < 3; axis++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < count; i++) {
            double at = pel_dot(points[i], axes[axis]);
            low = fmin(low, at);
            high = fmax(high, at);
        }
        half[axis] = (high - low) / 2;
        for (int i = 0; i < 3; i++)
            fit->middle[i] += (low + half[axis]) * axes[axis][i];
    }
    fit->half_width = half[0];
    fit->half_height = half[1];
    fit->half_depth = half[2];
}

static struct fit fit_points(size_t count, const double (*points)[3], const double axes[3][3],
                             double half_width, double half_height) {
    struct fit fit = {.distance = 0};
    find_middle(&fit, count, points, axes);
    for (size_t i = 0; i < count; i++) {
        double p[3];
        for (int axis = 0; axis < 3; axis++)
            p[axis] = points[i][axis] - fit.middle[axis];
        double x = fabs(pel_dot(p, axes[0])), y = fabs(pel_dot(p, axes[1]));
        double depth = pel_dot(p, axes[2]);
        fit.front = fmax(fit.front, -depth);
        fit.distance = fmax(fit.distance, fmax(x / half_width, y / half_height) - depth);
    }
    return fit;
}

bool pel_camera_basis(const struct pel_camera *camera, double forward[3], double right[3],
                      double up[3]) {
    double wanted[3];
    for (int i = 0; i < 3; i++) {
        forward[i] = camera->target[i] - camera->eye[i];
        wanted[i] = camera->up[i];
    }
    if (!pel_normalize(forward))
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "the camera's eye and target are one point, or not finite");
    if (!pel_normalize(wanted))
        return pel_fail(PEL_ERROR_ARGUMENT, "the camera's up vector is zero");
    pel_cross(right, forward, wanted);
    // Less than this sine of their angle and the roll would be made of rounding errors.
    if (!(pel_length(right) > 1e-6) || !pel_normalize(right))
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "the camera looks along its up vector (%g, %g, %g), which leaves its roll "
                        "open",
                        camera->up[0], camera->up[1], camera->up[2]);
    pel_cross(up, right, forward);
    return pel_normalize(up);
}

bool pel_camera_fit_points(struct pel_camera *camera, const char *view, size_t count,
                           const double (*points)[3], double aspect) {
    int index = find_view(view);
    if (index < 0)
        return false;
    if (camera->fov_deg == 0)
        camera->fov_deg = PEL_CAMERA_FOV_DEFAULT_DEG;
    if (!(aspect > 0 && isfinite(aspect)))
        return pel_fail(PEL_ERROR_ARGUMENT, "aspect ratio %g is not positive", aspect);
    if (!camera->orthographic && !(camera->fov_deg > 0 && camera->fov_deg < 180))
        return pel_fail(PEL_ERROR_ARGUMENT, "field of view of %g degrees is outside 0..180",
                        camera->fov_deg);

    // Look at the world's origin from one millimetre away to learn the axes.
    double back[3], axes[3][3];
    memcpy(back, views[index].eye, sizeof back);
    pel_normalize(back);
    memset(camera->target, 0, sizeof camera->target);
    memcpy(camera->eye, back, sizeof camera->eye);
    memcpy(camera->up, views[index].up, sizeof camera->up);
    if (!pel_camera_basis(camera, axes[2], axes[0], axes[1]))
        return false;

    double half = camera->orthographic ? 1 : filled * tan(camera->fov_deg * PEL_PI / 360);
    struct fit fit = fit_points(count, points, axes, half * aspect, half);
    double distance = fit.distance;
    if (camera->orthographic) {
        double height = 2 * fmax(fit.half_height, fit.half_width / aspect) / filled;
        camera->height_mm = height > 0 ? height : 1;
        distance = 0;
    }
    // The points stay before the eye, even where they are a line or one point.
    double radius = hypot(hypot(fit.half_width, fit.half_height), fit.half_depth);
    if (!(distance > fit.front * (1 + 1e-9)))
        distance = fit.front + fmax(radius, 1);
    for (int i = 0; i < 3; i++) {
        camera->target[i] = fit.middle[i];
        camera->eye[i] = fit.middle[i] + distance * back[i];
    }
    return true;
}

bool pel_camera_fit(struct pel_camera *camera, const char *view, const struct pel_bounds *bounds,
                    double aspect) {
    double corners[8][3];
    for (int i = 0; i < 3; i++) {
        if (!(bounds->low[i] <= bounds->high[i]) || !isfinite(bounds->high[i] - bounds->low[i]))
            return pel_fail(PEL_ERROR_ARGUMENT, "bounds from %g to %g are not a box",
                            bounds->low[i], bounds->high[i]);
        for (int corner = 0; corner < 8; corner++)
            corners[corner][i] = corner >> i & 1 ? bounds->high[i] : bounds->low[i];
    }
    return pel_camera_fit_points(camera, view, 8, corners, aspect);
}

struct pel_camera pel_camera_part(const struct pel_camera *whole, double aspect,
                                  const double place[4]) {
    // u = u_whole - 2 shift, in half heights of the part: see docs/picture.md, "Rays".
    struct pel_camera part = *whole;
    double right = aspect * (2 * place[0] + place[2] - 1), up = 1 - 2 * place[1] - place[3];
    part.shift[0] = (right / 2 + whole->shift[0]) / place[3];
    part.shift[1] = (up / 2 + whole->shift[1]) / place[3];
    part.height_mm = whole->height_mm * place[3];
    part.fov_deg = 2 * atan(tan(whole->fov_deg * PEL_PI / 360) * place[3]) * 180 / PEL_PI;
    return part;
}
