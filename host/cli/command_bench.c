// command_bench.c - `pellucid bench`: how fast this device renders.
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/bench.h"
#include "cli/device_option.h"
#include "cli/nearest.h"
#include "cli/options.h"
#include "cli/report.h"

static const struct suite {
    const char *name, *summary;
    int (*add)(struct bench *bench);
} suites[] = {
    {"task",
     "256^3 voxels, transparent, nearly a surface, and rainbow; 1 to 8 copies; lanes, readers",
     bench_add_task},
    {"volumes", "1 to 32 volumes of 64^3 voxels, overlapping and side by side", bench_add_volumes},
    {"workgroup", "sizes and shapes of work-groups, and rays per work-item", bench_add_workgroup},
    {"thesis", "what tables 6.1 to 6.11 of Romero 2009 measured", bench_add_thesis},
    {"stereo", "what a second eye costs over one, of a fog and of a surface", bench_add_stereo},
    {"skip", "all ways to skip empty space, for several volumes and transfer functions",
     bench_add_skip},
    {"scaling", "1 to all compute units, sizes of pictures and volumes, 1 to 32 volumes",
     bench_add_scaling},
    {"changes", "what a moved camera, and edits of a scene, send and derive", bench_add_changes},
    {"start", "the whole program on a small scene, before and after kernels are cached",
     bench_add_start},
};

enum { SUITES = sizeof suites / sizeof *suites };

enum {
    KEY_LIST = CLI_KEY_COMMAND,
    KEY_FRAMES,
    KEY_SIZE,
    KEY_JSON,
    KEY_MARKDOWN,
    KEY_PLOT,
    KEY_DATA,
    KEY_LARGEST,
    KEY_SKIP,
    KEY_SHADING,
    KEY_ONLY,
    KEY_PEER,
};

static const struct argp_option options[] = {
    {"list", KEY_LIST, NULL, 0, "List the suites", 0},
    {"frames", KEY_FRAMES, "N", 0, "Frames of each case (default 7)", 0},
    {"size", KEY_SIZE, "WxH", 0, "Pixels (default: the suite's own)", 0},
    {"largest", KEY_LARGEST, "N", 0,
     "Voxels along a side of the largest volume of 'thesis', 'skip', 'scaling' and 'changes' "
     "(default 512)",
     0},
    {"skip", KEY_SKIP, "NAME", 0,
     "How empty space is skipped in the suites 'task', 'skip' and 'changes' and in scenes: none, "
     "grid, distance, octree, bvh, blocks, auto, or all of them; may be repeated",
     0},
    {"shading", KEY_SHADING, NULL, 0, "Measure the suite 'task' with light, too", 0},
    {"only", KEY_ONLY, "PATTERN", 0,
     "Only cases in whose 'SUITE NAME xVOLUMES WxH' the shell pattern is found, and those they "
     "are compared with",
     0},
    {"data", KEY_DATA, "DIR", 0,
     "Folder with the files of the suite 'task', or with their folder 'oracle' (default: "
     "$PELLUCID_TEST_DATA)",
     0},
    {"peer", KEY_PEER, "NAME=COMMAND", 0,
     "Another program to measure in turns with the suite 'task'; {tf}, {width}, {height}, "
     "{volumes}, {shading} (0 or 1) and {data} in its command are filled in, and the last line it "
     "prints must be "
     "JSON with \"median_ms\"; may be repeated",
     0},
    {"json", KEY_JSON, "FILE", 0, "Write a line of JSON for each case; - for standard output", 0},
    {"markdown", KEY_MARKDOWN, "FILE", 0, "Write the tables to a file, too", 0},
    {"plot", KEY_PLOT, "FILE", 0, "Draw the medians as bars, as SVG", 0},
    {0},
};

struct arguments {
    struct bench *bench;
    char **names;
    int name_count;
    bool list;
};

static bool read_frames(const char *text, int *frames) {
    if (!cli_integer("--frames", text, 1, frames))
        return false;
    if (*frames <= BENCH_FRAMES_MOST)
        return true;
    cli_fail(PEL_ERROR_ARGUMENT, "--frames: %d, at most %d", *frames, BENCH_FRAMES_MOST);
    return false;
}

static bool add_peer(struct bench_options *chosen, const char *text) {
    const char *equals = strchr(text, '=');
    if (!equals || equals == text || !equals[1] || equals - text >= BENCH_NAME_BYTES) {
        cli_fail(PEL_ERROR_ARGUMENT, "--peer: '%s' is not of the form NAME=COMMAND", text);
        return false;
    }
    if (chosen->peer_count == BENCH_PEERS) {
        cli_fail(PEL_ERROR_ARGUMENT, "--peer: more than %d", BENCH_PEERS);
        return false;
    }
    struct bench_peer *peer = &chosen->peers[chosen->peer_count++];
    snprintf(peer->name, sizeof peer->name, "%.*s", (int)(equals - text), text);
    peer->command = equals + 1;
    return bench_peer_check(peer);
}

static error_t parse(int key, char *argument, struct argp_state *state) {
    struct arguments *arguments = state->input;
    struct bench_options *chosen = &arguments->bench->options;
    bool good = true;
    int size[2];
    switch (key) {
    case KEY_LIST:
        arguments->list = true;
        break;
    case KEY_FRAMES:
        good = read_frames(argument, &chosen->frames);
        break;
    case KEY_SIZE:
        good = cli_sizes("--size", argument, 2, size);
        if (good)
            chosen->width = size[0], chosen->height = size[1];
        break;
    case KEY_JSON:
        chosen->json = argument;
        break;
    case KEY_MARKDOWN:
        chosen->markdown = argument;
        break;
    case KEY_PLOT:
        chosen->plot = argument;
        break;
    case KEY_LARGEST:
        good = cli_integer("--largest", argument, 16, &chosen->largest);
        break;
    case KEY_ONLY:
        chosen->only = argument;
        break;
    case KEY_SKIP:
        good = bench_read_skip(argument, &chosen->skips);
        break;
    case KEY_SHADING:
        chosen->shading = true;
        break;
    case KEY_DATA:
        chosen->data = argument;
        break;
    case KEY_PEER:
        good = add_peer(chosen, argument);
        break;
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &chosen->renderer;
        break;
    case ARGP_KEY_ARGS:
        arguments->names = state->argv + state->next;
        arguments->name_count = state->argc - state->next;
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

static int list_suites(void) {
    for (int i = 0; i < SUITES; i++)
        printf("%-10s %s\n", suites[i].name, suites[i].summary);
    return report_finish(PEL_OK);
}

static const struct suite *find_suite(const char *name) {
    for (int i = 0; i < SUITES; i++)
        if (strcmp(name, suites[i].name) == 0)
            return &suites[i];
    return NULL;
}

static int fail_unknown(const char *name) {
    const char *names[SUITES];
    for (int i = 0; i < SUITES; i++)
        names[i] = suites[i].name;
    const char *nearest = cli_nearest(name, names, SUITES);
    if (nearest)
        return cli_fail(PEL_ERROR_ARGUMENT, "no suite '%s'; did you mean '%s'?", name, nearest);
    return cli_fail(PEL_ERROR_ARGUMENT,
                    "'%s' is neither a suite nor a scene; 'pellucid bench --list' lists the suites",
                    name);
}

// A suite, or a scene or volume file. All names are checked before any work is done.
static int add_names(struct bench *bench, char **names, int count) {
    for (int i = 0; i < count; i++)
        if (!find_suite(names[i]) && access(names[i], F_OK) != 0)
            return fail_unknown(names[i]);
    int status = PEL_OK;
    for (int i = 0; !status && i < count; i++) {
        const struct suite *suite = find_suite(names[i]);
        status = suite ? suite->add(bench) : bench_add_scene_file(bench, names[i]);
    }
    for (int i = 0; !status && count == 0 && i < SUITES; i++)
        status = suites[i].add(bench);
    return status;
}

static bool has_task(const struct arguments *arguments) {
    for (int i = 0; i < arguments->name_count; i++)
        if (strcmp(arguments->names[i], "task") == 0)
            return true;
    return arguments->name_count == 0;
}

static bool is_standard_output(const char *path) {
    return path && strcmp(path, "-") == 0;
}

// Tells before minutes of measuring that a result could not be written.
static int check_output(const char *path) {
    if (!path || is_standard_output(path))
        return PEL_OK;
    char folder[4096];
    const char *slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path + 1) : 1,
             slash ? path : ".");
    struct stat status;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode))
        return cli_fail(PEL_ERROR_FILE, "%s: is a folder", path);
    if (access(folder, W_OK) != 0)
        return cli_fail(PEL_ERROR_FILE, "%s: cannot write: %s", path, strerror(errno));
    return PEL_OK;
}

typedef void (*writer)(FILE *, const struct bench *, const struct bench_machine *);

// Through a temporary beside the file, so that a failure leaves an older one as it was. What is no
// ordinary file, such as a pipe, is written to directly.
static int write_output(const char *path, writer write, const struct bench *bench,
                        const struct bench_machine *machine) {
    struct stat status;
    bool special = stat(path, &status) == 0 && !S_ISREG(status.st_mode);
    char temporary[4096];
    snprintf(temporary, sizeof temporary, special ? "%s" : "%s.%ld", path, (long)getpid());
    FILE *file = fopen(temporary, special ? "w" : "wx");
    if (!file)
        return cli_fail(PEL_ERROR_FILE, "%s: cannot write: %s", path, strerror(errno));
    write(file, bench, machine);
    bool good = !ferror(file);
    good = fclose(file) == 0 && good;
    good = good && (special || rename(temporary, path) == 0);
    if (good)
        return PEL_OK;
    int code = cli_fail(PEL_ERROR_FILE, "%s: cannot write: %s", path, strerror(errno));
    if (!special)
        unlink(temporary);
    return code;
}

// A peer that has never given a time is a mistake in its command.
static int check_peers(const struct bench *bench) {
    for (int p = 0; p < bench->options.peer_count; p++) {
        const char *problem = "";
        int times = 0;
        for (int i = 0; i < bench->case_count; i++) {
            times += bench->cases[i].peers[p].count;
            if (bench->cases[i].peer_problems[p][0])
                problem = bench->cases[i].peer_problems[p];
        }
        if (times == 0)
            return cli_fail(PEL_ERROR_ARGUMENT, "--peer %s: never gave a time: %s",
                            bench->options.peers[p].name, problem);
    }
    return PEL_OK;
}

// The tables go to standard output unless the JSON does.
static int report(const struct bench *bench) {
    struct bench_machine machine;
    bench_machine_describe(&machine, bench);
    const char *json = bench->options.json, *markdown = bench->options.markdown;
    int status = PEL_OK;
    if (is_standard_output(json))
        bench_write_json(stdout, bench, &machine);
    else
        bench_write_table(stdout, bench, &machine);
    if (json && !is_standard_output(json))
        status = write_output(json, bench_write_json, bench, &machine);
    if (!status && markdown && !is_standard_output(markdown))
        status = write_output(markdown, bench_write_table, bench, &machine);
    if (!status && bench->options.plot)
        status = write_output(bench->options.plot, bench_write_plot, bench, &machine);
    return report_finish(status ? status : check_peers(bench));
}

static int run(struct bench *bench, const struct arguments *arguments) {
    const struct bench_options *chosen = &bench->options;
    if (is_standard_output(chosen->json) && is_standard_output(chosen->markdown))
        return cli_fail(PEL_ERROR_ARGUMENT, "--json and --markdown both want standard output");
    if (chosen->peer_count && !has_task(arguments))
        return cli_fail(PEL_ERROR_ARGUMENT,
                        "--peer: only the suite 'task' is measured with other programs");
    int status = check_output(chosen->json);
    if (!status)
        status = check_output(chosen->markdown);
    if (!status)
        status = check_output(chosen->plot);
    if (!status)
        status = add_names(bench, arguments->names, arguments->name_count);
    if (!status && chosen->only && !bench_keep_only(bench))
        status = (int)PEL_ERROR_ARGUMENT;
    if (!status)
        status = bench_run(bench);
    return status ? status : report(bench);
}

int command_bench(int argc, char **argv) {
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .children = cli_device_children,
        .args_doc = "[SUITE|SCENE...]",
        .doc = "Measures how fast this device renders: suites of cases (all of them by default), "
               "or scenes and volumes of your own. Cases are measured in turns, so that whatever "
               "else the machine does hits all alike: compare ratios within a run.\v"
               "Examples:\n\n"
               "  pellucid bench --list\n"
               "  pellucid bench task --size 640x480 --frames 15 --json task.jsonl\n"
               "  pellucid bench scene.json --lanes 8\n"
               "  pellucid bench task --peer 'other=other-bench {tf} {width} {height} {volumes}'\n",
    };
    struct bench bench;
    bench_init(&bench);
    struct arguments arguments = {.bench = &bench};
    int status = argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    if (!status)
        status = arguments.list ? list_suites() : run(&bench, &arguments);
    bench_finish(&bench);
    return status;
}
