// render_options.c - the options of `pellucid render`.
#include "cli/render_options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/clip_option.h"
#include "cli/mask_option.h"
#include "cli/options.h"
#include "cli/probe.h"

enum {
    KEY_SIZE = CLI_KEY_COMMAND,
    KEY_CAMERA,
    KEY_MIX,
    KEY_CLIP,
    KEY_MASK,
    KEY_STEP,
    KEY_STEP_MM,
    KEY_MODEL,
    KEY_QUALITY,
    KEY_PREINTEGRATION,
    KEY_ORDER,
    KEY_FILTER,
    KEY_GRADIENT,
    KEY_TERMINATION,
    KEY_ADAPTIVE_STEP,
    KEY_PHASE,
    KEY_SKIP,
    KEY_SUPERSAMPLE,
    KEY_PATTERN,
    KEY_RECONSTRUCTION,
    KEY_ADAPTIVE,
    KEY_SEED,
    KEY_JITTER,
    KEY_DEBUG,
    KEY_DENSITY,
    KEY_SHADING,
    KEY_LOD,
    KEY_SHADOWS,
    KEY_AMBIENT_OCCLUSION,
    KEY_BACKGROUND,
    KEY_STEREO,
    KEY_STEREO_SEPARATION,
    KEY_STEREO_CONVERGENCE,
    KEY_STEREO_SWAP,
    KEY_STEREO_TOE_IN,
    KEY_STEREO_REPROJECT,
    KEY_TRANSFER,
    KEY_READER,
    KEY_LANES,
    KEY_WORK_GROUP,
    KEY_COMPUTE_UNITS,
    KEY_DEVICE,
    KEY_DEPTH,
    KEY_ALPHA,
    KEY_SET,
    KEY_PIXEL,
    KEY_REGION,
    KEY_JSON,
    KEY_FRAMES,
    KEY_FRAME,
    KEY_FPS,
};

static const struct argp_option argp_options[] = {
    {0, 0, NULL, 0, "The picture:", 1},
    {"output", 'o', "FILE", 0,
     "Where the picture goes: .png, .tif (32-bit float) or .ppm; - writes PPM to standard output "
     "(default: the scene's own, else the first input's name with .png)",
     0},
    {"size", KEY_SIZE, "WxH", 0, "Pixels, such as 640x480", 0},
    {"region", KEY_REGION, "X,Y,W,H", 0,
     "Render this part of the picture alone: left and top edge, width and height in pixels", 0},
    {"depth", KEY_DEPTH, "8|16", 0, "Bits of a PNG's channels", 0},
    {"alpha", KEY_ALPHA, "straight|premultiplied", 0, "How a PNG's colours are written", 0},
    {"background", KEY_BACKGROUND, "COLOUR", 0,
     "A name such as white or none, #rrggbb, or r,g,b[,a] from 0 to 1", 0},
    {"frames", KEY_FRAMES, "FIRST:END", 0,
     "Render these frames of the scene's animation, END not included (or FIRST:END:STRIDE, N for "
     "the first N, all), to pictures (-o frame_%04d.png) or to a video (-o turn.mp4, .webm, .mkv "
     "or .gif, through ffmpeg)",
     0},
    {"frame", KEY_FRAME, "N", 0, "Render this frame alone", 0},
    {"fps", KEY_FPS, "X", 0, "Frames per second", 0},
    {0, 0, NULL, 0, "The view:", 2},
    {"camera", KEY_CAMERA, "VIEW|KEY=VALUE,...", 0,
     "anterior, posterior, left, right, superior, inferior or oblique; or keys of the scene's "
     "camera, such as eye=0,-400,0,target=0,0,0,fov=30",
     0},
    {"stereo", KEY_STEREO, "KIND", 0,
     "Render for two eyes: an anaglyph, such as dubois-red-cyan, half-colour-green-magenta or "
     "grey-amber-blue; side-by-side, top-bottom (or -half), row-interlaced, column-interlaced, "
     "checkerboard; or two-files, NAME_left and NAME_right",
     0},
    {"stereo-separation", KEY_STEREO_SEPARATION, "MM", 0,
     "Distance of the eyes (default: automatic, comfortable for the scene's depth)", 0},
    {"stereo-convergence", KEY_STEREO_CONVERGENCE, "MM", 0,
     "Distance at which both eyes' pictures agree (default: automatic)", 0},
    {"stereo-swap", KEY_STEREO_SWAP, NULL, 0, "Exchange the eyes", 0},
    {"stereo-toe-in", KEY_STEREO_TOE_IN, NULL, 0,
     "Turn the cameras inwards instead of shifting their windows", 0},
    {"stereo-reproject", KEY_STEREO_REPROJECT, NULL, 0,
     "Make the second eye's picture from the first one's: faster, not exact (--json says both)", 0},
    {0, 0, NULL, 0, "The volumes, all of them:", 3},
    {"transfer", KEY_TRANSFER, "PRESET|FILE", 0, "Transfer function", 0},
    {"density", KEY_DENSITY, "X", 0, "Multiplies the extinction", 0},
    {"filter", KEY_FILTER, "linear|nearest|cubic-b-spline|catmull-rom", 0,
     "Interpolation between voxels; the cubic ones are smoother and slower", 0},
    {"gradient", KEY_GRADIENT, "central|sobel|analytic", 0,
     "How the gradients that light and opacity follow are found", 0},
    {"shading", KEY_SHADING, "on|off|KEY=VALUE,...", OPTION_ARG_OPTIONAL,
     "Light them by the gradient of their values; or not; or with keys of the scene's shading, "
     "such "
     "as model=phong,shininess=40",
     0},
    {"clip", KEY_CLIP, "SPEC", 0,
     "Keep one side of a plane, such as 'x<10' or 'z>-5.5' (world millimetres); the inside of a "
     "box, box=X0:X1,Y0:Y1,Z0:Z1, or its outside, cut=...; may be repeated",
     0},
    {"mask", KEY_MASK, "VOLUME=OTHER:VALUES", 0,
     "Show a volume, by name or index, only where another one has these values, such as "
     "ct=labels:7,8, 0=1:3..5 or 0=1:>=0.5; with != only elsewhere; may be repeated",
     0},
    {0, 0, NULL, 0, "Rendering:", 4},
    {"mix", KEY_MIX, "KIND", 0,
     "How overlapping volumes share a sample: sum, over, ordered, max, priority, union, "
     "intersection or difference",
     0},
    {"quality", KEY_QUALITY, "0..1|draft|normal|high|best", 0,
     "Choose steps, termination and supersampling together", 0},
    {"preintegration", KEY_PREINTEGRATION, NULL, 0,
     "Let what lies between two samples count, so that thin shells show at long steps", 0},
    {"model", KEY_MODEL, "absorption|emission|mip|minip|average|iso|thesis", 0,
     "How light is gathered along a ray, in volumes that say nothing else; thesis is that of a "
     "2009 "
     "thesis and wrong by design",
     0},
    {"order", KEY_ORDER, "front-to-back|back-to-front", 0,
     "From which end a ray's samples are put together", 0},
    {"shadows", KEY_SHADOWS, "on|off|KEY=VALUE,...", OPTION_ARG_OPTIONAL,
     "Let volumes cast shadows on shaded ones; or with keys of the scene's shadows, such as "
     "length=50,strength=0.7",
     0},
    {"ambient-occlusion", KEY_AMBIENT_OCCLUSION, "on|off|KEY=VALUE,...", OPTION_ARG_OPTIONAL,
     "Darken shaded volumes where something near hides what is around, such as "
     "directions=32,radius=20",
     0},
    {"step", KEY_STEP, "N", 0, "Distance of samples, in voxels of the finest volume", 0},
    {"step-mm", KEY_STEP_MM, "MM", 0, "The same in millimetres", 0},
    {"adaptive-step", KEY_ADAPTIVE_STEP, "DEPTH", 0,
     "Take longer steps where volumes are locally thin or smooth: where they vary by no more than "
     "this optical depth, such as 0.1",
     0},
    {"phase", KEY_PHASE, "X", 0, "Place of the first sample, in steps, 0 to 1", 0},
    {"termination", KEY_TERMINATION, "X", 0, "End a ray once its opacity exceeds this; 1 for never",
     0},
    {"skip", KEY_SKIP, "auto|none|grid|distance|octree|bvh|blocks", 0,
     "How empty space is skipped; the picture is the same with each", 0},
    {"lod", KEY_LOD, "off|auto|N", 0,
     "Show volumes coarser: far ones as coarse as a pixel, or all at level N", 0},
    {"supersample", KEY_SUPERSAMPLE, "N", 0, "N x N rays for each pixel, N up to 8", 0},
    {"supersample-pattern", KEY_PATTERN, "regular|jittered|n-rooks|multi-jittered|hammersley", 0,
     "Where they go through the pixel", 0},
    {"supersample-filter", KEY_RECONSTRUCTION, "box|gaussian", 0,
     "Whether a pixel is the mean of its rays, or weighs those around it, too", 0},
    {"adaptive", KEY_ADAPTIVE, "X", 0,
     "N x N rays only where neighbouring pixels differ by more than X, 0 to 1", 0},
    {"seed", KEY_SEED, "N", 0, "Seed of all random patterns", 0},
    {"jitter", KEY_JITTER, NULL, 0, "A random phase for every ray", 0},
    {"debug", KEY_DEBUG, "samples|spans|volumes|work-group|work-item|time|clusters|nodes", 0,
     "Show a number of each pixel's ray in place of its light, as a heat map", 0},
    {0, 0, NULL, 0, "The device:", 5},
    {"device", KEY_DEVICE, "D", 0,
     "Number, part of the name, or type (gpu, cpu); 'pellucid devices' lists them", 0},
    {"reader", KEY_READER, "auto|buffer|image", 0, "How kernels read voxels", 0},
    {"lanes", KEY_LANES, "1|4|8|16", 0, "Rays per work-item", 0},
    {"work-group", KEY_WORK_GROUP, "N", 0, "Work-items per work-group", 0},
    {"compute-units", KEY_COMPUTE_UNITS, "N", 0, "Of a device that can be divided, only so many",
     0},
    {0, 0, NULL, 0, "Everything else:", 6},
    {"set", KEY_SET, "KEY=VALUE", 0,
     "Set any key of the scene, such as volumes.0.density=0.2; may be repeated", 0},
    {"pixel", KEY_PIXEL, "X,Y", 0,
     "Make no picture, but print what the ray of this pixel meets: spans and samples", 0},
    {"json", KEY_JSON, NULL, 0, "Write timings and what was used as JSON to standard output", 0},
    {"quiet", 'q', NULL, 0, "Say nothing but errors", 0},
    {0},
};

static bool add_number(struct render_options *options, const char *option, const char *key,
                       const char *text) {
    double value;
    if (!cli_number(option, text, &value))
        return false;
    // Printed anew, because strtod reads more spellings than JSON has.
    char number[CLI_NUMBER_BYTES];
    cli_print_number(number, value);
    overrides_add(&options->overrides, key, number);
    return true;
}

static bool add_size(struct render_options *options, const char *text) {
    int size[2];
    if (!cli_sizes("--size", text, 2, size))
        return false;
    char list[32];
    snprintf(list, sizeof list, "[%d,%d]", size[0], size[1]);
    overrides_add(&options->overrides, "render.size", list);
    return true;
}

static bool add_integer(struct render_options *options, const char *option, const char *key,
                        const char *text) {
    int value;
    if (!cli_integer(option, text, 0, &value))
        return false;
    overrides_add(&options->overrides, key, text);
    return true;
}

static bool add_region(struct render_options *options, const char *text) {
    int region[4], end = 0;
    if (sscanf(text, "%9d,%9d,%9d,%9d%n", &region[0], &region[1], &region[2], &region[3], &end) !=
            4 ||
        text[end] != '\0') {
        cli_fail(PEL_ERROR_ARGUMENT, "--region: '%s' is not of the form X,Y,W,H", text);
        return false;
    }
    char list[64];
    snprintf(list, sizeof list, "[%s]", text);
    overrides_add(&options->overrides, "render.region", list);
    return true;
}

// Millimetres, or "automatic".
static bool add_length(struct render_options *options, const char *option, const char *key,
                       const char *text) {
    if (strcmp(text, "automatic") != 0)
        return add_number(options, option, key, text);
    overrides_add_text(&options->overrides, key, text);
    return true;
}

static void add_background(struct render_options *options, const char *text) {
    char list[128];
    snprintf(list, sizeof list, "[%s]", text);
    if (strchr(text, ','))
        overrides_add(&options->overrides, "background", list);
    else
        overrides_add_text(&options->overrides, "background", text);
}

static bool add_camera(struct render_options *options, const char *text) {
    if (strchr(text, '='))
        return overrides_add_pairs(&options->overrides, "--camera", "camera", text);
    overrides_add_text(&options->overrides, "camera.view", text);
    return true;
}

static bool add_set(struct render_options *options, const char *text) {
    const char *equals = strchr(text, '=');
    if (!equals || equals == text) {
        cli_fail(PEL_ERROR_ARGUMENT, "--set: '%s' is not of the form key=value", text);
        return false;
    }
    char key[256];
    snprintf(key, sizeof key, "%.*s", (int)(equals - text), text);
    overrides_add(&options->overrides, key, equals + 1);
    return true;
}

// Keys of the scene's stereo; ARGP_ERR_UNKNOWN for the other options.
static error_t parse_stereo_key(int key, const char *argument, struct render_options *options) {
    bool good = true;
    switch (key) {
    case KEY_STEREO:
        overrides_add_text(&options->overrides, "stereo.kind", argument);
        break;
    case KEY_STEREO_SEPARATION:
        good = add_length(options, "--stereo-separation", "stereo.separation", argument);
        break;
    case KEY_STEREO_CONVERGENCE:
        good = add_length(options, "--stereo-convergence", "stereo.convergence", argument);
        break;
    case KEY_STEREO_SWAP:
        overrides_add(&options->overrides, "stereo.swap", "true");
        break;
    case KEY_STEREO_TOE_IN:
        overrides_add(&options->overrides, "stereo.toe_in", "true");
        break;
    case KEY_STEREO_REPROJECT:
        overrides_add(&options->overrides, "stereo.reproject", "true");
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

// Options whose argument is the text of a key of the scene.
static const struct {
    int key;
    const char *path;
} text_keys[] = {
    {KEY_MIX, "render.mixing"},
    {KEY_MODEL, "render.model"},
    {KEY_ORDER, "render.order"},
    {KEY_SKIP, "render.skip"},
    {KEY_PATTERN, "render.supersampling.pattern"},
    {KEY_RECONSTRUCTION, "render.supersampling.filter"},
    {KEY_DEBUG, "render.debug"},
    {KEY_FILTER, "volumes.*.filter"},
    {KEY_GRADIENT, "volumes.*.gradient"},
    {KEY_TRANSFER, "volumes.*.transfer"},
    {KEY_ALPHA, "output.alpha"},
};

// Keys of the scene; ARGP_ERR_UNKNOWN for the other options.
static error_t parse_scene_key(int key, const char *argument, struct render_options *options) {
    bool good = true;
    for (size_t n = 0; n < sizeof text_keys / sizeof *text_keys; n++) {
        if (text_keys[n].key == key) {
            overrides_add_text(&options->overrides, text_keys[n].path, argument);
            return 0;
        }
    }
    switch (key) {
    case KEY_SIZE:
        good = add_size(options, argument);
        break;
    case KEY_REGION:
        good = add_region(options, argument);
        break;
    case KEY_CAMERA:
        good = add_camera(options, argument);
        break;
    case KEY_CLIP:
        good = clip_option_add(&options->overrides, &options->clip_count, argument);
        break;
    case KEY_MASK:
        good = mask_option_add(&options->overrides, argument);
        break;
    case KEY_STEP:
        overrides_add(&options->overrides, "render.step_mm", "null");
        good = add_number(options, "--step", "render.step", argument);
        break;
    case KEY_QUALITY:
        overrides_add(&options->overrides, "render.step", "null");
        overrides_add(&options->overrides, "render.step_mm", "null");
        overrides_add(&options->overrides, "render.termination", "null");
        overrides_add(&options->overrides, "render.supersampling", "null");
        overrides_add(&options->overrides, "render.quality", argument);
        break;
    case KEY_PREINTEGRATION:
        overrides_add(&options->overrides, "render.preintegration", "true");
        break;
    case KEY_STEP_MM:
        overrides_add(&options->overrides, "render.step", "null");
        good = add_number(options, "--step-mm", "render.step_mm", argument);
        break;
    case KEY_ADAPTIVE_STEP:
        good = add_number(options, "--adaptive-step", "render.adaptive_step", argument);
        break;
    case KEY_TERMINATION:
        good = add_number(options, "--termination", "render.termination", argument);
        break;
    case KEY_PHASE:
        good = add_number(options, "--phase", "render.phase", argument);
        break;
    case KEY_SUPERSAMPLE:
        good = add_integer(options, "--supersample", "render.supersampling.n", argument);
        break;
    case KEY_ADAPTIVE:
        good = add_number(options, "--adaptive", "render.supersampling.adaptive", argument);
        break;
    case KEY_SEED:
        good = add_integer(options, "--seed", "render.supersampling.seed", argument);
        break;
    case KEY_JITTER:
        overrides_add(&options->overrides, "render.jitter", "true");
        break;
    case KEY_DENSITY:
        good = add_number(options, "--density", "volumes.*.density", argument);
        break;
    case KEY_SHADING:
        good =
            overrides_add_switch(&options->overrides, "--shading", "volumes.*.shading", argument);
        break;
    case KEY_LOD:
        overrides_add(&options->overrides, "render.lod", argument);
        break;
    case KEY_SHADOWS:
        good = overrides_add_switch(&options->overrides, "--shadows", "render.shadows", argument);
        break;
    case KEY_AMBIENT_OCCLUSION:
        good = overrides_add_switch(&options->overrides, "--ambient-occlusion",
                                    "render.ambient_occlusion", argument);
        break;
    case KEY_BACKGROUND:
        add_background(options, argument);
        break;
    case KEY_DEPTH:
        good = add_integer(options, "--depth", "output.depth", argument);
        break;
    case KEY_FPS:
        good = add_number(options, "--fps", "animation.fps", argument);
        break;
    case KEY_SET:
        good = add_set(options, argument);
        break;
    default:
        return parse_stereo_key(key, argument, options);
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

static error_t parse(int key, char *argument, struct argp_state *state) {
    struct render_options *options = state->input;
    bool good = true;
    switch (key) {
    case 'o':
        options->output = argument;
        break;
    case 'q':
        options->quiet = true;
        break;
    case KEY_PIXEL:
        options->probe = true;
        good = probe_parse(argument, options->pixel) == PEL_OK;
        break;
    case KEY_JSON:
        options->json = true;
        break;
    case KEY_FRAMES:
        options->frames = argument;
        break;
    case KEY_FRAME:
        good = cli_integer("--frame", argument, 0, &options->frame);
        break;
    case KEY_DEVICE:
        options->renderer.device = argument;
        break;
    case KEY_READER:
        good = cli_reader(argument, &options->renderer.reader);
        break;
    case KEY_LANES:
        good = cli_lanes(argument, &options->renderer.lanes);
        break;
    case KEY_WORK_GROUP:
        good = cli_integer("--work-group", argument, 1, &options->renderer.work_group);
        break;
    case KEY_COMPUTE_UNITS:
        good = cli_integer("--compute-units", argument, 1, &options->renderer.compute_units);
        break;
    case ARGP_KEY_ARGS:
        options->inputs = state->argv + state->next;
        options->input_count = state->argc - state->next;
        break;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "a scene or a volume is needed");
        break;
    default:
        return parse_scene_key(key, argument, options);
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

int render_options_parse(struct render_options *options, int argc, char **argv) {
    static const struct argp argp = {
        .options = argp_options,
        .parser = parse,
        .args_doc = "SCENE|VOLUME...",
        .doc = "Renders a scene file (.json), or one or more volumes placed by their headers, to a "
               "picture.\v"
               "Options override what the scene says. Examples:\n\n"
               "  pellucid render head.nii.gz\n"
               "  pellucid render head.nii.gz brain.nii.gz --camera left -o both.png\n"
               "  pellucid render scene.json --size 1920x1080 --step 0.25 --set camera.fov=20\n"
               "  pellucid render ct.nrrd --transfer ct-bone --background white -o - | display\n"
               "  pellucid render ct.nrrd --stereo dubois-red-cyan -o anaglyph.png\n"
               "  pellucid render turn.json --frames 0:100 -o frame_%04d.png\n"
               "  pellucid render turn.json -o turn.mp4\n",
    };
    *options = (struct render_options){.frame = -1};
    error_t status = argp_parse(&argp, argc, argv, 0, NULL, options);
    if (!status && options->frames && options->frame >= 0)
        return cli_fail(PEL_ERROR_ARGUMENT, "--frame and --frames cannot be combined");
    if (!status && options->frames && options->probe)
        return cli_fail(PEL_ERROR_ARGUMENT, "--pixel is of one frame: take --frame");
    return status;
}

void render_options_finish(struct render_options *options) {
    overrides_finish(&options->overrides);
}
