// level.c - coarser versions of a volume, by a box filter.
//
// An axis of n voxels is cut into m = ceil(n / 2^h) equal cells, which for odd n do not end where
// voxels do. What lies in two cells counts for both by its share (a polyphase box filter, as for
// textures of any size: Guthe & Heckbert 2005), so that the volume stays where it is and its mean
// what it is. Every level is made from the volume itself, as rounding would add up from level to
// level.
#include "volume/level.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "volume/row.h"
#include "volume/volume.h"

// The old voxels of one new one along an axis: first, ... end - 1.
struct stretch {
    double low, high; // in old cells, the first of which reaches from 0 to 1
    int first, end;
};

static struct stretch stretch_of(int i, int old_count, int new_count) {
    double scale = (double)old_count / new_count;
    struct stretch stretch = {.low = i * scale, .high = (i + 1) * scale};
    stretch.first = (int)floor(stretch.low);
    stretch.end = (int)fmin(ceil(stretch.high), old_count);
    return stretch;
}

// The share of an old voxel that lies in the new one.
static double share_of(const struct stretch *stretch, int old) {
    return fmax(fmin(stretch->high, old + 1) - fmax(stretch->low, old), 0);
}

// Weighted sums of what is present in rows, voxel by voxel, and the weights.
struct sums {
    double *values, *weights, *row; // owned; the row is what is read or written
    int channels;
};

static void add_row(struct sums *sums, const struct pel_volume *source, int j, int k,
                    double weight) {
    pel_row_read(source, j, k, sums->row);
    for (int i = 0; i < source->dims[0]; i++) {
        const double *voxel = sums->row + (ptrdiff_t)i * sums->channels;
        if (isnan(voxel[0]))
            continue;
        sums->weights[i] += weight;
        for (int c = 0; c < sums->channels; c++)
            sums->values[i * sums->channels + c] += weight * voxel[c];
    }
}

static void write_row(struct sums *sums, struct pel_volume *result, int old_count, int j, int k) {
    for (int i = 0; i < result->dims[0]; i++) {
        struct stretch x = stretch_of(i, old_count, result->dims[0]);
        double total[4] = {0}, weight = 0;
        for (int old = x.first; old < x.end; old++) {
            double share = share_of(&x, old);
            weight += share * sums->weights[old];
            for (int c = 0; c < sums->channels; c++)
                total[c] += share * sums->values[old * sums->channels + c];
        }
        for (int c = 0; c < sums->channels; c++)
            sums->row[i * sums->channels + c] = weight > 0 ? total[c] / weight : NAN;
    }
    pel_row_write(result, j, k, sums->row);
}

static void fill(struct pel_volume *result, const struct pel_volume *source, struct sums *sums) {
    size_t width = (size_t)source->dims[0];
    for (int k = 0; k < result->dims[2]; k++) {
        struct stretch z = stretch_of(k, source->dims[2], result->dims[2]);
        for (int j = 0; j < result->dims[1]; j++) {
            struct stretch y = stretch_of(j, source->dims[1], result->dims[1]);
            memset(sums->values, 0, width * (size_t)sums->channels * sizeof *sums->values);
            memset(sums->weights, 0, width * sizeof *sums->weights);
            for (int kk = z.first; kk < z.end; kk++)
                for (int jj = y.first; jj < y.end; jj++)
                    add_row(sums, source, jj, kk, share_of(&y, jj) * share_of(&z, kk));
            write_row(sums, result, source->dims[0], j, k);
        }
    }
}

void pel_volume_level_halvings(const struct pel_volume *volume, int level, int halvings[3]) {
    double spacing[3];
    pel_volume_spacing(volume, spacing);
    double least = fmin(spacing[0], fmin(spacing[1], spacing[2]));
    for (int axis = 0; axis < 3; axis++) {
        // A hair more, so that sides which are powers of two of each other are in step.
        double count = level + log2(least / spacing[axis]) + 1e-6;
        halvings[axis] = count >= 1 ? (int)count : 0;
    }
}

struct pel_volume *pel_volume_level(const struct pel_volume *source, int level) {
    int dims[3], halvings[3];
    double scale[3], offset[3];
    pel_volume_level_halvings(source, level, halvings);
    for (int axis = 0; axis < 3; axis++) {
        dims[axis] = (int)ceil(ldexp(source->dims[axis], -halvings[axis]));
        scale[axis] = (double)source->dims[axis] / dims[axis];
        offset[axis] = (scale[axis] - 1) / 2;
    }
    struct pel_volume *result = pel_volume_create_like(source, dims, source->type, scale, offset);
    if (!result)
        return NULL;
    size_t width = (size_t)source->dims[0];
    struct sums sums = {.channels = pel_row_channels(source->type)};
    size_t voxel_bytes = (size_t)sums.channels * sizeof(double);
    sums.values = pel_allocate(width, voxel_bytes);
    sums.weights = pel_allocate(width, sizeof(double));
    sums.row = pel_allocate(width, voxel_bytes);
    if (sums.values && sums.weights && sums.row) {
        fill(result, source, &sums);
    } else {
        pel_volume_destroy(result);
        result = NULL;
    }
    free(sums.values);
    free(sums.weights);
    free(sums.row);
    return result;
}
