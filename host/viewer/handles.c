// handles.c - gizmos and boxes that follow the pointer.
#include "viewer/handles.h"

#include "viewer/vector.h"

// Sizes of the gizmo's parts, in lengths of its arrows.
static const double ring = 0.8, view_ring = 1.15, plane_near = 0.3, plane_far = 0.5, middle = 0.08;

// An arrow that is seen this much from its end is of no use, nor a plane from its side; of rings
// the pointer is followed along the picture instead.
static const double end_on = 0.12, side_on = 0.15;

static int axis_of(enum pel_handle handle) {
    return ((int)handle - PEL_HANDLE_MOVE_X) % 3;
}

static bool is_turn(enum pel_handle handle) {
    return (handle >= PEL_HANDLE_TURN_X && handle <= PEL_HANDLE_TURN_Z) ||
           handle == PEL_HANDLE_TURN_VIEW;
}

// The axis a handle moves along, turns about, or is perpendicular to.
static void direction_of(const struct pel_gizmo *gizmo, enum pel_handle handle, double out[3]) {
    if (handle == PEL_HANDLE_MOVE_VIEW || handle == PEL_HANDLE_TURN_VIEW)
        vector_scale(out, gizmo->view.forward, -1);
    else
        vector_set(out, gizmo->axes[axis_of(handle)]);
}

// Two unit vectors perpendicular to the handle's axis.
static void sides_of(const struct pel_gizmo *gizmo, enum pel_handle handle, double u[3],
                     double v[3]) {
    if (handle == PEL_HANDLE_MOVE_VIEW || handle == PEL_HANDLE_TURN_VIEW) {
        vector_set(u, gizmo->view.right);
        vector_set(v, gizmo->view.up);
    } else {
        vector_set(u, gizmo->axes[(axis_of(handle) + 1) % 3]);
        vector_set(v, gizmo->axes[(axis_of(handle) + 2) % 3]);
    }
}

// The way from the eye to the gizmo.
static void sight_of(const struct pel_gizmo *gizmo, double out[3]) {
    vector_set(out, gizmo->view.forward);
    if (!gizmo->view.camera.orthographic) {
        vector_subtract(out, gizmo->centre, gizmo->view.camera.eye);
        vector_normalize(out);
    }
}

bool pel_gizmo_make(struct pel_gizmo *gizmo, const struct pel_scene *scene, int instance,
                    const struct pel_view *view, double size_px, bool own) {
    const struct pel_instance *shown = &scene->instances[instance];
    const struct pel_volume *volume = scene->volumes[shown->volume];
    struct pel_matrix world_from_voxel =
        matrix_multiply(&shown->transform, &volume->world_from_voxel);
    double pixel[2];
    *gizmo = (struct pel_gizmo){.view = *view};
    for (int axis = 0; axis < 3; axis++) {
        gizmo->centre[axis] = (volume->dims[axis] - 1) / 2.0;
        gizmo->axes[axis][axis] = 1;
        if (own)
            matrix_direction(gizmo->axes[axis], &shown->transform, gizmo->axes[axis]);
        vector_normalize(gizmo->axes[axis]);
    }
    matrix_point(gizmo->centre, &world_from_voxel, gizmo->centre);
    gizmo->size_mm = size_px * pel_view_mm_per_px(view, gizmo->centre);
    return pel_view_project(view, gizmo->centre, pixel);
}

// ---- What is drawn, and hit --------------------------------------------------------------------

static bool is_usable(const struct pel_gizmo *gizmo, enum pel_handle handle) {
    double sight[3], direction[3];
    sight_of(gizmo, sight);
    direction_of(gizmo, handle, direction);
    double cosine = fabs(vector_dot(sight, direction));
    if (handle <= PEL_HANDLE_MOVE_Z)
        return 1 - cosine * cosine > end_on * end_on;
    return handle > PEL_HANDLE_PLANE_Z || cosine > side_on;
}

// Point `i` of `count` of a handle's line, in lengths of the arrows along two vectors.
static int shape_of(enum pel_handle handle, double along[PEL_HANDLE_POINTS][2]) {
    if (handle <= PEL_HANDLE_MOVE_Z) {
        along[0][0] = middle * 1.5, along[1][0] = 1;
        along[0][1] = along[1][1] = 0;
        return 2;
    }
    if (handle <= PEL_HANDLE_PLANE_Z) {
        static const double corners[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
        for (int i = 0; i < 5; i++)
            for (int c = 0; c < 2; c++)
                along[i][c] = corners[i][c] > 0 ? plane_far : plane_near;
        return 5;
    }
    double radius = handle == PEL_HANDLE_MOVE_VIEW   ? middle
                    : handle == PEL_HANDLE_TURN_VIEW ? view_ring
                                                     : ring;
    for (int i = 0; i < PEL_HANDLE_POINTS; i++) {
        double angle = 2 * VECTOR_PI * i / (PEL_HANDLE_POINTS - 1);
        along[i][0] = radius * cos(angle);
        along[i][1] = radius * sin(angle);
    }
    return PEL_HANDLE_POINTS;
}

int pel_gizmo_outline(const struct pel_gizmo *gizmo, enum pel_handle handle,
                      double pixels[PEL_HANDLE_POINTS][2]) {
    double u[3], v[3];
    if (handle == PEL_HANDLE_NONE || gizmo->missing >> handle & 1 || !is_usable(gizmo, handle))
        return 0;
    int count = shape_of(handle, pixels);
    if (handle <= PEL_HANDLE_MOVE_Z)
        direction_of(gizmo, handle, u);
    else
        sides_of(gizmo, handle, u, v);
    for (int i = 0; i < count; i++) {
        double point[3];
        vector_add_scaled(point, gizmo->centre, gizmo->size_mm * pixels[i][0], u);
        if (handle > PEL_HANDLE_MOVE_Z)
            vector_add_scaled(point, point, gizmo->size_mm * pixels[i][1], v);
        if (!pel_view_project(&gizmo->view, point, pixels[i]))
            return 0;
    }
    return count;
}

static double distance_to_line(const double a[2], const double b[2], const double p[2]) {
    double x = b[0] - a[0], y = b[1] - a[1], length = x * x + y * y;
    double share = length > 0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / length : 0;
    share = fmin(fmax(share, 0), 1);
    return hypot(p[0] - a[0] - share * x, p[1] - a[1] - share * y);
}

// Even-odd: how often a ray to the right leaves the shape.
static bool is_within(double pixels[][2], int count, const double p[2]) {
    bool within = false;
    for (int i = 0; i + 1 < count; i++) {
        const double *a = pixels[i], *b = pixels[i + 1];
        if ((a[1] > p[1]) != (b[1] > p[1]) &&
            p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            within = !within;
    }
    return within;
}

enum pel_handle pel_gizmo_hit(const struct pel_gizmo *gizmo, const double pixel[2],
                              double reach_px) {
    enum pel_handle best = PEL_HANDLE_NONE;
    double nearest = reach_px;
    for (int i = PEL_HANDLE_NONE + 1; i < PEL_HANDLE_COUNT; i++) {
        enum pel_handle handle = (enum pel_handle)i;
        double pixels[PEL_HANDLE_POINTS][2];
        int count = pel_gizmo_outline(gizmo, handle, pixels);
        bool filled = handle == PEL_HANDLE_MOVE_VIEW ||
                      (handle >= PEL_HANDLE_PLANE_X && handle <= PEL_HANDLE_PLANE_Z);
        double distance = INFINITY;
        for (int k = 0; k + 1 < count; k++)
            distance = fmin(distance, distance_to_line(pixels[k], pixels[k + 1], pixel));
        // Inside of a plane counts as next to its edge, so that a line over it still wins; the
        // middle, where all lines may cross, wins over them.
        if (filled && count > 0 && is_within(pixels, count, pixel))
            distance = fmin(distance, handle == PEL_HANDLE_MOVE_VIEW ? -1 : reach_px / 2);
        if (distance < nearest) {
            nearest = distance;
            best = handle;
        }
    }
    return best;
}

// ---- Drags -------------------------------------------------------------------------------------

// Where the ray of a pixel meets the plane through the gizmo's centre.
static bool meet(double point[3], const struct pel_gizmo *gizmo, enum pel_handle handle,
                 const double pixel[2]) {
    double normal[3];
    struct pel_view_ray ray = pel_view_ray(&gizmo->view, pixel);
    direction_of(gizmo, handle, normal);
    return pel_view_meet_plane(point, &ray, gizmo->centre, normal);
}

bool pel_handle_begin(struct pel_handle_drag *drag, const struct pel_gizmo *gizmo,
                      enum pel_handle handle, const double pixel[2],
                      const struct pel_matrix *transform) {
    *drag = (struct pel_handle_drag){
        .gizmo = *gizmo, .handle = handle, .before = *transform, .pixel = {pixel[0], pixel[1]}};
    if (handle == PEL_HANDLE_NONE)
        return false;
    return handle <= PEL_HANDLE_MOVE_Z || meet(drag->grip, gizmo, handle, pixel) || is_turn(handle);
}

static double snapped(double amount, double snap) {
    return snap > 0 ? snap * round(amount / snap) : amount;
}

// The angle, in radians, that the pointer has led a ring by.
static bool turned_by(const struct pel_handle_drag *drag, const double pixel[2], double *angle) {
    const struct pel_gizmo *gizmo = &drag->gizmo;
    double axis[3], sight[3], from[3], to[3], cross[3], point[3];
    direction_of(gizmo, drag->handle, axis);
    sight_of(gizmo, sight);
    if (fabs(vector_dot(axis, sight)) > side_on) {
        if (!meet(point, gizmo, drag->handle, pixel))
            return false;
        vector_subtract(from, drag->grip, gizmo->centre);
        vector_subtract(to, point, gizmo->centre);
        vector_cross(cross, from, to);
        *angle = atan2(vector_dot(cross, axis), vector_dot(from, to));
        return vector_length(from) > 0 && vector_length(to) > 0;
    }
    // Seen from its side, a ring is a line: the pointer rolls its near side along it.
    double along[3], first[2], second[2];
    vector_cross(along, sight, axis);
    vector_add_scaled(point, gizmo->centre, gizmo->size_mm, along);
    if (!vector_normalize(along) || !pel_view_project(&gizmo->view, gizmo->centre, first) ||
        !pel_view_project(&gizmo->view, point, second))
        return false;
    double x = second[0] - first[0], y = second[1] - first[1], length = hypot(x, y);
    double moved = ((pixel[0] - drag->pixel[0]) * x + (pixel[1] - drag->pixel[1]) * y) / length;
    // The near side's velocity is axis x (-sight) = sight x axis.
    *angle = moved / (ring * length);
    return true;
}

static void turn_matrix(struct pel_matrix *transform, const struct pel_matrix *before,
                        const double axis[3], double angle, const double centre[3]) {
    double q[4];
    struct pel_matrix rotation = {.m[3] = {0, 0, 0, 1}};
    quaternion_turn(q, axis, angle);
    for (int column = 0; column < 3; column++) {
        double unit[3] = {0};
        unit[column] = 1;
        quaternion_rotate(unit, q, unit);
        for (int row = 0; row < 3; row++)
            rotation.m[row][column] = unit[row];
    }
    double moved[3];
    matrix_direction(moved, &rotation, centre);
    for (int row = 0; row < 3; row++)
        rotation.m[row][3] = centre[row] - moved[row];
    *transform = matrix_multiply(&rotation, before);
}

bool pel_handle_drag(struct pel_handle_drag *drag, const double pixel[2], double snap,
                     struct pel_matrix *transform) {
    const struct pel_gizmo *gizmo = &drag->gizmo;
    double axis[3], amount, point[3], moved[3];
    direction_of(gizmo, drag->handle, axis);
    if (is_turn(drag->handle)) {
        if (!turned_by(drag, pixel, &amount))
            return false;
        drag->amount = snapped(amount * 180 / VECTOR_PI, snap);
        turn_matrix(transform, &drag->before, axis, radians(drag->amount), gizmo->centre);
        return true;
    }
    if (drag->handle <= PEL_HANDLE_MOVE_Z) {
        if (!pel_axis_drag(&amount, gizmo->centre, axis, &gizmo->view, drag->pixel, pixel))
            return false;
        drag->amount = snapped(amount, snap);
        vector_scale(moved, axis, drag->amount);
    } else {
        double u[3], v[3];
        if (!meet(point, gizmo, drag->handle, pixel))
            return false;
        vector_subtract(moved, point, drag->grip);
        sides_of(gizmo, drag->handle, u, v);
        double along_u = snapped(vector_dot(moved, u), snap);
        double along_v = snapped(vector_dot(moved, v), snap);
        vector_scale(moved, u, along_u);
        vector_add_scaled(moved, moved, along_v, v);
        drag->amount = vector_length(moved);
    }
    *transform = drag->before;
    for (int row = 0; row < 3; row++)
        transform->m[row][3] += moved[row];
    return true;
}

// ---- Boxes -------------------------------------------------------------------------------------

void pel_box_face(const struct pel_handle_box *box, int face, double point[3]) {
    for (int axis = 0; axis < 3; axis++)
        point[axis] = (box->low[axis] + box->high[axis]) / 2;
    point[face / 2] = face % 2 ? box->high[face / 2] : box->low[face / 2];
    matrix_point(point, &box->world_from_box, point);
}

int pel_box_hit(const struct pel_handle_box *box, const struct pel_view *view,
                const double pixel[2], double reach_px) {
    int best = -1;
    double nearest = reach_px;
    for (int face = 0; face < 6; face++) {
        double point[3], at[2];
        pel_box_face(box, face, point);
        if (!pel_view_project(view, point, at))
            continue;
        double distance = hypot(at[0] - pixel[0], at[1] - pixel[1]);
        if (distance < nearest) {
            nearest = distance;
            best = face;
        }
    }
    return best;
}

bool pel_axis_drag(double *moved_mm, const double point[3], const double axis[3],
                   const struct pel_view *view, const double from_px[2], const double to_px[2]) {
    double from, to;
    struct pel_view_ray first = pel_view_ray(view, from_px), second = pel_view_ray(view, to_px);
    if (!pel_view_nearest_on_axis(&from, &first, point, axis) ||
        !pel_view_nearest_on_axis(&to, &second, point, axis))
        return false;
    *moved_mm = to - from;
    return isfinite(*moved_mm);
}

bool pel_box_drag(struct pel_handle_box *moved, const struct pel_handle_box *before, int face,
                  const struct pel_view *view, const double from_px[2], const double to_px[2]) {
    double point[3], axis[3] = {0}, moved_mm;
    int a = face / 2;
    axis[a] = 1;
    matrix_direction(axis, &before->world_from_box, axis);
    double scale = vector_length(axis);
    pel_box_face(before, face, point);
    if (!vector_normalize(axis) || !pel_axis_drag(&moved_mm, point, axis, view, from_px, to_px))
        return false;
    *moved = *before;
    if (face % 2)
        moved->high[a] = fmax(before->high[a] + moved_mm / scale, before->low[a]);
    else
        moved->low[a] = fmin(before->low[a] + moved_mm / scale, before->high[a]);
    return true;
}
