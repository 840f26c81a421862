// hypertexture.c - where hypertextures lie, and volumes that are worked out instead of read.
//
//     position of a recipe          -1 ........ 0 ........ +1    along the longest side
//     voxels of the grid             | 0 | 1 | 2 | 3 | 4 | 5 |   centres, half a voxel inside
#include "world/hypertexture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/math.h"
#include "base/memory.h"
#include "volume/hypertexture.h"
#include "volume/volume.h"
#include "world/narrow.h"
#include "world/recipe.h"

enum { SIZE_DEFAULT = 64, SIZE_MAX_VOXELS = 65536 };

static const double natural_extent_mm = 100;

static bool check_options(const struct pel_bake_options *options) {
    if (options->size < 0 || options->size > SIZE_MAX_VOXELS)
        return pel_fail(PEL_ERROR_ARGUMENT, "size %d is outside 1..%d", options->size,
                        SIZE_MAX_VOXELS);
    if (!isfinite(options->time))
        return pel_fail(PEL_ERROR_ARGUMENT, "time %g is not a number", options->time);
    bool floats = options->type == PEL_VOXEL_F32;
    if (options->type != PEL_VOXEL_U8 && options->type != PEL_VOXEL_U16 && !floats)
        return pel_fail(PEL_ERROR_ARGUMENT, "hypertextures are uint8, uint16 or float32 only");
    if (floats && options->wrap)
        return pel_fail(PEL_ERROR_ARGUMENT, "only integers wrap around, and these are float32");
    return true;
}

// ---- Places ------------------------------------------------------------------------------------

// The grid and its place: a cube around the origin, or the object's box in voxels as near to cubes
// as whole numbers allow. The caller owns it.
static struct pel_volume *make_grid(const char *name, const struct pel_bake_options *options,
                                    bool voxels) {
    const struct pel_volume *object = options->object;
    int size = options->size ? options->size : SIZE_DEFAULT;
    int dims[3] = {size, size, size};
    double spacing_mm[3] = {1, 1, 1}, extent_mm[3], longest = 0;
    if (object)
        pel_volume_spacing(object, spacing_mm);
    for (int axis = 0; axis < 3; axis++) {
        extent_mm[axis] = object ? object->dims[axis] * spacing_mm[axis] : natural_extent_mm;
        longest = fmax(longest, extent_mm[axis]);
    }
    for (int axis = 0; axis < 3; axis++)
        dims[axis] = (int)fmax(floor(size * extent_mm[axis] / longest + 0.5), 1);
    const int nothing[3] = {1, 1, 1};
    struct pel_volume *volume = pel_volume_create(name, voxels ? dims : nothing, options->type);
    if (!volume)
        return NULL;
    memcpy(volume->dims, dims, sizeof dims);
    struct pel_matrix from_grid = pel_matrix_identity();
    for (int axis = 0; axis < 3; axis++) {
        int from = object ? object->dims[axis] : 1;
        double scale = (object ? from : natural_extent_mm) / dims[axis];
        from_grid.m[axis][axis] = scale;
        // Both cells begin at the same place; without an object the middle is the origin.
        from_grid.m[axis][3] = object ? 0.5 * scale - 0.5 : 0.5 * scale - 0.5 * natural_extent_mm;
    }
    volume->world_from_voxel =
        object ? pel_matrix_multiply(&object->world_from_voxel, &from_grid) : from_grid;
    snprintf(volume->space, sizeof volume->space, "%s",
             object ? object->space : "hypertexture, [-1,1]^3 = 100 mm");
    return volume;
}

// Tells the program where voxels lie and what the object is like. The longest side of the grid is
// [-1, 1].
static void place(struct recipe *program, const struct pel_volume *grid,
                  const struct pel_bake_options *options) {
    double spacing_mm[3], longest = 0;
    pel_volume_spacing(grid, spacing_mm);
    for (int axis = 0; axis < 3; axis++)
        longest = fmax(longest, grid->dims[axis] * spacing_mm[axis]);
    double start[3], step[3], scale[3] = {0}, bias[3] = {0};
    for (int axis = 0; axis < 3; axis++) {
        step[axis] = 2 * spacing_mm[axis] / longest;
        start[axis] = -0.5 * (grid->dims[axis] - 1) * step[axis];
        if (options->object) {
            // Both boxes are the same, so their middles are.
            int count = options->object->dims[axis];
            scale[axis] = count / (step[axis] * grid->dims[axis]);
            bias[axis] = 0.5 * (count - 1);
        }
    }
    program->grid_start = pel_narrow(start, 0);
    program->grid_step = pel_narrow(step, 0);
    program->object_scale = pel_narrow(scale, 0);
    program->object_bias = pel_narrow(bias, 0);
    program->grid_dims = (int4){grid->dims[0], grid->dims[1], grid->dims[2], 0};
    program->time = (float)options->time;
}

// Tells the program what the volume that it reads is like.
static bool describe_object(struct recipe *program, const struct pel_volume *object) {
    if (!pel_recipe_needs_object(program))
        return true;
    if (!object)
        return pel_fail(PEL_ERROR_ARGUMENT, "the recipe grows on a volume, and none was given");
    if (!object->voxels)
        return pel_fail(PEL_ERROR_ARGUMENT, "the recipe grows on '%s', which is a hypertexture",
                        object->name);
    struct pel_statistics *statistics = pel_allocate(1, sizeof *statistics);
    if (!statistics)
        return false;
    pel_volume_measure(object, statistics);
    program->object_dims = (int4){object->dims[0], object->dims[1], object->dims[2], 0};
    program->object_low = (float)statistics->min;
    program->object_span = (float)(statistics->max - statistics->min);
    free(statistics);
    return true;
}

// A short name for messages.
static const char *name_of(const char *recipe) {
    return recipe[strspn(recipe, " \t\r\n")] == '{' ? "recipe" : pel_path_leaf(recipe);
}

struct pel_volume *pel_hypertexture_place(struct recipe *program, const char *recipe,
                                          const struct pel_bake_options *options, bool voxels) {
    *program = (struct recipe){.length = 0};
    if (!check_options(options) || !pel_recipe_compile(program, recipe) ||
        !describe_object(program, options->object))
        return NULL;
    pel_recipe_seed(program, options->seed);
    struct pel_volume *volume = make_grid(name_of(recipe), options, voxels);
    if (volume)
        place(program, volume, options);
    return volume;
}

struct pel_volume *pel_volume_hypertexture(const char *recipe,
                                           const struct pel_bake_options *options, bool live) {
    static const struct pel_bake_options defaults;
    struct recipe *program = pel_allocate(1, sizeof *program);
    struct pel_hypertexture *hypertexture = pel_allocate(1, sizeof *hypertexture);
    if (!program || !hypertexture) {
        free(program);
        free(hypertexture);
        return NULL;
    }
    // Live densities are floats, whatever they would be baked to.
    struct pel_bake_options chosen = options ? *options : defaults;
    if (live)
        chosen.type = PEL_VOXEL_F32;
    *hypertexture = (struct pel_hypertexture){
        .live = live,
        .recipe = pel_copy_text(recipe),
        .program = program,
        .object = chosen.object ? pel_volume_share((struct pel_volume *)chosen.object) : NULL,
        .options = chosen};
    struct pel_volume *volume =
        hypertexture->recipe ? pel_hypertexture_place(program, recipe, &chosen, false) : NULL;
    if (!volume) {
        pel_hypertexture_destroy(hypertexture);
        return NULL;
    }
    free(volume->voxels);
    volume->voxels = NULL;
    volume->hypertexture = hypertexture;
    volume->slope = pel_hypertexture_slope(chosen.type);
    return volume;
}

double pel_hypertexture_slope(enum pel_voxel_type type) {
    return type == PEL_VOXEL_U8 ? 1 / 255.0 : type == PEL_VOXEL_U16 ? 1 / 65535.0 : 1;
}
