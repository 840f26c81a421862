// command_devices.c - `pellucid devices`: what OpenCL offers, and what Pellucid would make of it.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"
#include "cli/report.h"

enum { KEY_JSON = CLI_KEY_COMMAND };

static const struct argp_option options[] = {
    {"json", KEY_JSON, NULL, 0, "Write a JSON array", 0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state) {
    (void)argument;
    bool *json = state->input;
    switch (key) {
    case KEY_JSON:
        *json = true;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const char *type_name(const struct pel_device_info *device) {
    return device->gpu ? "gpu" : device->cpu ? "cpu" : "accelerator";
}

static json_t *device_json(const struct pel_device_info *device, int index, bool chosen) {
    json_t *object = json_object();
    json_object_set_new(object, "index", json_integer(index));
    json_object_set_new(object, "name", report_text(device->name));
    json_object_set_new(object, "vendor", report_text(device->vendor));
    json_object_set_new(object, "platform", report_text(device->platform));
    json_object_set_new(object, "driver", report_text(device->driver));
    json_object_set_new(object, "version", report_text(device->version));
    json_object_set_new(object, "type", json_string(type_name(device)));
    json_object_set_new(object, "usable", json_boolean(device->usable));
    json_object_set_new(object, "problem", report_text(device->problem));
    json_object_set_new(object, "compute_units", json_integer(device->compute_units));
    json_object_set_new(object, "memory_bytes", json_integer((json_int_t)device->memory_bytes));
    json_object_set_new(object, "max_allocation_bytes",
                        json_integer((json_int_t)device->max_allocation_bytes));
    json_object_set_new(object, "max_constant_bytes",
                        json_integer((json_int_t)device->max_constant_bytes));
    json_object_set_new(object, "local_bytes", json_integer((json_int_t)device->local_bytes));
    json_object_set_new(object, "images", json_boolean(device->images));
    json_t *max_image = json_array();
    for (int axis = 0; axis < 3; axis++)
        json_array_append_new(max_image, json_integer((json_int_t)device->max_image[axis]));
    json_object_set_new(object, "max_image", max_image);
    json_object_set_new(object, "gl_sharing", json_boolean(device->gl_sharing));
    json_object_set_new(object, "native_float_width", json_integer(device->native_float_width));
    json_object_set_new(object, "max_work_group", json_integer((json_int_t)device->max_work_group));
    json_object_set_new(object, "reader", json_string(report_reader(device->reader)));
    json_object_set_new(object, "lanes", json_integer(device->lanes));
    json_object_set_new(object, "work_group", json_integer(device->work_group));
    json_object_set_new(object, "chosen", json_boolean(chosen));
    return object;
}

static void print_bytes(const char *label, uint64_t bytes) {
    char text[REPORT_TEXT_BYTES];
    printf("    %-16s %s\n", label, report_bytes(text, bytes));
}

static void print_device(const struct pel_device_info *device, int index, bool chosen) {
    printf("%c %d  %s\n", chosen ? '*' : ' ', index, device->name);
    printf("    %-16s %s\n", "platform", device->platform);
    printf("    %-16s %s\n", "vendor", device->vendor);
    printf("    %-16s %s\n", "type", type_name(device));
    printf("    %-16s %s\n", "driver", device->driver);
    printf("    %-16s %s\n", "version", device->version);
    printf("    %-16s %d\n", "compute units", device->compute_units);
    print_bytes("memory", device->memory_bytes);
    print_bytes("one buffer", device->max_allocation_bytes);
    print_bytes("constant memory", device->max_constant_bytes);
    print_bytes("local memory", device->local_bytes);
    if (device->images)
        printf("    %-16s up to %zu x %zu x %zu\n", "3-D images", device->max_image[0],
               device->max_image[1], device->max_image[2]);
    else
        printf("    %-16s none\n", "3-D images");
    printf("    %-16s %s\n", "OpenGL buffers", device->gl_sharing ? "can be shared" : "not shared");
    printf("    %-16s %d\n", "float lanes", device->native_float_width);
    printf("    %-16s up to %zu\n", "work-group", device->max_work_group);
    if (device->usable)
        printf("    %-16s reader %s, lanes %d, work-group %d\n", "Pellucid takes",
               report_reader(device->reader), device->lanes, device->work_group);
    else
        printf("    %-16s %s\n", "cannot be used", device->problem);
}

// The first usable GPU, else the first usable device, else -1: the rule of pel_renderer_create.
static int choose(const struct pel_device_info *devices, int count) {
    int chosen = -1;
    for (int i = 0; i < count; i++) {
        if (devices[i].usable && devices[i].gpu)
            return i;
        if (devices[i].usable && chosen < 0)
            chosen = i;
    }
    return chosen;
}

int command_devices(int argc, char **argv) {
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .doc = "Lists the OpenCL devices of this machine, with what Pellucid would choose for "
               "each. The one marked * is used when neither --device nor PELLUCID_DEVICE names "
               "another.\v"
               "Examples:\n\n"
               "  pellucid devices\n"
               "  pellucid devices --json\n",
    };
    bool json = false;
    error_t status = argp_parse(&argp, argc, argv, 0, NULL, &json);
    if (status)
        return status;
    struct pel_device_info *devices = calloc(PEL_DEVICE_MAX, sizeof *devices);
    if (!devices)
        return cli_fail(PEL_ERROR_MEMORY, "cannot allocate the list of devices");
    int count = pel_device_list(devices);
    int chosen = choose(devices, count);
    json_t *array = json_array();
    for (int i = 0; i < count; i++) {
        if (json)
            json_array_append_new(array, device_json(&devices[i], i, i == chosen));
        else
            print_device(&devices[i], i, i == chosen);
    }
    free(devices);
    if (count == 0) {
        json_decref(array);
        return cli_fail_library();
    }
    if (json)
        return report_json(array);
    json_decref(array);
    return report_finish(PEL_OK);
}
