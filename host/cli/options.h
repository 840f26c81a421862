// options.h - what the sub-commands share: their table, messages, and how values are read from the
// command line. The command line is a client of pellucid.h like any other.
#ifndef PEL_CLI_OPTIONS_H
#define PEL_CLI_OPTIONS_H

#include <argp.h>

#include "pellucid.h"

// One sub-command. `run` gets "pellucid NAME" as argv[0] and returns the exit status.
struct command {
    const char *name, *summary;
    int (*run)(int argc, char **argv);
};

int command_render(int argc, char **argv);
int command_view(int argc, char **argv);
int command_info(int argc, char **argv);
int command_devices(int argc, char **argv);
int command_convert(int argc, char **argv);
int command_generate(int argc, char **argv);
int command_bench(int argc, char **argv);

// Says "pellucid: sentence" on standard error and returns `code`, the exit status.
int cli_fail(enum pel_error code, const char *format, ...) PEL_PRINTF(2, 3);

// The same for the library's last failure.
int cli_fail_library(void);

// Shows the library's warnings on standard error from now on, or drops them.
void cli_show_warnings(bool show);

// Reading values. Each returns false and says what is wrong with the value of `option` when `text`
// is not as demanded; the exit status is then PEL_ERROR_ARGUMENT.
bool cli_number(const char *option, const char *text, double *value);
bool cli_integer(const char *option, const char *text, int least, int *value);

// Prints a number with no more digits than it needs, as messages and pictures repeat it.
enum { CLI_NUMBER_BYTES = 32 };
void cli_print_number(char text[CLI_NUMBER_BYTES], double value);

// Reads `count` positive integers with an 'x' between them: "640x480".
bool cli_sizes(const char *option, const char *text, int count, int *values);

// Reads the value of --reader and of --lanes.
bool cli_reader(const char *text, enum pel_reader *reader);
bool cli_lanes(const char *text, int *lanes);

// True when a path names a scene file and not a volume: it ends in .json.
bool cli_is_scene(const char *path);

// Options --time, --channel, --split-channels and --raw, for commands that load volumes. The input
// is a struct pel_load_options; use it as `children` of a command's argp.
extern const struct argp_child cli_load_children[];

// Keys of long options that have no short form; each command counts from its own base.
enum { CLI_KEY_COMMAND = 0x100, CLI_KEY_LOAD = 0x200, CLI_KEY_DEVICE = 0x300 };

#endif
