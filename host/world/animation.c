// animation.c - a scene at one frame of its animation.
#include "world/animation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "camera/path.h"
#include "world/scene_interpolate.h"
#include "world/scene_override.h"

// Where a frame lies among a track's keyframes: on the way from one to the next.
struct place {
    size_t from, to;
    double share; // 0..1
};

static struct place find_place(const struct pel_track *track, double frame) {
    const double *frames = track->frames;
    int next = 0;
    while (next < track->count && frames[next] <= frame)
        next++;
    if (next == 0 || next == track->count) {
        size_t end = next == 0 ? 0 : (size_t)next - 1;
        return (struct place){end, end, 0};
    }
    double share = (frame - frames[next - 1]) / (frames[next] - frames[next - 1]);
    if (track->interpolation == PEL_INTERPOLATION_STEP)
        share = 0;
    else if (track->interpolation == PEL_INTERPOLATION_SMOOTH)
        share = share * share * (3 - 2 * share);
    return (struct place){(size_t)next - 1, (size_t)next, share};
}

// Rounds all numbers inside a value down. The little more is for numbers that are whole but for the
// rounding of their interpolation.
static void round_down(json_t *value) {
    size_t index;
    json_t *member;
    const char *key;
    if (json_is_real(value)) {
        json_real_set(value, floor(json_real_value(value) + 1e-9));
    } else if (json_is_array(value)) {
        json_array_foreach(value, index, member) round_down(member);
    } else if (json_is_object(value)) {
        json_object_foreach(value, key, member) round_down(member);
    }
}

static bool put_value(const struct pel_track *track, double frame, json_t *root) {
    struct place place = find_place(track, frame);
    json_t *value = pel_interpolate(json_array_get(track->values, place.from),
                                    json_array_get(track->values, place.to), place.share);
    if (!value)
        return false;
    if (track->interpolation == PEL_INTERPOLATION_WHOLE)
        round_down(value);
    bool good = pel_scene_put(root, track->key, value);
    json_decref(value);
    if (good)
        return true;
    struct pel_scene_node key;
    pel_node_member(&key, &track->node, "key");
    return pel_node_fail(&key, "%s", pel_error_message());
}

// A viewpoint as a camera of its own: what it does not say of the lens and of what it looks at is
// the scene's. NULL (MEMORY).
static json_t *make_camera(const json_t *view, const json_t *scene) {
    static const char *const kept[] = {"fov", "orthographic", "fit"};
    json_t *camera = json_is_string(view) ? json_pack("{s:O}", "view", view) : json_deep_copy(view);
    for (size_t i = 0; camera && i < sizeof kept / sizeof *kept; i++) {
        json_t *value = json_object_get(json_object_get(scene, "camera"), kept[i]);
        if (value && json_is_object(camera) && !json_object_get(camera, kept[i]))
            json_object_set(camera, kept[i], value);
    }
    if (!camera)
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a camera");
    return camera;
}

// Replaces the camera by the viewpoint before, and keeps the one after for later.
static bool put_view(struct pel_animation *animation, const struct pel_track *track, json_t *root) {
    struct place place = find_place(track, animation->timeline.frame);
    json_t *from = make_camera(json_array_get(track->values, place.from), root);
    json_t *to = make_camera(json_array_get(track->values, place.to), root);
    json_decref(animation->towards);
    animation->towards = to;
    animation->towards_share = place.share;
    if (to && from)
        return json_object_set_new(root, "camera", from) == 0;
    json_decref(from);
    return false;
}

// The transfer function before, whole; the way to the next is found when both are read.
static bool put_transfer(const struct pel_track *track, double frame, json_t *root) {
    struct pel_track start = *track;
    start.interpolation = PEL_INTERPOLATION_STEP;
    return put_value(&start, frame, root);
}

bool pel_animation_apply(struct pel_animation *animation, json_t *root) {
    double frame = animation->timeline.frame;
    for (int i = 0; i < animation->track_count; i++) {
        const struct pel_track *track = &animation->tracks[i];
        if (track->kind == PEL_TRACK_VALUE && !put_value(track, frame, root))
            return false;
        if (track->kind == PEL_TRACK_TRANSFER && !put_transfer(track, frame, root))
            return false;
    }
    for (int i = 0; i < animation->track_count; i++)
        if (animation->tracks[i].kind == PEL_TRACK_VIEW &&
            !put_view(animation, &animation->tracks[i], root))
            return false;
    return true;
}

bool pel_animation_read_transfers(const struct pel_animation *animation,
                                  struct pel_scene_plan *plan, int volume_count) {
    for (int i = 0; i < animation->track_count; i++) {
        const struct pel_track *track = &animation->tracks[i];
        if (track->kind != PEL_TRACK_TRANSFER)
            continue;
        struct place place = find_place(track, animation->timeline.frame);
        struct pel_scene_node values;
        pel_node_member(&values, &track->node, "values");
        struct pel_scene_node value = pel_node_element(&values, place.to);
        for (int v = 0; v < volume_count && place.share > 0; v++) {
            struct pel_volume_plan *volume = &plan->volume[v];
            if (track->volume >= 0 && track->volume != v)
                continue;
            pel_transfer_destroy(volume->towards);
            volume->towards = NULL;
            volume->towards_share = place.share;
            if (!pel_scene_read_transfer_value(&volume->towards, &value))
                return false;
        }
    }
    return true;
}

// Puts the scene's camera on its way to the next viewpoint, which is placed like any camera.
static bool move_to_view(const struct pel_animation *animation, struct pel_scene *scene,
                         const struct pel_scene_node *root) {
    struct pel_camera start = scene->camera;
    struct pel_camera_plan plan;
    struct pel_scene_node changed = *root;
    changed.value = json_copy(root->value);
    bool good =
        changed.value && json_object_set(changed.value, "camera", animation->towards) == 0 &&
        pel_scene_read_camera(&plan, &changed, scene) && pel_scene_place_camera(scene, &plan) &&
        pel_camera_between(&scene->camera, &start, &scene->camera, animation->towards_share);
    json_decref(changed.value);
    return good;
}

static void move_on_orbit(const struct pel_track *track, double frame, struct pel_camera *camera) {
    struct place place = find_place(track, frame);
    double share = (double)place.from + place.share, axis[3];
    memcpy(axis, track->orbit.camera_up ? camera->up : track->orbit.axis, sizeof axis);
    pel_camera_orbit(camera, axis, share * track->orbit.radians);
}

bool pel_animation_place_camera(const struct pel_animation *animation, struct pel_scene *scene,
                                const struct pel_scene_plan *plan) {
    if (!pel_scene_place_camera(scene, &plan->camera))
        return false;
    if (animation->towards_share > 0 && !move_to_view(animation, scene, &plan->scene))
        return false;
    for (int i = 0; i < animation->track_count; i++)
        if (animation->tracks[i].kind == PEL_TRACK_ORBIT)
            move_on_orbit(&animation->tracks[i], animation->timeline.frame, &scene->camera);
    return true;
}
