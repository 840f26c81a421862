// main.c - the program `pellucid`: finds the sub-command and runs it.
//
// A sub-command is one file command_<name>.c and one line in the table below. The exit status is
// enum pel_error.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/nearest.h"
#include "cli/options.h"

static const struct command commands[] = {
    {"render", "render a scene, or volumes, to a picture", command_render},
    {"view", "explore a scene, or volumes, in a window", command_view},
    {"info", "say what is in volume and scene files", command_info},
    {"devices", "list the OpenCL devices and what Pellucid would choose", command_devices},
    {"convert", "crop, resample and rewrite a volume", command_convert},
    {"generate", "write a synthetic volume", command_generate},
    {"bench", "measure how fast this device renders", command_bench},
};

enum { COMMAND_COUNT = sizeof commands / sizeof *commands };

static const struct command *find_command(const char *name) {
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(name, commands[i].name) == 0)
            return &commands[i];
    return NULL;
}

static int fail_unknown(const char *name) {
    const char *names[COMMAND_COUNT];
    for (int i = 0; i < COMMAND_COUNT; i++)
        names[i] = commands[i].name;
    const char *nearest = cli_nearest(name, names, COMMAND_COUNT);
    if (nearest)
        return cli_fail(PEL_ERROR_ARGUMENT, "no command '%s'; did you mean '%s'?", name, nearest);
    return cli_fail(PEL_ERROR_ARGUMENT, "no command '%s'; 'pellucid --help' lists them", name);
}

static int run_command(const struct command *command, int argc, char **argv) {
    char name[64];
    snprintf(name, sizeof name, "pellucid %s", command->name);
    argv[0] = name;
    return command->run(argc, argv);
}

static int run_help(const char *name) {
    const struct command *command = find_command(name);
    if (!command)
        return fail_unknown(name);
    char *argv[] = {NULL, "--help", NULL};
    return run_command(command, 2, argv);
}

// Puts the list of commands behind the introduction.
static char *add_commands(int key, const char *text, void *input) {
    (void)input;
    if (key != ARGP_KEY_HELP_POST_DOC)
        return (char *)text;
    char *list = NULL;
    size_t bytes;
    FILE *stream = open_memstream(&list, &bytes);
    if (!stream)
        return (char *)text;
    fprintf(stream, "Commands:\n");
    for (int i = 0; i < COMMAND_COUNT; i++)
        fprintf(stream, "  %-10s %s\n", commands[i].name, commands[i].summary);
    fprintf(stream, "\n%s", text);
    fclose(stream);
    return list;
}

// Stops at the first word that is not an option: it names the command, and the rest is its own.
static error_t parse(int key, char *argument, struct argp_state *state) {
    int *first = state->input;
    switch (key) {
    case ARGP_KEY_ARG:
        (void)argument;
        *first = state->next - 1;
        state->next = state->argc;
        return 0;
    case ARGP_KEY_NO_ARGS:
        return cli_fail(PEL_ERROR_ARGUMENT, "a command is needed; 'pellucid --help' lists them");
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static void print_version(FILE *stream, struct argp_state *state) {
    (void)state;
    fprintf(stream, "pellucid %s\n", pel_version());
}

int main(int argc, char **argv) {
    static const struct argp argp = {
        .parser = parse,
        .args_doc = "COMMAND [ARGUMENT...]",
        .doc = "Ray casts up to 32 volumes at once on any OpenCL device.\v"
               "'pellucid help COMMAND' says what a command takes. Examples:\n\n"
               "  pellucid render head.nii.gz brain.nii.gz -o head.png\n"
               "  pellucid info head.nii.gz\n",
        .help_filter = add_commands,
    };
    argp_err_exit_status = PEL_ERROR_ARGUMENT;
    argp_program_version_hook = print_version;
    cli_show_warnings(true);
    int first = 0;
    error_t status = argp_parse(&argp, argc, argv, ARGP_IN_ORDER, NULL, &first);
    if (status)
        return status;
    const char *name = argv[first];
    if (strcmp(name, "help") == 0) {
        if (argv[first + 1])
            return run_help(argv[first + 1]);
        argp_help(&argp, stdout, ARGP_HELP_STD_HELP, "pellucid");
        return PEL_OK;
    }
    const struct command *command = find_command(name);
    if (!command)
        return fail_unknown(name);
    return run_command(command, argc - first, argv + first);
}
