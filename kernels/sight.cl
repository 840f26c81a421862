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
#include "span.cl"

// Whether samples of a part need gradients; of one that looks around they come from bricks.
#if STYLE
#define HAS_NORMALS(part) ((part)->shading != SHADING_NONE || (part)->styled)
#define LOOKS_AROUND(part) (HAS_BRICK_GRADIENT(part) && (part)->gradient == GRADIENT_CENTRAL)
#else
#define HAS_NORMALS(part) ((part)->shading != SHADING_NONE)
#define LOOKS_AROUND(part) HAS_BRICK_GRADIENT(part)
#endif

struct sight {
    mask present; // the lanes that have the sample
    real t;       // its number
    real x, y, z; // and its place
    struct sample sample;
#if BRICK_GRADIENT
    struct surroundings around; // where the part looks around and something is visible
#endif
    struct entry entry; // where something is visible
    mask visible;
};

// Takes the samples where the sights are.
INLINE void take_samples(MEMORY_PARAMETERS, __constant struct part *part, struct sight *sights) {
#if AT_ONCE == 1
    sights->sample = sample_part(MEMORY_ARGUMENTS, part, sights->x, sights->y, sights->z);
#else
    const bool nearest = IS_FILTER(part, FILTERS_NEAREST);
    struct cell cells[AT_ONCE];
#pragma unroll
    for (int k = 0; k < AT_ONCE; k++)
        find_cell(part, nearest, sights[k].x, sights[k].y, sights[k].z, &cells[k] PAGES_ARGUMENT);
#pragma unroll
    for (int k = 0; k < AT_ONCE; k++)
        fetch_cell(MEMORY_ARGUMENTS, part, nearest, &cells[k], &sights[k].sample);
#endif
}

// Looks the samples' values up in the table, unless it can show none of them. Returns the lanes in
// which something is visible.
INLINE mask look_up(TABLE_SPACE const uint *table, __constant struct part *part,
                    struct sight *sights) {
    real places[AT_ONCE];
    mask seen = (mask)(0);
#pragma unroll
    for (int k = 0; k < AT_ONCE; k++) {
        struct sight *sight = &sights[k];
        places[k] = table_place(part, sight->sample.raw, &sight->present);
        sight->visible =
            sight->present & MASK(places[k] >= part->seen_from) & MASK(places[k] < part->seen_to);
        clear_entry(&sight->entry);
        seen |= sight->visible;
    }
    if (!any_lane(seen))
        return seen;
    struct address addresses[AT_ONCE];
#pragma unroll
    for (int k = 0; k < AT_ONCE; k++)
        find_address(part, places[k], &addresses[k]);
    seen = (mask)(0);
#pragma unroll
    for (int k = 0; k < AT_ONCE; k++) {
        struct sight *sight = &sights[k];
        load_entry(table, part, &addresses[k], &sight->entry);
        sight->visible &= MASK(sight->entry.strength > 0.0f);
        seen |= sight->visible;
    }
    return seen;
}

// Looks at a part, where it clears the lanes whose value is absent. Returns those in which
// something is visible; `expected` tells that this is likely. Of a part with another model than
// absorption only the samples are taken.
INLINE mask look(TABLE_SPACE const uint *table, MEMORY_PARAMETERS, __constant struct part *part,
                 bool expected, struct sight *sights) {
    mask seen = (mask)(0);
#if BRICK_GRADIENT
    const bool looks_around = HAS_NORMALS(part) && LOOKS_AROUND(part);
    bool around = looks_around && expected;
#pragma unroll 1
    for (int turn = 0; turn < 2; turn++) {
        if (around) {
            look_around(MEMORY_ARGUMENTS, part, sights->x, sights->y, sights->z, &sights->around);
            sights->sample.raw = sights->around.raw;
        } else
#endif
            take_samples(MEMORY_ARGUMENTS, part, sights);
#if MODELS
        if (part->model != MODEL_ABSORPTION)
            return seen;
#endif
        seen = look_up(table, part, sights);
#if BRICK_GRADIENT
        if (around || !looks_around || !any_lane(seen))
            return seen;
        around = true;
    }
#endif
    return seen;
}

#endif
