// scene_option.c - the options that are shorthands for keys of a scene: most by a table of which
// key it is and what form the argument has, a few that change several keys or read a form of their
// own.
#include "cli/scene_option.h"

#include <stdio.h>
#include <string.h>

#include "cli/clip_option.h"
#include "cli/mask_option.h"
#include "cli/overrides.h"

// What an option's argument is.
enum form {
    FORM_NONE,   // there is none, and the key is true
    FORM_TEXT,   // text, whatever it looks like
    FORM_JSON,   // the key's value as it is
    FORM_NUMBER, //
    FORM_WHOLE,  // a whole number of at least 0
    FORM_LENGTH, // millimetres, or "automatic"
    FORM_SWITCH, // on, off, or keys of an object
};

static const struct shorthand {
    enum scene_option key;
    enum form form;
    const char *option, *path;
} shorthands[] = {
    {SCENE_FPS, FORM_NUMBER, "--fps", "animation.fps"},
    {SCENE_DEPTH, FORM_WHOLE, "--depth", "output.depth"},
    {SCENE_ALPHA, FORM_TEXT, "--alpha", "output.alpha"},
    {SCENE_STEREO, FORM_TEXT, "--stereo", "stereo.kind"},
    {SCENE_STEREO_SEPARATION, FORM_LENGTH, "--stereo-separation", "stereo.separation"},
    {SCENE_STEREO_CONVERGENCE, FORM_LENGTH, "--stereo-convergence", "stereo.convergence"},
    {SCENE_STEREO_SWAP, FORM_NONE, "--stereo-swap", "stereo.swap"},
    {SCENE_STEREO_TOE_IN, FORM_NONE, "--stereo-toe-in", "stereo.toe_in"},
    {SCENE_STEREO_REPROJECT, FORM_NONE, "--stereo-reproject", "stereo.reproject"},
    {SCENE_TRANSFER, FORM_TEXT, "--transfer", "volumes.*.transfer"},
    {SCENE_DENSITY, FORM_NUMBER, "--density", "volumes.*.density"},
    {SCENE_FILTER, FORM_TEXT, "--filter", "volumes.*.filter"},
    {SCENE_GRADIENT, FORM_TEXT, "--gradient", "volumes.*.gradient"},
    {SCENE_SHADING, FORM_SWITCH, "--shading", "volumes.*.shading"},
    {SCENE_MIX, FORM_TEXT, "--mix", "render.mixing"},
    {SCENE_QUALITY, FORM_JSON, "--quality", "render.quality"},
    {SCENE_PREINTEGRATION, FORM_NONE, "--preintegration", "render.preintegration"},
    {SCENE_MODEL, FORM_TEXT, "--model", "render.model"},
    {SCENE_ORDER, FORM_TEXT, "--order", "render.order"},
    {SCENE_SHADOWS, FORM_SWITCH, "--shadows", "render.shadows"},
    {SCENE_AMBIENT_OCCLUSION, FORM_SWITCH, "--ambient-occlusion", "render.ambient_occlusion"},
    {SCENE_STEP, FORM_NUMBER, "--step", "render.step"},
    {SCENE_STEP_MM, FORM_NUMBER, "--step-mm", "render.step_mm"},
    {SCENE_ADAPTIVE_STEP, FORM_NUMBER, "--adaptive-step", "render.adaptive_step"},
    {SCENE_PHASE, FORM_NUMBER, "--phase", "render.phase"},
    {SCENE_TERMINATION, FORM_NUMBER, "--termination", "render.termination"},
    {SCENE_SKIP, FORM_TEXT, "--skip", "render.skip"},
    {SCENE_LOD, FORM_JSON, "--lod", "render.lod"},
    {SCENE_SUPERSAMPLE, FORM_WHOLE, "--supersample", "render.supersampling.n"},
    {SCENE_PATTERN, FORM_TEXT, "--supersample-pattern", "render.supersampling.pattern"},
    {SCENE_RECONSTRUCTION, FORM_TEXT, "--supersample-filter", "render.supersampling.filter"},
    {SCENE_ADAPTIVE, FORM_NUMBER, "--adaptive", "render.supersampling.adaptive"},
    {SCENE_SEED, FORM_WHOLE, "--seed", "render.supersampling.seed"},
    {SCENE_JITTER, FORM_NONE, "--jitter", "render.jitter"},
    {SCENE_DEBUG, FORM_TEXT, "--debug", "render.debug"},
};

static bool add_number(struct overrides *overrides, const struct shorthand *is, const char *text) {
    double value;
    if (!cli_number(is->option, text, &value))
        return false;
    // Printed anew, because strtod reads more spellings than JSON has.
    char number[CLI_NUMBER_BYTES];
    cli_print_number(number, value);
    overrides_add(overrides, is->path, number);
    return true;
}

static bool add_whole(struct overrides *overrides, const struct shorthand *is, const char *text) {
    int value;
    if (!cli_integer(is->option, text, 0, &value))
        return false;
    overrides_add(overrides, is->path, text);
    return true;
}

static bool add_shorthand(struct overrides *overrides, const struct shorthand *is,
                          const char *text) {
    enum form form = is->form;
    if (form == FORM_LENGTH)
        form = strcmp(text, "automatic") == 0 ? FORM_TEXT : FORM_NUMBER;
    switch (form) {
    case FORM_TEXT:
        overrides_add_text(overrides, is->path, text);
        return true;
    case FORM_NUMBER:
        return add_number(overrides, is, text);
    case FORM_WHOLE:
        return add_whole(overrides, is, text);
    case FORM_SWITCH:
        return overrides_add_switch(overrides, is->option, is->path, text);
    default:
        overrides_add(overrides, is->path, form == FORM_NONE ? "true" : text);
        return true;
    }
}

// What else the scene says of what an option decides must not be in its way.
static void clear_rivals(struct overrides *overrides, int key) {
    if (key == SCENE_STEP_MM || key == SCENE_QUALITY)
        overrides_add(overrides, "render.step", "null");
    if (key == SCENE_STEP || key == SCENE_QUALITY)
        overrides_add(overrides, "render.step_mm", "null");
    if (key == SCENE_QUALITY) {
        overrides_add(overrides, "render.termination", "null");
        overrides_add(overrides, "render.supersampling", "null");
    }
}

static bool add_size(struct overrides *overrides, const char *text) {
    int size[2];
    if (!cli_sizes("--size", text, 2, size))
        return false;
    char list[32];
    snprintf(list, sizeof list, "[%d,%d]", size[0], size[1]);
    overrides_add(overrides, "render.size", list);
    return true;
}

static bool add_region(struct overrides *overrides, const char *text) {
    int region[4], end = 0;
    if (sscanf(text, "%9d,%9d,%9d,%9d%n", &region[0], &region[1], &region[2], &region[3], &end) !=
            4 ||
        text[end] != '\0') {
        cli_fail(PEL_ERROR_ARGUMENT, "--region: '%s' is not of the form X,Y,W,H", text);
        return false;
    }
    char list[64];
    snprintf(list, sizeof list, "[%s]", text);
    overrides_add(overrides, "render.region", list);
    return true;
}

static bool add_background(struct overrides *overrides, const char *text) {
    char list[128];
    snprintf(list, sizeof list, "[%s]", text);
    if (strchr(text, ','))
        overrides_add(overrides, "background", list);
    else
        overrides_add_text(overrides, "background", text);
    return true;
}

static bool add_camera(struct overrides *overrides, const char *text) {
    if (strchr(text, '='))
        return overrides_add_pairs(overrides, "--camera", "camera", text);
    overrides_add_text(overrides, "camera.view", text);
    return true;
}

error_t scene_option_parse(int key, const char *argument, struct render_options *options) {
    struct overrides *overrides = &options->overrides;
    bool good = true;
    switch (key) {
    case SCENE_SIZE:
        good = add_size(overrides, argument);
        break;
    case SCENE_REGION:
        good = add_region(overrides, argument);
        break;
    case SCENE_BACKGROUND:
        good = add_background(overrides, argument);
        break;
    case SCENE_CAMERA:
        good = add_camera(overrides, argument);
        break;
    case SCENE_CLIP:
        good = clip_option_add(overrides, &options->clip_count, argument);
        break;
    case SCENE_MASK:
        good = mask_option_add(overrides, argument);
        break;
    case SCENE_SET:
        good = overrides_add_setting(overrides, "--set", argument);
        break;
    default: {
        const struct shorthand *is = shorthands, *end = is + sizeof shorthands / sizeof *shorthands;
        while (is < end && (int)is->key != key)
            is++;
        if (is == end)
            return ARGP_ERR_UNKNOWN;
        clear_rivals(overrides, key);
        good = add_shorthand(overrides, is, argument);
    }
    }
    return good ? 0 : PEL_ERROR_ARGUMENT;
}
