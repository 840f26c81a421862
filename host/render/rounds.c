// rounds.c - how often a work-item may go round its loops, on a device that does not let it.
//
// llvmpipe, a software rasteriser under rusticl, counts the rounds of all loops of a work-item
// together and leaves each loop when there were 65535 (LP_MAX_TGSI_LOOP_ITERATIONS in Mesa). Rays
// then end where they are, and the picture is wrong without a word; so there has to be one before.
// Loops of a fixed few rounds are unrolled by its compiler and do not count.
#include "render/rounds.h"

#include <math.h>
#include <string.h>

#include "base/error.h"

static const double llvmpipe_most = 65535;

// The samples of a part along the longest line through it.
static double part_samples(const struct pel_world *world, int p) {
    const struct world *bytes = &world->bytes;
    double length_mm = fmin(world->diagonals_mm[p], pel_world_diagonal_mm(world));
    double step_mm = bytes->step_mm;
    if (world->mixing == MIXING_ORDERED)
        step_mm = bytes->parts[p].step_mm;
    // The exact integrator goes from face to face between voxels instead, on three axes.
    if (world->models & MODELS_EMISSION)
        step_mm = (double)bytes->parts[p].spacing_mm / 3;
    return length_mm / step_mm + 1;
}

// Rounds for each sample of a part: in the loop over parts at a sample, and in the way to skip,
// whose every round goes on by a sample or more; down a hierarchy it takes about one more.
static double rounds_per_sample(const struct pel_world *world, enum pel_skip skip) {
    double leaps = skip == PEL_SKIP_NONE                             ? 0
                   : skip == PEL_SKIP_BVH || skip == PEL_SKIP_BLOCKS ? 2
                                                                     : 1;
    return (world->bytes.part_count > 1) + leaps;
}

// Rounds of one secondary ray. It asks all parts whether it crosses them, and each at every sample.
static double secondary_rounds(const struct pel_world *world, enum pel_skip skip, double length_mm,
                               double step_mm) {
    double parts = world->bytes.part_count;
    double samples = fmin(length_mm, pel_world_diagonal_mm(world)) / step_mm + 1;
    double asked = parts > 1 ? 3 * parts : 1; // nodes of the hierarchy, and what is in it
    return asked + samples * (1 + parts * rounds_per_sample(world, skip));
}

// Rounds of shading one sample: lamp by lamp, each with its shadow, and around the normal.
static double shading_rounds(const struct pel_world *world, enum pel_skip skip) {
    const struct world *bytes = &world->bytes;
    double lamps = bytes->lamp_count, rounds = lamps;
    if (world->secondary & SECONDARY_SHADOWS)
        rounds += lamps * secondary_rounds(world, skip, (double)bytes->shadow_length_mm,
                                           (double)bytes->shadow_step_mm);
    if (world->secondary & SECONDARY_OCCLUSION)
        rounds += bytes->occlusion_count *
                  (1 + secondary_rounds(world, skip, (double)bytes->occlusion_radius_mm,
                                        (double)bytes->occlusion_step_mm));
    return rounds;
}

double pel_rounds_most(const struct pel_world *world, enum pel_skip skip) {
    const struct world *bytes = &world->bytes;
    double all = 0, within = 0, shading = shading_rounds(world, skip);
    for (int p = 0; p < bytes->part_count; p++) {
        double samples = part_samples(world, p);
        all += samples;
        within += samples * rounds_per_sample(world, skip);
        if (bytes->parts[p].shading != SHADING_NONE)
            within += samples * shading;
    }
    // Where each volume has samples of its own, all are asked which comes next; elsewhere they
    // share those of the ray.
    if (world->mixing == MIXING_ORDERED)
        all *= 1 + bytes->part_count;
    else if (!(world->models & MODELS_EMISSION))
        all = fmin(all, pel_world_diagonal_mm(world) / (double)bytes->step_mm + 1);
    // And a few for each part to find where the ray crosses it, and its place among the others.
    double ray = all + within + bytes->part_count * (3.0 + bytes->part_count);
    return world->eyes == EYES_MERGED ? 2 * ray : ray;
}

void pel_rounds_check(bool *warned, const struct pel_device_info *device,
                      const struct pel_world *world, enum pel_skip skip) {
    double most = strstr(device->name, "llvmpipe") ? pel_rounds_most(world, skip) : 0;
    bool exceeds = most > llvmpipe_most;
    if (exceeds && !*warned)
        pel_warn("llvmpipe ends the loops of a ray after %.0f rounds, and here one may need %.3g: "
                 "what is behind is then missing; take a longer step, fewer or shorter shadow and "
                 "occlusion rays, or another device",
                 llvmpipe_most, most);
    *warned = exceeds;
}
