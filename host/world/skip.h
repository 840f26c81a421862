// skip.h - which way to skip empty space `auto` takes (docs/skipping.md).
#ifndef PEL_WORLD_SKIP_H
#define PEL_WORLD_SKIP_H

#include "world/world.h"

// What the choice goes by.
struct pel_skip_facts {
    bool nothing;    // every sample counts, whatever its value
    bool counts;     // a debug view counts boxes of a hierarchy
    uint64_t voxels; // of all volumes that are shown
    double visible;  // share of them that the transfer functions show, as far as values tell
};

// Fewer voxels than these, and so little empty space is not worth a look.
enum { PEL_SKIP_VOXELS_LEAST = 8192 };
#define PEL_SKIP_VISIBLE_MOST 0.95

// Finds the facts of a scene and of the world that was made of it, with the memo, for a reader.
void pel_skip_find_facts(struct pel_skip_facts *facts, const struct pel_scene *scene,
                         const struct pel_world *world, struct pel_memo *memo,
                         enum pel_reader reader);

// The rule, and why in a few words; never PEL_SKIP_AUTO.
enum pel_skip pel_skip_choose(const struct pel_skip_facts *facts,
                              char reason[PEL_SKIP_REASON_BYTES]);

#endif
