// scene_option.h - the options that are shorthands for keys of a scene.
#ifndef PEL_CLI_SCENE_OPTION_H
#define PEL_CLI_SCENE_OPTION_H

#include "cli/options.h"
#include "cli/render_options.h"

// Their keys; those of other options begin with SCENE_OPTION_END.
enum scene_option {
    SCENE_SIZE = CLI_KEY_COMMAND,
    SCENE_CAMERA,
    SCENE_MIX,
    SCENE_CLIP,
    SCENE_MASK,
    SCENE_STEP,
    SCENE_STEP_MM,
    SCENE_MODEL,
    SCENE_QUALITY,
    SCENE_PREINTEGRATION,
    SCENE_ORDER,
    SCENE_FILTER,
    SCENE_GRADIENT,
    SCENE_TERMINATION,
    SCENE_ADAPTIVE_STEP,
    SCENE_PHASE,
    SCENE_SKIP,
    SCENE_SUPERSAMPLE,
    SCENE_PATTERN,
    SCENE_RECONSTRUCTION,
    SCENE_ADAPTIVE,
    SCENE_SEED,
    SCENE_JITTER,
    SCENE_DEBUG,
    SCENE_DENSITY,
    SCENE_SHADING,
    SCENE_LOD,
    SCENE_SHADOWS,
    SCENE_AMBIENT_OCCLUSION,
    SCENE_BACKGROUND,
    SCENE_STEREO,
    SCENE_STEREO_SEPARATION,
    SCENE_STEREO_CONVERGENCE,
    SCENE_STEREO_SWAP,
    SCENE_STEREO_TOE_IN,
    SCENE_STEREO_REPROJECT,
    SCENE_TRANSFER,
    SCENE_DEPTH,
    SCENE_ALPHA,
    SCENE_SET,
    SCENE_REGION,
    SCENE_FPS,
    SCENE_OPTION_END,
};

// Adds what one of them says to the overrides. ARGP_ERR_UNKNOWN for other keys; PEL_ERROR_ARGUMENT,
// after a message, for an argument that is not of its form.
error_t scene_option_parse(int key, const char *argument, struct render_options *options);

#endif
