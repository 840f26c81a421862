// mixing.c - what kernels are told about how volumes share a sample (docs/mixing.md).
#include "world/mixing.h"

#include "shared/variant.h"

int pel_mixing_find(enum pel_mixing mixing) {
    static const int numbers[] = {
        [PEL_MIX_SUM] = MIXING_SUM,
        [PEL_MIX_OVER] = MIXING_OVER,
        [PEL_MIX_ORDERED] = MIXING_ORDERED,
        [PEL_MIX_MAX] = MIXING_MAX,
        [PEL_MIX_PRIORITY] = MIXING_PRIORITY,
        [PEL_MIX_UNION] = MIXING_UNION,
        [PEL_MIX_INTERSECTION] = MIXING_INTERSECTION,
        [PEL_MIX_DIFFERENCE] = MIXING_DIFFERENCE,
    };
    return numbers[mixing];
}

int pel_mixing_rank(const struct pel_scene *scene, const struct pel_instance *instance) {
    int rank = 0;
    for (int k = 0; k < scene->instance_count; k++)
        rank += !scene->instances[k].hidden && scene->instances[k].priority < instance->priority;
    return rank;
}

const char *const *pel_mixing_names(void) {
    static const char *const mixing_names[] = {
        "sum", "over", "ordered", "max", "priority", "union", "intersection", "difference", NULL};
    return mixing_names;
}
