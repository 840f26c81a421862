// model.h - which optical model each volume has, and what the kernel must know of it.
#ifndef PEL_WORLD_MODEL_H
#define PEL_WORLD_MODEL_H

#include "world/strength.h"
#include "world/world.h"

// The model of an instance, its own or the scene's; never PEL_MODEL_DEFAULT.
enum pel_model pel_model_of(const struct pel_scene *scene, const struct pel_instance *instance);

// True when an instance's absorption is integrated between samples.
bool pel_model_is_preintegrated(const struct pel_scene *scene, const struct pel_instance *instance);

// Fails (ARGUMENT) on models that make no sense, alone or together.
bool pel_model_check(const struct pel_scene *scene);

// What the kernel has to be able to do, MODELS_*.
int pel_model_kernel(const struct pel_scene *scene);

// True when no ray may end early: the samples behind may still count.
bool pel_model_never_ends(const struct pel_scene *scene);

// True when there is nothing that can be skipped.
bool pel_model_skips_nothing(const struct pel_scene *scene);

// What the instance's strengths are; depth and step are left to the caller.
void pel_model_fill_rule(struct pel_strength_rule *rule, const struct pel_scene *scene,
                         const struct pel_instance *instance);

// Fills in the instance's model and its surfaces, whose colours are those of `table`. The part must
// know its table's scale. Fails (UNSUPPORTED) where a volume that `slab_count` slabs make up has to
// be whole.
bool pel_model_fill_part(struct part *part, const struct pel_scene *scene,
                         const struct pel_instance *instance, const struct pel_table *table,
                         int slab_count);

#endif
