// scene_file.c - scenes from JSON files, or made for volume files that come without one.
//
// A scene's JSON is parsed (jansson finds syntax errors), changed by overrides, checked and read as
// a whole (scene_read_*.c), and only then are its volumes loaded (scene_load.c). Volume files in
// place of a scene become JSON in memory and take the same way.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/memory.h"
#include "world/animation.h"
#include "world/remark.h"
#include "world/scene.h"
#include "world/scene_source.h"

// Scenes are written by people.
enum { SCENE_BYTES_MAX = 16 << 20 };

static const char *const scene_keys[] = {"$schema", "comment", "camera", "background", "lights",
                                         "volumes", "render",  "stereo", "animation",  "output",
                                         "wall",    "clip",    NULL};

static bool read_document(struct pel_scene *scene, struct pel_scene_plan *plan) {
    const struct pel_scene_node *node = &plan->scene;
    const char *schema;
    return pel_node_check_object(node, scene_keys) && pel_node_get_text(node, "$schema", &schema) &&
           pel_scene_read_settings(scene, node) && pel_scene_read_stereo(scene, node) &&
           pel_scene_read_wall(scene, node) && pel_scene_read_volumes(scene, plan) &&
           pel_scene_read_camera(&plan->camera, node, scene);
}

static bool write_text(struct pel_scene *scene, const json_t *root) {
    char *text = json_dumps(root, JSON_COMPACT);
    scene->text = text ? pel_copy_text(text) : NULL;
    free(text);
    return scene->text || pel_fail(PEL_ERROR_MEMORY, "cannot allocate the scene's text");
}

// Reads the scene of `source` at a frame of its animation, by default the one that it says, and
// takes over what stays of the scene before.
static bool read_frame(struct pel_scene *scene, const double *frame,
                       const struct pel_scene *before) {
    const struct pel_scene_document *document = &scene->source->document;
    struct pel_animation animation = {0};
    struct pel_scene_plan *plan = pel_allocate(1, sizeof *plan);
    json_t *written = json_deep_copy(scene->source->root), *root = json_deep_copy(written);
    if (frame)
        json_object_set_new(json_object_get(written, "animation"), "frame", json_real(*frame));
    const struct pel_scene_node written_node = {.document = document, .value = written};
    bool good = plan && (root || pel_fail(PEL_ERROR_MEMORY, "cannot allocate a scene"));
    if (good) {
        plan->scene = (struct pel_scene_node){.document = document, .value = root};
        good = pel_animation_read(&animation, &written_node) &&
               pel_animation_apply(&animation, root) && read_document(scene, plan) &&
               pel_animation_read_transfers(&animation, plan, scene->instance_count) &&
               pel_scene_load_volumes(scene, plan, before) &&
               pel_animation_place_camera(&animation, scene, plan) && write_text(scene, written);
        scene->timeline = animation.timeline;
        pel_animation_finish(&animation);
        pel_scene_plan_finish(plan);
    }
    json_decref(written);
    json_decref(root);
    free(plan);
    return good;
}

// Makes a scene of parsed JSON.
static struct pel_scene *build(const struct pel_scene_document *document, const json_t *root) {
    struct pel_scene *scene = pel_scene_create();
    if (!scene)
        return NULL;
    scene->source = pel_scene_source_create(document, root);
    if (scene->source && read_frame(scene, NULL, NULL)) {
        pel_scene_remark(scene);
        return scene;
    }
    pel_scene_destroy(scene);
    return NULL;
}

static struct pel_scene *load_json(const char *path, const char *const *overrides,
                                   int override_count) {
    char *text = pel_file_read(path, SCENE_BYTES_MAX, NULL);
    if (!text)
        return NULL;
    struct pel_scene *scene = NULL;
    struct pel_scene_document document = {path, text, overrides, override_count};
    json_error_t error;
    json_t *root = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    if (root)
        scene = build(&document, root);
    else
        pel_fail(PEL_ERROR_FORMAT, "%s:%d:%d: %s", path, error.line, error.column, error.text);
    json_decref(root);
    free(text);
    return scene;
}

// The JSON of a scene that shows these files: one as suits it, several in a colour each.
static json_t *describe_files(const char *const *paths, int path_count) {
    static const char *const palettes[] = {"grey", "hot",    "green", "magenta",
                                           "cyan", "yellow", "blue",  "red"};
    enum { PALETTE_COUNT = sizeof palettes / sizeof *palettes };
    json_t *volumes = json_array();
    for (int i = 0; i < path_count; i++) {
        json_t *volume = json_pack("{s:s}", "file", paths[i]);
        if (path_count > 1)
            json_object_set_new(volume, "palette", json_string(palettes[i % PALETTE_COUNT]));
        if (json_array_append_new(volumes, volume) != 0) {
            json_decref(volumes);
            pel_fail(PEL_ERROR_ARGUMENT, "%s: the name is not valid UTF-8", paths[i]);
            return NULL;
        }
    }
    json_t *root = json_pack("{s:{s:s, s:s}, s:o}", "camera", "view", "oblique", "fit", "visible",
                             "volumes", volumes);
    if (!root)
        pel_fail(PEL_ERROR_MEMORY, "cannot allocate a scene");
    return root;
}

struct pel_scene *pel_scene_load(const char *path, const char *const *overrides,
                                 int override_count) {
    return pel_scene_from_files(&path, 1, overrides, override_count);
}

struct pel_scene *pel_scene_from_files(const char *const *paths, int path_count,
                                       const char *const *overrides, int override_count) {
    if (path_count < 1 || path_count > PEL_VOLUME_MAX) {
        pel_fail(PEL_ERROR_ARGUMENT, "%d files, outside 1..%d", path_count, PEL_VOLUME_MAX);
        return NULL;
    }
    for (int i = 0; i < path_count; i++) {
        if (!*paths[i]) {
            pel_fail(PEL_ERROR_ARGUMENT, "the name of a file is empty");
            return NULL;
        }
    }
    if (path_count == 1 && pel_path_has_extension(paths[0], ".json"))
        return load_json(paths[0], overrides, override_count);
    for (int i = 0; i < path_count; i++) {
        if (pel_path_has_extension(paths[i], ".json")) {
            pel_fail(PEL_ERROR_ARGUMENT,
                     "%s: a scene cannot be combined with other files like '%s'", paths[i],
                     paths[i == 0]);
            return NULL;
        }
    }
    struct pel_scene *scene = NULL;
    struct pel_scene_document document = {NULL, NULL, overrides, override_count};
    json_t *root = describe_files(paths, path_count);
    if (root)
        scene = build(&document, root);
    json_decref(root);
    return scene;
}

bool pel_scene_set_frame(struct pel_scene *scene, double frame) {
    int count = scene->timeline.frame_count;
    if (!scene->source || count == 0)
        return pel_fail(PEL_ERROR_ARGUMENT, "the scene has no animation");
    if (!(frame >= 0 && frame <= count))
        return pel_fail(PEL_ERROR_ARGUMENT, "frame %g, outside 0..%d", frame, count);
    struct pel_scene *next = pel_scene_create();
    if (!next)
        return false;
    next->source = pel_scene_source_share(scene->source);
    bool good = read_frame(next, &frame, scene) || pel_fail_in("frame %g", frame);
    if (good) {
        // The caller's scene becomes the next one, and what it was goes.
        struct pel_scene old = *scene;
        *scene = *next;
        *next = old;
    }
    pel_scene_destroy(next);
    return good;
}
