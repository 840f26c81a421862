// bake.c - hypertextures into voxels.
//
// A recipe is compiled to a program that one kernel interprets at every voxel, so that a new recipe
// needs no new kernel. Voxels are worked out as floats, in batches short enough for a watchdog, and
// stored in the volume's type here.
//
//     position of a recipe          -1 ........ 0 ........ +1    along the longest side
//     voxels of the grid             | 0 | 1 | 2 | 3 | 4 | 5 |   centres, half a voxel inside
#include "render/bake.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/error.h"
#include "base/file.h"
#include "base/math.h"
#include "base/memory.h"
#include "world/recipe.h"

enum { SIZE_DEFAULT = 64, SIZE_MAX_VOXELS = 65536, BATCH_FIRST = 1 << 12, BATCH_MAX = 1 << 20 };

static const double natural_extent_mm = 100;

// A batch of voxels should take about this long.
static const double batch_ms = 150;

struct bake {
    struct pel_kernel *kernel;                   // borrowed
    struct pel_buffer *program, *object, *block; // of values
    float *values;                               // a batch, here
};

static double now_ms(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

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
static struct pel_volume *make_grid(const char *name, const struct pel_bake_options *options) {
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
    struct pel_volume *volume = pel_volume_create(name, dims, options->type);
    if (!volume)
        return NULL;
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
    program->grid_start = (float4){(float)start[0], (float)start[1], (float)start[2], 0};
    program->grid_step = (float4){(float)step[0], (float)step[1], (float)step[2], 0};
    program->object_scale = (float4){(float)scale[0], (float)scale[1], (float)scale[2], 0};
    program->object_bias = (float4){(float)bias[0], (float)bias[1], (float)bias[2], 0};
    program->grid_dims = (int4){grid->dims[0], grid->dims[1], grid->dims[2], 0};
    program->time = (float)options->time;
}

// ---- The object --------------------------------------------------------------------------------

// Sends the object's values as shares of their range, slice by slice; absent ones are 0.
static bool send_object(struct pel_buffer *buffer, const struct pel_volume *object, double low,
                        double high) {
    size_t count = (size_t)object->dims[0] * (size_t)object->dims[1];
    float *slice = pel_allocate(count, sizeof *slice);
    bool good = slice != NULL;
    double scale = high > low ? 1 / (high - low) : 0;
    for (int k = 0; good && k < object->dims[2]; k++) {
        for (size_t n = 0; n < count; n++) {
            int i = (int)(n % (size_t)object->dims[0]), j = (int)(n / (size_t)object->dims[0]);
            double value = pel_volume_value(object, i, j, k);
            slice[n] = isnan(value) ? 0 : (float)((value - low) * scale);
        }
        good = pel_buffer_write(buffer, (size_t)k * count * sizeof *slice, count * sizeof *slice,
                                slice);
    }
    free(slice);
    return good;
}

static bool prepare_object(struct bake *bake, struct pel_device *device, struct recipe *program,
                           const struct pel_volume *object) {
    if (!pel_recipe_needs_object(program)) {
        bake->object = pel_buffer_create(device, sizeof(float), "no volume");
        return bake->object != NULL;
    }
    if (!object)
        return pel_fail(PEL_ERROR_ARGUMENT, "the recipe grows on a volume, and none was given");
    struct pel_statistics *statistics = pel_allocate(1, sizeof *statistics);
    if (!statistics)
        return false;
    pel_volume_measure(object, statistics);
    double low = statistics->min, high = statistics->max;
    free(statistics);
    program->object_dims = (int4){object->dims[0], object->dims[1], object->dims[2], 0};
    program->object_low = (float)low;
    program->object_span = (float)(high - low);
    bake->object = pel_buffer_create(device, pel_volume_voxel_count(object) * sizeof(float),
                                     "the volume a recipe grows on");
    return bake->object && send_object(bake->object, object, low, high);
}

// ---- Voxels ------------------------------------------------------------------------------------

// What a density becomes: rounded, and clamped to 0..most, or reduced to the low bits of `most`.
// What is no number is absent, which is 0.
static uint32_t quantise(float density, double most, bool wrap) {
    double raw = floor((double)density * most + 0.5);
    if (!isfinite(raw))
        return raw > 0 && !wrap ? (uint32_t)most : 0;
    if (!wrap)
        return (uint32_t)fmin(fmax(raw, 0), most);
    double range = most + 1;
    return (uint32_t)(raw - range * floor(raw / range));
}

static void store(struct pel_volume *volume, size_t first, size_t count, const float *values,
                  bool wrap) {
    if (volume->type == PEL_VOXEL_F32)
        memcpy((float *)volume->voxels + first, values, count * sizeof *values);
    else if (volume->type == PEL_VOXEL_U8)
        for (size_t i = 0; i < count; i++)
            ((uint8_t *)volume->voxels)[first + i] = (uint8_t)quantise(values[i], 255, wrap);
    else
        for (size_t i = 0; i < count; i++)
            ((uint16_t *)volume->voxels)[first + i] = (uint16_t)quantise(values[i], 65535, wrap);
}

// Works out `count` voxels from `first` on, a multiple of BAKE_ROUND.
static bool run_batch(struct bake *bake, struct pel_volume *volume, size_t first, size_t count,
                      bool wrap) {
    size_t group = BAKE_ROUND;
    while (group > pel_kernel_max_group(bake->kernel))
        group /= 2;
    size_t items = (count + BAKE_ROUND - 1) / BAKE_ROUND * BAKE_ROUND;
    if (!pel_kernel_set_u32(bake->kernel, 3, (uint32_t)(first / BAKE_ROUND)) ||
        !pel_kernel_set_u32(bake->kernel, 4, (uint32_t)count) ||
        !pel_kernel_launch(bake->kernel, items, group) ||
        !pel_buffer_read(bake->block, 0, count * sizeof(float), bake->values))
        return false;
    store(volume, first, count, bake->values, wrap);
    return true;
}

static bool run(struct bake *bake, struct pel_volume *volume,
                const struct pel_bake_options *options) {
    size_t voxels = pel_volume_voxel_count(volume), batch = BATCH_FIRST;
    for (size_t first = 0; first < voxels;) {
        size_t count = voxels - first < batch ? voxels - first : batch;
        double start = now_ms();
        if (!run_batch(bake, volume, first, count, options->wrap))
            return false;
        double took = now_ms() - start;
        first += count;
        if (options->progress && !options->progress((double)first / (double)voxels, options->user))
            return pel_fail(PEL_ERROR_ARGUMENT, "the hypertexture was abandoned");
        if (took < 0.5 * batch_ms && batch < BATCH_MAX)
            batch *= 2;
        else if (took > 2 * batch_ms && batch > BAKE_ROUND)
            batch /= 2;
    }
    if (volume->type == PEL_VOXEL_F32)
        // Absent voxels are NaN, never infinite.
        for (size_t i = 0; i < voxels; i++)
            if (!isfinite(((float *)volume->voxels)[i]))
                ((float *)volume->voxels)[i] = NAN;
    return true;
}

static bool prepare(struct bake *bake, struct pel_device *device, struct recipe *program,
                    const struct pel_volume *grid, const struct pel_bake_options *options) {
    size_t voxels = pel_volume_voxel_count(grid);
    size_t block = voxels < BATCH_MAX ? voxels : BATCH_MAX;
    place(program, grid, options);
    if (!prepare_object(bake, device, program, options->object))
        return false;
    bake->values = pel_allocate(block, sizeof *bake->values);
    bake->program = pel_buffer_create(device, sizeof *program, "a recipe");
    bake->block = pel_buffer_create(device, block * sizeof(float), "voxels");
    return bake->values && bake->program && bake->block &&
           pel_buffer_write(bake->program, 0, sizeof *program, program) &&
           pel_kernel_set_buffer(bake->kernel, 0, bake->program) &&
           pel_kernel_set_buffer(bake->kernel, 1, bake->object) &&
           pel_kernel_set_buffer(bake->kernel, 2, bake->block);
}

// A short name for messages.
static const char *name_of(const char *recipe) {
    return recipe[strspn(recipe, " \t\r\n")] == '{' ? "recipe" : pel_path_leaf(recipe);
}

struct pel_volume *pel_bake(struct pel_device *device, struct pel_kernel **kernel,
                            const char *recipe, const struct pel_bake_options *options) {
    struct recipe program = {.length = 0};
    if (!check_options(options) || !pel_recipe_compile(&program, recipe))
        return NULL;
    pel_recipe_seed(&program, options->seed);
    if (!*kernel)
        *kernel = pel_kernel_build(device, "hypertexture.cl", "bake", "-cl-std=CL1.2");
    struct pel_volume *volume = *kernel ? make_grid(name_of(recipe), options) : NULL;
    if (!volume)
        return NULL;
    struct bake bake = {.kernel = *kernel};
    if (!prepare(&bake, device, &program, volume, options) || !run(&bake, volume, options)) {
        pel_volume_destroy(volume);
        volume = NULL;
    }
    pel_buffer_destroy(bake.program);
    pel_buffer_destroy(bake.object);
    pel_buffer_destroy(bake.block);
    free(bake.values);
    return volume;
}
