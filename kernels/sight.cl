// sight.cl - what a sample of a part shows.
//
// Where a sample is seen and needs a gradient, voxels around it are fetched that have its own among
// them. The one before tells where that will be: seen samples come in runs. So behind one that was
// seen a sample is fetched with its surroundings at once, behind one that was not by itself, and
// again only if it turns out to be seen. The values are the same.
#ifndef SIGHT_CL
#define SIGHT_CL

#include "classify.cl"
#include "gradient.cl"

// Whether samples of a part need gradients; of one that looks around they come from bricks.
#if STYLE
#define HAS_NORMALS(part) ((part)->shading != SHADING_NONE || (part)->styled)
#define LOOKS_AROUND(part) (HAS_BRICK_GRADIENT(part) && (part)->gradient == GRADIENT_CENTRAL)
#else
#define HAS_NORMALS(part) ((part)->shading != SHADING_NONE)
#define LOOKS_AROUND(part) HAS_BRICK_GRADIENT(part)
#endif

struct sight {
    struct sample sample;
#if BRICK_GRADIENT
    struct surroundings around; // where the part looks around and something is visible
#endif
    struct entry entry;
    mask visible;
};

// Looks at a part in the lanes of *present and clears those whose value is absent. `expected` tells
// that something is likely to be visible. Of a part with another model than absorption only the
// sample is taken.
INLINE void look(TABLE_SPACE const uint *table, MEMORY_PARAMETERS, __constant struct part *part, real x,
                 real y, real z, mask *present, bool expected, struct sight *sight) {
#if BRICK_GRADIENT
    const bool looks_around = HAS_NORMALS(part) && LOOKS_AROUND(part);
    bool around = looks_around && expected;
#pragma unroll 1
    for (int turn = 0; turn < 2; turn++) {
        if (around) {
            look_around(MEMORY_ARGUMENTS, part, x, y, z, &sight->around);
            sight->sample.raw = sight->around.raw;
        } else
#endif
            sight->sample = sample_part(MEMORY_ARGUMENTS, part, x, y, z);
#if MODELS
        if (part->model != MODEL_ABSORPTION)
            return;
#endif
        const real place = table_place(part, sight->sample.raw, present);
        sight->visible = *present & MASK(place >= part->seen_from) & MASK(place < part->seen_to);
        if (!any_lane(sight->visible))
            return;
        sight->entry = entry_at(table, part, place);
        sight->visible &= MASK(sight->entry.strength > 0.0f);
#if BRICK_GRADIENT
        if (around || !looks_around || !any_lane(sight->visible))
            return;
        around = true;
    }
#endif
}

#endif
