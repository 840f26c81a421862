// stereo.c - two cameras in place of one.
//
// By default both look along parallel lines and their windows shift (off-axis frusta), so that
// points at the convergence distance fall on one place of both pictures and nothing is displaced
// vertically. With t = tan(fov / 2), a point at depth z on the view's axis is seen by the camera
// that stands e to the left at u = e / (t z) half heights right of its middle; a shift of
// e / (2 t convergence) heights takes that away at the convergence distance. The difference of both
// eyes, in widths of the picture, is
//
//     disparity(z) = separation / (2 t aspect) * (1 / z - 1 / convergence)          [perspective]
//     disparity(z) = separation (convergence - z) / (convergence height aspect)     [orthographic]
//
// and positive for what is nearer: the left eye sees it further right. The orthographic one is that
// of cameras which turn by small angles. docs/stereo.md has the rule for what is left open.
#include <math.h>
#include <stddef.h>

#include "base/error.h"
#include "base/math.h"
#include "camera/camera.h"

// The nearest and the farthest visible thing are this share of the picture's width away from where
// they would be in a single picture's plane: together 1/30, the stereographers' rule.
static const double comfortable_share = 1.0 / 60;

// A scene without depth would allow any separation; more than this share of the distance strains.
static const double separation_share_max = 0.1;

// What is nearer than this share of the farthest depth, as around an eye inside a volume, does not
// count: else it would take all depth from the rest.
static const double nearest_share = 0.05;

static const char *const stereo_names[] = {
    "none",
    "true-red-cyan",
    "true-green-magenta",
    "true-amber-blue",
    "grey-red-cyan",
    "grey-green-magenta",
    "grey-amber-blue",
    "colour-red-cyan",
    "colour-green-magenta",
    "colour-amber-blue",
    "half-colour-red-cyan",
    "half-colour-green-magenta",
    "half-colour-amber-blue",
    "optimised-red-cyan",
    "optimised-green-magenta",
    "optimised-amber-blue",
    "dubois-red-cyan",
    "dubois-green-magenta",
    "dubois-amber-blue",
    "red-blue",
    "red-green",
    "thesis",
    "matrix",
    "side-by-side",
    "side-by-side-half",
    "top-bottom",
    "top-bottom-half",
    "row-interlaced",
    "column-interlaced",
    "checkerboard",
    "two-files",
    NULL,
};

// What the choice of separation and convergence depends on.
struct view {
    double forward[3], right[3], up[3];
    bool orthographic;
    double aspect;
    double half_height;  // of the picture: at distance 1, or everywhere when orthographic
    double nearest, far; // depth of what is visible; nearest < far
};

// The depth of the visible volumes along the view, or of the target where there is none before the
// camera.
static void measure_depth(struct view *view, const struct pel_scene *scene) {
    const struct pel_camera *camera = &scene->camera;
    struct pel_bounds bounds;
    double nearest = INFINITY, far = -INFINITY, to_corner[3];
    if (pel_scene_bounds(scene, &bounds)) {
        for (int corner = 0; corner < 8; corner++) {
            for (int i = 0; i < 3; i++)
                to_corner[i] = (corner >> i & 1 ? bounds.high[i] : bounds.low[i]) - camera->eye[i];
            double depth = pel_dot(to_corner, view->forward);
            nearest = fmin(nearest, depth);
            far = fmax(far, depth);
        }
    }
    if (!(far > 0)) {
        double to_target[3];
        for (int i = 0; i < 3; i++)
            to_target[i] = camera->target[i] - camera->eye[i];
        nearest = far = pel_length(to_target);
    }
    view->far = far;
    view->nearest = fmax(nearest, nearest_share * far);
}

static bool make_view(struct view *view, const struct pel_scene *scene) {
    const struct pel_camera *camera = &scene->camera;
    if (!pel_camera_basis(camera, view->forward, view->right, view->up))
        return false;
    if (scene->render.width < 1 || scene->render.height < 1)
        return pel_fail(PEL_ERROR_ARGUMENT, "a picture of %d x %d pixels", scene->render.width,
                        scene->render.height);
    view->orthographic = camera->orthographic;
    view->aspect = (double)scene->render.width / scene->render.height;
    view->half_height =
        camera->orthographic ? camera->height_mm / 2 : tan(camera->fov_deg * PEL_PI / 360);
    if (!(view->half_height > 0 && isfinite(view->half_height)))
        return pel_fail(PEL_ERROR_ARGUMENT,
                        camera->orthographic ? "an orthographic view %g mm high"
                                             : "field of view of %g degrees, outside 0..180",
                        camera->orthographic ? camera->height_mm : camera->fov_deg);
    measure_depth(view, scene);
    return true;
}

// Equal disparities, of opposite sign, for the nearest and the farthest.
static double choose_convergence(const struct view *view) {
    if (view->orthographic)
        return (view->nearest + view->far) / 2;
    return 2 / (1 / view->nearest + 1 / view->far);
}

// The separation at which the greater of both disparities is the comfortable one.
static double choose_separation(const struct view *view, double convergence) {
    double per_mm; // disparity per separation
    if (view->orthographic)
        per_mm = fmax(fabs(convergence - view->nearest), fabs(view->far - convergence)) /
                 (convergence * 2 * view->half_height * view->aspect);
    else
        per_mm =
            fmax(fabs(1 / view->nearest - 1 / convergence), fabs(1 / convergence - 1 / view->far)) /
            (2 * view->half_height * view->aspect);
    return fmin(comfortable_share / per_mm, separation_share_max * convergence);
}

static bool check_lengths(const struct pel_stereo *stereo) {
    if (!(stereo->separation_mm >= 0 && isfinite(stereo->separation_mm)))
        return pel_fail(PEL_ERROR_ARGUMENT, "a separation of %g mm; swap exchanges the eyes",
                        stereo->separation_mm);
    if (!(stereo->convergence_mm >= 0 && isfinite(stereo->convergence_mm)))
        return pel_fail(PEL_ERROR_ARGUMENT, "a convergence of %g mm", stereo->convergence_mm);
    return true;
}

// The camera that stands `offset` millimetres to the right of the scene's.
static struct pel_camera make_camera(const struct pel_camera *middle, const struct view *view,
                                     double offset, const struct pel_stereo *stereo) {
    struct pel_camera camera = *middle;
    bool turn = stereo->toe_in || middle->orthographic;
    for (int i = 0; i < 3 && offset != 0; i++) {
        camera.eye[i] += offset * view->right[i];
        if (turn)
            camera.target[i] = middle->eye[i] + stereo->convergence_mm * view->forward[i];
        else
            camera.target[i] += offset * view->right[i];
    }
    if (!turn)
        camera.shift[0] -= offset / (2 * view->half_height * stereo->convergence_mm);
    return camera;
}

const char *const *pel_stereo_names(void) {
    return stereo_names;
}

bool pel_stereo_cameras(const struct pel_scene *scene, struct pel_camera cameras[2],
                        struct pel_stereo *used) {
    struct pel_stereo stereo = scene->stereo;
    struct view view;
    if (!check_lengths(&stereo) || !make_view(&view, scene))
        return false;
    if (stereo.convergence_mm == 0)
        stereo.convergence_mm = choose_convergence(&view);
    if (stereo.flat || stereo.kind == PEL_STEREO_NONE)
        stereo.separation_mm = 0;
    else if (stereo.separation_mm == 0)
        stereo.separation_mm = choose_separation(&view, stereo.convergence_mm);

    double half = stereo.separation_mm / 2;
    cameras[stereo.swap] = make_camera(&scene->camera, &view, -half, &stereo);
    cameras[!stereo.swap] = make_camera(&scene->camera, &view, half, &stereo);
    if (used)
        *used = stereo;
    return true;
}
