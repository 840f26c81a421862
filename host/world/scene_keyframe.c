// scene_keyframe.c - viewpoints that were recorded become the scene's animation.
//
// The scene as it stands is written and becomes what its animation acts upon, so that what was
// changed since it was loaded stays. Other tracks than the camera's stay, too.
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

bool pel_scene_set_keyframes(struct pel_scene *scene, const struct pel_keyframe *keyframes,
                             int count, double fps) {
    if (!check(keyframes, count, fps))
        return false;
    char *text = pel_scene_text(scene, NULL);
    json_t *root = text ? json_loads(text, 0, NULL) : NULL;
    free(text);
    if (!root)
        return false;
    struct pel_timeline timeline = scene->timeline;
    timeline.fps = fps;
    const struct pel_scene_document document = {0};
    struct pel_scene_source *source = put(scene, root, keyframes, count, &timeline)
                                          ? pel_scene_source_create(&document, root)
                                          : NULL;
    json_decref(root);
    if (!source)
        return false;
    pel_scene_source_destroy(scene->source);
    scene->source = source;
    scene->timeline = timeline;
    return true;
}
