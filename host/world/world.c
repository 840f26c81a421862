// world.c - a scene as the bytes that a kernel reads.
#include "world/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/grid.h"
#include "base/error.h"
#include "base/math.h"
#include "shared/tiles.h"
#include "world/boxes.h"
#include "world/brick.h"
#include "world/clip.h"
#include "world/lighting.h"
#include "world/mask.h"
#include "world/mixing.h"
#include "world/model.h"
#include "world/narrow.h"
#include "world/secondary.h"
#include "world/step.h"
#include "world/stride.h"
#include "world/style.h"
#include "world/world_table.h"

// Gives the part the number of its volume's recipe.
static bool fill_recipe(struct pel_world *world, struct part *part, int volume) {
    int number = 0;
    while (number < world->live_count && world->live[number] != volume)
        number++;
    if (number == RECIPE_LIVE_MAX)
        return pel_fail(PEL_ERROR_UNSUPPORTED,
                        "more than %d hypertextures are live; the others can be baked",
                        RECIPE_LIVE_MAX);
    if (number == world->live_count)
        world->live[world->live_count++] = volume;
    part->recipe = number + 1;
    return true;
}

// Where the slab of a volume lies, in voxels and in memory, and the box around it in the world.
static void fill_place(struct pel_world *world, struct part *part, const struct pel_slab *slab,
                       const struct pel_volume *volume, double outer,
                       const struct pel_matrix *world_from_voxel) {
    double low[3], high[3], shift[3] = {1, 1, slab->border[0] - (double)slab->first}, origin[3];
    for (int i = 0; i < 3; i++) {
        low[i] = -outer;
        high[i] = volume->dims[i] - 1 + outer;
        origin[i] = (double)slab->origin[i];
    }
    // Slabs meet at voxel centres, half a voxel before the first slice they own.
    if (slab->first > 0)
        low[2] = slab->first - 0.5;
    if (slab->first + slab->count < volume->dims[2])
        high[2] = slab->first + slab->count - 0.5;
    part->box_low = pel_narrow(low, 0);
    part->box_high = pel_narrow(high, 0);
    pel_boxes_bound(world, part, world_from_voxel);
    part->memory_from_voxel = pel_narrow(shift, 0);
    part->atlas_from_memory = pel_narrow(origin, 0);
}

// Where the voxels and the cells of a slab are found.
static void fill_memory(struct pel_world *world, struct part *part, const struct pel_slab *slab,
                        const struct pel_volume *volume, size_t cell_side) {
    part->buffer = slab->buffer;
    part->offset = (u32)(slab->offset_bytes /
                         pel_brick_element_bytes(pel_voxel_class_bytes(slab->class_index)));
    part->voxels = 1 << slab->class_index;
    world->voxels |= part->voxels;

    size_t stored[3];
    pel_slab_dims(slab, volume, stored);
    part->memory_high =
        (float4){(float)stored[0] - 1.5F, (float)stored[1] - 1.5F, (float)stored[2] - 1.5F, 0};
    part->brick_row = (i32)pel_brick_count(stored[0]);
    part->brick_slice = part->brick_row * (i32)pel_brick_count(stored[1]);
    part->cell_row = (i32)pel_grid_cells(stored[0], cell_side);
    part->cell_slice = part->cell_row * (i32)pel_grid_cells(stored[1], cell_side);
    part->cells = (u32)world->cell_count;
    part->ranges = slab->ranges;
    world->cell_count += (size_t)part->cell_slice * pel_grid_cells(stored[2], cell_side);
}

// The parts of one instance, one for each slab of its volume.
static bool fill_parts(struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_layout *layout, const struct pel_instance *instance,
                       const struct part *pattern, const double centre[3]) {
    const struct pel_volume *volume = scene->volumes[instance->volume];
    struct pel_matrix world_from_voxel =
        pel_matrix_multiply(&instance->transform, &volume->world_from_voxel);
    for (int i = 0; i < 3; i++)
        world_from_voxel.m[i][3] -= centre[i];
    struct pel_matrix voxel_from_world;
    if (!pel_matrix_invert(&voxel_from_world, &world_from_voxel))
        return pel_fail_in("placement of volume '%s'", instance->name);

    double outer = instance->extent == PEL_EXTENT_CELL ? 0.5 : 0;
    for (int s = 0; s < layout->slab_count; s++) {
        const struct pel_slab *slab = &layout->slabs[s];
        if (slab->volume != instance->volume)
            continue;
        if (world->bytes.part_count == WORLD_PART_MAX)
            return pel_fail(PEL_ERROR_UNSUPPORTED, "the volumes are cut into more than %d parts",
                            WORLD_PART_MAX);
        world->instances[world->bytes.part_count] = (int)(instance - scene->instances);
        struct part *part = &world->bytes.parts[world->bytes.part_count++];
        *part = *pattern;
        part->number = world->bytes.part_count - 1;
        for (int i = 0; i < 3; i++)
            part->voxel_from_world[i] = pel_narrow(voxel_from_world.m[i], voxel_from_world.m[i][3]);
        fill_place(world, part, slab, volume, outer, &world_from_voxel);
        fill_memory(world, part, slab, volume, (size_t)layout->cell_side);
        if (volume->hypertexture && !fill_recipe(world, part, instance->volume))
            return false;
    }
    return true;
}

static void fill_frame(struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_bounds *bounds, const double centre[3]) {
    const struct pel_render_settings *settings = &scene->render;
    struct world *bytes = &world->bytes;
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = bounds->low[i] - centre[i];
        high[i] = bounds->high[i] - centre[i];
    }
    bytes->bounds_low = pel_narrow(low, 0);
    bytes->bounds_high = pel_narrow(high, 0);
    double alpha = scene->background[3];
    bytes->background =
        (float4){(float)(scene->background[0] * alpha), (float)(scene->background[1] * alpha),
                 (float)(scene->background[2] * alpha), (float)alpha};
    bytes->step_mm = (float)pel_step_of_scene(scene);
    bytes->phase = (float)settings->phase;
    bool ends = settings->termination < 1 && !pel_model_never_ends(scene);
    bytes->termination = ends ? (float)settings->termination : 2;
    bytes->origin_bounds = settings->origin == PEL_ORIGIN_BOUNDS;
    bool part = settings->region[2] > 0;
    bytes->left = settings->region[0];
    bytes->top = settings->region[1];
    bytes->width = part ? settings->region[2] : settings->width;
    bytes->height = part ? settings->region[3] : settings->height;
    bytes->whole_width = settings->width;
    bytes->whole_height = settings->height;
    bytes->tiles_x = TILES_ALONG(bytes->width);
    bytes->tiles_y = TILES_ALONG(bytes->height);
    const struct pel_supersampling *supersampling = &settings->supersampling;
    bytes->rays_n = supersampling->n > 1 ? supersampling->n : 1;
    bytes->pattern = (i32)supersampling->pattern;
    bytes->reconstruction = (i32)supersampling->filter;
    bytes->seed = supersampling->seed;
    bytes->contrast = (float)supersampling->adaptive;
    bytes->debug = (i32)settings->debug; // numbers are in the order of enums
}

static bool fill_filter(struct part *part, const struct pel_instance *instance) {
    static const i32 filters[] = {FILTERS_LINEAR, FILTERS_NEAREST, FILTERS_CUBIC_B_SPLINE,
                                  FILTERS_CATMULL_ROM};
    if ((unsigned)instance->filter > PEL_FILTER_CATMULL_ROM)
        return pel_fail(PEL_ERROR_ARGUMENT, "volume '%s': filter %d", instance->name,
                        (int)instance->filter);
    part->filter = filters[instance->filter];
    return true;
}

// The parts an instance is cut into.
static int count_slabs(const struct pel_layout *layout, const struct pel_instance *instance) {
    int count = 0;
    for (int s = 0; s < layout->slab_count; s++)
        count += layout->slabs[s].volume == instance->volume;
    return count;
}

static bool fill_instances(struct pel_world *world, const struct pel_scene *scene,
                           const struct pel_layout *layout, struct pel_memo *memo,
                           const double centre[3]) {
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        if (instance->hidden)
            continue;
        struct part pattern = {0};
        if (!fill_filter(&pattern, instance))
            return false;
        pattern.step_mm = (float)pel_step_of_instance(scene, instance);
        if (world->models & MODELS_EMISSION)
            pattern.filter = FILTERS_NEAREST;
        world->filters |= pattern.filter;
        if (!pel_world_add_table(world, scene, layout, instance, memo, &pattern))
            return false;
        const struct pel_table *table = &memo->tables[k].table;
        if (!pel_lighting_fill_part(&pattern, instance, scene->volumes[instance->volume]) ||
            !pel_style_fill_part(&pattern, instance, table->high - table->low) ||
            !pel_model_fill_part(&pattern, scene, instance, table, count_slabs(layout, instance)))
            return pel_fail_in("volume '%s'", instance->name);
        world->shaded |= pattern.shading != SHADING_NONE || pattern.styled;
        world->styled |= pattern.styled || pattern.gradient != GRADIENT_CENTRAL;
        pattern.rank = (float)pel_mixing_rank(scene, instance);
        pel_clip_fill_part(world, &pattern, scene, instance, centre);
        // Only media are mixed.
        pattern.medium =
            pattern.model == MODEL_ABSORPTION ? world->bytes.medium_count++ : MEDIUM_NONE;
        if (!pel_stride_fill_part(world, &pattern, scene, instance, &memo->tables[k]) ||
            !fill_parts(world, scene, layout, instance, &pattern, centre))
            return false;
    }
    return true;
}

// The volumes that decide where others are shown have parts of their own, as they may be hidden.
static bool fill_masks(struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_layout *layout, const double centre[3]) {
    const struct part pattern = {.filter = FILTERS_NEAREST};
    int first[PEL_VOLUME_MAX], count[PEL_VOLUME_MAX] = {0}, shown = world->bytes.part_count;
    for (int p = 0; p < shown; p++) {
        int mask = pel_mask_of(&scene->instances[world->instances[p]]);
        if (mask < 0)
            continue;
        if (count[mask] == 0) {
            first[mask] = world->bytes.part_count;
            if (!fill_parts(world, scene, layout, &scene->instances[mask], &pattern, centre))
                return false;
            count[mask] = world->bytes.part_count - first[mask];
        }
        if (!pel_mask_fill_part(world, p, scene, layout->reader, first[mask], count[mask]))
            return false;
    }
    world->part_total = world->bytes.part_count;
    world->bytes.part_count = shown;
    return true;
}

// One ray through the centre, as it is, is what a kernel does without being told.
bool pel_world_is_supersampled(const struct pel_supersampling *supersampling) {
    bool centred = supersampling->pattern == PEL_PATTERN_REGULAR ||
                   supersampling->pattern == PEL_PATTERN_HAMMERSLEY;
    return supersampling->n > 1 || !centred || supersampling->filter != PEL_RECONSTRUCTION_BOX;
}

bool pel_world_build(struct pel_world *world, const struct pel_scene *scene,
                     const struct pel_layout *layout, struct pel_memo *memo) {
    memset(world, 0, sizeof *world);
    world->cell_side = layout->cell_side;
    world->pool = layout->pool;
    world->border = layout->border;
    world->eyes = EYES_ONE;
    world->bytes.pictures = 1;
    struct pel_bounds bounds = {{0}, {0}};
    int visible = 0;
    for (int k = 0; k < scene->instance_count; k++)
        visible += !scene->instances[k].hidden;
    if (visible > 0 && !pel_scene_bounds(scene, &bounds))
        return false;
    double *centre = world->centre;
    for (int i = 0; i < 3; i++)
        centre[i] = (bounds.low[i] + bounds.high[i]) / 2;
    fill_frame(world, scene, &bounds, centre);
    if (!pel_world_set_eye(world, scene) || !pel_lighting_fill_lamps(&world->bytes, scene, centre))
        return false;

    world->supersampling =
        !scene->render.debug && pel_world_is_supersampled(&scene->render.supersampling);
    world->jitter = scene->render.jitter;
    world->models = pel_model_kernel(scene);
    // A volume on its own, or one blended at a time, is looked up as opacity; slabs of one count as
    // several.
    int parts = 0;
    for (int k = 0; k < scene->instance_count; k++)
        if (!scene->instances[k].hidden)
            parts += count_slabs(layout, &scene->instances[k]);
    world->mixing = parts > 1 ? pel_mixing_find(scene->render.mixing) : MIXING_SUM;
    world->depth = parts > 1 && world->mixing != MIXING_OVER && world->mixing != MIXING_ORDERED;
    bool good = pel_world_build_tables(world, scene, memo);
    good = good && fill_instances(world, scene, layout, memo, centre) &&
           fill_masks(world, scene, layout, centre) && pel_secondary_fill(world, scene);
    if (good)
        pel_boxes_join(world);
    return good;
}

double pel_world_diagonal_mm(const struct pel_world *world) {
    const float4 *low = &world->bytes.bounds_low, *high = &world->bytes.bounds_high;
    return pel_length((double[]){(double)high->x - (double)low->x, (double)high->y - (double)low->y,
                                 (double)high->z - (double)low->z});
}

void pel_world_cells(const struct pel_world *world, int p, size_t cells[3]) {
    const struct part *parts = world->bytes.parts;
    size_t end = p + 1 < world->part_total ? parts[p + 1].cells : world->cell_count;
    cells[0] = (size_t)parts[p].cell_row;
    cells[1] = (size_t)(parts[p].cell_slice / parts[p].cell_row);
    cells[2] = (end - parts[p].cells) / (size_t)parts[p].cell_slice;
}

size_t pel_world_bytes(const struct pel_world *world) {
    int rows = world->cut_count + world->bytes.occlusion_count;
    return offsetof(struct world, cuts) + (size_t)rows * sizeof *world->bytes.cuts;
}
