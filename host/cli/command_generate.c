// command_generate.c - `pellucid generate`: writes a synthetic volume or a hypertexture, or lists
// the kinds and recipes.
#include <stdio.h>
#include <string.h>

#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"

enum {
    KEY_SIZE = CLI_KEY_COMMAND,
    KEY_SPACING,
    KEY_TYPE,
    KEY_SECOND,
    KEY_SEED,
    KEY_TIME,
    KEY_WRAP,
    KEY_OBJECT,
    KEY_DEVICE,
};

struct arguments {
    const char *kind, *recipe, *output, *object, *device;
    const char *only_kind, *only_recipe; // an option that was given and is for one of them only
    struct pel_generate_options generate;
    struct pel_bake_options bake;
};

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "Where to write it: .nrrd .nhdr .nii .nii.gz .tif .mhd .mha or .raw",
     0},
    {"size", KEY_SIZE, "N", 0, "Voxels along the longest side (default 64)", 0},
    {"spacing", KEY_SPACING, "MM", 0, "Distance of the voxels (default: the object's natural size)",
     0},
    {"type", KEY_TYPE, "TYPE", 0, "uint8 (default), uint16 or float32", 0},
    {"second", KEY_SECOND, NULL, 0, "The moving volume of a pair instead of the fixed one", 0},
    {NULL, 0, NULL, 0, "Hypertextures:", 1},
    {"seed", KEY_SEED, "N", 0, "Of the noise (default 0: Perlin's published permutation)", 1},
    {"time", KEY_TIME, "T", 0, "The recipe's time (default 0)", 1},
    {"wrap", KEY_WRAP, NULL, 0, "Let densities outside 0..1 wrap around instead of clamping them",
     1},
    {"object", KEY_OBJECT, "FILE", 0, "The volume that the recipe grows on", 1},
    {"device", KEY_DEVICE, "D", 0, "The device: its number, part of its name, or gpu or cpu", 1},
    {0},
};

static error_t parse_hypertexture(int key, char *argument, struct arguments *arguments) {
    int seed = 0;
    bool good = true;
    switch (key) {
    case KEY_SEED:
        arguments->only_recipe = "--seed";
        good = cli_integer("--seed", argument, 0, &seed);
        arguments->bake.seed = (uint32_t)seed;
        break;
    case KEY_TIME:
        arguments->only_recipe = "--time";
        good = cli_number("--time", argument, &arguments->bake.time);
        break;
    case KEY_WRAP:
        arguments->only_recipe = "--wrap";
        arguments->bake.wrap = true;
        break;
    case KEY_OBJECT:
        arguments->only_recipe = "--object";
        arguments->object = argument;
        break;
    case KEY_DEVICE:
        arguments->only_recipe = "--device";
        arguments->device = argument;
        break;
    case ARGP_KEY_ARG:
        if (!arguments->kind)
            arguments->kind = argument;
        else if (!arguments->recipe && strcmp(arguments->kind, "hypertexture") == 0)
            arguments->recipe = argument;
        else
            return ARGP_ERR_UNKNOWN;
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

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
        arguments->only_kind = "--spacing";
        good = cli_number("--spacing", argument, &arguments->generate.spacing_mm);
        if (good && arguments->generate.spacing_mm <= 0)
            return cli_fail(PEL_ERROR_ARGUMENT, "--spacing: '%s' is not above 0", argument);
        break;
    case KEY_TYPE:
        if (!pel_voxel_type_from_name(argument, &arguments->generate.type))
            return cli_fail_library();
        break;
    case KEY_SECOND:
        arguments->only_kind = "--second";
        arguments->generate.second = true;
        break;
    default:
        return parse_hypertexture(key, argument, arguments);
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

static int list(const char *const *names) {
    for (; *names; names++)
        puts(*names);
    return report_finish(PEL_OK);
}

// Bakes the recipe; NULL, with the library's sentence, when that fails.
static struct pel_volume *bake(struct arguments *arguments) {
    struct pel_renderer_options device = {.device = arguments->device};
    struct pel_volume *object = arguments->object ? pel_volume_load(arguments->object, NULL) : NULL;
    if (arguments->object && !object)
        return NULL;
    struct pel_volume *volume = NULL;
    struct pel_renderer *renderer = pel_renderer_create(&device);
    if (renderer) {
        struct progress progress;
        progress_begin(&progress, false);
        arguments->bake.size = arguments->generate.size;
        arguments->bake.type = arguments->generate.type;
        arguments->bake.object = object;
        arguments->bake.progress = progress_update;
        arguments->bake.user = &progress;
        volume = pel_renderer_bake(renderer, arguments->recipe, &arguments->bake);
        progress_end(&progress);
    }
    pel_renderer_destroy(renderer);
    pel_volume_destroy(object);
    return volume;
}

int command_generate(int argc, char **argv) {
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "[KIND -o FILE]\nhypertexture [RECIPE -o FILE]",
        .doc =
            "Writes a synthetic volume, or bakes a hypertexture: a preset, or a recipe in a JSON "
            "file. Without KIND, lists the kinds; without RECIPE, the presets.\v"
            "Examples:\n\n"
            "  pellucid generate\n"
            "  pellucid generate c60 --size 128 -o c60.nrrd\n"
            "  pellucid generate sphere --type float32 --spacing 0.5 -o sphere.nii.gz\n"
            "  pellucid generate hypertexture fireball --size 128 --seed 7 -o fire.nrrd\n",
    };
    struct arguments arguments = {0};
    error_t status = argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    if (status)
        return status;
    bool hypertexture = arguments.kind && strcmp(arguments.kind, "hypertexture") == 0;
    const char *stray = hypertexture ? arguments.only_kind : arguments.only_recipe;
    if (stray)
        return cli_fail(PEL_ERROR_ARGUMENT, "%s: %s", stray,
                        hypertexture ? "not for hypertextures" : "for hypertextures only");
    if (!arguments.kind)
        return list(pel_generator_names());
    if (hypertexture && !arguments.recipe)
        return list(pel_recipe_presets());
    for (int i = 0; !hypertexture && pel_recipe_presets()[i]; i++)
        if (strcmp(arguments.kind, pel_recipe_presets()[i]) == 0)
            return cli_fail(PEL_ERROR_ARGUMENT, "'%s' is a hypertexture: generate hypertexture %s",
                            arguments.kind, arguments.kind);
    if (!arguments.output)
        return cli_fail(PEL_ERROR_ARGUMENT, "-o FILE is missing: where should the volume go?");
    struct pel_volume *volume =
        hypertexture ? bake(&arguments) : pel_volume_generate(arguments.kind, &arguments.generate);
    bool good = volume && pel_volume_save(volume, arguments.output);
    pel_volume_destroy(volume);
    return good ? PEL_OK : cli_fail_library();
}
