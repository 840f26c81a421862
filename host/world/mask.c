// mask.c - which values of another volume decide where a volume is shown, as kernels read them
// (docs/mixing.md, "Masks").
//
// A kernel goes straight from the memory coordinates of a part to those of its mask, so that a
// sample costs one small matrix and one voxel more.
#include "world/mask.h"

#include <float.h>
#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "world/narrow.h"

int pel_mask_of(const struct pel_instance *instance) {
    return instance->mask.range_count > 0 ? instance->mask.instance : -1;
}

bool pel_mask_leads_back(const struct pel_scene *scene, int start) {
    int k = pel_mask_of(&scene->instances[start]);
    for (int steps = 0; k >= 0 && steps < scene->instance_count; steps++) {
        if (k == start)
            return true;
        k = pel_mask_of(&scene->instances[k]);
    }
    return false;
}

static bool check_mask(const struct pel_scene *scene, int k) {
    const struct pel_mask *mask = &scene->instances[k].mask;
    if (mask->range_count < 0 || mask->range_count > PEL_MASK_RANGE_MAX)
        return pel_fail(PEL_ERROR_ARGUMENT, "a mask of %d ranges of values, outside 0..%d",
                        mask->range_count, PEL_MASK_RANGE_MAX);
    if (mask->range_count == 0)
        return true;
    for (int n = 0; n < mask->range_count; n++)
        if (!(mask->ranges[n].low <= mask->ranges[n].high))
            return pel_fail(PEL_ERROR_ARGUMENT, "a mask's range of values from %g to %g",
                            mask->ranges[n].low, mask->ranges[n].high);
    if (mask->instance < 0 || mask->instance >= scene->instance_count)
        return pel_fail(PEL_ERROR_ARGUMENT, "its mask is volume %d of %d", mask->instance,
                        scene->instance_count);
    return true;
}

bool pel_mask_check(const struct pel_scene *scene) {
    for (int k = 0; k < scene->instance_count; k++)
        if (!check_mask(scene, k))
            return pel_fail_in("volume '%s'", scene->instances[k].name);
    for (int k = 0; k < scene->instance_count; k++) {
        const struct pel_instance *instance = &scene->instances[k];
        if (pel_mask_of(instance) == k)
            return pel_fail(PEL_ERROR_ARGUMENT, "volume '%s': it is its own mask", instance->name);
        if (pel_mask_leads_back(scene, k))
            return pel_fail(PEL_ERROR_ARGUMENT,
                            "volume '%s': its mask '%s' is masked by it in turn", instance->name,
                            scene->instances[instance->mask.instance].name);
    }
    return true;
}

static double shift_of(const struct part *part, int axis) {
    return (double)(axis == 0   ? part->memory_from_voxel.x
                    : axis == 1 ? part->memory_from_voxel.y
                                : part->memory_from_voxel.z);
}

// From the memory coordinates of one part to those of another.
static void add_matrix(struct pel_world *world, const struct pel_matrix *voxel_from_voxel,
                       const struct part *from, const struct part *to) {
    for (int i = 0; i < 3; i++) {
        const double *row = voxel_from_voxel->m[i];
        double offset = row[3] + shift_of(to, i);
        for (int c = 0; c < 3; c++)
            offset -= row[c] * shift_of(from, c);
        world->bytes.cuts[world->cut_count++] = pel_narrow(row, offset);
    }
}

// The range of values as samples have it. Whole numbers are told apart half way between them, since
// a device's images round.
static void add_range(struct pel_world *world, const struct pel_value_range *range,
                      const struct pel_volume *volume, enum pel_reader reader) {
    double ends[2] = {range->low, range->high};
    bool whole = volume->type != PEL_VOXEL_F32 && !volume->hypertexture;
    bool turned = volume->slope < 0;
    // Without a slope all voxels have one value, which is in the range or is not.
    if (volume->slope == 0) {
        bool in = volume->intercept >= ends[0] && volume->intercept <= ends[1];
        float end = in ? -FLT_MAX : FLT_MAX;
        world->bytes.cuts[world->cut_count++] = (float4){end, -end, 0, 0};
        return;
    }
    double factor = pel_reader_factor(reader, pel_voxel_class(volume->type));
    for (int n = 0; n < 2; n++) {
        double raw = pel_world_raw(volume, ends[n]);
        bool upper = (n == 1) != turned;
        double slack = 1e-9 * fmax(1, fabs(raw));
        if (whole)
            raw = upper ? floor(raw + slack) + 0.5 : ceil(raw - slack) - 0.5;
        ends[n] = fmax(-(double)FLT_MAX, fmin((double)FLT_MAX, raw / factor));
    }
    world->bytes.cuts[world->cut_count++] =
        (float4){(float)ends[turned], (float)ends[!turned], 0, 0};
}

bool pel_mask_fill_part(struct pel_world *world, int p, const struct pel_scene *scene,
                        enum pel_reader reader, int first, int count) {
    struct part *part = &world->bytes.parts[p];
    const struct pel_instance *shown = &scene->instances[world->instances[p]];
    const struct pel_instance *other = &scene->instances[shown->mask.instance];
    const struct pel_volume *values = scene->volumes[other->volume];
    struct pel_matrix world_from_voxel = pel_matrix_multiply(
                          &shown->transform, &scene->volumes[shown->volume]->world_from_voxel),
                      world_from_other =
                          pel_matrix_multiply(&other->transform, &values->world_from_voxel),
                      other_from_world;
    if (!pel_matrix_invert(&other_from_world, &world_from_other))
        return pel_fail_in("placement of volume '%s'", other->name);
    struct pel_matrix other_from_voxel = pel_matrix_multiply(&other_from_world, &world_from_voxel);
    part->mask_cuts = world->cut_count;
    part->mask_part = first;
    part->mask_count = count;
    part->mask_range_count = shown->mask.range_count;
    part->mask_inverted = shown->mask.inverted;
    for (int n = 0; n < count; n++)
        add_matrix(world, &other_from_voxel, part, &world->bytes.parts[first + n]);
    for (int n = 0; n < shown->mask.range_count; n++)
        add_range(world, &shown->mask.ranges[n], values, reader);
    world->masked = true;
    return true;
}

// FNV-1a (Fowler, Noll & Vo 1991).
static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t count) {
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ byte[i]) * 0x100000001b3U;
    return hash;
}

uint64_t pel_mask_hash(const struct pel_world *world) {
    uint64_t hash = 0xcbf29ce484222325U;
    for (int p = 0; p < world->bytes.part_count; p++) {
        const struct part *part = &world->bytes.parts[p];
        size_t rows = 3 * (size_t)part->mask_count + (size_t)part->mask_range_count;
        hash = hash_bytes(hash, &world->bytes.cuts[part->mask_cuts],
                          part->mask_count ? rows * sizeof *world->bytes.cuts : 0);
    }
    for (int p = world->bytes.part_count; p < world->part_total; p++) {
        const struct part *part = &world->bytes.parts[p];
        hash = hash_bytes(hash, &part->box_low, sizeof part->box_low);
        hash = hash_bytes(hash, &part->box_high, sizeof part->box_high);
    }
    return hash;
}
