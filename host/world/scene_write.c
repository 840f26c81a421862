// scene_write.c - scenes to JSON files.
//
// Everything is written from the scene in memory, so what a file said by a preset, a percentile, a
// named view or another program's transform comes back in numbers. Files are named relative to the
// scene's folder, both resolved first, so that a scene and its data can be moved together.
#include "world/scene_write.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/json.h"
#include "base/memory.h"

enum { COLUMNS = 100 };

// ---- Members -----------------------------------------------------------------------------------

void pel_write_value(struct pel_scene_writer *writer, json_t *object, const char *key,
                     json_t *value) {
    if (writer->failed) {
        json_decref(value);
        return;
    }
    if (json_object_set_new(object, key, value) == 0)
        return;
    writer->failed = true;
    pel_fail(PEL_ERROR_MEMORY, "cannot allocate the scene's '%s'", key);
}

json_t *pel_write_object(struct pel_scene_writer *writer, json_t *object, const char *key) {
    pel_write_value(writer, object, key, json_object());
    return json_object_get(object, key);
}

json_t *pel_write_make_number(double value) {
    // Beyond 2^53 doubles are whole, but not every one near them is.
    bool whole = value == floor(value) && fabs(value) < 0x1p53 && !(value == 0 && signbit(value));
    return whole ? json_integer((json_int_t)value) : json_real(value);
}

json_t *pel_write_make_numbers(int count, const double values[]) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++) {
        if (json_array_append_new(list, pel_write_make_number(values[i])) != 0) {
            json_decref(list);
            return NULL;
        }
    }
    return list;
}

void pel_write_number(struct pel_scene_writer *writer, json_t *object, const char *key,
                      double value, double usual) {
    if (value != usual)
        pel_write_value(writer, object, key, pel_write_make_number(value));
}

void pel_write_numbers(struct pel_scene_writer *writer, json_t *object, const char *key, int count,
                       const double values[]) {
    pel_write_value(writer, object, key, pel_write_make_numbers(count, values));
}

void pel_write_bool(struct pel_scene_writer *writer, json_t *object, const char *key, bool value,
                    bool usual) {
    if (value != usual)
        pel_write_value(writer, object, key, json_boolean(value));
}

void pel_write_name(struct pel_scene_writer *writer, json_t *object, const char *key,
                    const char *const *names, int which, int usual) {
    if (which != usual)
        pel_write_value(writer, object, key, json_string(names[which]));
}

void pel_write_text(struct pel_scene_writer *writer, json_t *object, const char *key,
                    const char *text) {
    json_t *value = json_string(text);
    if (value || writer->failed) {
        pel_write_value(writer, object, key, value);
        return;
    }
    writer->failed = true;
    pel_fail(PEL_ERROR_ARGUMENT, "%s: the name is not valid UTF-8", text);
}

void pel_write_colour(struct pel_scene_writer *writer, json_t *object, const char *key,
                      const double rgba[4], bool with_alpha) {
    char text[16] = "#";
    bool exact = true;
    int count = with_alpha && rgba[3] != 1 ? 4 : 3;
    for (int i = 0; i < count; i++) {
        double byte = round(rgba[i] * 255);
        exact = exact && byte >= 0 && byte <= 255 && byte / 255 == rgba[i];
        if (exact)
            snprintf(text + 1 + 2 * i, 3, "%02x", (unsigned)byte);
    }
    if (exact)
        pel_write_text(writer, object, key, text);
    else
        pel_write_numbers(writer, object, key, count, rgba);
}

// ---- Paths -------------------------------------------------------------------------------------

// The folder a path lies in, resolved; NULL with errno.
static char *real_folder(const char *path) {
    char *copy = pel_copy_text(path);
    if (!copy)
        return NULL;
    char *slash = strrchr(copy, '/');
    if (slash)
        slash[slash == copy] = '\0';
    char *folder = realpath(slash ? copy : ".", NULL);
    free(copy);
    return folder;
}

// The same file by a path from the root. Only its folder is resolved: its own name may be a link
// that is meant, or a pattern. NULL when the folder does not exist.
static char *absolute(const char *path) {
    const char *leaf = pel_path_leaf(path);
    char *real = NULL, *folder = NULL;
    // "slices/", "." and ".." have no name of their own.
    if (leaf[0] == '\0' || strchr(leaf, '/') || strcmp(leaf, ".") == 0 || strcmp(leaf, "..") == 0)
        return realpath(path, NULL);
    folder = real_folder(path);
    if (folder && asprintf(&real, "%s/%s", strcmp(folder, "/") ? folder : "", leaf) < 0)
        real = NULL;
    free(folder);
    return real;
}

// The way from a folder to a path, both absolute: out of what they do not share, then in.
static char *relative(const char *folder, const char *path) {
    size_t shared = 0;
    for (size_t i = 0; path[i]; i++) {
        bool ends = (folder[i] == '/' || folder[i] == '\0') && path[i] == '/';
        if (ends)
            shared = i + 1;
        if (folder[i] != path[i])
            break;
    }
    int out = 0;
    for (const char *rest = folder + (strlen(folder) < shared ? strlen(folder) : shared); *rest;
         rest = *rest ? rest + (*rest == '/') : rest) {
        out++;
        rest += strcspn(rest, "/");
    }
    char *text = pel_allocate(strlen(path + shared) + 3 * (size_t)out + 1, 1);
    for (int i = 0; text && i < out; i++)
        strcat(text, "../");
    return text ? strcat(text, path + shared) : NULL;
}

void pel_write_path(struct pel_scene_writer *writer, json_t *object, const char *key,
                    const char *path) {
    char *whole = absolute(path);
    char *named = whole && writer->folder ? relative(writer->folder, whole) : whole;
    // A file in a folder that is gone keeps the name it was given.
    pel_write_text(writer, object, key, named ? named : path);
    if (named != whole)
        free(named);
    free(whole);
}

// ---- Scenes ------------------------------------------------------------------------------------

static json_t *write_scene(const struct pel_scene *scene, const char *folder) {
    struct pel_scene *usual = pel_scene_create();
    json_t *root = usual ? json_object() : NULL;
    if (root) {
        struct pel_scene_writer writer = {.scene = scene, .usual = usual, .folder = folder};
        pel_scene_write_camera(&writer, root);
        pel_scene_write_lights(&writer, root);
        pel_scene_write_clips(&writer, root, true, scene->clip_count, scene->clips);
        pel_scene_write_volumes(&writer, root);
        pel_scene_write_settings(&writer, root);
        pel_scene_write_stereo(&writer, root);
        pel_scene_write_wall(&writer, root);
        pel_scene_write_animation(&writer, root);
        if (writer.failed) {
            json_decref(root);
            root = NULL;
        }
    }
    pel_scene_destroy(usual);
    return root;
}

// The scene's JSON, relative to the folder of `path` if there is one.
static json_t *write_beside(const struct pel_scene *scene, const char *path) {
    char *folder = path ? real_folder(path) : NULL;
    if (path && !folder) {
        pel_fail(PEL_ERROR_FILE, "%s: %s", path, strerror(errno));
        return NULL;
    }
    json_t *root = write_scene(scene, folder);
    free(folder);
    return root;
}

char *pel_scene_text(const struct pel_scene *scene, const char *path) {
    json_t *root = write_beside(scene, path);
    char *text = root ? pel_json_print(root, path ? COLUMNS : 0) : NULL;
    json_decref(root);
    return text;
}

bool pel_scene_save(const struct pel_scene *scene, const char *path) {
    json_t *root = write_beside(scene, path);
    bool good = root && pel_json_save(root, path, COLUMNS);
    json_decref(root);
    return good;
}
