// stride.c - docs/picture.md, "Adaptive steps".
#include "reference/stride.h"

#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "reference/clip.h"
#include "reference/model.h"

enum { CELL = 4 };

// Cells along each axis.
static void cells_of(int cells[3], const struct pel_volume *volume) {
    for (int c = 0; c < 3; c++)
        cells[c] = (volume->dims[c] + 1) / CELL + 1;
}

// The least and the greatest value that a cell may have; false where all are absent.
static bool values_in(double range[2], const struct reference_body *body, const int cell[3]) {
    enum pel_filter filter = body->instance->filter;
    bool cubic = filter == PEL_FILTER_CUBIC_B_SPLINE || filter == PEL_FILTER_CATMULL_ROM;
    int first[3], last[3], reach = cubic ? 1 : 0;
    for (int c = 0; c < 3; c++) {
        int end = body->volume->dims[c] - 1;
        int low = CELL * (cell[c] - reach) - 1, high = CELL * (cell[c] + 1 + reach) - 1;
        first[c] = low < 0 ? 0 : low;
        last[c] = high > end ? end : high;
    }
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int k = first[2]; k <= last[2]; k++) {
        for (int j = first[1]; j <= last[1]; j++) {
            for (int i = first[0]; i <= last[0]; i++) {
                double value = pel_volume_value(body->volume, i, j, k);
                if (isnan(value))
                    continue;
                range[0] = fmin(range[0], value);
                range[1] = fmax(range[1], value);
            }
        }
    }
    double beyond = filter == PEL_FILTER_CATMULL_ROM ? (range[1] - range[0]) * 61 / 128 : 0;
    range[0] -= beyond;
    range[1] += beyond;
    return range[0] <= range[1];
}

// Optical depth of one step at entry j of the table, and how much light that emits in a channel.
static void entry_at(double entry[4], const struct reference *reference,
                     const struct reference_body *body, int j) {
    const double *rgba = body->table.entries[j];
    double depth = -log(1 - fmin(rgba[3], 1 - 0x1p-24)) /
                   body->instance->transfer->opacity_unit_mm * body->instance->density *
                   reference->step_mm;
    for (int c = 0; c < 3; c++)
        entry[c] = depth * rgba[c];
    entry[3] = depth;
}

// Whether what is shown may change where the value does not, or begin anywhere.
static bool begins_anywhere(const struct reference_body *body) {
    const struct pel_volume *volume = body->volume;
    const struct pel_instance *instance = body->instance;
    const struct pel_silhouette *silhouette = &instance->silhouette;
    if (instance->material.shading != PEL_SHADING_NONE || instance->gradient_opacity_count > 0 ||
        silhouette->base != 0 || silhouette->strength != 0 || volume->type == PEL_VOXEL_RGB8 ||
        volume->type == PEL_VOXEL_RGBA8)
        return true;
    const float *voxels = volume->voxels;
    for (size_t n = 0; volume->type == PEL_VOXEL_F32 && n < pel_volume_voxel_count(volume); n++)
        if (isnan(voxels[n]))
            return true;
    return false;
}

static double variation_in(const struct reference *reference, const struct reference_body *body,
                           const int cell[3]) {
    double range[2], before[4], entry[4];
    if (!values_in(range, body, cell))
        return 0;
    const struct reference_table *table = &body->table;
    double x[2];
    for (int n = 0; n < 2; n++) {
        x[n] = (range[n] - table->low) / (table->high - table->low) * (table->count - 1);
        x[n] = fmin(fmax(x[n], 0), table->count - 1);
    }
    int first = (int)floor(x[0] + 0x1p-10), last = (int)ceil(x[1] - 0x1p-10);
    entry_at(before, reference, body, first);
    double variation = begins_anywhere(body) ? before[3] : 0;
    for (int j = first + 1; j <= last; j++) {
        double most = 0;
        entry_at(entry, reference, body, j);
        for (int c = 0; c < 4; c++) {
            most = fmax(most, fabs(entry[c] - before[c]));
            before[c] = entry[c];
        }
        variation += most;
    }
    return variation;
}

// Whether a body never has one sample stand for others.
static bool takes_all(const struct reference *reference, int k) {
    const struct reference_body *body = &reference->bodies[k];
    bool cut_away = false;
    for (int n = 0; n < reference->scene->clip_count; n++)
        cut_away |=
            reference->scene->clips[n].kind == PEL_CLIP_BOX && reference->scene->clips[n].outside;
    for (int n = 0; n < body->instance->clip_count; n++)
        cut_away |=
            body->instance->clips[n].kind == PEL_CLIP_BOX && body->instance->clips[n].outside;
    return cut_away || body->instance->mask.range_count > 0 || body->pairs ||
           reference_model_of(reference, k) != PEL_MODEL_ABSORPTION;
}

// How many steps a run may be long without leading further than the next cell.
static int most_steps(const struct reference *reference, const struct reference_body *body) {
    double fastest = 0;
    for (int c = 0; c < 3; c++)
        fastest = fmax(fastest, pel_length(body->voxel_from_world.m[c]));
    double step = reference->step_mm * fastest;
    return 3 * step <= CELL ? 4 : step <= CELL ? 2 : 1;
}

// The longest run that may begin or end at p_voxel.
static int run_at(const struct reference *reference, int k, const double p_voxel[3]) {
    const struct reference_body *body = &reference->bodies[k];
    int cells[3], cell[3];
    if (takes_all(reference, k))
        return 1;
    cells_of(cells, body->volume);
    for (int c = 0; c < 3; c++) {
        cell[c] = (int)floor((p_voxel[c] + 1) / CELL);
        cell[c] = cell[c] < 0 ? 0 : cell[c] < cells[c] ? cell[c] : cells[c] - 1;
    }
    // What was found once is kept.
    unsigned char *run = &body->runs[(cell[2] * cells[1] + cell[1]) * cells[0] + cell[0]];
    if (*run == 0) {
        double variation = variation_in(reference, body, cell);
        int most = most_steps(reference, body);
        while (most > 1 && variation * most > reference->scene->render.adaptive_step)
            most /= 2;
        *run = (unsigned char)most;
    }
    return *run;
}

void reference_run_prepare(struct reference_body *body) {
    int cells[3];
    cells_of(cells, body->volume);
    body->runs = calloc((size_t)cells[0] * (size_t)cells[1] * (size_t)cells[2], 1);
    if (!body->runs)
        abort();
}

// The sample of the common grid at which a body begins or ends: the first at or behind t.
static double sample_behind(const struct reference *reference, const struct reference_path *path,
                            double t) {
    return ceil((t - path->t_near) / reference->step_mm - path->phase);
}

// Whether the cells of the first and the last sample of a run let it be that long.
static bool fits(const struct reference *reference, const struct reference_path *path, int k,
                 double i, int length) {
    for (int n = 0; n < length; n += length - 1) {
        double p_voxel[3];
        reference_point_at(p_voxel, &path->rays[k], reference_sample_t(reference, path, i + n));
        if (run_at(reference, k, p_voxel) < length)
            return false;
    }
    return true;
}

int reference_run(const struct reference *reference, const struct reference_path *path, double i) {
    if (reference->scene->render.adaptive_step == 0)
        return 1;
    int length = fmod(i, 4) == 0 ? 4 : fmod(i, 2) == 0 ? 2 : 1;
    for (int k = 0; k < reference->body_count; k++) {
        struct reference_span span = reference_clip_span(reference, path, k);
        if (span.t_in >= span.t_out)
            continue;
        double first = fmax(0, sample_behind(reference, path, span.t_in)),
               end = sample_behind(reference, path, span.t_out);
        while (length > 1 && ((first > i && first < i + length) || (end > i && end < i + length)) &&
               first < end)
            length /= 2;
        while (length > 1 && i >= first && i < end && !fits(reference, path, k, i, length))
            length /= 2;
    }
    return length;
}
