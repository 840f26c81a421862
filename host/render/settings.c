// settings.c - whether a scene's settings make sense.
#include "render/settings.h"

#include <math.h>

#include "base/error.h"
#include "shared/tiles.h"
#include "world/bricks.h"
#include "world/clip.h"
#include "world/detail.h"
#include "world/mask.h"
#include "world/model.h"
#include "world/step.h"
#include "world/stride.h"

enum { PICTURE_MAX = 32768 };

static bool check_supersampling(const struct pel_supersampling *supersampling) {
    if (supersampling->n < 0 || supersampling->n > PEL_SUPERSAMPLING_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "supersampling with n = %d, outside 0..%d",
                        supersampling->n, PEL_SUPERSAMPLING_MAX);
    if ((unsigned)supersampling->pattern > PEL_PATTERN_HAMMERSLEY ||
        (unsigned)supersampling->filter > PEL_RECONSTRUCTION_GAUSSIAN)
        return pel_fail(PEL_ERROR_ARGUMENT, "supersampling with pattern %d and filter %d",
                        (int)supersampling->pattern, (int)supersampling->filter);
    if (!(supersampling->adaptive >= 0))
        return pel_fail(PEL_ERROR_ARGUMENT, "adaptive supersampling beyond %g, must be at least 0",
                        supersampling->adaptive);
    return true;
}

bool pel_settings_check(const struct pel_scene *scene) {
    const struct pel_render_settings *settings = &scene->render;
    if (settings->width < 1 || settings->height < 1 || settings->width > PICTURE_MAX ||
        settings->height > PICTURE_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "picture of %d x %d pixels, outside 1..%d",
                        settings->width, settings->height, PICTURE_MAX);
    if (!pel_step_check(scene))
        return false;
    if (!(settings->phase >= 0 && settings->phase <= 1))
        return pel_fail(PEL_ERROR_ARGUMENT, "phase %g, outside 0..1", settings->phase);
    if (!(settings->termination >= 0 && settings->termination <= 1))
        return pel_fail(PEL_ERROR_ARGUMENT, "termination %g, outside 0..1", settings->termination);
    if ((unsigned)settings->debug > PEL_DEBUG_NODES)
        return pel_fail(PEL_ERROR_ARGUMENT, "debug view %d", (int)settings->debug);
    if ((settings->debug == PEL_DEBUG_CLUSTERS || settings->debug == PEL_DEBUG_NODES) &&
        settings->skip != PEL_SKIP_AUTO && settings->skip != PEL_SKIP_BVH &&
        settings->skip != PEL_SKIP_BLOCKS)
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "this debug view counts boxes of the hierarchy that only skip bvh and "
                        "blocks have");
    if ((unsigned)settings->mixing > PEL_MIX_DIFFERENCE)
        return pel_fail(PEL_ERROR_ARGUMENT, "mixing of kind %d", (int)settings->mixing);
    for (int k = 0; k < scene->instance_count; k++)
        if (!isfinite(scene->instances[k].priority))
            return pel_fail(PEL_ERROR_ARGUMENT, "volume '%s': priority %g, must be finite",
                            scene->instances[k].name, scene->instances[k].priority);
    return pel_model_check(scene) && pel_stride_check(scene) && pel_clip_check(scene) &&
           pel_mask_check(scene) && pel_detail_check(settings) &&
           pel_bricks_check(&settings->bricks) && check_supersampling(&settings->supersampling);
}

bool pel_settings_check_options(const struct pel_renderer_options *options) {
    int lanes = options->lanes, group = options->work_group, rows = options->work_group_rows;
    if (lanes != 0 && lanes != 1 && lanes != 4 && lanes != 8 && lanes != 16)
        return pel_fail(PEL_ERROR_ARGUMENT, "%d lanes; there are kernels for 1, 4, 8 and 16",
                        lanes);
    if (group < 0 || (group & (group - 1)) != 0)
        return pel_fail(PEL_ERROR_ARGUMENT, "work-group of %d, must be a power of two", group);
    if (options->compute_units < 0)
        return pel_fail(PEL_ERROR_ARGUMENT, "%d compute units, must be at least 1",
                        options->compute_units);
    if ((unsigned)options->gl.platform > PEL_GL_EGL)
        return pel_fail(PEL_ERROR_ARGUMENT, "OpenGL platform %d", (int)options->gl.platform);
    // A tile has at least four packets above each other, however many rays there are in one.
    if (rows < 0 || rows > TILE_PX / 4 || (rows & (rows - 1)) != 0)
        return pel_fail(PEL_ERROR_ARGUMENT, "work-groups of %d rows, must be 1, 2 or 4", rows);
    return true;
}
