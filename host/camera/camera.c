// camera.c - a camera's axes, and cameras that show all of a box.
#include "camera/camera.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/text.h"

// The share of the picture's half height and half width that a fitted box reaches.
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
    if (nearest)
        pel_fail(PEL_ERROR_ARGUMENT, "no view '%.32s'; did you mean '%s'", name, nearest);
    else
        pel_fail(PEL_ERROR_ARGUMENT,
                 "no view '%.32s'; there are anterior, posterior, left, right, superior, inferior "
                 "and oblique",
                 name);
    return -1;
}

// What must be known of a box to show it: seen from its centre, how far the eye must at least be
// for its corners to be in a perspective picture of these half extents at distance 1, how far for
// them to lie before the eye, and the half extents of an orthographic one.
struct fit {
    double distance, front, half_width, half_height;
};

static struct fit fit_corners(const struct pel_bounds *bounds, const double axes[3][3],
                              double half_width, double half_height) {
    struct fit fit = {0};
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = (corner >> i & 1 ? 0.5 : -0.5) * (bounds->high[i] - bounds->low[i]);
        double x = fabs(pel_dot(p, axes[0])), y = fabs(pel_dot(p, axes[1]));
        double depth = pel_dot(p, axes[2]);
        fit.front = fmax(fit.front, -depth);
        fit.half_width = fmax(fit.half_width, x);
        fit.half_height = fmax(fit.half_height, y);
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

bool pel_camera_fit(struct pel_camera *camera, const char *view, const struct pel_bounds *bounds,
                    double aspect) {
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
    double radius = 0;
    for (int i = 0; i < 3; i++) {
        if (!(bounds->low[i] <= bounds->high[i]) || !isfinite(bounds->high[i] - bounds->low[i]))
            return pel_fail(PEL_ERROR_ARGUMENT, "bounds from %g to %g are not a box",
                            bounds->low[i], bounds->high[i]);
        radius = hypot(radius, (bounds->high[i] - bounds->low[i]) / 2);
    }

    // Look at the box's centre from one millimetre away to learn the axes.
    double back[3], axes[3][3];
    memcpy(back, views[index].eye, sizeof back);
    pel_normalize(back);
    memset(camera->target, 0, sizeof camera->target);
    memcpy(camera->eye, back, sizeof camera->eye);
    memcpy(camera->up, views[index].up, sizeof camera->up);
    if (!pel_camera_basis(camera, axes[2], axes[0], axes[1]))
        return false;

    double half = camera->orthographic ? 1 : filled * tan(camera->fov_deg * PEL_PI / 360);
    struct fit fit = fit_corners(bounds, axes, half * aspect, half);
    double distance = fit.distance;
    if (camera->orthographic) {
        double height = 2 * fmax(fit.half_height, fit.half_width / aspect) / filled;
        camera->height_mm = height > 0 ? height : 1;
        distance = 0;
    }
    // The box stays before the eye, even where it is a line or a point.
    if (!(distance > fit.front * (1 + 1e-9)))
        distance = fit.front + fmax(radius, 1);
    for (int i = 0; i < 3; i++) {
        camera->target[i] = bounds->low[i] + (bounds->high[i] - bounds->low[i]) / 2;
        camera->eye[i] = camera->target[i] + distance * back[i];
    }
    return true;
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
