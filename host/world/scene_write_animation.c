// scene_write_animation.c - the `animation` of a scene file, written again.
//
// What moves stands in the scene in memory as it is at one frame, but tracks act upon what the file
// says. So a file's tracks are written as they were, and with them what they act upon as the file
// had it: the camera as a whole, anything else by its key. A track of a volume that is gone goes,
// too; indices follow volumes that moved.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "world/scene_override.h"
#include "world/scene_source.h"
#include "world/scene_write.h"

enum { KEY_BYTES = 1024 };

// Brings back what the file had under a key, or that it had nothing. Files are named anew.
static void restore(struct pel_scene_writer *writer, json_t *object, const json_t *before,
                    const char *key) {
    json_t *value = json_object_get(before, key);
    const char *text = json_string_value(value);
    if (!value) {
        json_object_del(object, key);
    } else if (text && strcmp(key, "transfer") == 0 && strpbrk(text, "./")) {
        char *path = pel_path_beside(writer->scene->source->document.path, text);
        if (path)
            pel_write_path(writer, object, key, path);
        free(path);
    } else {
        pel_write_value(writer, object, key, json_deep_copy(value));
    }
}

// The name that the volume of that index had in the file.
static const char *name_before(const json_t *volume) {
    const char *name = json_string_value(json_object_get(volume, "name"));
    const char *file = json_string_value(json_object_get(volume, "file"));
    const char *kind =
        json_string_value(json_object_get(json_object_get(volume, "generate"), "kind"));
    return name ? name : file ? pel_path_leaf(file) : kind ? kind : "";
}

// Where the volume of an index in the file is now: the one of its name, in the same place if it can
// be; -1 when it is gone.
static int find_now(const struct pel_scene *scene, const json_t *volumes, size_t index) {
    const char *name = name_before(json_array_get(volumes, index));
    int found = -1;
    for (int i = scene->instance_count; i-- > 0;)
        if (strcmp(scene->instances[i].name, name) == 0 && (found < 0 || found != (int)index))
            found = i;
    return found;
}

// Brings back what a track of a volume acts upon, and points the track to where the volume is now.
static bool restore_volume(struct pel_scene_writer *writer, json_t *root, json_t *track,
                           const char *path) {
    static const char *const look[] = {"transfer", "palette", "opacity_unit", NULL};
    const json_t *volumes = json_object_get(writer->scene->source->root, "volumes");
    char *rest, member[KEY_BYTES], key[KEY_BYTES];
    size_t index = strtoul(path, &rest, 10);
    int now = find_now(writer->scene, volumes, index);
    if (rest == path || *rest != '.' || now < 0) {
        pel_warn("the track of '%s' is left out, as its volume is gone",
                 json_string_value(json_object_get(track, "key")));
        return false;
    }
    snprintf(member, sizeof member, "%.*s", (int)strcspn(rest + 1, "."), rest + 1);
    snprintf(key, sizeof key, "volumes.%d%.900s", now, rest);
    json_t *volume = json_array_get(json_object_get(root, "volumes"), (size_t)now);
    const json_t *before = json_array_get(volumes, index);
    bool looks = false;
    for (int i = 0; look[i]; i++)
        looks = looks || strcmp(member, look[i]) == 0;
    for (int i = 0; looks && look[i]; i++)
        restore(writer, volume, before, look[i]);
    if (!looks)
        restore(writer, volume, before, member);
    // A name still says which volume is meant; an index may not.
    const char *said = json_string_value(json_object_get(track, "key"));
    if (said[strlen("volumes.")] >= '0' && said[strlen("volumes.")] <= '9')
        pel_write_text(writer, track, "key", key);
    return true;
}

// False when the track is to be left out.
static bool restore_target(struct pel_scene_writer *writer, json_t *root, json_t *track) {
    const json_t *before = writer->scene->source->root;
    const char *said = json_string_value(json_object_get(track, "key"));
    char path[KEY_BYTES] = "camera", *dot;
    if (said && !pel_scene_key_resolve(path, sizeof path, before, said))
        return false;
    dot = strchr(path, '.');
    if (dot)
        *dot = '\0';
    if (strcmp(path, "volumes") == 0 && dot)
        return restore_volume(writer, root, track, dot + 1);
    json_t *object = json_object_get(root, path);
    const json_t *object_before = json_object_get(before, path);
    if (!dot || strcmp(path, "camera") == 0 || !json_is_object(object) ||
        !json_is_object(object_before)) {
        restore(writer, root, before, path);
        return true;
    }
    char *end = strchr(dot + 1, '.');
    if (end)
        *end = '\0';
    restore(writer, object, object_before, dot + 1);
    return true;
}

void pel_scene_write_animation(struct pel_scene_writer *writer, json_t *root) {
    const struct pel_scene *scene = writer->scene;
    const json_t *before = scene->source ? json_object_get(scene->source->root, "animation") : NULL;
    if (!before || writer->failed)
        return;
    json_t *animation = json_deep_copy(before), *tracks = json_object_get(animation, "tracks");
    pel_write_value(writer, root, "animation", animation);
    if (writer->failed)
        return;
    // The number of frames must not come from the last keyframe of a track that goes.
    if (!json_object_get(animation, "duration"))
        pel_write_value(writer, animation, "frames", json_integer(scene->timeline.frame_count));
    json_object_del(animation, "frame");
    pel_write_number(writer, animation, "frame", scene->timeline.frame, 0);
    for (size_t i = 0; i < json_array_size(tracks);) {
        if (restore_target(writer, root, json_array_get(tracks, i)))
            i++;
        else
            json_array_remove(tracks, i);
    }
}
