// command_convert.c - `pellucid convert`: reads a volume and writes it in another format, cropped,
// resampled or with another voxel type on the way, in the order crop, downsample, resample, type;
// but floats come right after cropping, so that means and interpolated values are not rounded.
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

enum { KEY_CROP = CLI_KEY_COMMAND, KEY_RESAMPLE, KEY_TYPE, KEY_DOWNSAMPLE };

struct arguments {
    const char *input, *output;
    const char *crop, *resample; // understood once the volume's size is known
    int downsample;
    bool retype;
    enum pel_voxel_type type;
    struct pel_load_options load;
};

static const struct argp_option options[] = {
    {"crop", KEY_CROP, "I0:I1,J0:J1,K0:K1", 0,
     "Keep voxels I0 up to but not including I1, and so on; an empty end is the volume's own", 0},
    {"downsample", KEY_DOWNSAMPLE, "N", 0, "Average blocks of N x N x N voxels", 0},
    {"resample", KEY_RESAMPLE, "SIZE", 0,
     "Interpolate to 64x64x64 voxels, or to cubic voxels of 1.5mm", 0},
    {"type", KEY_TYPE, "TYPE", 0, "uint8, int8, uint16, int16, float32, rgb8 or rgba8", 0},
    {0},
};

static error_t parse(int key, char *argument, struct argp_state *state) {
    struct arguments *arguments = state->input;
    bool good = true;
    switch (key) {
    case KEY_CROP:
        arguments->crop = argument;
        break;
    case KEY_RESAMPLE:
        arguments->resample = argument;
        break;
    case KEY_DOWNSAMPLE:
        good = cli_integer("--downsample", argument, 1, &arguments->downsample);
        break;
    case KEY_TYPE:
        if (!pel_voxel_type_from_name(argument, &arguments->type))
            return cli_fail(PEL_ERROR_ARGUMENT, "--type: %s", pel_error_message());
        arguments->retype = true;
        break;
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &arguments->load;
        break;
    case ARGP_KEY_ARG:
        if (state->arg_num > 1)
            return ARGP_ERR_UNKNOWN;
        *(state->arg_num ? &arguments->output : &arguments->input) = argument;
        break;
    case ARGP_KEY_END:
        if (state->arg_num < 2)
            argp_error(state, "IN and OUT are needed");
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

// Reads one "I0:I1"; moves `*text` behind it. Empty ends keep the values that are there.
static bool read_range(const char **text, long range[2]) {
    for (int end = 0; end < 2; end++) {
        char *rest;
        long value = strtol(*text, &rest, 10);
        if (rest != *text)
            range[end] = value;
        *text = rest;
        if (end == 0 && *(*text)++ != ':')
            return false;
    }
    return true;
}

// The ranges lie inside the volume when this succeeds.
static bool read_crop(const char *text, const struct pel_volume *volume, int first[3],
                      int dims[3]) {
    const char *rest = text;
    for (int axis = 0; axis < 3; axis++) {
        long range[2] = {0, volume->dims[axis]};
        if ((axis > 0 && *rest++ != ',') || !read_range(&rest, range)) {
            cli_fail(PEL_ERROR_ARGUMENT, "--crop: '%s' is not of the form 10:90,0:64,:32", text);
            return false;
        }
        if (range[0] < 0 || range[0] >= range[1] || range[1] > volume->dims[axis]) {
            cli_fail(PEL_ERROR_ARGUMENT, "--crop: %ld:%ld is not inside 0:%d along axis %c",
                     range[0], range[1], volume->dims[axis], "ijk"[axis]);
            return false;
        }
        first[axis] = (int)range[0];
        dims[axis] = (int)(range[1] - range[0]);
    }
    if (*rest == '\0')
        return true;
    cli_fail(PEL_ERROR_ARGUMENT, "--crop: '%s' is not of the form 10:90,0:64,:32", text);
    return false;
}

// "64x64x64", or the edge of a cubic voxel: "1.5mm" gives the nearest number of voxels that fills
// the volume's extent.
static bool read_resample(const char *text, const struct pel_volume *volume, int dims[3]) {
    char *unit;
    double edge_mm = strtod(text, &unit);
    if (unit == text || strcmp(unit, "mm") != 0)
        return cli_sizes("--resample", text, 3, dims);
    double spacing_mm[3];
    pel_volume_spacing(volume, spacing_mm);
    for (int axis = 0; axis < 3; axis++) {
        double count = fmax(1, round(volume->dims[axis] * spacing_mm[axis] / edge_mm));
        if (!(edge_mm > 0) || !(count <= INT_MAX)) {
            cli_fail(PEL_ERROR_ARGUMENT, "--resample: '%s' is no usable size of a voxel", text);
            return false;
        }
        dims[axis] = (int)count;
    }
    return true;
}

// Replaces `*volume` by `next`, unless there is none. Like all below, returns the exit status and
// has said what was wrong.
static int take(struct pel_volume **volume, struct pel_volume *next) {
    if (!next)
        return cli_fail_library();
    pel_volume_destroy(*volume);
    *volume = next;
    return PEL_OK;
}

static int crop(struct pel_volume **volume, const char *text) {
    int first[3], dims[3];
    if (!read_crop(text, *volume, first, dims))
        return PEL_ERROR_ARGUMENT;
    return take(volume, pel_volume_crop(*volume, first, dims));
}

static int resample(struct pel_volume **volume, const char *text) {
    int dims[3];
    if (!read_resample(text, *volume, dims))
        return PEL_ERROR_ARGUMENT;
    struct pel_volume *resampled = pel_volume_resample(*volume, dims);
    if (!resampled)
        return cli_fail(pel_error_code(), "--resample: %s", pel_error_message());
    return take(volume, resampled);
}

static int apply(struct pel_volume **volume, const struct arguments *arguments) {
    bool floats_first = arguments->retype && arguments->type == PEL_VOXEL_F32;
    int status = PEL_OK;
    if (arguments->crop)
        status = crop(volume, arguments->crop);
    if (!status && floats_first)
        status = take(volume, pel_volume_convert(*volume, arguments->type));
    if (!status && arguments->downsample > 1)
        status = take(volume, pel_volume_downsample(*volume, arguments->downsample));
    if (!status && arguments->resample)
        status = resample(volume, arguments->resample);
    if (!status && arguments->retype && !floats_first)
        status = take(volume, pel_volume_convert(*volume, arguments->type));
    return status;
}

int command_convert(int argc, char **argv) {
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "IN OUT",
        .doc = "Reads the volume IN and writes it to OUT in the format its extension names: .nrrd "
               ".nhdr .nii .nii.gz .tif .mhd .mha or .raw (with a JSON sidecar).\v"
               "Examples:\n\n"
               "  pellucid convert scan.nii.gz scan.nrrd\n"
               "  pellucid convert slices/ stack.tif --crop 100:400,100:400,: --type uint8\n"
               "  pellucid convert big.nrrd small.nrrd --resample 1.5mm\n"
               "  pellucid convert dump.bin dump.mha --raw dims=64x64x32,type=uint16\n",
        .children = cli_load_children,
    };
    struct arguments arguments = {0};
    error_t status = argp_parse(&argp, argc, argv, 0, NULL, &arguments);
    if (status)
        return status;
    struct pel_volume *volume = pel_volume_load(arguments.input, &arguments.load);
    if (!volume)
        return cli_fail_library();
    status = apply(&volume, &arguments);
    if (!status && !pel_volume_save(volume, arguments.output))
        status = cli_fail_library();
    pel_volume_destroy(volume);
    return status;
}
