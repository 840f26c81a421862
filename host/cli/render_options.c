// render_options.c - the options of `pellucid render`.
#include "cli/render_options.h"

#include "cli/device_option.h"
#include "cli/probe.h"
#include "cli/scene_option.h"

enum {
    KEY_PIXEL = SCENE_OPTION_END,
    KEY_JSON,
    KEY_FRAMES,
    KEY_FRAME,
};

static const struct argp_option argp_options[] = {
    {0, 0, NULL, 0, "The picture:", 1},
    {"output", 'o', "FILE", 0,
     "Where the picture goes: .png, .tif (32-bit float) or .ppm; - writes PPM to standard output "
     "(default: the scene's own, else the first input's name with .png)",
     0},
    {"size", SCENE_SIZE, "WxH", 0, "Pixels, such as 640x480", 0},
    {"region", SCENE_REGION, "X,Y,W,H", 0,
     "Render this part of the picture alone: left and top edge, width and height in pixels", 0},
    {"depth", SCENE_DEPTH, "8|16", 0, "Bits of a PNG's channels", 0},
    {"alpha", SCENE_ALPHA, "straight|premultiplied", 0, "How a PNG's colours are written", 0},
    {"background", SCENE_BACKGROUND, "COLOUR", 0,
     "A name such as white or none, #rrggbb, or r,g,b[,a] from 0 to 1", 0},
    {"frames", KEY_FRAMES, "FIRST:END", 0,
     "Render these frames of the scene's animation, END not included (or FIRST:END:STRIDE, N for "
     "the first N, all), to pictures (-o frame_%04d.png) or to a video (-o turn.mp4, .webm, .mkv "
     "or .gif, through ffmpeg)",
     0},
    {"frame", KEY_FRAME, "N", 0, "Render this frame alone", 0},
    {"fps", SCENE_FPS, "X", 0, "Frames per second", 0},
    {0, 0, NULL, 0, "The view:", 2},
    {"camera", SCENE_CAMERA, "VIEW|KEY=VALUE,...", 0,
     "anterior, posterior, left, right, superior, inferior or oblique; or keys of the scene's "
     "camera, such as eye=0,-400,0,target=0,0,0,fov=30",
     0},
    {"stereo", SCENE_STEREO, "KIND", 0,
     "Render for two eyes: an anaglyph, such as dubois-red-cyan, half-colour-green-magenta or "
     "grey-amber-blue; side-by-side, top-bottom (or -half), row-interlaced, column-interlaced, "
     "checkerboard; or two-files, NAME_left and NAME_right",
     0},
    {"stereo-separation", SCENE_STEREO_SEPARATION, "MM", 0,
     "Distance of the eyes (default: automatic, comfortable for the scene's depth)", 0},
    {"stereo-convergence", SCENE_STEREO_CONVERGENCE, "MM", 0,
     "Distance at which both eyes' pictures agree (default: automatic)", 0},
    {"stereo-swap", SCENE_STEREO_SWAP, NULL, 0, "Exchange the eyes", 0},
    {"stereo-toe-in", SCENE_STEREO_TOE_IN, NULL, 0,
     "Turn the cameras inwards instead of shifting their windows", 0},
    {"stereo-reproject", SCENE_STEREO_REPROJECT, NULL, 0,
     "Make the second eye's picture from the first one's: faster, not exact (--json says both)", 0},
    {0, 0, NULL, 0, "The volumes, all of them:", 3},
    {"transfer", SCENE_TRANSFER, "PRESET|FILE", 0, "Transfer function", 0},
    {"density", SCENE_DENSITY, "X", 0, "Multiplies the extinction", 0},
    {"filter", SCENE_FILTER, "linear|nearest|cubic-b-spline|catmull-rom", 0,
     "Interpolation between voxels; the cubic ones are smoother and slower", 0},
    {"gradient", SCENE_GRADIENT, "central|sobel|analytic", 0,
     "How the gradients that light and opacity follow are found", 0},
    {"shading", SCENE_SHADING, "on|off|KEY=VALUE,...", OPTION_ARG_OPTIONAL,
     "Light them by the gradient of their values; or not; or with keys of the scene's shading, "
     "such as model=phong,shininess=40",
     0},
    {"clip", SCENE_CLIP, "SPEC", 0,
     "Keep one side of a plane, such as 'x<10' or 'z>-5.5' (world millimetres); the inside of a "
     "box, box=X0:X1,Y0:Y1,Z0:Z1, or its outside, cut=...; may be repeated",
     0},
    {"mask", SCENE_MASK, "VOLUME=OTHER:VALUES", 0,
     "Show a volume, by name or index, only where another one has these values, such as "
     "ct=labels:7,8, 0=1:3..5 or 0=1:>=0.5; with != only elsewhere; may be repeated",
     0},
    {0, 0, NULL, 0, "Rendering:", 4},
    {"mix", SCENE_MIX, "KIND", 0,
     "How overlapping volumes share a sample: sum, over, ordered, max, priority, union, "
     "intersection or difference",
     0},
    {"quality", SCENE_QUALITY, "0..1|draft|normal|high|best", 0,
     "Choose steps, termination and supersampling together", 0},
    {"preintegration", SCENE_PREINTEGRATION, NULL, 0,
     "Let what lies between two samples count, so that thin shells show at long steps", 0},
    {"model", SCENE_MODEL, "absorption|emission|mip|minip|average|iso|thesis", 0,
     "How light is gathered along a ray, in volumes that say nothing else; thesis is that of a "
     "2009 thesis and wrong by design",
     0},
    {"order", SCENE_ORDER, "front-to-back|back-to-front", 0,
     "From which end a ray's samples are put together", 0},
    {"shadows", SCENE_SHADOWS, "on|off|KEY=VALUE,...", OPTION_ARG_OPTIONAL,
     "Let volumes cast shadows on shaded ones; or with keys of the scene's shadows, such as "
     "length=50,strength=0.7",
     0},
    {"ambient-occlusion", SCENE_AMBIENT_OCCLUSION, "on|off|KEY=VALUE,...", OPTION_ARG_OPTIONAL,
     "Darken shaded volumes where something near hides what is around, such as "
     "directions=32,radius=20",
     0},
    {"step", SCENE_STEP, "N", 0, "Distance of samples, in voxels of the finest volume", 0},
    {"step-mm", SCENE_STEP_MM, "MM", 0, "The same in millimetres", 0},
    {"adaptive-step", SCENE_ADAPTIVE_STEP, "DEPTH", 0,
     "Take longer steps where volumes are locally thin or smooth: where they vary by no more than "
     "this optical depth, such as 0.1",
     0},
    {"phase", SCENE_PHASE, "X", 0, "Place of the first sample, in steps, 0 to 1", 0},
    {"termination", SCENE_TERMINATION, "X", 0,
     "End a ray once its opacity exceeds this; 1 for never", 0},
    {"skip", SCENE_SKIP, "auto|none|grid|distance|octree|bvh|blocks", 0,
     "How empty space is skipped; the picture is the same with each", 0},
    {"lod", SCENE_LOD, "off|auto|N", 0,
     "Show volumes coarser: far ones as coarse as a pixel, or all at level N", 0},
    {"supersample", SCENE_SUPERSAMPLE, "N", 0, "N x N rays for each pixel, N up to 8", 0},
    {"supersample-pattern", SCENE_PATTERN, "regular|jittered|n-rooks|multi-jittered|hammersley", 0,
     "Where they go through the pixel", 0},
    {"supersample-filter", SCENE_RECONSTRUCTION, "box|gaussian", 0,
     "Whether a pixel is the mean of its rays, or weighs those around it, too", 0},
    {"adaptive", SCENE_ADAPTIVE, "X", 0,
     "N x N rays only where neighbouring pixels differ by more than X, 0 to 1", 0},
    {"seed", SCENE_SEED, "N", 0, "Seed of all random patterns", 0},
    {"jitter", SCENE_JITTER, NULL, 0, "A random phase for every ray", 0},
    {"debug", SCENE_DEBUG, "samples|spans|volumes|work-group|work-item|time|clusters|nodes", 0,
     "Show a number of each pixel's ray in place of its light, as a heat map", 0},
    {0, 0, NULL, 0, "Everything else:", 6},
    {"set", SCENE_SET, "KEY=VALUE", 0,
     "Set any key of the scene, such as volumes.0.density=0.2; may be repeated", 0},
    {"pixel", KEY_PIXEL, "X,Y", 0,
     "Make no picture, but print what the ray of this pixel meets: spans and samples", 0},
    {"json", KEY_JSON, NULL, 0, "Write timings and what was used as JSON to standard output", 0},
    {"quiet", 'q', NULL, 0, "Say nothing but errors", 0},
    {0},
};

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
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &options->renderer;
        break;
    case ARGP_KEY_ARGS:
        options->inputs = state->argv + state->next;
        options->input_count = state->argc - state->next;
        break;
    case ARGP_KEY_NO_ARGS:
        argp_error(state, "a scene or a volume is needed");
        break;
    default:
        return scene_option_parse(key, argument, options);
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}

int render_options_parse(struct render_options *options, int argc, char **argv) {
    static const struct argp argp = {
        .options = argp_options,
        .parser = parse,
        .children = cli_device_children,
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
