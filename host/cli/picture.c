// picture.c - where pictures go, and what is written into them.
#include "cli/picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "cli/frames.h"
#include "cli/options.h"
#include "cli/report.h"

// The first input's name in the working directory with .png in place of its extension:
// "scans/head.nii.gz" gives "head.png", and so does a folder of slices "scans/head/". The letters
// of a glob pattern are left out.
static void default_picture(char *picture, size_t bytes, const char *input) {
    char name[256];
    size_t length = strlen(input);
    while (length > 1 && input[length - 1] == '/')
        length--;
    size_t begin = length;
    while (begin > 0 && input[begin - 1] != '/')
        begin--;
    snprintf(name, sizeof name, "%.*s", (int)(length - begin), input + begin);
    char *dot = strrchr(name, '.');
    if (dot && dot > name && strcasecmp(dot, ".gz") == 0) {
        *dot = '\0';
        dot = strrchr(name, '.');
    }
    if (dot && dot > name)
        *dot = '\0';
    size_t end = 0;
    for (const char *c = name; *c; c++)
        if (!strchr("*?[]", *c))
            name[end++] = *c;
    name[end] = '\0';
    snprintf(picture, bytes, "%s.png", end ? name : "picture");
}

static bool is_same_file(const char *a, const char *b) {
    struct stat status_a, status_b;
    return stat(a, &status_a) == 0 && stat(b, &status_b) == 0 &&
           status_a.st_dev == status_b.st_dev && status_a.st_ino == status_b.st_ino;
}

// "head.png" becomes "head_left.png" and "head_right.png".
static void name_eyes(struct pictures *pictures) {
    char *name = pictures->names[0];
    char whole[PICTURE_NAME_BYTES];
    memcpy(whole, name, sizeof whole);
    const char *slash = strrchr(whole, '/'), *dot = strrchr(whole, '.');
    if (!dot || (slash && dot < slash))
        dot = whole + strlen(whole);
    // A name too long to take the addition is cut, and then refused for want of an extension.
    for (int i = 0; i < 2; i++)
        snprintf(pictures->names[i], PICTURE_NAME_BYTES, "%.*s_%s%s", (int)(dot - whole), whole,
                 i == 0 ? "left" : "right", dot);
    pictures->count = 2;
}

static int check_overwrite(const char *picture, const struct render_options *options) {
    for (int i = 0; i < options->input_count; i++)
        if (is_same_file(picture, options->inputs[i]))
            return cli_fail(PEL_ERROR_ARGUMENT,
                            "%s: the picture would overwrite its input; name "
                            "another file with -o",
                            picture);
    return PEL_OK;
}

static int check_picture(const char *picture, const struct render_options *options) {
    int status = check_overwrite(picture, options);
    if (status)
        return status;
    return pel_image_check_path(picture) ? PEL_OK : cli_fail_library();
}

// A name for many frames is a video's, or says where their numbers go.
static int check_frames_name(const char *name, const struct render_options *options) {
    if (pel_video_is_path(name))
        return check_overwrite(name, options);
    if (frames_is_pattern(name))
        return check_picture(name, options);
    return cli_fail(PEL_ERROR_ARGUMENT,
                    "%s: many frames need a name with one %%d in it, such as frame_%%04d.png, or "
                    "a video's: .mp4, .webm, .mkv or .gif",
                    name);
}

// The camera as the scene format writes it; memory to free(), or NULL.
static char *camera_text(const struct pel_camera *camera) {
    json_t *object = json_object();
    json_object_set_new(object, "eye", report_numbers(camera->eye, 3));
    json_object_set_new(object, "target", report_numbers(camera->target, 3));
    json_object_set_new(object, "up", report_numbers(camera->up, 3));
    if (camera->orthographic) {
        json_object_set_new(object, "orthographic", json_true());
        json_object_set_new(object, "height", report_number(camera->height_mm));
    } else {
        json_object_set_new(object, "fov", report_number(camera->fov_deg));
    }
    json_object_set_new(object, "shift", report_numbers(camera->shift, 2));
    char *text = json_dumps(object, JSON_REAL_PRECISION(12));
    json_decref(object);
    return text;
}

int pictures_choose(struct pictures *pictures, const struct pel_scene *scene,
                    const struct render_options *options, bool many) {
    char *name = pictures->names[0];
    pictures->count = 1;
    if (options->output)
        snprintf(name, PICTURE_NAME_BYTES, "%s", options->output);
    else if (scene->output.path[0])
        snprintf(name, PICTURE_NAME_BYTES, "%s", scene->output.path);
    else
        default_picture(name, PICTURE_NAME_BYTES, options->inputs[0]);
    bool piped = strcmp(name, "-") == 0;
    if (options->json && piped)
        return cli_fail(PEL_ERROR_ARGUMENT, "--json and the picture both want standard output");
    if (scene->stereo.kind == PEL_STEREO_TWO_FILES) {
        if (piped)
            return cli_fail(PEL_ERROR_ARGUMENT, "two files cannot go to standard output");
        name_eyes(pictures);
    }
    int status = PEL_OK;
    for (int i = 0; i < pictures->count && !status; i++)
        status = many ? check_frames_name(pictures->names[i], options)
                      : check_picture(pictures->names[i], options);
    return status;
}

bool picture_save(const struct pel_image *image, const char *path, const struct pel_scene *scene,
                  const struct pel_render_statistics *statistics) {
    char software[64];
    snprintf(software, sizeof software, "Pellucid %s", pel_version());
    char *camera = camera_text(&scene->camera);
    const char *const texts[][2] = {
        {"Software", software},           {"scene", scene->text ? scene->text : ""},
        {"camera", camera ? camera : ""}, {"device", statistics->device},
        {"driver", statistics->driver},
    };
    struct pel_image_options options = {
        .depth = scene->output.depth,
        .premultiplied = scene->output.premultiplied,
        .texts = texts,
        .text_count = sizeof texts / sizeof *texts,
    };
    bool good = pel_image_save(image, path, &options);
    free(camera);
    return good;
}
