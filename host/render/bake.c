// bake.c - hypertextures into voxels.
//
// A recipe is compiled to a program that one kernel interprets at every voxel, so that a new recipe
// needs no new kernel. Voxels are worked out as floats, in batches short enough for a watchdog, and
// stored in the volume's type here.
#include "render/bake.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/math.h"
#include "base/memory.h"
#include "world/hypertexture.h"

enum { BATCH_FIRST = 1 << 12, BATCH_MAX = 1 << 20 };

// A batch of voxels should take about this long.
static const double batch_ms = 150;

struct bake {
    struct pel_kernel *kernel;                   // borrowed
    struct pel_buffer *program, *object, *block; // of values
    float *values;                               // a batch, here
};

// ---- The object --------------------------------------------------------------------------------

// Sends the object's values as shares of their range, slice by slice; absent ones are 0.
bool pel_bake_send_object(struct pel_buffer *buffer, size_t offset, const struct pel_volume *object,
                          const struct recipe *program) {
    size_t count = (size_t)object->dims[0] * (size_t)object->dims[1];
    float *slice = pel_allocate(count, sizeof *slice);
    bool good = slice != NULL;
    double low = program->object_low, span = program->object_span;
    double scale = span > 0 ? 1 / span : 0;
    for (int k = 0; good && k < object->dims[2]; k++) {
        for (size_t n = 0; n < count; n++) {
            int i = (int)(n % (size_t)object->dims[0]), j = (int)(n / (size_t)object->dims[0]);
            double value = pel_volume_value(object, i, j, k);
            slice[n] = isnan(value) ? 0 : (float)((value - low) * scale);
        }
        good = pel_buffer_write(buffer, (offset + (size_t)k * count) * sizeof *slice,
                                count * sizeof *slice, slice);
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
    bake->object = pel_buffer_create(device, pel_volume_voxel_count(object) * sizeof(float),
                                     "the volume a recipe grows on");
    return bake->object && pel_bake_send_object(bake->object, 0, object, program);
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
        double start = pel_clock_ms();
        if (!run_batch(bake, volume, first, count, options->wrap))
            return false;
        double took = pel_clock_ms() - start;
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

struct pel_volume *pel_bake(struct pel_device *device, struct pel_kernel **kernel,
                            const char *recipe, const struct pel_bake_options *options) {
    static const struct pel_bake_options defaults;
    struct recipe program;
    options = options ? options : &defaults;
    if (!*kernel)
        *kernel = pel_kernel_build(device, "hypertexture.cl", "bake", "-cl-std=CL1.2");
    struct pel_volume *volume =
        *kernel ? pel_hypertexture_place(&program, recipe, options, true) : NULL;
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
