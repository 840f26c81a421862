// mask.cl - another volume's values decide where a part is shown.
//
// The parts of the deciding volume lie behind those that are shown in world->parts. Rows for them
// are in world->cuts: for each such part the matrix from this part's memory coordinates to its own,
// then the ranges of values that are selected, as samples have them, in x and y. See
// docs/mixing.md, "Masks".
#ifndef MASK_CL
#define MASK_CL

#include "sample.cl"
#include "shared/grid.h"
#include "traverse/cursor.cl"

// Cells of a mask that are looked through for one cell of a part; where it spans more, it counts as
// mixed.
#define MASK_CELLS_MAX 128

// How far from a sample voxels are read, where bricks come from a pool: by cubic filters and for
// gradients.
#define MASK_POOL_REACH 5.0f

INLINE real mask_row(float4 row, real x, real y, real z) {
    return row.x * x + row.y * y + row.z * z + row.w;
}

// The value of a part of a mask at a place in its memory coordinates: that of the nearest voxel.
INLINE real mask_value(MEMORY_PARAMETERS, __constant struct part *part, real x, real y, real z) {
#if LIVE
    if (part->recipe != 0)
        return sample_live(MEMORY_ARGUMENTS, part, x, y, z).raw;
#endif
    return fetch_part(MEMORY_ARGUMENTS, part, true, x, y, z).raw;
}

// The lanes whose place, in the part's memory coordinates, its mask leaves.
INLINE mask mask_keeps(__constant struct world *world, __constant struct part *part,
                       MEMORY_PARAMETERS, real x, real y, real z) {
    mask selected = (mask)(0);
    __constant const float4 *ranges = world->cuts + part->mask_cuts + 3 * part->mask_count;
    for (int n = 0; n < part->mask_count; n++) {
        __constant const float4 *rows = &world->cuts[part->mask_cuts + 3 * n];
        __constant struct part *other = &world->parts[part->mask_part + n];
        const float4 low = other->box_low + other->memory_from_voxel,
                     high = other->box_high + other->memory_from_voxel;
        real mx = mask_row(rows[0], x, y, z), my = mask_row(rows[1], x, y, z),
             mz = mask_row(rows[2], x, y, z);
        const mask inside = MASK(mx >= low.x) & MASK(mx < high.x) & MASK(my >= low.y) &
                            MASK(my < high.y) & MASK(mz >= low.z) & MASK(mz < high.z);
        if (!any_lane(inside))
            continue;
        // Lanes outside rest at a place that exists.
        mx = CHOOSE((real)(1.0f), mx, inside);
        my = CHOOSE((real)(1.0f), my, inside);
        mz = CHOOSE((real)(1.0f), mz, inside);
        const real raw = mask_value(MEMORY_ARGUMENTS, other, mx, my, mz);
        for (int r = 0; r < part->mask_range_count; r++)
            selected |= inside & MASK(raw >= ranges[r].x) & MASK(raw <= ranges[r].y);
    }
    return part->mask_inverted || part->mask_count == 0 ? ~selected : selected;
}

#if SKIP != SKIP_NONE || POOL || ADAPTIVE
// ---- Cells -------------------------------------------------------------------------------------

// Whether values from range.x to range.y may be (`all`: all are) in the part's ranges.
static bool mask_selects(__constant struct part *part, __constant const float4 *ranges,
                         float2 range, bool all) {
    for (int r = 0; r < part->mask_range_count; r++)
        if (all ? range.x >= ranges[r].x && range.y <= ranges[r].y
                : range.y >= ranges[r].x && range.x <= ranges[r].y)
            return true;
    return false;
}

// Whether something in a box of a mask's memory coordinates may be (`all`: everything is) selected.
static bool mask_selects_box(__constant struct part *part, __constant struct part *other,
                             __constant const float4 *ranges, __global const float2 *values,
                             float4 low, float4 high, bool all) {
    const int4 first = convert_int4(low + 0.5f) >> CELL_BITS,
               last = convert_int4(high + 0.5f) >> CELL_BITS;
    const int4 count = last - first + 1;
    if (count.x > MASK_CELLS_MAX || count.y > MASK_CELLS_MAX || count.z > MASK_CELLS_MAX ||
        count.x * count.y * count.z > MASK_CELLS_MAX)
        return !all;
    for (int z = first.z; z <= last.z; z++)
        for (int y = first.y; y <= last.y; y++)
            for (int x = first.x; x <= last.x; x++) {
                const float2 range =
                    values[other->ranges + z * other->cell_slice + y * other->cell_row + x];
                // A cell without any value has its ends the wrong way round.
                const bool selects =
                    range.x <= range.y && mask_selects(part, ranges, range, all);
                if (selects != all)
                    return selects;
            }
    return all;
}

// Whether the mask of a part leaves nothing of its cell (x, y, z). `values` are the ranges of all
// cells.
static bool mask_empties(__constant struct world *world, __constant struct part *part,
                         __global const float2 *values, int x, int y, int z) {
    if (part->mask_count == 0)
        return false;
    __constant const float4 *ranges = world->cuts + part->mask_cuts + 3 * part->mask_count;
    const float half_side = 0.5f * CELL_VOXELS;
    // A fiftieth of a voxel for rounding.
    const float reach = half_side + 0.02f + (POOL ? MASK_POOL_REACH : 0.0f);
    const float cx = x * CELL_VOXELS + half_side, cy = y * CELL_VOXELS + half_side,
                cz = z * CELL_VOXELS + half_side;
    for (int n = 0; n < part->mask_count; n++) {
        __constant const float4 *rows = &world->cuts[part->mask_cuts + 3 * n];
        __constant struct part *other = &world->parts[part->mask_part + n];
        const float4 box_low = other->box_low + other->memory_from_voxel,
                     box_high = other->box_high + other->memory_from_voxel;
        float4 middle = (float4)(0.0f), size = (float4)(0.0f);
        middle.x = rows[0].x * cx + rows[0].y * cy + rows[0].z * cz + rows[0].w;
        middle.y = rows[1].x * cx + rows[1].y * cy + rows[1].z * cz + rows[1].w;
        middle.z = rows[2].x * cx + rows[2].y * cy + rows[2].z * cz + rows[2].w;
        size.x = fabs(rows[0].x) + fabs(rows[0].y) + fabs(rows[0].z);
        size.y = fabs(rows[1].x) + fabs(rows[1].y) + fabs(rows[1].z);
        size.z = fabs(rows[2].x) + fabs(rows[2].y) + fabs(rows[2].z);
        const float4 slack = size * reach + 0.02f;
        const float4 low = fmax(middle - slack, box_low), high = fmin(middle + slack, box_high);
        const bool apart = low.x > high.x || low.y > high.y || low.z > high.z;
        const bool within = low.x > box_low.x && low.y > box_low.y && low.z > box_low.z &&
                            high.x < box_high.x && high.y < box_high.y && high.z < box_high.z;
        // Floats may be absent, which ranges do not tell.
        const bool all = part->mask_inverted;
        if (all ? !within || other->voxels == VOXELS_F32 : apart)
            continue;
        if (mask_selects_box(part, other, ranges, values, low, high, all))
            return all;
    }
    return !part->mask_inverted;
}

#endif
#endif
