// command_generate.c - `pellucid generate`: writes a synthetic volume, or lists the kinds.
#include <stdio.h>
#include <string.h>

#include "cli/options.h"
#include "cli/report.h"

enum { KEY_SIZE = CLI_KEY_COMMAND, KEY_SPACING, KEY_TYPE, KEY_SECOND };

struct arguments {
    const char *kind, *output;
    struct pel_generate_options generate;
};

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "Where to write it: .nrrd .nhdr .nii .nii.gz .tif .mhd .mha or .raw",
     0},
    {"size", KEY_SIZE, "N", 0, "Voxels along the longest side (default 64)", 0},
    {"spacing", KEY_SPACING, "MM", 0, "Distance of the voxels (default: the object's natural size)",
     0},
    {"type", KEY_TYPE, "TYPE", 0, "uint8 (default), uint16 or float32", 0},
    {"second", KEY_SECOND, NULL, 0, "The moving volume of a pair instead of the fixed one", 0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state) {
    struct arguments *arguments = state->input;
    bool good = true;
    switch (key) {
    case 'o':
        arguments->output = argument;
        break;
    case KEY_SIZE:
        good = cli_integer("--size", argument, 1, &arguments->generate.size);
        break;
    case KEY_SPACING:
        good = cli_number("--spacing", argument, &arguments->generate.spacing_mm);
        if (good && arguments->generate.spacing_mm <= 0)
            return cli_fail(PEL_ERROR_ARGUMENT, "--spacing: '%s' is not above 0", argument);
        break;
    case KEY_TYPE:
        if (!pel_voxel_type_from_name(argument, &arguments->generate.type))
            return cli_fail_library();
        break;
    case KEY_SECOND:
        arguments->generate.second = true;
        break;
    case ARGP_KEY_ARG:
        if (arguments->kind)
            return ARGP_ERR_UNKNOWN;
        arguments->kind = argument;
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

static int list_kinds(void) {
    for (const char *const *name = pel_generator_names(); *name; name++)
        puts(*name);
    return report_finish(PEL_OK);
}

int command_generate(int argc, char **argv) {
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "[KIND -o FILE]",
        .doc = "Writes a synthetic volume. Without KIND, lists the kinds.\v"
               "Examples:\n\n"
               "  pellucid generate\n"
               "  pellucid generate c60 --size 128 -o c60.nrrd\n"
               "  pellucid generate sphere --type float32 --spacing 0.5 -o sphere.nii.gz\n",
    };
    struct arguments arguments = {0};
    error_t status = argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    if (status)
        return status;
    if (!arguments.kind)
        return list_kinds();
    if (!arguments.output)
        return cli_fail(PEL_ERROR_ARGUMENT, "-o FILE is missing: where should the volume go?");
    struct pel_volume *volume = pel_volume_generate(arguments.kind, &arguments.generate);
    bool good = volume && pel_volume_save(volume, arguments.output);
    pel_volume_destroy(volume);
    return good ? PEL_OK : cli_fail_library();
}
