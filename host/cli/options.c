// options.c - messages, and values read from the command line.
#include "cli/options.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

int cli_fail(enum pel_error code, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    fputs("pellucid: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return (int)code;
}

int cli_fail_library(void) {
    return cli_fail(pel_error_code(), "%s", pel_error_message());
}

static void print_warning(const char *message, void *user) {
    (void)user;
    fprintf(stderr, "pellucid: warning: %s\n", message);
}

void cli_show_warnings(bool show) {
    pel_on_warning(show ? print_warning : NULL, NULL);
}

bool cli_number(const char *option, const char *text, double *value) {
    char *end;
    *value = strtod(text, &end);
    if (end != text && *end == '\0' && isfinite(*value))
        return true;
    cli_fail(PEL_ERROR_ARGUMENT, "%s: '%s' is not a number", option, text);
    return false;
}

void cli_print_number(char text[CLI_NUMBER_BYTES], double value) {
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, CLI_NUMBER_BYTES, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
}

// Reads a decimal integer and moves `*text` behind it.
static bool read_integer(const char **text, int least, int *value) {
    char *end;
    errno = 0;
    long number = strtol(*text, &end, 10);
    if (end == *text || errno || number < least || number > INT32_MAX)
        return false;
    *text = end;
    *value = (int)number;
    return true;
}

bool cli_integer(const char *option, const char *text, int least, int *value) {
    const char *rest = text;
    if (read_integer(&rest, least, value) && *rest == '\0')
        return true;
    cli_fail(PEL_ERROR_ARGUMENT, "%s: '%s' is not a whole number of at least %d", option, text,
             least);
    return false;
}

bool cli_sizes(const char *option, const char *text, int count, int *values) {
    const char *rest = text;
    bool good = true;
    for (int i = 0; good && i < count; i++) {
        good = read_integer(&rest, 1, &values[i]);
        if (good && i + 1 < count)
            good = *rest++ == 'x';
    }
    if (good && *rest == '\0')
        return true;
    cli_fail(PEL_ERROR_ARGUMENT, "%s: '%s' is not of the form %s", option, text,
             count == 2 ? "640x480" : "64x64x64");
    return false;
}

bool cli_reader(const char *text, enum pel_reader *reader) {
    static const char *const names[] = {"auto", "buffer", "image"};
    for (int i = 0; i < 3; i++) {
        if (strcmp(text, names[i]) == 0) {
            *reader = (enum pel_reader)i;
            return true;
        }
    }
    cli_fail(PEL_ERROR_ARGUMENT, "--reader: '%s' is none of auto, buffer, image", text);
    return false;
}

bool cli_lanes(const char *text, int *lanes) {
    if (!cli_integer("--lanes", text, 1, lanes))
        return false;
    if (*lanes == 1 || *lanes == 4 || *lanes == 8 || *lanes == 16)
        return true;
    cli_fail(PEL_ERROR_ARGUMENT, "--lanes: %d is none of 1, 4, 8, 16", *lanes);
    return false;
}

bool cli_is_scene(const char *path) {
    size_t length = strlen(path);
    return length > 5 && strcasecmp(path + length - 5, ".json") == 0;
}

static bool read_vector(const char *option, const char *text, double vector[3]) {
    const char *rest = text;
    bool good = true;
    for (int i = 0; good && i < 3; i++) {
        char *end;
        vector[i] = strtod(rest, &end);
        good = end != rest && isfinite(vector[i]) && *end == (i < 2 ? 'x' : '\0');
        rest = end + 1;
    }
    if (!good)
        cli_fail(PEL_ERROR_ARGUMENT, "%s: '%s' is not of the form 1x1x2.5", option, text);
    return good;
}

static bool read_type(const char *name, enum pel_voxel_type *type) {
    if (pel_voxel_type_from_name(name, type))
        return true;
    cli_fail_library();
    return false;
}

// One key of --raw; `value` is NULL when there is no '='.
static bool read_raw_key(int key, const char *value, struct pel_load_options *load) {
    int offset = 0;
    switch (key) {
    case 0:
        return cli_sizes("--raw dims", value, 3, load->raw.dims);
    case 1:
        return read_type(value, &load->raw.type);
    case 2:
        return read_vector("--raw spacing", value, load->raw.spacing);
    case 3:
        return read_vector("--raw origin", value, load->raw.origin);
    case 4:
        if (!cli_integer("--raw offset", value, 0, &offset))
            return false;
        load->raw.offset = (size_t)offset;
        return true;
    default:
        load->raw.big_endian = strcmp(value, "big") == 0;
        if (load->raw.big_endian || strcmp(value, "little") == 0)
            return true;
        cli_fail(PEL_ERROR_ARGUMENT, "--raw endian: '%s' is neither little nor big", value);
        return false;
    }
}

// Reads "dims=64x64x64,type=uint16,spacing=1x1x2,offset=512,endian=big".
static bool read_raw(const char *text, struct pel_load_options *load) {
    char *const keys[] = {"dims", "type", "spacing", "origin", "offset", "endian", NULL};
    char *copy = strdup(text), *rest = copy, *value;
    bool good = copy != NULL;
    while (good && *rest) {
        char *token = rest;
        int key = getsubopt(&rest, keys, &value);
        if (key >= 0 && value) {
            good = read_raw_key(key, value, load);
        } else {
            cli_fail(
                PEL_ERROR_ARGUMENT,
                "--raw: '%s' is none of dims=, type=, spacing=, origin=, offset=, endian=", token);
            good = false;
        }
    }
    free(copy);
    if (good && load->raw.dims[0] == 0) {
        cli_fail(PEL_ERROR_ARGUMENT, "--raw: dims= is missing");
        good = false;
    }
    return good;
}

enum { KEY_TIME = CLI_KEY_LOAD, KEY_CHANNEL, KEY_SPLIT, KEY_RAW, KEY_LABELS };

static error_t parse_load(int key, char *argument, struct argp_state *state) {
    struct pel_load_options *load = state->input;
    bool good = true;
    switch (key) {
    case KEY_TIME:
        good = cli_integer("--time", argument, 0, &load->time);
        break;
    case KEY_CHANNEL:
        good = cli_integer("--channel", argument, 0, &load->channel);
        break;
    case KEY_SPLIT:
        load->split_channels = true;
        break;
    case KEY_LABELS:
        load->labels = PEL_LABELS_YES;
        break;
    case KEY_RAW:
        good = read_raw(argument, load);
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

static const struct argp_option load_options[] = {
    {"time", KEY_TIME, "N", 0, "Which time point of a series to load, counted from 0", 0},
    {"channel", KEY_CHANNEL, "N", 0, "Which channel to load, counted from 0", 0},
    {"split-channels", KEY_SPLIT, NULL, 0,
     "Take the channels of a TIFF apart instead of reading them as colours", 0},
    {"labels", KEY_LABELS, NULL, 0,
     "Take the values as labels, which are never averaged or interpolated; without it files that "
     "say so are label maps, and those whose name and values do",
     0},
    {"raw", KEY_RAW, "KEY=VALUE,...", 0,
     "How to read a headerless file: dims=64x64x64 (needed), type=uint8, spacing=1x1x2.5, "
     "origin=0x0x0, offset=BYTES, endian=little|big",
     0},
    {0},
};

static const struct argp load_argp = {.options = load_options, .parser = parse_load};

const struct argp_child cli_load_children[] = {{&load_argp, 0, "Reading volumes:", 2}, {0}};
