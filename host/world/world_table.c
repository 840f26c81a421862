// world_table.c - the instances' transfer functions as a world's tables, and how a kernel finds an
// entry for what it reads.
//
// A table's words are those of world/strength.h; the tables of all instances lie one after the
// other, and so do the lists of visible entries, one more than a table has entries.
#include "world/world_table.h"

#include <math.h>

#include "base/error.h"
#include "world/mixing.h"
#include "world/model.h"
#include "world/step.h"

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

// Between which entries a value shows something. One that lies before the first by less than an
// entry may be read between both, and what lies outside a table is shown as its end.
static void fill_seen(struct part *part, const struct pel_memo_table *table) {
    float from = (float)table->visible[0], to = (float)table->seen_end;
    part->seen_from = from > 0 ? from - 1 : -INFINITY;
    part->seen_to = to > part->table_last ? INFINITY : to;
}

// The length that one sample of the instance stands for.
static double sample_mm(const struct pel_world *world, const struct pel_scene *scene,
                        const struct pel_instance *instance) {
    return world->mixing == MIXING_ORDERED ? pel_step_of_instance(scene, instance)
                                           : world->bytes.step_mm;
}

bool pel_world_build_tables(struct pel_world *world, const struct pel_scene *scene,
                            struct pel_memo *memo) {
    pel_memo_begin(memo);
    world->tables = &memo->words;
    world->visible = &memo->visible;
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

bool pel_world_add_table(struct pel_world *world, const struct pel_scene *scene,
                         const struct pel_layout *layout, const struct pel_instance *instance,
                         struct pel_memo *memo, struct part *part) {
    struct pel_memo_table *table = &memo->tables[instance - scene->instances];
    struct pel_memo_form form = {.depth = world->depth,
                                 .linear = world->table_linear,
                                 .glows = (world->models & MODELS_THESIS) != 0};
    struct pel_table ends = table->table;
    bool pairs = table->rule.model == MODEL_PREINTEGRATED;
    if (pairs) { // over the values that the volume has
        const struct pel_statistics *values = &scene->statistics[instance->volume];
        ends.low = form.low = values->min;
        ends.high = form.high = values->max > values->min ? values->max : values->min + 1;
    }
    if (!pel_memo_write(table, &form) || !pel_memo_place(memo, table))
        return false;
    part->table = (u32)table->word_place;
    part->visible = (u32)table->visible_place;
    int last = pairs ? PAIR_ENTRIES - 1 : (int)table->entries - 2;
    fill_table_address(part, scene->volumes[instance->volume], &ends, last, layout->reader);
    fill_seen(part, table);
    return true;
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
