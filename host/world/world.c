// world.c - a scene as the bytes that a kernel reads.
#include "world/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/grid.h"
#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "camera/camera.h"
#include "world/brick.h"
#include "world/clip.h"
#include "world/lighting.h"
#include "world/mask.h"
#include "world/mixing.h"
#include "world/model.h"
#include "world/secondary.h"
#include "world/step.h"
#include "world/stride.h"
#include "world/strength.h"
#include "world/style.h"

static float4 to_float4(const double v[3], double w) {
    return (float4){(float)v[0], (float)v[1], (float)v[2], (float)w};
}

// a * x + b * y + c * z, for the camera's plane.
static void combine(double out[3], const double x[3], double a, const double y[3], double b,
                    const double z[3], double c) {
    for (int i = 0; i < 3; i++)
        out[i] = a * x[i] + b * y[i] + c * z[i];
}

// docs/picture.md, "Rays", with the window's shift folded into `forward` or `eye`.
static bool fill_camera(struct camera *out, const struct pel_camera *camera,
                        const struct pel_render_settings *settings, const double centre[3]) {
    double forward[3], right[3], up[3];
    if (!pel_camera_basis(camera, forward, right, up))
        return false;
    double aspect = (double)settings->width / settings->height;
    double half =
        camera->orthographic ? camera->height_mm / 2 : tan(camera->fov_deg * PEL_PI / 360);
    const double zero[3] = {0};
    double eye[3], across[3], upward[3], window[3];
    combine(eye, camera->eye, 1, centre, -1, zero, 0);
    combine(across, right, half * aspect, zero, 0, zero, 0);
    combine(upward, up, half, zero, 0, zero, 0);
    combine(window, camera->orthographic ? eye : forward, 1, right, 2 * half * camera->shift[0], up,
            2 * half * camera->shift[1]);

    *out = (struct camera){0};
    if (camera->orthographic) {
        out->eye = to_float4(window, 1);
        out->eye_right = to_float4(across, 0);
        out->eye_up = to_float4(upward, 0);
        out->forward = to_float4(forward, 0);
    } else {
        out->eye = to_float4(eye, 1);
        out->forward = to_float4(window, 0);
        out->right = to_float4(across, 0);
        out->up = to_float4(upward, 0);
    }
    return true;
}

// What has to be added to a stored voxel to have the file's raw one: signed integers are stored
// unsigned.
static double stored_bias(enum pel_voxel_type type) {
    return type == PEL_VOXEL_I8 ? -128 : type == PEL_VOXEL_I16 ? -32768 : 0;
}

// How the kernel finds the table's entry for what it reads.
static void fill_table_address(struct part *part, const struct pel_volume *volume,
                               const struct pel_table *table, int last, enum pel_reader reader) {
    double bias = stored_bias(volume->type);
    double factor = pel_reader_factor(reader, pel_voxel_class(volume->type));
    double entries = last / (table->high - table->low);
    part->table_scale = (float)(volume->slope * factor * entries);
    part->table_bias = (float)((volume->intercept + volume->slope * bias - table->low) * entries);
    part->table_last = (float)last;
    part->table_nearest = table->nearest;
}

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

// The ball around a part's box, a little too large for what rounding may add.
static float4 bound_part(const struct part *part, const struct pel_matrix *world_from_voxel) {
    const double low[3] = {part->box_low.x, part->box_low.y, part->box_low.z};
    const double high[3] = {part->box_high.x, part->box_high.y, part->box_high.z};
    double middle[3], radius = 0;
    for (int i = 0; i < 3; i++) {
        middle[i] = world_from_voxel->m[i][3];
        for (int j = 0; j < 3; j++)
            middle[i] += world_from_voxel->m[i][j] * (low[j] + high[j]) / 2;
    }
    for (int corner = 0; corner < 8; corner++) {
        double squared = 0;
        for (int i = 0; i < 3; i++) {
            double away = world_from_voxel->m[i][3] - middle[i];
            for (int j = 0; j < 3; j++)
                away += world_from_voxel->m[i][j] * (corner >> j & 1 ? high[j] : low[j]);
            squared += away * away;
        }
        radius = fmax(radius, sqrt(squared));
    }
    return to_float4(middle, radius * (1 + 1e-5) + 1e-6 * pel_length(middle));
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
            part->voxel_from_world[i] = to_float4(voxel_from_world.m[i], voxel_from_world.m[i][3]);
        double low[3], high[3], shift[3] = {1, 1, slab->border[0]}, origin[3];
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
        shift[2] -= slab->first;
        part->box_low = to_float4(low, 0);
        part->box_high = to_float4(high, 0);
        world->bytes.balls[part->number] = bound_part(part, &world_from_voxel);
        part->memory_from_voxel = to_float4(shift, 0);
        part->atlas_from_memory = to_float4(origin, 0);
        part->buffer = slab->buffer;
        part->offset = (u32)(slab->offset_bytes /
                             pel_brick_element_bytes(pel_voxel_class_bytes(slab->class_index)));
        if (volume->hypertexture && !fill_recipe(world, part, instance->volume))
            return false;
        part->voxels = 1 << slab->class_index;
        world->voxels |= part->voxels;

        size_t stored[3], side = (size_t)layout->cell_side;
        pel_slab_dims(slab, volume, stored);
        part->memory_high =
            (float4){(float)stored[0] - 1.5F, (float)stored[1] - 1.5F, (float)stored[2] - 1.5F, 0};
        part->brick_row = (i32)pel_brick_count(stored[0]);
        part->brick_slice = part->brick_row * (i32)pel_brick_count(stored[1]);
        part->cell_row = (i32)pel_grid_cells(stored[0], side);
        part->cell_slice = part->cell_row * (i32)pel_grid_cells(stored[1], side);
        part->cells = (u32)world->cell_count;
        part->ranges = slab->ranges;
        world->cell_count += (size_t)part->cell_slice * pel_grid_cells(stored[2], side);
    }
    return true;
}

// Appends the first visible entry from each one on, for the table that starts at `start` and from
// behind it, too; where there is none, it is the one behind the table.
static bool list_visible(struct pel_world *world, const u32 *start, size_t entries,
                         struct part *part) {
    size_t words = world->visible_words + entries + 1;
    u32 *visible = realloc(world->visible, words * sizeof *visible);
    if (!visible)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu words for tables", words);
    world->visible = visible;
    part->visible = (u32)world->visible_words;
    u32 *next = visible + world->visible_words;
    next[entries] = (u32)entries;
    for (size_t i = entries; i-- > 0;) {
        float strength;
        memcpy(&strength, &start[PEL_STRENGTH_WORDS * i], sizeof strength);
        bool glows = world->models & MODELS_THESIS && start[PEL_STRENGTH_WORDS * i + 1] != 0;
        next[i] = strength > 0 || glows ? (u32)i : next[i + 1];
    }
    world->visible_words = words;
    return true;
}

// The length that one sample of the instance stands for.
static double sample_mm(const struct pel_world *world, const struct pel_scene *scene,
                        const struct pel_instance *instance) {
    return world->mixing == MIXING_ORDERED ? pel_step_of_instance(scene, instance)
                                           : world->bytes.step_mm;
}

// Appends the instance's table to the world's and lets `part` refer to it.
static bool fill_table(struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_layout *layout, const struct pel_instance *instance,
                       struct pel_memo_table *memo, struct part *part) {
    struct pel_memo_form form = {.depth = world->depth, .linear = world->table_linear};
    struct pel_table ends = memo->table;
    bool pairs = memo->rule.model == MODEL_PREINTEGRATED;
    if (pairs) { // over the values that the volume has
        const struct pel_statistics *values = &scene->statistics[instance->volume];
        ends.low = form.low = values->min;
        ends.high = form.high = values->max > values->min ? values->max : values->min + 1;
    }
    if (!pel_memo_write(memo, &form))
        return false;
    size_t words = world->table_words + memo->entries * PEL_STRENGTH_WORDS;
    u32 *tables = realloc(world->tables, words * sizeof *tables);
    if (!tables)
        return pel_fail(PEL_ERROR_MEMORY, "cannot allocate %zu words for tables", words);
    world->tables = tables;
    memcpy(tables + world->table_words, memo->words,
           memo->entries * PEL_STRENGTH_WORDS * sizeof *tables);
    part->table = (u32)world->table_words;
    world->table_words = words;
    int last = pairs ? PAIR_ENTRIES - 1 : (int)memo->entries - 2;
    fill_table_address(part, scene->volumes[instance->volume], &ends, last, layout->reader);
    return list_visible(world, memo->seen, memo->seen_entries, part);
}

// Builds every visible instance's table, so that the kernel's way of reading them can be decided.
static bool build_tables(struct pel_memo *memo, struct pel_world *world,
                         const struct pel_scene *scene) {
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        if (instance->hidden)
            continue;
        struct pel_strength_rule rule = {.step_mm = sample_mm(world, scene, instance)};
        pel_model_fill_rule(&rule, scene, instance);
        if (!pel_memo_build(&memo->tables[k], instance->transfer, scene->volumes[instance->volume],
                            &rule))
            return pel_fail_in("volume '%s'", instance->name);
        if (!memo->tables[k].gentle)
            world->table_linear = true;
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
    bytes->bounds_low = to_float4(low, 0);
    bytes->bounds_high = to_float4(high, 0);
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
    bytes->tiles_x = (bytes->width + TILE_PX - 1) / TILE_PX;
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
        if (!fill_table(world, scene, layout, instance, &memo->tables[k], &pattern))
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
    if (!fill_camera(&world->bytes.camera, &scene->camera, &scene->render, centre) ||
        !pel_lighting_fill_lamps(&world->bytes, scene, centre))
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
    bool good = build_tables(memo, world, scene);
    good = good && fill_instances(world, scene, layout, memo, centre) &&
           fill_masks(world, scene, layout, centre) && pel_secondary_fill(world, scene);
    if (!good)
        pel_world_finish(world);
    return good;
}

bool pel_world_add_eye(struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_camera *second, int eyes, const int weave[2]) {
    world->eyes = eyes;
    world->bytes.pictures = pel_world_pictures(world);
    world->bytes.row_px = world->bytes.width;
    world->bytes.eye_px = world->bytes.width * world->bytes.height;
    world->bytes.weave_x = weave[0];
    world->bytes.weave_y = weave[1];
    return fill_camera(&world->bytes.second, second, &scene->render, world->centre);
}

void pel_world_merge_eyes(struct pel_world *world, const double matrix[3][6], bool linear,
                          const float background[4]) {
    memcpy(&world->bytes.merged_background, background, sizeof world->bytes.merged_background);
    world->bytes.merge_linear = linear;
    for (int n = 0; n < 6; n++) {
        const double column[3] = {matrix[0][n], matrix[1][n], matrix[2][n]};
        world->bytes.merge[n] = to_float4(column, 0);
    }
}

void pel_world_lay_beside(struct pel_world *world) {
    world->bytes.eye_px = world->bytes.width;
    world->bytes.row_px = 2 * world->bytes.width;
}

int pel_world_eyes(const struct pel_world *world) {
    return world->eyes == EYES_BOTH || world->eyes == EYES_MERGED ? 2 : 1;
}

int pel_world_pictures(const struct pel_world *world) {
    return world->eyes == EYES_BOTH ? 2 : 1;
}

int pel_world_across(const struct pel_world *world) {
    return world->eyes == EYES_BOTH && world->bytes.row_px > world->bytes.width ? 2 : 1;
}

int pel_world_planes(const struct pel_world *world) {
    bool two = world->eyes == EYES_BOTH || world->eyes == EYES_DEPTH;
    return two ? 2 / pel_world_across(world) : 1;
}

void pel_world_cells(const struct pel_world *world, int p, size_t cells[3]) {
    const struct part *parts = world->bytes.parts;
    size_t end = p + 1 < world->part_total ? parts[p + 1].cells : world->cell_count;
    cells[0] = (size_t)parts[p].cell_row;
    cells[1] = (size_t)(parts[p].cell_slice / parts[p].cell_row);
    cells[2] = (end - parts[p].cells) / (size_t)parts[p].cell_slice;
}

double pel_world_value(const struct pel_scene *scene, int instance, enum pel_reader reader,
                       double raw) {
    const struct pel_volume *volume = scene->volumes[scene->instances[instance].volume];
    double stored = raw * pel_reader_factor(reader, pel_voxel_class(volume->type));
    return volume->slope * (stored + stored_bias(volume->type)) + volume->intercept;
}

double pel_world_raw(const struct pel_volume *volume, double value) {
    return (value - volume->intercept) / volume->slope - stored_bias(volume->type);
}

size_t pel_world_bytes(const struct pel_world *world) {
    int rows = world->cut_count + world->bytes.occlusion_count;
    return offsetof(struct world, cuts) + (size_t)rows * sizeof *world->bytes.cuts;
}

void pel_world_finish(struct pel_world *world) {
    free(world->tables);
    free(world->visible);
    world->tables = world->visible = NULL;
    world->table_words = world->visible_words = 0;
}
