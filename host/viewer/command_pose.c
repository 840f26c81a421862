// command_pose.c - moving and turning the selected volume by keys and numbers.
#include "viewer/command.h"
#include "viewer/vector.h"

// Of one press of a key.
static const double nudge_mm = 1, nudge_deg = 1;

static struct pel_instance *selected(struct pel_state *state) {
    return &state->scene->instances[state->selected];
}

// The middle of the selected volume where its file puts it.
static void file_middle(const struct pel_state *state, double middle[3]) {
    const struct pel_instance *instance = &state->scene->instances[state->selected];
    const struct pel_volume *volume = state->scene->volumes[instance->volume];
    double voxel[3];
    for (int i = 0; i < 3; i++)
        voxel[i] = (volume->dims[i] - 1) / 2.0;
    matrix_point(middle, &volume->world_from_voxel, voxel);
}

static void set_identity(struct pel_matrix *matrix) {
    *matrix = (struct pel_matrix){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

// A turn about an axis (a unit vector) through nothing.
static struct pel_matrix turn_about(const double axis[3], double angle_deg) {
    struct pel_matrix turn;
    double q[4];
    set_identity(&turn);
    quaternion_turn(q, axis, radians(angle_deg));
    for (int column = 0; column < 3; column++) {
        double unit[3] = {column == 0, column == 1, column == 2}, turned[3];
        quaternion_rotate(turned, q, unit);
        for (int row = 0; row < 3; row++)
            turn.m[row][column] = turned[row];
    }
    return turn;
}

// Keys 0 to 5: left, right, up, down, away and near, or clockwise and back.
static void nudge(struct pel_state *state, int number, bool turns) {
    static const double signs[2][6] = {{-1, 1, 1, -1, 1, -1}, {-1, 1, -1, 1, 1, -1}};
    struct pel_view view;
    if (!pel_state_view(state, 0, &view))
        return;
    const double *axes[2][3] = {{view.right, view.up, view.forward},
                                {view.up, view.right, view.forward}};
    const double *axis = axes[turns][number / 2];
    struct pel_matrix *transform = &selected(state)->transform;
    double middle[3], now[3];
    file_middle(state, middle);
    matrix_point(now, transform, middle);
    if (turns) {
        struct pel_matrix turn = turn_about(axis, signs[1][number] * nudge_deg);
        *transform = matrix_multiply(&turn, transform);
        // The middle stays where it was.
        double turned[3];
        matrix_point(turned, transform, middle);
        for (int i = 0; i < 3; i++)
            transform->m[i][3] += now[i] - turned[i];
    } else {
        for (int i = 0; i < 3; i++)
            transform->m[i][3] += signs[0][number] * nudge_mm * axis[i];
    }
    pel_state_change(state, turns ? "turn a volume" : "move a volume");
}

struct pel_pose pel_command_get_pose(const struct pel_state *state) {
    const struct pel_matrix *transform = &state->scene->instances[state->selected].transform;
    const double(*m)[4] = transform->m;
    struct pel_pose pose;
    double middle[3], now[3];
    file_middle(state, middle);
    matrix_point(now, transform, middle);
    vector_subtract(pose.move_mm, now, middle);
    const double to_deg = 180 / VECTOR_PI;
    pose.turn_deg[1] = to_deg * asin(fmax(-1, fmin(1, -m[2][0])));
    // Where y points along the axis of the first turn, the other two are one.
    if (hypot(m[0][0], m[1][0]) > 1e-9) {
        pose.turn_deg[0] = to_deg * atan2(m[2][1], m[2][2]);
        pose.turn_deg[2] = to_deg * atan2(m[1][0], m[0][0]);
    } else {
        pose.turn_deg[0] = to_deg * atan2(-m[1][2], m[1][1]);
        pose.turn_deg[2] = 0;
    }
    return pose;
}

void pel_command_set_pose(struct pel_state *state, const struct pel_pose *pose) {
    struct pel_matrix *transform = &selected(state)->transform;
    double middle[3], turned[3];
    file_middle(state, middle);
    set_identity(transform);
    for (int axis = 0; axis < 3; axis++) {
        const double unit[3] = {axis == 0, axis == 1, axis == 2};
        struct pel_matrix turn = turn_about(unit, pose->turn_deg[axis]);
        *transform = matrix_multiply(&turn, transform);
    }
    matrix_point(turned, transform, middle);
    for (int i = 0; i < 3; i++)
        transform->m[i][3] = middle[i] + pose->move_mm[i] - turned[i];
}

// The volume that FSL's transforms lead to.
static const struct pel_volume *other_volume(const struct pel_state *state) {
    const struct pel_scene *scene = state->scene;
    for (int i = 0; i < scene->instance_count; i++)
        if (i != state->selected)
            return scene->volumes[scene->instances[i].volume];
    return NULL;
}

void pel_command_load_pose(struct pel_state *state, const char *path) {
    struct pel_instance *instance = selected(state);
    struct pel_matrix transform;
    if (!pel_transform_load(&transform, path, state->scene->volumes[instance->volume],
                            other_volume(state))) {
        pel_state_say(state, "%s", pel_error_message());
        return;
    }
    instance->transform = transform;
    pel_state_begin_gesture(state);
    pel_state_change(state, "load a pose");
    pel_state_say(state, "%s is placed by %s", instance->name, path);
}

void pel_command_save_pose(struct pel_state *state, const char *path) {
    const struct pel_instance *instance = selected(state);
    bool good = pel_transform_save(&instance->transform, path,
                                   state->scene->volumes[instance->volume], other_volume(state));
    pel_state_say(state, "%s%s", good ? "saved " : "", good ? path : pel_error_message());
}

bool pel_command_pose(struct pel_state *state, enum pel_action action, int number) {
    switch (action) {
    case PEL_ACTION_HANDLES:
        state->handles = !state->handles;
        return true;
    case PEL_ACTION_NUDGE:
    case PEL_ACTION_NUDGE_TURN:
        nudge(state, number, action == PEL_ACTION_NUDGE_TURN);
        return true;
    case PEL_ACTION_RESET_POSE:
        set_identity(&selected(state)->transform);
        pel_state_change(state, "reset the pose");
        return true;
    default:
        return false;
    }
}
