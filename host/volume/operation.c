// operation.c - new volumes from old on other grids: crop, resample, downsample.
//
// A voxel index q of the result lies at index scale * q + offset of the source, so that
//
//     world_from_result = world_from_source * [ scale on the diagonal, offset in the last column ].
//
// A voxel is a cell that reaches half an index to either side. Cutting the cell extent
// [-1/2, n - 1/2] into m equal cells gives scale = n / m and offset = (scale - 1) / 2. Absent
// voxels (NaN) stay absent: whatever is made of one, at a weight that is not 0, is absent too.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "volume/row.h"
#include "volume/volume.h"

// ---- Resampling --------------------------------------------------------------------------------

// Where a resampled index lies between two source indices: (1 - weight) * low + weight * high.
struct tap {
    int low, high;
    double weight;
};

static struct tap tap_at(int q, double scale, int source_dim, bool nearest) {
    double p = fmin(fmax((q + 0.5) * scale - 0.5, 0), source_dim - 1);
    if (nearest) {
        int index = (int)fmin(floor((q + 0.5) * scale), source_dim - 1);
        return (struct tap){index, index, 0};
    }
    int low = (int)fmin(floor(p), source_dim - 1);
    return (struct tap){low, low + 1 < source_dim ? low + 1 : low, p - low};
}

// Adds weight * row (j, k) to `sum`; a weight of 0 leaves absent voxels out of it.
static void add_row(double *sum, double *scratch, const struct pel_volume *source, int j, int k,
                    double weight) {
    if (weight == 0)
        return;
    pel_row_read(source, j, k, scratch);
    int count = source->dims[0] * pel_row_channels(source->type);
    for (int i = 0; i < count; i++)
        sum[i] += weight * scratch[i];
}

static void resample_row(double *out, const double *in, const struct tap *taps, int count,
                         int channels) {
    for (int i = 0; i < count; i++) {
        for (int c = 0; c < channels; c++) {
            double low = in[taps[i].low * channels + c], high = in[taps[i].high * channels + c];
            double weight = taps[i].weight;
            out[i * channels + c] = weight == 0 ? low : (1 - weight) * low + weight * high;
        }
    }
}

static void resample(struct pel_volume *result, const struct pel_volume *source,
                     const double scale[3], double *rows[3], struct tap *taps) {
    int channels = pel_row_channels(source->type);
    size_t row_bytes = (size_t)source->dims[0] * (size_t)channels * sizeof(double);
    for (int i = 0; i < result->dims[0]; i++)
        taps[i] = tap_at(i, scale[0], source->dims[0], source->labels);
    for (int k = 0; k < result->dims[2]; k++) {
        struct tap z = tap_at(k, scale[2], source->dims[2], source->labels);
        for (int j = 0; j < result->dims[1]; j++) {
            struct tap y = tap_at(j, scale[1], source->dims[1], source->labels);
            memset(rows[0], 0, row_bytes);
            add_row(rows[0], rows[1], source, y.low, z.low, (1 - y.weight) * (1 - z.weight));
            add_row(rows[0], rows[1], source, y.high, z.low, y.weight * (1 - z.weight));
            add_row(rows[0], rows[1], source, y.low, z.high, (1 - y.weight) * z.weight);
            add_row(rows[0], rows[1], source, y.high, z.high, y.weight * z.weight);
            resample_row(rows[2], rows[0], taps, result->dims[0], channels);
            pel_row_write(result, j, k, rows[2]);
        }
    }
}

struct pel_volume *pel_volume_resample(const struct pel_volume *source, const int dims[3]) {
    double scale[3], offset[3];
    for (int axis = 0; axis < 3; axis++) {
        if (dims[axis] < 1) {
            pel_fail(PEL_ERROR_ARGUMENT, "cannot resample to %d voxels along axis %d", dims[axis],
                     axis);
            return NULL;
        }
        scale[axis] = (double)source->dims[axis] / dims[axis];
        offset[axis] = (scale[axis] - 1) / 2;
    }
    struct pel_volume *result = pel_volume_create_like(source, dims, source->type, scale, offset);
    if (!result)
        return NULL;
    size_t width = (size_t)pel_row_channels(source->type) * sizeof(double);
    double *rows[3] = {pel_allocate((size_t)source->dims[0], width),
                       pel_allocate((size_t)source->dims[0], width),
                       pel_allocate((size_t)dims[0], width)};
    struct tap *taps = pel_allocate((size_t)dims[0], sizeof *taps);
    if (rows[0] && rows[1] && rows[2] && taps) {
        resample(result, source, scale, rows, taps);
    } else {
        pel_volume_destroy(result);
        result = NULL;
    }
    free(taps);
    for (int i = 0; i < 3; i++)
        free(rows[i]);
    return result;
}

// ---- Downsampling ------------------------------------------------------------------------------

// Means over blocks; the last block of an axis may be cut short by the volume's end.
static void downsample(struct pel_volume *result, const struct pel_volume *source,
                       const int block[3], double *sum, double *row) {
    int channels = pel_row_channels(source->type);
    for (int k = 0; k < result->dims[2]; k++) {
        for (int j = 0; j < result->dims[1]; j++) {
            int j_end = j * block[1] + block[1], k_end = k * block[2] + block[2];
            j_end = j_end < source->dims[1] ? j_end : source->dims[1];
            k_end = k_end < source->dims[2] ? k_end : source->dims[2];
            int rows = (j_end - j * block[1]) * (k_end - k * block[2]);
            memset(sum, 0, (size_t)source->dims[0] * (size_t)channels * sizeof *sum);
            for (int kk = k * block[2]; kk < k_end; kk++)
                for (int jj = j * block[1]; jj < j_end; jj++)
                    add_row(sum, row, source, jj, kk, 1);
            for (int i = 0; i < result->dims[0]; i++) {
                int end = i * block[0] + block[0];
                end = end < source->dims[0] ? end : source->dims[0];
                for (int c = 0; c < channels; c++) {
                    double total = 0;
                    for (int ii = i * block[0]; ii < end; ii++)
                        total += sum[ii * channels + c];
                    row[i * channels + c] = total / ((double)rows * (end - i * block[0]));
                }
            }
            pel_row_write(result, j, k, row);
        }
    }
}

// The voxel in the middle of each block.
static void pick_middles(struct pel_volume *result, const struct pel_volume *source,
                         const int block[3]) {
    size_t bytes = pel_voxel_bytes(source->type);
    int at[3], middle[3];
    for (at[2] = 0; at[2] < result->dims[2]; at[2]++) {
        for (at[1] = 0; at[1] < result->dims[1]; at[1]++) {
            char *row = pel_row_at(result, at[1], at[2]);
            for (at[0] = 0; at[0] < result->dims[0]; at[0]++) {
                for (int axis = 0; axis < 3; axis++) {
                    middle[axis] = at[axis] * block[axis] + block[axis] / 2;
                    if (middle[axis] >= source->dims[axis])
                        middle[axis] = source->dims[axis] - 1;
                }
                const char *from = pel_row_at(source, middle[1], middle[2]);
                memcpy(row + (size_t)at[0] * bytes, from + (size_t)middle[0] * bytes, bytes);
            }
        }
    }
}

struct pel_volume *pel_volume_create_like(const struct pel_volume *source, const int dims[3],
                                          enum pel_voxel_type type, const double scale[3],
                                          const double offset[3]) {
    if (!pel_volume_check_voxels(source))
        return NULL;
    struct pel_volume *volume = pel_volume_create(source->name, dims, type);
    if (!volume)
        return NULL;
    struct pel_matrix source_from_result = pel_matrix_scaling(scale);
    for (int axis = 0; axis < 3; axis++)
        source_from_result.m[axis][3] = offset[axis];
    volume->world_from_voxel = pel_matrix_multiply(&source->world_from_voxel, &source_from_result);
    volume->slope = source->slope;
    volume->intercept = source->intercept;
    memcpy(volume->unit, source->unit, sizeof volume->unit);
    memcpy(volume->space, source->space, sizeof volume->space);
    volume->labels = source->labels;
    return volume;
}

struct pel_volume *pel_volume_downsample(const struct pel_volume *source, int factor) {
    if (factor < 1) {
        pel_fail(PEL_ERROR_ARGUMENT, "cannot downsample by a factor of %d", factor);
        return NULL;
    }
    int dims[3], block[3];
    double scale[3], offset[3];
    for (int axis = 0; axis < 3; axis++) {
        // An axis shorter than a block becomes one voxel of its own size: a slice stays as thin.
        block[axis] = factor < source->dims[axis] ? factor : source->dims[axis];
        dims[axis] = (source->dims[axis] - 1) / block[axis] + 1;
        scale[axis] = block[axis];
        offset[axis] = (scale[axis] - 1) / 2;
    }
    struct pel_volume *result = pel_volume_create_like(source, dims, source->type, scale, offset);
    if (!result)
        return NULL;
    if (source->labels) {
        pick_middles(result, source, block);
        return result;
    }
    size_t width = (size_t)pel_row_channels(source->type) * sizeof(double);
    double *sum = pel_allocate((size_t)source->dims[0], width);
    double *row = pel_allocate((size_t)source->dims[0], width);
    if (sum && row) {
        downsample(result, source, block, sum, row);
    } else {
        pel_volume_destroy(result);
        result = NULL;
    }
    free(sum);
    free(row);
    return result;
}

struct pel_volume *pel_volume_crop(const struct pel_volume *source, const int first[3],
                                   const int dims[3]) {
    for (int axis = 0; axis < 3; axis++) {
        if (first[axis] < 0 || dims[axis] < 1 || dims[axis] > source->dims[axis] - first[axis]) {
            pel_fail(PEL_ERROR_ARGUMENT,
                     "cannot crop %d voxels from %d on along axis %d, which has %d", dims[axis],
                     first[axis], axis, source->dims[axis]);
            return NULL;
        }
    }
    struct pel_volume *result = pel_volume_create_like(
        source, dims, source->type, (double[]){1, 1, 1}, (double[]){first[0], first[1], first[2]});
    if (!result)
        return NULL;
    size_t voxel_bytes = pel_voxel_bytes(source->type);
    for (int k = 0; k < dims[2]; k++)
        for (int j = 0; j < dims[1]; j++)
            memcpy(pel_row_at(result, j, k),
                   (char *)pel_row_at(source, first[1] + j, first[2] + k) +
                       (size_t)first[0] * voxel_bytes,
                   (size_t)dims[0] * voxel_bytes);
    return result;
}
