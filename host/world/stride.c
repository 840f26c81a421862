// stride.c - which parts may be sampled in longer strides (docs/picture.md, "Adaptive steps").
//
// What the transfer function may do between two values is bounded by its variation between them:
// the sum of its changes from entry to entry. Summed up once for the table, two look-ups have it
// for any cell.
#include "world/stride.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "world/mask.h"
#include "world/model.h"

enum { STRIDE_MAX = 4 };

// How far a run may lead, along any axis: the cells of a grid, whatever a pool makes of them.
static const double reach_voxels = 4;

bool pel_stride_is_on(const struct pel_scene *scene) {
    return scene->render.adaptive_step > 0 && !(pel_model_kernel(scene) & MODELS_EMISSION);
}

bool pel_stride_check(const struct pel_scene *scene) {
    const struct pel_render_settings *settings = &scene->render;
    if (!(settings->adaptive_step >= 0) || !isfinite(settings->adaptive_step))
        return pel_fail(PEL_ERROR_ARGUMENT, "adaptive steps for a depth of %g, must be at least 0",
                        settings->adaptive_step);
    if (settings->adaptive_step > 0 && settings->mixing == PEL_MIX_ORDERED)
        return pel_fail(PEL_ERROR_ARGUMENT,
                        "adaptive steps are those of all volumes together, and with mixing ordered "
                        "each has its own");
    if (settings->adaptive_step > 0 && settings->order == PEL_ORDER_BACK_TO_FRONT)
        return pel_fail(PEL_ERROR_ARGUMENT, "adaptive steps go from front to back only");
    return true;
}

// The longest run that stays within a cell and its neighbours.
static int longest_run(const struct pel_world *world, const struct pel_scene *scene,
                       const struct pel_instance *instance) {
    struct pel_matrix world_from_voxel =
                          pel_matrix_multiply(&instance->transform,
                                              &scene->volumes[instance->volume]->world_from_voxel),
                      voxel_from_world;
    if (!pel_matrix_invert(&voxel_from_world, &world_from_voxel))
        return 1; // and the part itself will say so
    double fastest = 0;
    for (int i = 0; i < 3; i++)
        fastest = fmax(fastest, pel_length(voxel_from_world.m[i]));
    int longest = STRIDE_MAX;
    while (longest > 1 && (longest - 1) * world->bytes.step_mm * fastest > reach_voxels)
        longest /= 2;
    return longest;
}

// What an entry has of depth in one step, and of light in each channel.
static void find_entry(double entry[4], const float rgba[4], const struct pel_strength_rule *rule) {
    double opacity = fmin((double)rgba[3], 1 - 0x1p-24);
    entry[3] = -log1p(-opacity) / rule->opacity_unit_mm * rule->density * rule->step_mm;
    for (int c = 0; c < 3; c++)
        entry[c] = entry[3] * (double)rgba[c];
}

bool pel_stride_fill_part(struct pel_world *world, struct part *part, const struct pel_scene *scene,
                          const struct pel_instance *instance, const struct pel_memo_table *memo) {
    world->adaptive = pel_stride_is_on(scene);
    world->bytes.stride_depth = (float)scene->render.adaptive_step;
    part->stride_max = 1;
    if (!world->adaptive || part->model != MODEL_ABSORPTION || part->hole_count > 0 ||
        pel_mask_of(instance) >= 0)
        return true;
    const struct pel_table *table = &memo->table;
    const struct pel_volume *volume = scene->volumes[instance->volume];
    part->variation = (u32)world->visible->count;
    u32 *variation;
    if (!pel_memo_append(world->visible, 2 * (size_t)table->entry_count, &variation))
        return false;
    part->variation_scale = (float)(table->entry_count - 1) / part->table_last;
    part->stride_max = longest_run(world, scene, instance);
    // Light changes with the normal, a volume's own colours with anything, and what is absent
    // begins anywhere.
    part->stride_nought = part->shading != SHADING_NONE || part->styled || volume->hypertexture ||
                          volume->type == PEL_VOXEL_RGB8 || volume->type == PEL_VOXEL_RGBA8 ||
                          scene->statistics[instance->volume].absent_count > 0;
    double sum = 0, before[4];
    for (int j = 0; j < table->entry_count; j++) {
        double entry[4], most = 0;
        find_entry(entry, table->rgba[j], &memo->rule);
        for (int c = 0; c < 4 && j > 0; c++)
            most = fmax(most, fabs(entry[c] - before[c]));
        memcpy(before, entry, sizeof before);
        sum += most;
        const float pair[2] = {(float)sum, (float)entry[3]};
        memcpy(&variation[2 * (size_t)j], pair, sizeof pair);
    }
    return true;
}
