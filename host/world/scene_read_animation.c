// scene_read_animation.c - reads and checks the `animation` of a scene file.
#include "world/animation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "world/scene_override.h"

enum { TRACK_MAX = 1024, KEYFRAME_MAX = 100000, FRAME_MAX = 1000000 };

static const double fps_default = 25;

static const char *const animation_keys[] = {"comment", "fps",    "frames", "duration",
                                             "frame",   "tracks", NULL};
static const char *const track_keys[] = {"comment", "key",           "times", "frames",
                                         "values",  "interpolation", "orbit", NULL};
static const char *const orbit_keys[] = {"comment", "axis", "turns", NULL};

// In the order of enum pel_interpolation.
static const char *const interpolation_names[] = {"linear", "smooth", "step", "whole", NULL};

// World axes by the side they point to, and the camera's own.
static const char *const axis_names[] = {"superior", "inferior", "anterior", "posterior",
                                         "right",    "left",     "up",       NULL};
static const double axes[][3] = {{0, 0, 1},  {0, 0, -1}, {0, 1, 0},
                                 {0, -1, 0}, {1, 0, 0},  {-1, 0, 0}};

static bool read_orbit_axis(struct pel_track *track, const struct pel_scene_node *orbit) {
    struct pel_scene_node node;
    double *axis = track->orbit.axis;
    if (!pel_node_member(&node, orbit, "axis")) {
        axis[2] = 1;
        return true;
    }
    if (json_is_array(node.value)) {
        if (!pel_node_check_numbers(&node, 3, &pel_any_number, axis))
            return false;
        return pel_normalize(axis) || pel_node_fail(&node, "has no direction");
    }
    int which;
    if (!pel_node_check_name(&node, axis_names, &which))
        return false;
    track->orbit.camera_up = strcmp(axis_names[which], "up") == 0;
    if (!track->orbit.camera_up)
        memcpy(axis, axes[which], sizeof axes[which]);
    return true;
}

static bool read_orbit(struct pel_track *track, const struct pel_scene_node *orbit) {
    struct pel_scene_node member;
    double turns = 1;
    const struct pel_range range = {.low = -1e6, .high = 1e6};
    track->kind = PEL_TRACK_ORBIT;
    if (!pel_node_check_object(orbit, orbit_keys) || !read_orbit_axis(track, orbit) ||
        !pel_node_get_number(orbit, "turns", &range, &turns))
        return false;
    if (pel_node_member(&member, &track->node, "values"))
        return pel_node_fail(&member, "an orbit has none");
    track->orbit.radians = 2 * PEL_PI * turns;
    return true;
}

// What kind of value a key has. Volumes are known by their index here.
static void find_kind(struct pel_track *track) {
    const char *key = track->key;
    size_t stem = strlen("volumes."), step = 0;
    if (strncmp(key, "volumes.", stem) == 0)
        step = strcspn(key + stem, ".");
    if (strcmp(key, "camera") == 0 || strcmp(key, "camera.view") == 0) {
        track->kind = PEL_TRACK_VIEW;
    } else if (step > 0 && strcmp(key + stem + step, ".transfer") == 0) {
        track->kind = PEL_TRACK_TRANSFER;
        track->volume = key[stem] == '*' ? -1 : (int)strtol(key + stem, NULL, 10);
    }
}

static bool read_key(struct pel_track *track, const struct pel_scene_node *scene) {
    struct pel_scene_node node;
    const char *key;
    if (!pel_node_member(&node, &track->node, "key"))
        return pel_node_fail(&track->node, "needs 'key' or 'orbit'");
    if (!pel_node_get_text(&track->node, "key", &key))
        return false;
    if (strncmp(key, "animation", strlen("animation")) == 0 || strpbrk(key, "=") || !*key)
        return pel_node_fail(&node, "'%.64s' cannot be animated", key);
    if (!pel_scene_key_resolve(track->key, sizeof track->key, scene->value, key))
        return pel_node_fail(&node, "%s", pel_error_message());
    find_kind(track);
    return true;
}

// `times` in seconds or `frames`, where a track has them.
static bool read_given_frames(struct pel_track *track, double fps) {
    struct pel_scene_node times, frames;
    bool timed = pel_node_member(&times, &track->node, "times");
    bool framed = pel_node_member(&frames, &track->node, "frames");
    if (timed && framed)
        return pel_node_fail(&times, "there are 'frames' already");
    if (!timed && !framed)
        return true;
    const struct pel_scene_node *node = timed ? &times : &frames;
    const struct pel_range range = {.low = 0, .high = FRAME_MAX};
    size_t wanted = track->kind == PEL_TRACK_ORBIT ? 2 : json_array_size(track->values);
    track->frames = pel_allocate(wanted, sizeof *track->frames);
    if (!track->frames || !pel_node_check_numbers(node, wanted, &range, track->frames))
        return false;
    for (size_t i = 0; i < wanted; i++) {
        if (i > 0 && !(track->frames[i] > track->frames[i - 1]))
            return pel_node_fail(node, "must ascend, but %g comes after %g", track->frames[i],
                                 track->frames[i - 1]);
    }
    for (size_t i = 0; timed && i < wanted; i++)
        track->frames[i] *= fps;
    return true;
}

static bool read_track(struct pel_track *track, const struct pel_animation *animation) {
    struct pel_scene_node values, orbit;
    int interpolation = PEL_INTERPOLATION_LINEAR;
    if (!pel_node_check_object(&track->node, track_keys) ||
        !pel_node_get_name(&track->node, "interpolation", interpolation_names, &interpolation))
        return false;
    track->interpolation = (enum pel_interpolation)interpolation;
    track->count = 2;
    if (pel_node_member(&orbit, &track->node, "orbit")) {
        struct pel_scene_node key;
        if (pel_node_member(&key, &track->node, "key") &&
            strcmp(json_is_string(key.value) ? json_string_value(key.value) : "", "camera") != 0)
            return pel_node_fail(&key, "must be \"camera\" for an orbit");
        if (!read_orbit(track, &orbit))
            return false;
    } else {
        if (!read_key(track, &animation->scene))
            return false;
        if (!pel_node_member(&values, &track->node, "values"))
            return pel_node_fail(&track->node, "needs 'values'");
        if (!pel_node_check_list(&values, 1, KEYFRAME_MAX))
            return false;
        track->values = values.value;
        track->count = (int)json_array_size(values.value);
    }
    return read_given_frames(track, animation->timeline.fps);
}

// How many frames there are: as many as is said, or else up to the last keyframe.
static bool count_frames(struct pel_animation *animation) {
    struct pel_timeline *timeline = &animation->timeline;
    struct pel_scene_node duration_node, frames_node;
    const struct pel_range range = {.high = FRAME_MAX, .low_open = true};
    double duration = 0, last = -1;
    bool timed = pel_node_member(&duration_node, &animation->node, "duration");
    bool framed = pel_node_member(&frames_node, &animation->node, "frames");
    if (timed && framed)
        return pel_node_fail(&duration_node, "there are 'frames' already");
    if (!pel_node_get_number(&animation->node, "duration", &range, &duration) ||
        !pel_node_get_integer(&animation->node, "frames", 1, FRAME_MAX, &timeline->frame_count))
        return false;
    if (framed)
        return true;
    for (int i = 0; i < animation->track_count; i++) {
        const struct pel_track *track = &animation->tracks[i];
        if (track->frames)
            last = fmax(last, track->frames[track->count - 1]);
    }
    if (!timed && last < 0)
        return pel_node_fail(&animation->node, "needs 'frames' or 'duration'");
    double count = timed ? round(duration * timeline->fps) : floor(last) + 1;
    if (!(count >= 1 && count <= FRAME_MAX))
        return pel_node_fail(timed ? &duration_node : &animation->node,
                             "makes %g frames, outside 1..%d", count, FRAME_MAX);
    timeline->frame_count = (int)count;
    return true;
}

// Keyframes without times are spread evenly from the first frame to the last. An orbit goes on to
// the one behind the last, which would be the first again.
static bool spread_frames(struct pel_track *track, int frame_count) {
    if (track->frames)
        return true;
    track->frames = pel_allocate((size_t)track->count, sizeof *track->frames);
    if (!track->frames)
        return false;
    int last = track->kind == PEL_TRACK_ORBIT ? frame_count : frame_count - 1;
    for (int i = 0; i < track->count; i++)
        track->frames[i] = track->count > 1 ? (double)last * i / (track->count - 1) : 0;
    return true;
}

static bool read_tracks(struct pel_animation *animation) {
    if (!pel_node_member(&animation->list, &animation->node, "tracks"))
        return true;
    if (!pel_node_check_list(&animation->list, 0, TRACK_MAX))
        return false;
    size_t count = json_array_size(animation->list.value);
    animation->tracks = pel_allocate(count, sizeof *animation->tracks);
    if (!animation->tracks)
        return false;
    for (size_t i = 0; i < count; i++) {
        struct pel_track *track = &animation->tracks[i];
        animation->track_count = (int)i + 1;
        track->node = pel_node_element(&animation->list, i);
        if (!read_track(track, animation))
            return false;
    }
    return true;
}

bool pel_animation_read(struct pel_animation *animation, const struct pel_scene_node *scene) {
    struct pel_timeline *timeline = &animation->timeline;
    const struct pel_range fps_range = {.high = 1000, .low_open = true};
    animation->scene = *scene;
    if (!pel_node_member(&animation->node, &animation->scene, "animation"))
        return true;
    timeline->fps = fps_default;
    if (!pel_node_check_object(&animation->node, animation_keys) ||
        !pel_node_get_number(&animation->node, "fps", &fps_range, &timeline->fps) ||
        !read_tracks(animation) || !count_frames(animation))
        return false;
    for (int i = 0; i < animation->track_count; i++)
        if (!spread_frames(&animation->tracks[i], timeline->frame_count))
            return false;
    const struct pel_range frame_range = {.high = timeline->frame_count};
    return pel_node_get_number(&animation->node, "frame", &frame_range, &timeline->frame);
}

void pel_animation_finish(struct pel_animation *animation) {
    for (int i = 0; i < animation->track_count; i++)
        free(animation->tracks[i].frames);
    free(animation->tracks);
    json_decref(animation->towards);
    animation->towards = NULL;
    animation->tracks = NULL;
    animation->track_count = 0;
}
