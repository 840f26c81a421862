// command_info.c - `pellucid info`: what is in volume and scene files, as Pellucid would load them.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/describe.h"
#include "cli/describe_scene.h"
#include "cli/options.h"
#include "cli/report.h"

enum { KEY_JSON = CLI_KEY_COMMAND, KEY_BRICKS };

struct arguments {
    char **files; // borrowed from the command line
    int file_count;
    bool json, bricks;
    struct pel_load_options load;
};

static const struct argp_option options[] = {
    {"json", KEY_JSON, NULL, 0, "Write a JSON array with an object for each file", 0},
    {"bricks", KEY_BRICKS, NULL, 0,
     "How many bricks of 8 to 128 voxels can be seen, and to how few clusters they join; not of "
     "hypertextures",
     0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state) {
    (void)argument;
    struct arguments *arguments = state->input;
    switch (key) {
    case KEY_JSON:
        arguments->json = true;
        return 0;
    case KEY_BRICKS:
        arguments->bricks = true;
        return 0;
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &arguments->load;
        return 0;
    case ARGP_KEY_ARGS:
        arguments->files = state->argv + state->next;
        arguments->file_count = state->argc - state->next;
        return 0;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "a file is needed");
        return PEL_ERROR_ARGUMENT;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

// Hypertextures have no voxels before they are baked.
static bool has_bricks(const struct pel_scene *scene, int instance) {
    return scene->volumes[scene->instances[instance].volume]->voxels != NULL;
}

// Adds what is to be said about bricks to each volume of a scene; returns the exit status.
static int add_bricks(const struct pel_scene *scene, json_t *volumes) {
    for (int i = 0; i < scene->instance_count; i++) {
        if (!has_bricks(scene, i))
            continue;
        json_t *bricks = describe_bricks_json(scene, i);
        if (!bricks)
            return cli_fail_library();
        json_object_set_new(json_array_get(volumes, (size_t)i), "bricks", bricks);
    }
    return PEL_OK;
}

// Both append to `array` or print, and return the exit status.
static int show_scene(const char *path, const struct arguments *arguments, json_t *array) {
    struct pel_scene *scene = pel_scene_load(path, NULL, 0);
    if (!scene)
        return cli_fail_library();
    int status = PEL_OK;
    if (array) {
        json_t *object = describe_scene_json(scene);
        json_object_set_new(object, "file", report_text(path));
        if (arguments->bricks)
            status = add_bricks(scene, json_object_get(object, "volumes"));
        json_array_append_new(array, object);
    } else {
        printf("%s\n", path);
        describe_scene(scene);
        for (int i = 0; !status && arguments->bricks && i < scene->instance_count; i++)
            if (has_bricks(scene, i))
                status = describe_bricks(scene, i, 4);
    }
    pel_scene_destroy(scene);
    return status;
}

// Bricks are those that `pellucid render` would show of the file.
static int show_file_bricks(const char *path, json_t *object) {
    struct pel_scene *scene = pel_scene_from_files(&path, 1, NULL, 0);
    if (!scene)
        return cli_fail_library();
    int status = PEL_OK;
    json_t *bricks = object ? describe_bricks_json(scene, 0) : NULL;
    if (!object)
        status = describe_bricks(scene, 0, 2);
    else if (bricks)
        json_object_set_new(object, "bricks", bricks);
    else
        status = cli_fail_library();
    pel_scene_destroy(scene);
    return status;
}

static int show_volume(const char *path, const struct arguments *arguments, json_t *array) {
    struct pel_volume *volume = pel_volume_load(path, &arguments->load);
    if (!volume)
        return cli_fail_library();
    struct pel_statistics statistics;
    pel_volume_measure(volume, &statistics);
    json_t *object = NULL;
    if (array) {
        object = describe_json(volume, &statistics);
        json_object_set_new(object, "file", report_text(path));
        json_array_append_new(array, object);
    } else {
        printf("%s\n", path);
        describe_print(volume, &statistics, 2);
    }
    pel_volume_destroy(volume);
    return arguments->bricks ? show_file_bricks(path, object) : PEL_OK;
}

int command_info(int argc, char **argv) {
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "FILE...",
        .doc = "Says what is in volume and scene files: size, type, place in the body (the axes' "
               "letters say where i, j and k lead: R right, A anterior, S superior), and values, "
               "with a histogram on a logarithmic scale.\v"
               "Files that cannot be read are reported, and the others shown. Examples:\n\n"
               "  pellucid info head.nii.gz\n"
               "  pellucid info scene.json --json\n"
               "  pellucid info scene.json --bricks\n"
               "  pellucid info dump.bin --raw dims=64x64x32,type=uint16\n",
        .children = cli_load_children,
    };
    struct arguments arguments = {0};
    error_t status = argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    if (status)
        return status;
    json_t *array = arguments.json ? json_array() : NULL;
    for (int i = 0; i < arguments.file_count; i++) {
        const char *path = arguments.files[i];
        int result = cli_is_scene(path) ? show_scene(path, &arguments, array)
                                        : show_volume(path, &arguments, array);
        if (!status)
            status = result;
    }
    if (!array)
        return report_finish(status);
    int written = report_json(array);
    return status ? status : written;
}
