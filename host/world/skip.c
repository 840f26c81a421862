// skip.c - which way to skip empty space `auto` takes: a rule from measurements
// (docs/performance.md, "Ways to skip").
//
// How much is empty is estimated by values alone, from each volume's histogram: where something
// lies does not count. That takes microseconds in each frame, and is wrong only where it costs
// little, because skipping nothing and skipping in vain take about the same time.
#include "world/skip.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "volume/hypertexture.h"
#include "world/model.h"

// Whether values tell what of a part can be seen.
static bool tells(const struct part *part) {
    return (part->model == MODEL_ABSORPTION || part->model == MODEL_PREINTEGRATED ||
            part->model == MODEL_THESIS) &&
           part->mask_count == 0 && part->plane_count == 0 && part->box_count == 0 &&
           part->hole_count == 0;
}

// A value that a bin of a histogram stands for: of integers one that there is, else its middle; but
// the least of all values often fills much of a volume by itself.
static double bin_value(const struct pel_volume *volume, const struct pel_statistics *statistics,
                        int bin) {
    double width = (statistics->max - statistics->min) / PEL_HISTOGRAM_BINS;
    double value = statistics->min + (bin ? bin + 0.5 : 0) * width;
    if (volume->type == PEL_VOXEL_F32)
        return value;
    return round((value - volume->intercept) / volume->slope) * volume->slope + volume->intercept;
}

// The share of an instance's voxels that its table shows.
static double visible_share(const struct pel_scene *scene, const struct pel_world *world, int p,
                            enum pel_reader reader) {
    const struct part *part = &world->bytes.parts[p];
    int instance = world->instances[p], volume = scene->instances[instance].volume;
    const struct pel_statistics *statistics = &scene->statistics[volume];
    const u32 *next = world->visible->words + part->visible;
    double nought = pel_world_value(scene, instance, reader, 0),
           one = pel_world_value(scene, instance, reader, 1);
    uint64_t seen = 0;
    for (int bin = 0; bin < PEL_HISTOGRAM_BINS; bin++) {
        double value = bin_value(scene->volumes[volume], statistics, bin);
        double entry = (value - nought) / (one - nought) * (double)part->table_scale +
                       (double)part->table_bias;
        // What is almost an entry is one: the table's place is rounded to floats.
        double nearest = round(entry);
        entry = fabs(entry - nearest) < 1e-3 ? nearest : entry;
        entry = fmin(fmax(entry, 0), (double)part->table_last);
        if (next[(size_t)floor(entry)] <= (u32)ceil(entry))
            seen += statistics->histogram[bin];
    }
    return statistics->count > 0 ? (double)seen / (double)statistics->count : 0;
}

// The same, from the frame before where neither table nor values have changed.
static double remembered_share(const struct pel_scene *scene, const struct pel_world *world, int p,
                               struct pel_memo *memo, enum pel_reader reader) {
    const struct part *part = &world->bytes.parts[p];
    int instance = world->instances[p];
    const struct pel_statistics *statistics = &scene->statistics[scene->instances[instance].volume];
    struct pel_memo_shown *shown = &memo->tables[instance].shown;
    bool same = shown->known && shown->scale == part->table_scale &&
                shown->bias == part->table_bias && shown->min == statistics->min &&
                shown->max == statistics->max && shown->count == statistics->count &&
                memcmp(shown->histogram, statistics->histogram, sizeof shown->histogram) == 0;
    if (!same) {
        *shown = (struct pel_memo_shown){.known = true,
                                         .scale = part->table_scale,
                                         .bias = part->table_bias,
                                         .min = statistics->min,
                                         .max = statistics->max,
                                         .count = statistics->count};
        memcpy(shown->histogram, statistics->histogram, sizeof shown->histogram);
        shown->share = visible_share(scene, world, p, reader);
    }
    return shown->share;
}

void pel_skip_find_facts(struct pel_skip_facts *facts, const struct pel_scene *scene,
                         const struct pel_world *world, struct pel_memo *memo,
                         enum pel_reader reader) {
    *facts = (struct pel_skip_facts){.nothing = pel_model_skips_nothing(scene),
                                     .counts = world->bytes.debug == DEBUG_CLUSTERS ||
                                               world->bytes.debug == DEBUG_NODES};
    double seen = 0;
    for (int p = 0; p < world->bytes.part_count; p++) {
        // Slabs of one volume have its values together.
        if (p > 0 && world->instances[p] == world->instances[p - 1])
            continue;
        const struct pel_volume *volume =
            scene->volumes[scene->instances[world->instances[p]].volume];
        uint64_t voxels =
            (uint64_t)volume->dims[0] * (uint64_t)volume->dims[1] * (uint64_t)volume->dims[2];
        facts->voxels += voxels;
        if (volume->hypertexture)
            seen += (double)voxels; // nobody knows its values
        else if (tells(&world->bytes.parts[p]))
            seen += (double)voxels * remembered_share(scene, world, p, memo, reader);
    }
    facts->visible = facts->voxels > 0 ? seen / (double)facts->voxels : 0;
}

enum pel_skip pel_skip_choose(const struct pel_skip_facts *facts,
                              char reason[PEL_SKIP_REASON_BYTES]) {
    double percent = 100 * facts->visible;
    if (facts->counts) {
        snprintf(reason, PEL_SKIP_REASON_BYTES, "the debug view counts boxes of its hierarchy");
        return PEL_SKIP_BVH;
    }
    if (facts->nothing) {
        snprintf(reason, PEL_SKIP_REASON_BYTES, "with this model every sample counts");
        return PEL_SKIP_NONE;
    }
    if (facts->voxels < PEL_SKIP_VOXELS_LEAST) {
        snprintf(reason, PEL_SKIP_REASON_BYTES, "%llu voxels are too few to skip any",
                 (unsigned long long)facts->voxels);
        return PEL_SKIP_NONE;
    }
    if (facts->visible > PEL_SKIP_VISIBLE_MOST) {
        snprintf(reason, PEL_SKIP_REASON_BYTES, "%.3g %% of the voxels can be seen", percent);
        return PEL_SKIP_NONE;
    }
    snprintf(reason, PEL_SKIP_REASON_BYTES, "%.3g %% of the voxels can be seen", percent);
    return PEL_SKIP_DISTANCE;
}

bool pel_scene_choose_skip(const struct pel_scene *scene, enum pel_skip *skip,
                           char reason[PEL_SKIP_REASON_BYTES]) {
    const struct pel_layout_limits endless = {.memory_bytes = UINT64_MAX,
                                              .max_allocation_bytes = UINT64_MAX};
    struct pel_layout layout;
    struct pel_world world;
    struct pel_memo memo = {0};
    bool good = pel_layout_plan(&layout, scene, &endless, PEL_READER_BUFFER, PEL_READER_BUFFER) &&
                pel_world_build(&world, scene, &layout, &memo);
    if (good) {
        struct pel_skip_facts facts;
        pel_skip_find_facts(&facts, scene, &world, &memo, PEL_READER_BUFFER);
        *skip = pel_skip_choose(&facts, reason);
    }
    pel_memo_finish(&memo);
    return good;
}
