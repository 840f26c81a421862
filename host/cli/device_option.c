// device_option.c - the options of commands that render: which device, and how it is used.
#include "cli/device_option.h"

enum { KEY_DEVICE = CLI_KEY_DEVICE, KEY_READER, KEY_LANES, KEY_WORK_GROUP, KEY_COMPUTE_UNITS };

static const struct argp_option device_options[] = {
    {"device", KEY_DEVICE, "D", 0,
     "Number, part of the name, or type (gpu, cpu); 'pellucid devices' lists them", 0},
    {"reader", KEY_READER, "auto|buffer|image", 0, "How kernels read voxels", 0},
    {"lanes", KEY_LANES, "1|4|8|16", 0, "Rays per work-item", 0},
    {"work-group", KEY_WORK_GROUP, "N", 0, "Work-items per work-group", 0},
    {"compute-units", KEY_COMPUTE_UNITS, "N", 0, "Of a device that can be divided, only so many",
     0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state) {
    struct pel_renderer_options *renderer = state->input;
    bool good = true;
    switch (key) {
    case KEY_DEVICE:
        renderer->device = argument;
        break;
    case KEY_READER:
        good = cli_reader(argument, &renderer->reader);
        break;
    case KEY_LANES:
        good = cli_lanes(argument, &renderer->lanes);
        break;
    case KEY_WORK_GROUP:
        good = cli_integer("--work-group", argument, 1, &renderer->work_group);
        break;
    case KEY_COMPUTE_UNITS:
        good = cli_integer("--compute-units", argument, 1, &renderer->compute_units);
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

static const struct argp device_argp = {.options = device_options, .parser = parse};

const struct argp_child cli_device_children[] = {{&device_argp, 0, "The device:", 5}, {0}};
