// scene_keyframe.c - viewpoints that were recorded become the scene's animation.
//
// The scene as it stands is written and becomes what its animation acts upon, so that what was
// changed since it was loaded stays. Other tracks than the camera's stay, too.
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "world/scene_source.h"
#include "world/scene_write.h"

static bool check(const struct pel_keyframe *keyframes, int count, double fps) {
    if (!(fps > 0 && fps <= 1000))
        return pel_fail(PEL_ERROR_ARGUMENT, "%g frames per second, outside 0..1000", fps);
    for (int i = 0; i < count; i++) {
        double time = keyframes[i].time_s, before = i > 0 ? keyframes[i - 1].time_s : -1;
        if (!(time >= 0 && time <= 1e6 / fps))
            return pel_fail(PEL_ERROR_ARGUMENT, "keyframe %d at %g s, outside 0..%g", i, time,
                            1e6 / fps);
        if (!(time > before))
            return pel_fail(PEL_ERROR_ARGUMENT, "keyframe %d at %g s is not after the one at %g", i,
                            time, before);
    }
    return true;
}

static bool moves_camera(const json_t *track) {
    const char *key = json_string_value(json_object_get(track, "key"));
    return json_object_get(track, "orbit") || (key && strcmp(key, "camera") == 0) ||
           (key && strncmp(key, "camera.", strlen("camera.")) == 0);
}

static json_t *make_track(struct pel_scene_writer *writer, const struct pel_keyframe *keyframes,
                          int count) {
    json_t *track = json_pack("{s:s, s:s}", "key", "camera", "interpolation", "smooth");
    json_t *times = json_array(), *values = json_array();
    for (int i = 0; i < count; i++) {
        json_t *value = json_object();
        json_array_append_new(times, pel_write_make_number(keyframes[i].time_s));
        json_array_append_new(values, value);
        pel_scene_write_viewpoint(writer, value, &keyframes[i].camera);
    }
    pel_write_value(writer, track, "times", times);
    pel_write_value(writer, track, "values", values);
    return track;
}

// Puts the keyframes into the scene's JSON, and tells how long the animation is then.
static bool put(const struct pel_scene *scene, json_t *root, const struct pel_keyframe *keyframes,
                int count, struct pel_timeline *timeline) {
    struct pel_scene_writer writer = {.scene = scene, .usual = scene};
    json_t *animation = json_object_get(root, "animation"), *tracks;
    json_object_del(root, "camera");
    pel_write_value(&writer, root, "camera", json_object());
    pel_scene_write_viewpoint(&writer, json_object_get(root, "camera"), &scene->camera);
    if (!animation)
        animation = pel_write_object(&writer, root, "animation");
    tracks = json_object_get(animation, "tracks");
    if (!tracks) {
        tracks = json_array();
        pel_write_value(&writer, animation, "tracks", tracks);
    }
    for (size_t i = json_array_size(tracks); i-- > 0;)
        if (moves_camera(json_array_get(tracks, i)))
            json_array_remove(tracks, i);
    // What other tracks do keeps its length.
    int frames = json_array_size(tracks) > 0 ? timeline->frame_count : 0;
    if (count > 0) {
        json_array_append_new(tracks, make_track(&writer, keyframes, count));
        frames = (int)fmax(frames, ceil(keyframes[count - 1].time_s * timeline->fps) + 1);
    }
    if (json_array_size(tracks) == 0) {
        json_object_del(root, "animation");
        *timeline = (struct pel_timeline){0};
        return !writer.failed;
    }
    timeline->frame_count = frames;
    timeline->frame = fmin(timeline->frame, frames);
    json_object_del(animation, "duration");
    pel_write_value(&writer, animation, "fps", json_real(timeline->fps));
    pel_write_value(&writer, animation, "frames", json_integer(frames));
    pel_write_value(&writer, animation, "frame", json_real(timeline->frame));
    return !writer.failed;
}

// The scene as it stands, as JSON; NULL: MEMORY, ARGUMENT.
static json_t *write_root(const struct pel_scene *scene) {
    char *text = pel_scene_text(scene, NULL);
    json_t *root = text ? json_loads(text, 0, NULL) : NULL;
    free(text);
    return root;
}

// Takes the root as what the scene is made of from now on.
static bool take_root(struct pel_scene *scene, json_t *root) {
    const struct pel_scene_document document = {0};
    struct pel_scene_source *source = pel_scene_source_create(&document, root);
    if (!source)
        return false;
    pel_scene_source_destroy(scene->source);
    scene->source = source;
    return true;
}

// ---- Reading back ------------------------------------------------------------------------------

static bool read_triple(const json_t *list, double out[3]) {
    for (size_t i = 0; i < 3; i++) {
        if (!json_is_number(json_array_get(list, i)))
            return false;
        out[i] = json_number_value(json_array_get(list, i));
    }
    return true;
}

// A whole camera; what it does not say is the scene's.
static bool read_viewpoint(const json_t *value, struct pel_camera *camera) {
    const json_t *fov = json_object_get(value, "fov"), *height = json_object_get(value, "height");
    const json_t *parallel = json_object_get(value, "orthographic");
    const json_t *shift = json_object_get(value, "shift");
    if (!read_triple(json_object_get(value, "eye"), camera->eye) ||
        !read_triple(json_object_get(value, "target"), camera->target) ||
        !read_triple(json_object_get(value, "up"), camera->up))
        return false;
    if (json_is_number(fov))
        camera->fov_deg = json_number_value(fov);
    if (json_is_number(height))
        camera->height_mm = json_number_value(height);
    if (json_is_boolean(parallel))
        camera->orthographic = json_is_true(parallel);
    for (size_t i = 0; i < 2 && json_is_array(shift); i++)
        camera->shift[i] = json_number_value(json_array_get(shift, i));
    return true;
}

// When a value of a track is reached.
static double time_of(const json_t *track, size_t value, size_t count,
                      const struct pel_timeline *timeline) {
    const json_t *time = json_array_get(json_object_get(track, "times"), value);
    const json_t *frame = json_array_get(json_object_get(track, "frames"), value);
    if (json_is_number(time))
        return json_number_value(time);
    if (json_is_number(frame))
        return json_number_value(frame) / timeline->fps;
    return count > 1
               ? (timeline->frame_count - 1) / timeline->fps * (double)value / (double)(count - 1)
               : 0;
}

int pel_scene_keyframes(const struct pel_scene *scene, struct pel_keyframe *keyframes, int most) {
    const json_t *root = scene->source ? scene->source->root : NULL, *found = NULL, *track;
    const json_t *tracks = json_object_get(json_object_get(root, "animation"), "tracks");
    size_t i;
    json_array_foreach(tracks, i, track) {
        // Of several that move the camera none is the way by itself.
        if (moves_camera(track) && found)
            return 0;
        if (moves_camera(track))
            found = track;
    }
    const char *key = json_string_value(json_object_get(found, "key"));
    const json_t *values = json_object_get(found, "values");
    size_t count = json_array_size(values);
    if (!key || strcmp(key, "camera") != 0 || count > INT_MAX)
        return 0;
    for (i = 0; i < count; i++) {
        struct pel_keyframe keyframe = {time_of(found, i, count, &scene->timeline), scene->camera};
        if (!read_viewpoint(json_array_get(values, i), &keyframe.camera))
            return 0;
        if (i < (size_t)most)
            keyframes[i] = keyframe;
    }
    return (int)count;
}

// ---- Writing -----------------------------------------------------------------------------------

bool pel_scene_rebase(struct pel_scene *scene) {
    json_t *root = write_root(scene);
    bool good = root && take_root(scene, root);
    json_decref(root);
    return good;
}

bool pel_scene_set_keyframes(struct pel_scene *scene, const struct pel_keyframe *keyframes,
                             int count, double fps) {
    if (!check(keyframes, count, fps))
        return false;
    json_t *root = write_root(scene);
    struct pel_timeline timeline = scene->timeline;
    timeline.fps = fps;
    bool good = root && put(scene, root, keyframes, count, &timeline) && take_root(scene, root);
    json_decref(root);
    if (good)
        scene->timeline = timeline;
    return good;
}
