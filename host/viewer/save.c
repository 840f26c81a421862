// save.c - a picture of a scene into a file.
#include "viewer/save.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool save(const struct pel_image *image, const struct pel_scene *scene, const char *text,
                 const char *path) {
    char software[64];
    snprintf(software, sizeof software, "Pellucid %s", pel_version());
    const char *const texts[][2] = {{"Software", software}, {"scene", text}};
    const struct pel_image_options options = {.depth = scene->output.depth,
                                              .premultiplied = scene->output.premultiplied,
                                              .texts = texts,
                                              .text_count = 2};
    return pel_image_save(image, path, &options);
}

// "head.png" becomes "head_left.png" or "head_right.png".
static char *name_eye(const char *path, int eye) {
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    if (!dot || (slash && dot < slash))
        dot = path + strlen(path);
    char *name = NULL;
    if (asprintf(&name, "%.*s_%s%s", (int)(dot - path), path, eye == 0 ? "left" : "right", dot) < 0)
        return NULL;
    return name;
}

static bool save_eyes(struct pel_renderer *renderer, const struct pel_scene *scene,
                      const char *text, const char *path,
                      const struct pel_render_options *options) {
    struct pel_image *eyes[2];
    bool good = pel_renderer_render_eyes(renderer, scene, options, NULL, eyes);
    for (int i = 0; i < 2 && good; i++) {
        char *name = name_eye(path, i);
        good = name && save(eyes[i], scene, text, name);
        free(name);
    }
    pel_image_destroy(eyes[0]);
    pel_image_destroy(eyes[1]);
    return good;
}

bool pel_save_picture(struct pel_renderer *renderer, const struct pel_scene *scene,
                      const char *path, const struct pel_render_options *options) {
    // A long computation is not begun for a file that cannot be written.
    if (!pel_image_check_path(path))
        return false;
    char *text = pel_scene_text(scene, NULL);
    bool good;
    if (scene->stereo.kind == PEL_STEREO_TWO_FILES) {
        good = save_eyes(renderer, scene, text ? text : "", path, options);
    } else {
        struct pel_image *image = pel_renderer_render(renderer, scene, options, NULL);
        good = image && save(image, scene, text ? text : "", path);
        pel_image_destroy(image);
    }
    free(text);
    return good;
}
