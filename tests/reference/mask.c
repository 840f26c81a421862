// mask.c - docs/mixing.md, "Masks".
#include "reference/mask.h"

#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "reference/sample.h"

// Whether the value is in one of the ranges. Integers are told apart by their raw values, so that
// the rounding of slope and intercept does not matter; floats as floats.
static bool is_selected(const struct pel_mask *mask, const struct pel_volume *volume,
                        double value) {
    double slack = volume->type == PEL_VOXEL_F32 ? 1e-7 * fabs(value) : 1e-6 * fabs(volume->slope);
    for (int n = 0; n < mask->range_count; n++)
        if (value >= mask->ranges[n].low - slack && value <= mask->ranges[n].high + slack)
            return true;
    return false;
}

static bool selects(const struct pel_mask *mask, const struct pel_volume *volume, double margin,
                    const double p_voxel[3]) {
    struct reference_sample sample;
    for (int c = 0; c < 3; c++)
        if (p_voxel[c] < -margin || p_voxel[c] >= volume->dims[c] - 1 + margin)
            return false;
    return reference_sample_volume(&sample, volume, PEL_FILTER_NEAREST, p_voxel) &&
           is_selected(mask, volume, sample.value);
}

static double spacing_along(const struct pel_matrix *matrix, int axis) {
    return pel_length((double[]){matrix->m[0][axis], matrix->m[1][axis], matrix->m[2][axis]});
}

// A recipe's values change everywhere, so near an end of a range rounding decides.
static bool is_near_end(const struct pel_mask *mask, const struct pel_volume *volume,
                        const double p_voxel[3]) {
    struct reference_sample sample;
    if (!volume->hypertexture ||
        !reference_sample_volume(&sample, volume, PEL_FILTER_NEAREST, p_voxel))
        return false;
    for (int n = 0; n < mask->range_count; n++)
        if (fabs(sample.value - mask->ranges[n].low) < 1e-4 ||
            fabs(sample.value - mask->ranges[n].high) < 1e-4)
            return true;
    return false;
}

bool reference_mask_keeps(const struct pel_scene *scene, const struct pel_instance *instance,
                          const double p_world[3], double *margin_mm) {
    const struct pel_mask *mask = &instance->mask;
    if (margin_mm)
        *margin_mm = INFINITY;
    if (mask->range_count == 0)
        return true;
    const struct pel_instance *other = &scene->instances[mask->instance];
    const struct pel_volume *volume = scene->volumes[other->volume];
    struct pel_matrix world_from_voxel =
                          pel_matrix_multiply(&other->transform, &volume->world_from_voxel),
                      voxel_from_world;
    if (!pel_matrix_invert(&voxel_from_world, &world_from_voxel))
        abort();
    double p_voxel[3], margin = other->extent == PEL_EXTENT_CELL ? 0.5 : 0;
    pel_matrix_point(p_voxel, &voxel_from_world, p_world);
    bool here = selects(mask, volume, margin, p_voxel);
    if (margin_mm && is_near_end(mask, volume, p_voxel))
        *margin_mm = 0;
    // The neighbours across faces, edges and corners, and the ends of the box.
    for (int n = 1; margin_mm && n < 8; n++) {
        double across[3], farthest = 0;
        for (int c = 0; c < 3; c++) {
            double away = p_voxel[c] + 0.5 - rint(p_voxel[c] + 0.5), end = volume->dims[c] - 1;
            if (margin == 0 && fabs(p_voxel[c]) < fabs(away))
                away = p_voxel[c];
            if (margin == 0 && fabs(p_voxel[c] - end) < fabs(away))
                away = p_voxel[c] - end;
            across[c] = p_voxel[c];
            if (!(n >> c & 1))
                continue;
            across[c] -= away + (away > 0 ? 1e-3 : -1e-3);
            farthest = fmax(farthest, fabs(away) * spacing_along(&world_from_voxel, c));
        }
        if (selects(mask, volume, margin, across) != here)
            *margin_mm = fmin(*margin_mm, farthest);
    }
    return here != mask->inverted;
}
