// clip_handles.c - planes and boxes that cut, as things to take hold of.
#include "viewer/clip_handles.h"

#include "viewer/vector.h"

// Unit vectors of the clip: a box's axes, or two in the plane and its normal.
static void axes_of(const struct pel_clip *clip, double axes[3][3]) {
    const double *xyzw = clip->xyzw;
    bool turned = xyzw[0] != 0 || xyzw[1] != 0 || xyzw[2] != 0 || xyzw[3] != 0;
    for (int axis = 0; axis < 3; axis++) {
        const double unit[3] = {axis == 0, axis == 1, axis == 2};
        vector_set(axes[axis], unit);
        if (turned && clip->kind == PEL_CLIP_BOX) {
            double q[4], length = hypot(hypot(xyzw[0], xyzw[1]), hypot(xyzw[2], xyzw[3]));
            for (int i = 0; i < 4; i++)
                q[i] = xyzw[i] / length;
            quaternion_rotate(axes[axis], q, unit);
        }
    }
    if (clip->kind == PEL_CLIP_BOX)
        return;
    vector_set(axes[2], clip->normal);
    vector_normalize(axes[2]);
    // Any direction that is not the normal's leads to two that are perpendicular to it.
    int least = 0;
    for (int i = 1; i < 3; i++)
        least = fabs(axes[2][i]) < fabs(axes[2][least]) ? i : least;
    const double other[3] = {least == 0, least == 1, least == 2};
    vector_cross(axes[0], other, axes[2]);
    vector_normalize(axes[0]);
    vector_cross(axes[1], axes[2], axes[0]);
}

bool pel_clip_gizmo(struct pel_gizmo *gizmo, const struct pel_clip *clip,
                    const struct pel_view *view, double size_px) {
    double pixel[2];
    *gizmo = (struct pel_gizmo){.view = *view};
    vector_set(gizmo->centre, clip->point);
    axes_of(clip, gizmo->axes);
    gizmo->size_mm = size_px * pel_view_mm_per_px(view, gizmo->centre);
    // What leaves a plane as it is is of no use.
    if (clip->kind == PEL_CLIP_PLANE)
        gizmo->missing = 1u << PEL_HANDLE_MOVE_X | 1u << PEL_HANDLE_MOVE_Y |
                         1u << PEL_HANDLE_PLANE_X | 1u << PEL_HANDLE_PLANE_Y |
                         1u << PEL_HANDLE_PLANE_Z | 1u << PEL_HANDLE_TURN_Z;
    return pel_view_project(view, gizmo->centre, pixel);
}

// The unit quaternion of a rotation, from its greatest member (Shepperd 1978).
static void quaternion_of(double q[4], const double m[4][4]) {
    const double trace = m[0][0] + m[1][1] + m[2][2];
    int best = 3;
    double most = trace;
    for (int i = 0; i < 3; i++)
        if (m[i][i] > most)
            most = m[best = i][i];
    if (best == 3) {
        q[3] = sqrt(1 + trace) / 2;
        for (int i = 0; i < 3; i++)
            q[i] = (m[(i + 2) % 3][(i + 1) % 3] - m[(i + 1) % 3][(i + 2) % 3]) / (4 * q[3]);
        return;
    }
    int j = (best + 1) % 3, k = (best + 2) % 3;
    q[best] = sqrt(1 + m[best][best] - m[j][j] - m[k][k]) / 2;
    q[j] = (m[j][best] + m[best][j]) / (4 * q[best]);
    q[k] = (m[k][best] + m[best][k]) / (4 * q[best]);
    q[3] = (m[k][j] - m[j][k]) / (4 * q[best]);
}

void pel_clip_move(struct pel_clip *moved, const struct pel_clip *before,
                   const struct pel_matrix *transform) {
    double axes[3][3];
    struct pel_matrix turned = {.m[3] = {0, 0, 0, 1}};
    *moved = *before;
    matrix_point(moved->point, transform, before->point);
    if (before->kind == PEL_CLIP_PLANE) {
        matrix_direction(moved->normal, transform, before->normal);
        return;
    }
    axes_of(before, axes);
    for (int axis = 0; axis < 3; axis++) {
        matrix_direction(axes[axis], transform, axes[axis]);
        for (int row = 0; row < 3; row++)
            turned.m[row][axis] = axes[axis][row];
    }
    quaternion_of(moved->xyzw, turned.m);
}

void pel_clip_push(struct pel_clip *moved, const struct pel_clip *before,
                   const struct pel_view *view, const double from_px[2], const double to_px[2]) {
    double axes[3][3];
    axes_of(before, axes);
    double away = vector_dot(axes[2], view->forward) < 0 ? -1 : 1;
    double push_mm = away * (from_px[1] - to_px[1]) * pel_view_mm_per_px(view, before->point);
    *moved = *before;
    vector_add_scaled(moved->point, before->point, push_mm, axes[2]);
}

struct pel_handle_box pel_clip_box(const struct pel_clip *clip) {
    struct pel_handle_box box = {.world_from_box.m[3] = {0, 0, 0, 1}};
    double axes[3][3];
    axes_of(clip, axes);
    for (int axis = 0; axis < 3; axis++) {
        box.high[axis] = clip->size[axis] / 2;
        box.low[axis] = -box.high[axis];
        box.world_from_box.m[axis][3] = clip->point[axis];
        for (int row = 0; row < 3; row++)
            box.world_from_box.m[row][axis] = axes[axis][row];
    }
    return box;
}

void pel_clip_set_box(struct pel_clip *clip, const struct pel_handle_box *box) {
    // A box that was pushed flat would be none.
    static const double least_mm = 1e-3;
    double middle[3];
    for (int axis = 0; axis < 3; axis++) {
        middle[axis] = (box->low[axis] + box->high[axis]) / 2;
        clip->size[axis] = fmax(box->high[axis] - box->low[axis], least_mm);
    }
    matrix_point(clip->point, &box->world_from_box, middle);
}

int pel_clip_outline(const struct pel_clip *clip, double size_mm,
                     double lines[PEL_CLIP_LINES][2][3]) {
    struct pel_handle_box box = pel_clip_box(clip);
    bool plane = clip->kind == PEL_CLIP_PLANE;
    for (int axis = 0; plane && axis < 3; axis++) {
        box.high[axis] = axis < 2 ? size_mm : 0;
        box.low[axis] = -box.high[axis];
    }
    int count = 0;
    for (int axis = 0; axis < (plane ? 2 : 3); axis++) {
        int u = (axis + 1) % 3, v = (axis + 2) % 3;
        // Of a plane both sides of the third axis are one.
        for (int corner = 0; corner < 4; corner++) {
            if (plane && corner >> (u == 2 ? 0 : 1) & 1)
                continue;
            for (int end = 0; end < 2; end++) {
                double point[3];
                point[axis] = end ? box.high[axis] : box.low[axis];
                point[u] = corner & 1 ? box.high[u] : box.low[u];
                point[v] = corner & 2 ? box.high[v] : box.low[v];
                matrix_point(lines[count][end], &box.world_from_box, point);
            }
            count++;
        }
    }
    return count;
}
