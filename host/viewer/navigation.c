// navigation.c - how a hand moves a camera.
//
// All turns go through `turn`, which rotates eye, target and up by one quaternion about a point and
// then takes rounding errors out of `up`. Sizes on the screen are compared at the target: `span` is
// what the picture's height covers there, in millimetres, for both kinds of camera.
#include "viewer/navigation.h"

#include <string.h>

#include "viewer/vector.h"

static const char *const mode_names[] = {"orbit", "trackball", "fly", NULL};
static const char *const view_names[] = {"anterior", "posterior", "left", "right",
                                         "superior", "inferior",  NULL};

// A drag over the picture's height goes so many times closer, and a click of the wheel.
static const double zoom_over_height = 10, zoom_per_click = 1.1;

// What the picture's height may cover, in millimetres.
static const double span_min_mm = 1e-3, span_max_mm = 1e8;

// The share of the picture that a fitted box reaches, as pel_camera_fit has it.
static const double filled = 0.95;

static double distance_of(const struct pel_camera *camera) {
    return vector_distance(camera->eye, camera->target);
}

static double span_of(const struct pel_camera *camera) {
    return camera->orthographic ? camera->height_mm
                                : 2 * distance_of(camera) * tan(radians(camera->fov_deg) / 2);
}

// The camera's axes. A camera that has none gets some: hands must not be able to lose it.
static void axes_of(const struct pel_camera *camera, double right[3], double up[3],
                    double forward[3]) {
    vector_subtract(forward, camera->target, camera->eye);
    if (!vector_normalize(forward))
        vector_set(forward, (double[]){0, -1, 0});
    vector_cross(right, forward, camera->up);
    for (int axis = 0; axis < 3 && !(vector_length(right) > 1e-9); axis++) {
        double other[3] = {0};
        other[axis] = 1;
        vector_cross(right, forward, other);
    }
    vector_normalize(right);
    vector_cross(up, right, forward);
}

static void straighten(struct pel_camera *camera) {
    double right[3], up[3], forward[3];
    axes_of(camera, right, up, forward);
    vector_set(camera->up, up);
}

// Puts the eye at a distance from the target, in the direction where it is.
static void set_distance(struct pel_camera *camera, double distance) {
    double right[3], up[3], forward[3];
    axes_of(camera, right, up, forward);
    vector_add_scaled(camera->eye, camera->target, -distance, forward);
}

static void turn(struct pel_camera *camera, const double pivot[3], const double q[4]) {
    double *points[2] = {camera->eye, camera->target};
    for (int i = 0; i < 2; i++) {
        double arm[3];
        vector_subtract(arm, points[i], pivot);
        quaternion_rotate(arm, q, arm);
        vector_add(points[i], pivot, arm);
    }
    quaternion_rotate(camera->up, q, camera->up);
    straighten(camera);
}

static void turn_about(struct pel_camera *camera, const double pivot[3], const double axis[3],
                       double angle_rad) {
    double q[4];
    quaternion_turn(q, axis, angle_rad);
    turn(camera, pivot, q);
}

// Goes closer by a factor (below 1) or away, with a point before the eye that stays in its place of
// the picture. Parallel rays begin at the eye, so there it keeps its distance.
static void scale_about(struct pel_camera *camera, const double fixed[3], double factor) {
    double span = span_of(camera);
    factor = fmin(fmax(factor, span_min_mm / span), span_max_mm / span);
    double arm[3], moved[3];
    vector_subtract(arm, camera->target, fixed);
    vector_scale(moved, arm, factor - 1);
    if (camera->orthographic) {
        camera->height_mm *= factor;
        vector_add(camera->eye, camera->eye, moved);
    } else {
        vector_subtract(arm, camera->eye, fixed);
        vector_add_scaled(camera->eye, fixed, factor, arm);
    }
    vector_add(camera->target, camera->target, moved);
}

static bool view_of(struct pel_view *view, const struct pel_camera *camera, const int size[2]) {
    return pel_view_make(view, camera, size[0], size[1]);
}

const char *const *pel_navigation_mode_names(void) {
    return mode_names;
}

const char *const *pel_navigation_view_names(void) {
    return view_names;
}

void pel_navigation_start(struct pel_navigation *navigation, const struct pel_camera *camera) {
    *navigation = (struct pel_navigation){.camera = *camera, .home = *camera};
    straighten(&navigation->camera);
}

void pel_navigation_set(struct pel_navigation *navigation, const struct pel_camera *camera) {
    navigation->camera = *camera;
    navigation->duration_s = 0;
    straighten(&navigation->camera);
}

// ---- Drags -------------------------------------------------------------------------------------

void pel_navigation_begin(struct pel_navigation *navigation) {
    navigation->duration_s = 0;
    navigation->upside_down = vector_dot(navigation->camera.up, navigation->home.up) < 0;
}

// As a globe: about the upright axis of the scene, then about the picture's horizontal one.
static void orbit(struct pel_navigation *navigation, double right_rad, double down_rad) {
    struct pel_camera *camera = &navigation->camera;
    double right[3], up[3], forward[3], vertical[3], pivot[3];
    vector_set(pivot, camera->target);
    axes_of(camera, right, up, forward);
    turn_about(camera, pivot, right, -down_rad);
    vector_set(vertical, navigation->home.up);
    if (vector_normalize(vertical))
        turn_about(camera, pivot, vertical, navigation->upside_down ? right_rad : -right_rad);
}

// As a ball that rolls under the hand: about the line in the picture across the way of the hand.
static void roll_ball(struct pel_camera *camera, double right_rad, double down_rad) {
    double right[3], up[3], forward[3], axis[3], pivot[3];
    vector_set(pivot, camera->target);
    axes_of(camera, right, up, forward);
    vector_scale(axis, right, -down_rad);
    vector_add_scaled(axis, axis, -right_rad, up);
    if (vector_normalize(axis))
        turn_about(camera, pivot, axis, hypot(right_rad, down_rad));
}

// Turns the camera where it stands so that what was under the pointer stays under it.
static void look(struct pel_camera *camera, const int size[2], const double from_px[2],
                 const double to_px[2]) {
    struct pel_view view;
    struct pel_camera pinhole = *camera;
    pinhole.orthographic = false;
    if (!view_of(&view, &pinhole, size))
        return;
    struct pel_view_ray from = pel_view_ray(&view, from_px), to = pel_view_ray(&view, to_px);
    double axis[3], pivot[3];
    vector_set(pivot, camera->eye);
    vector_cross(axis, to.direction, from.direction);
    double angle = atan2(vector_length(axis), vector_dot(to.direction, from.direction));
    if (vector_normalize(axis))
        turn_about(camera, pivot, axis, angle);
}

void pel_navigation_rotate(struct pel_navigation *navigation, const int size[2],
                           const double from_px[2], const double to_px[2]) {
    double right_rad = VECTOR_PI * (to_px[0] - from_px[0]) / size[1];
    double down_rad = VECTOR_PI * (to_px[1] - from_px[1]) / size[1];
    navigation->duration_s = 0;
    if (navigation->mode == PEL_NAVIGATION_ORBIT)
        orbit(navigation, right_rad, down_rad);
    else if (navigation->mode == PEL_NAVIGATION_TRACKBALL)
        roll_ball(&navigation->camera, right_rad, down_rad);
    else
        look(&navigation->camera, size, from_px, to_px);
}

void pel_navigation_pan(struct pel_navigation *navigation, const int size[2],
                        const double from_px[2], const double to_px[2]) {
    struct pel_camera *camera = &navigation->camera;
    double mm_per_px = span_of(camera) / size[1];
    double right[3], up[3], forward[3], moved[3];
    navigation->duration_s = 0;
    axes_of(camera, right, up, forward);
    vector_scale(moved, right, (from_px[0] - to_px[0]) * mm_per_px);
    vector_add_scaled(moved, moved, (to_px[1] - from_px[1]) * mm_per_px, up);
    vector_add(camera->eye, camera->eye, moved);
    vector_add(camera->target, camera->target, moved);
}

void pel_navigation_zoom(struct pel_navigation *navigation, const int size[2],
                         const double from_px[2], const double to_px[2]) {
    navigation->duration_s = 0;
    scale_about(&navigation->camera, navigation->camera.target,
                pow(zoom_over_height, (to_px[1] - from_px[1]) / size[1]));
}

void pel_navigation_roll(struct pel_navigation *navigation, const int size[2],
                         const double from_px[2], const double to_px[2]) {
    double from = atan2(from_px[1] - size[1] / 2.0, from_px[0] - size[0] / 2.0);
    double to = atan2(to_px[1] - size[1] / 2.0, to_px[0] - size[0] / 2.0);
    navigation->duration_s = 0;
    // Clockwise in the picture, as its y goes down; the camera turns against it.
    pel_navigation_tilt(navigation, -remainder(to - from, 2 * VECTOR_PI) * 180 / VECTOR_PI);
}

void pel_navigation_wheel(struct pel_navigation *navigation, const int size[2],
                          const double at_px[2], double clicks) {
    struct pel_camera *camera = &navigation->camera;
    struct pel_view view;
    double fixed[3];
    navigation->duration_s = 0;
    if (!view_of(&view, camera, size))
        return;
    struct pel_view_ray ray = pel_view_ray(&view, at_px);
    if (!pel_view_meet_plane(fixed, &ray, camera->target, view.forward))
        vector_set(fixed, camera->target);
    scale_about(camera, fixed, pow(zoom_per_click, -clicks));
}

// ---- Keys --------------------------------------------------------------------------------------

void pel_navigation_turn(struct pel_navigation *navigation, double right_deg, double up_deg) {
    struct pel_camera *camera = &navigation->camera;
    double right[3], up[3], forward[3], pivot[3];
    navigation->duration_s = 0;
    if (navigation->mode == PEL_NAVIGATION_ORBIT) {
        pel_navigation_begin(navigation);
        orbit(navigation, -radians(right_deg), radians(up_deg));
        return;
    }
    // Looking to the right is a clockwise turn about up; the eye that goes to the right round the
    // target turns the other way.
    double sign = navigation->mode == PEL_NAVIGATION_FLY ? 1 : -1;
    vector_set(pivot, navigation->mode == PEL_NAVIGATION_FLY ? camera->eye : camera->target);
    axes_of(camera, right, up, forward);
    turn_about(camera, pivot, up, -sign * radians(right_deg));
    axes_of(camera, right, up, forward);
    turn_about(camera, pivot, right, sign * radians(up_deg));
}

void pel_navigation_tilt(struct pel_navigation *navigation, double clockwise_deg) {
    struct pel_camera *camera = &navigation->camera;
    double right[3], up[3], forward[3], pivot[3];
    navigation->duration_s = 0;
    vector_set(pivot, camera->eye);
    axes_of(camera, right, up, forward);
    turn_about(camera, pivot, forward, radians(clockwise_deg));
}

void pel_navigation_move(struct pel_navigation *navigation, const double right_up_forward[3]) {
    struct pel_camera *camera = &navigation->camera;
    double right[3], up[3], forward[3], moved[3], distance = distance_of(camera);
    double span = camera->orthographic ? span_of(camera) : distance;
    navigation->duration_s = 0;
    axes_of(camera, right, up, forward);
    vector_scale(moved, right, right_up_forward[0] * span);
    vector_add_scaled(moved, moved, right_up_forward[1] * span, up);
    // Parallel rays look the same from nearer; there, forward makes things larger.
    if (camera->orthographic)
        scale_about(camera, camera->target, exp(-right_up_forward[2]));
    else
        vector_add_scaled(moved, moved, right_up_forward[2] * distance, forward);
    vector_add(camera->eye, camera->eye, moved);
    vector_add(camera->target, camera->target, moved);
}

// ---- Places ------------------------------------------------------------------------------------

// Half the size of a box.
static double radius_of(const struct pel_bounds *bounds) {
    return vector_distance(bounds->low, bounds->high) / 2;
}

static bool is_box(const struct pel_bounds *bounds) {
    for (int i = 0; i < 3; i++)
        if (!(bounds->low[i] <= bounds->high[i]) || !isfinite(bounds->high[i] - bounds->low[i]))
            return false;
    return true;
}

bool pel_navigation_view(struct pel_navigation *navigation, const char *name,
                         const struct pel_bounds *bounds, double aspect, double seconds) {
    struct pel_camera camera = navigation->camera;
    if (!pel_camera_fit(&camera, name, bounds, aspect))
        return false;
    pel_navigation_go(navigation, &camera, seconds);
    return true;
}

bool pel_navigation_fit(struct pel_navigation *navigation, const struct pel_bounds *bounds,
                        double aspect, double seconds) {
    struct pel_camera camera = navigation->camera;
    double right[3], up[3], forward[3];
    if (!is_box(bounds) || !(aspect > 0))
        return false;
    axes_of(&camera, right, up, forward);
    // The corners, seen from the box's centre: how far the eye must be for the steepest of them to
    // be in the picture, and how high the picture of parallel rays must be.
    double half = filled * tan(radians(camera.fov_deg) / 2), distance = 0, front = 0, height = 0;
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int i = 0; i < 3; i++)
            p[i] = (corner >> i & 1 ? 0.5 : -0.5) * (bounds->high[i] - bounds->low[i]);
        double reach = fmax(fabs(vector_dot(p, up)), fabs(vector_dot(p, right)) / aspect);
        double depth = vector_dot(p, forward);
        front = fmax(front, -depth);
        height = fmax(height, 2 * reach / filled);
        distance = fmax(distance, reach / half - depth);
    }
    for (int i = 0; i < 3; i++)
        camera.target[i] = bounds->low[i] + (bounds->high[i] - bounds->low[i]) / 2;
    if (camera.orthographic) {
        camera.height_mm = height > 0 ? height : 1;
        distance = 0;
    }
    if (!(distance > front))
        distance = front + fmax(radius_of(bounds), 1);
    vector_add_scaled(camera.eye, camera.target, -distance, forward);
    pel_navigation_go(navigation, &camera, seconds);
    return true;
}

void pel_navigation_reset(struct pel_navigation *navigation, double seconds) {
    pel_navigation_go(navigation, &navigation->home, seconds);
}

void pel_navigation_toggle_orthographic(struct pel_navigation *navigation,
                                        const struct pel_bounds *bounds) {
    struct pel_camera *camera = &navigation->camera;
    double span = span_of(camera);
    navigation->duration_s = 0;
    camera->orthographic = !camera->orthographic;
    if (!(camera->fov_deg > 0 && camera->fov_deg < 180))
        camera->fov_deg = 30;
    if (!camera->orthographic) {
        set_distance(camera, span / 2 / tan(radians(camera->fov_deg) / 2));
        return;
    }
    camera->height_mm = span;
    if (!bounds || !is_box(bounds))
        return;
    double centre[3], right[3], up[3], forward[3], to_centre[3];
    for (int i = 0; i < 3; i++)
        centre[i] = bounds->low[i] + (bounds->high[i] - bounds->low[i]) / 2;
    axes_of(camera, right, up, forward);
    vector_subtract(to_centre, camera->target, centre);
    double needed = vector_dot(to_centre, forward) + 1.001 * radius_of(bounds);
    set_distance(camera, fmax(distance_of(camera), needed));
}

void pel_navigation_set_fov(struct pel_navigation *navigation, double fov_deg) {
    struct pel_camera *camera = &navigation->camera;
    double span = span_of(camera);
    navigation->duration_s = 0;
    camera->fov_deg = fmin(fmax(fov_deg, 1), 170);
    if (!camera->orthographic)
        set_distance(camera, span / 2 / tan(radians(camera->fov_deg) / 2));
}

void pel_navigation_store(struct pel_navigation *navigation, int slot) {
    if (slot < 0 || slot >= PEL_VIEWPOINT_COUNT)
        return;
    navigation->viewpoints[slot].set = true;
    navigation->viewpoints[slot].camera = navigation->camera;
}

bool pel_navigation_recall(struct pel_navigation *navigation, int slot, double seconds) {
    if (slot < 0 || slot >= PEL_VIEWPOINT_COUNT || !navigation->viewpoints[slot].set)
        return false;
    pel_navigation_go(navigation, &navigation->viewpoints[slot].camera, seconds);
    return true;
}

// ---- Transitions -------------------------------------------------------------------------------

// The turn that takes one camera's axes to another's, as an angle about an axis.
static double turn_between(const struct pel_camera *first, const struct pel_camera *second,
                           double axis[3]) {
    double a[3][3], b[3][3], m[3][3];
    axes_of(first, a[0], a[1], a[2]);
    axes_of(second, b[0], b[1], b[2]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] = b[0][i] * a[0][j] + b[1][i] * a[1][j] + b[2][i] * a[2][j];
    vector_set(axis, (double[]){m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]});
    double angle = atan2(vector_length(axis), m[0][0] + m[1][1] + m[2][2] - 1);
    if (angle < 3.1)
        return vector_normalize(axis) ? angle : 0;
    // Near half a turn the axis is the column of m + 1 that is longest, up to its sign.
    double best = 0, sign[3];
    vector_set(sign, axis);
    for (int j = 0; j < 3; j++) {
        double column[3] = {m[0][j] + (j == 0), m[1][j] + (j == 1), m[2][j] + (j == 2)};
        if (vector_length(column) > best) {
            best = vector_length(column);
            vector_set(axis, column);
        }
    }
    if (vector_dot(axis, sign) < 0)
        vector_scale(axis, axis, -1);
    return vector_normalize(axis) ? angle : 0;
}

// a to b by equal factors.
static double between_log(double a, double b, double share) {
    return a > 0 && b > 0 ? a * pow(b / a, share) : b;
}

struct pel_camera pel_navigation_between(const struct pel_camera *first,
                                         const struct pel_camera *second, double share) {
    if (share <= 0 || share >= 1)
        return share <= 0 ? *first : *second;
    struct pel_camera camera = *second;
    double q[4], axis[3], forward[3], angle = turn_between(first, second, axis);
    quaternion_turn(q, axis, share * angle);
    vector_subtract(forward, first->target, first->eye);
    quaternion_rotate(forward, q, forward);
    vector_normalize(forward);
    quaternion_rotate(camera.up, q, first->up);
    for (int i = 0; i < 3; i++)
        camera.target[i] = first->target[i] + share * (second->target[i] - first->target[i]);
    for (int i = 0; i < 2; i++)
        camera.shift[i] = first->shift[i] + share * (second->shift[i] - first->shift[i]);
    camera.fov_deg = first->fov_deg + share * (second->fov_deg - first->fov_deg);
    double span = between_log(span_of(first), span_of(second), share);
    double distance = between_log(distance_of(first), distance_of(second), share);
    if (camera.orthographic)
        camera.height_mm = span;
    else
        distance = span / 2 / tan(radians(camera.fov_deg) / 2);
    vector_add_scaled(camera.eye, camera.target, -distance, forward);
    return camera;
}

void pel_navigation_go(struct pel_navigation *navigation, const struct pel_camera *camera,
                       double seconds) {
    struct pel_camera to = *camera;
    if (!(seconds > 0)) {
        pel_navigation_set(navigation, &to);
        return;
    }
    straighten(&to);
    navigation->from = navigation->camera;
    navigation->to = to;
    navigation->elapsed_s = 0;
    navigation->duration_s = seconds;
}

bool pel_navigation_tick(struct pel_navigation *navigation, double seconds) {
    if (!(navigation->duration_s > 0))
        return false;
    navigation->elapsed_s += seconds;
    double share = fmin(navigation->elapsed_s / navigation->duration_s, 1);
    double eased = share * share * (3 - 2 * share);
    navigation->camera = pel_navigation_between(&navigation->from, &navigation->to, eased);
    straighten(&navigation->camera);
    if (share >= 1)
        navigation->duration_s = 0;
    return true;
}
