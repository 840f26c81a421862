// statistics.c - what the values of a volume are like: range, moments, histogram, percentiles.
//
// Voxels of 8 and 16 bits are counted in one pass, one counter per raw level, and everything else
// follows exactly from these counts. Floats, and the luminance of RGB voxels, take two passes: one
// for range and mean, one that counts FINE_BINS equal bins over the range. Their percentiles are
// interpolated within a fine bin, so they are off by at most (max - min) / FINE_BINS; everything
// else is exact there too, but for rounding.
//
// percentiles[p] is the nearest-rank percentile: the least value such that at least p percent of
// the values are not greater; percentiles[0] is the minimum.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "volume/volume.h"

enum { FINE_BINS = 65536, LANES = 4, BATCH = 4096 };

// How often each level occurs; `first` is the raw value of level 0, levels are 1 apart.
struct counts {
    uint64_t level[FINE_BINS];
    int level_count, first;
};

// The number of values at or below percentile p: ceil(p n / 100), at least 1.
static uint64_t rank_of(int p, uint64_t count) {
    uint64_t rank = count / 100 * (uint64_t)p + (count % 100 * (uint64_t)p + 99) / 100;
    return rank ? rank : 1;
}

// Neighbouring voxels are often equal, and counting them in one table would wait for the store of
// the one before; so neighbours are counted in separate tables.
static void count_bytes(struct counts *counts, const uint8_t *bytes, size_t count, size_t stride) {
    uint64_t lanes[LANES][256] = {{0}};
    size_t i = 0;
    for (; i + LANES <= count; i += LANES)
        for (int lane = 0; lane < LANES; lane++)
            lanes[lane][bytes[(i + (size_t)lane) * stride]]++;
    for (; i < count; i++)
        lanes[0][bytes[i * stride]]++;
    for (int level = 0; level < 256; level++)
        for (int lane = 0; lane < LANES; lane++)
            counts->level[level] += lanes[lane][level];
}

static void count_words(struct counts *counts, const uint16_t *words, size_t count) {
    for (size_t i = 0; i < count; i++)
        counts->level[words[i]]++;
}

// Two's complement puts the negative half of signed types behind the positive one.
static void swap_halves(struct counts *counts) {
    int half = counts->level_count / 2;
    for (int level = 0; level < half; level++) {
        uint64_t positive = counts->level[level];
        counts->level[level] = counts->level[level + half];
        counts->level[level + half] = positive;
    }
    counts->first = -half;
}

static void count_levels(struct counts *counts, const struct pel_volume *volume) {
    size_t count = pel_volume_voxel_count(volume);
    bool wide = volume->type == PEL_VOXEL_U16 || volume->type == PEL_VOXEL_I16;
    counts->level_count = wide ? 65536 : 256;
    if (wide)
        count_words(counts, volume->voxels, count);
    else if (volume->type == PEL_VOXEL_RGBA8)
        count_bytes(counts, (const uint8_t *)volume->voxels + 3, count, 4);
    else
        count_bytes(counts, volume->voxels, count, 1);
    if (volume->type == PEL_VOXEL_I8 || volume->type == PEL_VOXEL_I16)
        swap_halves(counts);
}

// With a negative slope the greatest raw level is the least value; turning the levels round makes
// them ascend in value again.
static void turn_round(struct counts *counts) {
    for (int low = 0, high = counts->level_count - 1; low < high; low++, high--) {
        uint64_t count = counts->level[low];
        counts->level[low] = counts->level[high];
        counts->level[high] = count;
    }
}

static void measure_levels(const struct pel_volume *volume, struct pel_statistics *statistics) {
    struct counts counts = {.first = 0};
    count_levels(&counts, volume);
    double slope = volume->slope, intercept = volume->intercept + slope * counts.first;
    if (slope < 0) {
        turn_round(&counts);
        intercept += slope * (counts.level_count - 1);
        slope = -slope;
    }
    int low = 0, high = counts.level_count - 1;
    while (counts.level[low] == 0)
        low++;
    while (counts.level[high] == 0)
        high--;
    uint64_t count = pel_volume_voxel_count(volume), below = 0;
    double sum = 0, squares = 0;
    int p = 0;
    for (int level = low; level <= high; level++) {
        uint64_t here = counts.level[level];
        sum += (double)here * (level - low);
        below += here;
        for (; p <= 100 && rank_of(p, count) <= below; p++)
            statistics->percentiles[p] = slope * level + intercept;
        // A slope of 0 makes one value of all levels.
        int bin = slope > 0 && high > low ? (level - low) * PEL_HISTOGRAM_BINS / (high - low) : 0;
        statistics->histogram[bin < PEL_HISTOGRAM_BINS ? bin : PEL_HISTOGRAM_BINS - 1] += here;
    }
    double mean = sum / (double)count;
    for (int level = low; level <= high; level++)
        squares += (double)counts.level[level] * (level - low - mean) * (level - low - mean);
    statistics->min = slope * low + intercept;
    statistics->max = slope * high + intercept;
    statistics->mean = slope * (low + mean) + intercept;
    statistics->deviation = slope * sqrt(squares / (double)count);
    statistics->count = count;
}

// The raw values of voxels first .. first + count - 1 of a float or RGB volume.
static const float *raw_values(const struct pel_volume *volume, size_t first, size_t count,
                               float scratch[BATCH]) {
    if (volume->type == PEL_VOXEL_F32)
        return (const float *)volume->voxels + first;
    const uint8_t *rgb = (const uint8_t *)volume->voxels + 3 * first;
    for (size_t i = 0; i < count; i++, rgb += 3)
        scratch[i] = (float)(0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]);
    return scratch;
}

struct range {
    float low, high;
    double mean;
    uint64_t count;
};

static struct range find_range(const struct pel_volume *volume) {
    struct range range = {.low = INFINITY, .high = -INFINITY};
    size_t all = pel_volume_voxel_count(volume);
    float scratch[BATCH];
    double sum = 0;
    for (size_t first = 0; first < all; first += BATCH) {
        size_t count = all - first < BATCH ? all - first : BATCH;
        const float *values = raw_values(volume, first, count, scratch);
        for (size_t i = 0; i < count; i++) {
            if (!isfinite(values[i]))
                continue;
            range.low = values[i] < range.low ? values[i] : range.low;
            range.high = values[i] > range.high ? values[i] : range.high;
            sum += values[i];
            range.count++;
        }
    }
    range.mean = range.count ? sum / (double)range.count : 0;
    return range;
}

static double count_fine(struct counts *counts, const struct pel_volume *volume,
                         const struct range *range) {
    size_t all = pel_volume_voxel_count(volume);
    double width = (double)range->high - range->low, scale = width > 0 ? FINE_BINS / width : 0;
    double squares = 0;
    float scratch[BATCH];
    counts->level_count = FINE_BINS;
    for (size_t first = 0; first < all; first += BATCH) {
        size_t count = all - first < BATCH ? all - first : BATCH;
        const float *values = raw_values(volume, first, count, scratch);
        for (size_t i = 0; i < count; i++) {
            if (!isfinite(values[i]))
                continue;
            int bin = (int)(((double)values[i] - range->low) * scale);
            counts->level[bin < FINE_BINS ? bin : FINE_BINS - 1]++;
            double difference = values[i] - range->mean;
            squares += difference * difference;
        }
    }
    return squares;
}

static void measure_fine(const struct pel_volume *volume, struct pel_statistics *statistics) {
    struct range range = find_range(volume);
    statistics->count = range.count;
    statistics->absent_count = pel_volume_voxel_count(volume) - range.count;
    if (range.count == 0)
        return;
    struct counts counts = {.first = 0};
    double squares = count_fine(&counts, volume, &range);
    double slope = volume->slope, intercept = volume->intercept;
    double start = range.low, width = (double)range.high - range.low;
    statistics->mean = slope * range.mean + intercept;
    statistics->deviation = fabs(slope) * sqrt(squares / (double)range.count);
    if (slope < 0) {
        turn_round(&counts);
        start = range.high;
        width = -width;
    }
    uint64_t below = 0;
    int p = 0;
    for (int bin = 0; bin < FINE_BINS; bin++) {
        uint64_t here = counts.level[bin];
        statistics->histogram[slope != 0 ? bin / (FINE_BINS / PEL_HISTOGRAM_BINS) : 0] += here;
        for (; p <= 100 && rank_of(p, range.count) <= below + here; p++) {
            double part = (double)(rank_of(p, range.count) - below) / (double)here;
            statistics->percentiles[p] =
                slope * (start + (bin + part) / FINE_BINS * width) + intercept;
        }
        below += here;
    }
    statistics->min = slope * start + intercept;
    statistics->max = slope * (start + width) + intercept;
    statistics->percentiles[0] = statistics->min;
    statistics->percentiles[100] = statistics->max;
}

// Of a hypertexture nobody knows more than that densities are 0..1, so all are as likely.
static void measure_nothing(struct pel_statistics *statistics) {
    statistics->max = 1;
    statistics->mean = 0.5;
    statistics->deviation = sqrt(1 / 12.0);
    statistics->count = PEL_HISTOGRAM_BINS;
    for (int i = 0; i < PEL_HISTOGRAM_BINS; i++)
        statistics->histogram[i] = 1;
    for (int percent = 0; percent <= 100; percent++)
        statistics->percentiles[percent] = percent / 100.0;
}

void pel_volume_measure(const struct pel_volume *volume, struct pel_statistics *statistics) {
    *statistics = (struct pel_statistics){0};
    if (!volume->voxels)
        measure_nothing(statistics);
    else if (volume->type == PEL_VOXEL_F32 || volume->type == PEL_VOXEL_RGB8)
        measure_fine(volume, statistics);
    else
        measure_levels(volume, statistics);
}
