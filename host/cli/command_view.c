// command_view.c - `pellucid view`: a window on a scene or on volumes.
#include <stdio.h>
#include <string.h>

#include "cli/options.h"
#include "cli/overrides.h"
#include "cli/report.h"
#include "viewer/keys.h"
#include "viewer/viewer.h"

enum {
    KEY_SIZE = CLI_KEY_COMMAND,
    KEY_FULL_SCREEN,
    KEY_BARE,
    KEY_RATE,
    KEY_SCRIPT,
    KEY_SCREENSHOT,
    KEY_FRAMES,
    KEY_LATENCY,
    KEY_KEYS,
    KEY_VERBOSE,
    KEY_DEVICE,
    KEY_READER,
    KEY_SET,
};

struct arguments {
    bool keys;
    struct pel_viewer_latency latency;
    struct pel_viewer_report report;
    char **inputs;
    int input_count;
    struct overrides overrides;
    struct pel_viewer_options viewer;
};

static const struct argp_option options[] = {
    {0, 0, NULL, 0, "The window:", 1},
    {"size", KEY_SIZE, "WxH", 0, "Its size (default: that of the scene's picture)", 0},
    {"full-screen", KEY_FULL_SCREEN, "N", OPTION_ARG_OPTIONAL,
     "Begin on the whole screen, of monitor N if there are several, counted from 0 (default 0)", 0},
    {"bare", KEY_BARE, NULL, 0, "Begin without panels and read-outs", 0},
    {"rate", KEY_RATE, "N", 0, "Pictures per second to hold while things move (default 30)", 0},
    {0, 0, NULL, 0, "Demonstrations and tests:", 2},
    {"script", KEY_SCRIPT, "FILE", 0, "Replay the events of a file", 0},
    {"screenshot", KEY_SCREENSHOT, "FILE", 0,
     "Save the window there after the last event, once its picture is complete, and end", 0},
    {"frames", KEY_FRAMES, "N", 0, "End after N pictures", 0},
    {"latency", KEY_LATENCY, "N", 0,
     "Measure how long it takes from N inputs to pictures that show them, each input coming while "
     "a frame is in flight; write JSON to standard output, and end",
     0},
    {"keys", KEY_KEYS, NULL, 0, "List every key and mouse action as Markdown, and end", 0},
    {"verbose", KEY_VERBOSE, NULL, 0, "Say at the end how pictures came into the window", 0},
    {0, 0, NULL, 0, "The scene and the device:", 3},
    {"set", KEY_SET, "KEY=VALUE", 0,
     "Set any key of the scene, such as volumes.0.density=0.2; may be repeated", 0},
    {"device", KEY_DEVICE, "D", 0,
     "Number, part of the name, or type (gpu, cpu); 'pellucid devices' lists them", 0},
    {"reader", KEY_READER, "auto|buffer|image", 0, "How kernels read voxels", 0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state) {
    struct arguments *arguments = state->input;
    struct pel_viewer_options *viewer = &arguments->viewer;
    bool good = true;
    switch (key) {
    case KEY_SIZE:
        good = cli_sizes("--size", argument, 2, viewer->size);
        break;
    case KEY_FULL_SCREEN:
        viewer->full_screen = 0;
        good = !argument || cli_integer("--full-screen", argument, 0, &viewer->full_screen);
        viewer->full_screen++;
        break;
    case KEY_BARE:
        viewer->bare = true;
        break;
    case KEY_RATE:
        good = cli_number("--rate", argument, &viewer->rate);
        if (good && !(viewer->rate >= 1 && viewer->rate <= 1000))
            good = !cli_fail(PEL_ERROR_ARGUMENT, "--rate: %g is outside 1..1000", viewer->rate);
        break;
    case KEY_SCRIPT:
        viewer->script = argument;
        break;
    case KEY_SCREENSHOT:
        viewer->screenshot = argument;
        break;
    case KEY_FRAMES:
        good = cli_integer("--frames", argument, 1, &viewer->frames);
        break;
    case KEY_LATENCY:
        good = cli_integer("--latency", argument, 1, &arguments->latency.inputs);
        viewer->latency = &arguments->latency;
        break;
    case KEY_KEYS:
        arguments->keys = true;
        break;
    case KEY_SET:
        good = overrides_add_setting(&arguments->overrides, "--set", argument);
        break;
    case KEY_VERBOSE:
        viewer->report = &arguments->report;
        break;
    case KEY_DEVICE:
        viewer->renderer.device = argument;
        break;
    case KEY_READER:
        good = cli_reader(argument, &viewer->renderer.reader);
        break;
    case ARGP_KEY_ARGS:
        arguments->inputs = state->argv + state->next;
        arguments->input_count = state->argc - state->next;
        break;
    case ARGP_KEY_NO_ARGS:
        if (!arguments->keys)
            argp_error(state, "a scene or a volume is needed");
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

#ifdef PELLUCID_VIEWER

static int print_latency(const struct pel_viewer_latency *latency) {
    json_t *object = json_object();
    json_object_set_new(object, "inputs", json_integer(latency->measured));
    json_object_set_new(object, "in_flight", json_integer(latency->in_flight));
    json_object_set_new(object, "lost", json_integer(latency->lost));
    json_object_set_new(object, "full_frame_ms", report_number(latency->full_ms));
    json_object_set_new(object, "median_ms", report_number(latency->median_ms));
    json_object_set_new(object, "worst_ms", report_number(latency->worst_ms));
    return report_json(object);
}

static void print_report(const struct pel_viewer_report *report) {
    const char *reason = report->reason;
    fprintf(stderr, "pellucid: presented by: %s%s%s; %d of %d pictures by shared buffers\n",
            reason[0] ? "pixel buffer (" : "shared buffer", reason, reason[0] ? ")" : "",
            report->shared, report->pictures);
}

static int view(struct arguments *arguments) {
    if (arguments->keys) {
        pel_keys_write(stdout);
        return PEL_OK;
    }
    const char *const *overrides = (const char *const *)arguments->overrides.texts;
    int count = arguments->overrides.count;
    struct pel_scene *scene;
    if (arguments->viewer.screenshot && !pel_image_check_path(arguments->viewer.screenshot))
        return cli_fail_library();
    if (arguments->input_count == 1 && cli_is_scene(arguments->inputs[0])) {
        arguments->viewer.scene_path = arguments->inputs[0];
        scene = pel_scene_load(arguments->inputs[0], overrides, count);
    } else {
        scene = pel_scene_from_files((const char *const *)arguments->inputs, arguments->input_count,
                                     overrides, count);
    }
    if (!scene)
        return cli_fail_library();
    arguments->viewer.scene = scene;
    char sentence[512];
    enum pel_error code = pel_viewer_run(&arguments->viewer, sentence, sizeof sentence);
    pel_scene_destroy(scene);
    if (code)
        return cli_fail(code, "%s", sentence);
    if (arguments->viewer.report)
        print_report(arguments->viewer.report);
    return arguments->viewer.latency ? print_latency(&arguments->latency) : PEL_OK;
}

#else

static int view(struct arguments *arguments) {
    (void)arguments;
    return cli_fail(PEL_ERROR_UNSUPPORTED,
                    "this program was built without the viewer: install libglfw3-dev and "
                    "libepoxy-dev and configure it with -DPELLUCID_VIEWER=ON; 'pellucid render' "
                    "makes pictures without it");
}

#endif

int command_view(int argc, char **argv) {
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "SCENE|VOLUME...",
        .doc = "Opens a window on a scene file (.json), or on one or more volumes, to explore them "
               "and to change everything by hand.\v"
               "F1 lists every key and what the mouse does. Examples:\n\n"
               "  pellucid view head.nii.gz brain.nii.gz\n"
               "  pellucid view scene.json --full-screen\n"
               "  pellucid view ct.nrrd --size 800x600 --script tour.json --screenshot end.png\n",
    };
    struct arguments arguments = {0};
    int status = argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    if (!status)
        status = view(&arguments);
    overrides_finish(&arguments.overrides);
    return status;
}
