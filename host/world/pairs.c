// pairs.c - a transfer function as a table of pairs of values.
//
// Depth between two values is a difference of one running sum. Colour needs a way through all
// values between them only where the step is so dense that its own front hides its back; so an edit
// costs milliseconds. Source: Engel, Kraus & Ertl 2001.
#include "world/pairs.h"

#include <math.h>
#include <string.h>

enum { LAST = PAIR_ENTRIES - 1, PIECES = 32 };

// Below this depth of a step, what it hides of itself does not show in 8 bits.
static const double thin = 0.02;

// From one value to the next: the mean depth of a step there, and the mean of depth times colour.
struct interval {
    double depth, rgb[3];
};

// Depth and colour at a value.
static struct interval look_up(double value, const struct pel_table *table,
                               const struct pel_strength_rule *rule) {
    double x = (value - table->low) / (table->high - table->low) * (table->entry_count - 1);
    x = fmin(fmax(x, 0), table->entry_count - 1);
    int low = table->nearest ? (int)floor(x + 0.5) : (int)x;
    int high = low + 1 < table->entry_count ? low + 1 : low;
    double weight = table->nearest ? 0 : x - low, rgba[4];
    for (int c = 0; c < 4; c++)
        rgba[c] = table->rgba[low][c] +
                  weight * ((double)table->rgba[high][c] - (double)table->rgba[low][c]);
    double depth =
        -log1p(-fmin(rgba[3], 1 - 0x1p-24)) / rule->opacity_unit_mm * rule->density * rule->step_mm;
    return (struct interval){depth, {depth * rgba[0], depth * rgba[1], depth * rgba[2]}};
}

static void add(struct interval *sum, const struct interval *part, double share) {
    sum->depth += share * part->depth;
    for (int c = 0; c < 3; c++)
        sum->rgb[c] += share * part->rgb[c];
}

// What a step shows that goes through `count` intervals from `first` on, towards `direction`: its
// colour, times the opacity it has.
static void go_through(double rgb[3], const struct interval *intervals, int first, int count,
                       int direction) {
    double clear = 1;
    for (int n = 0; n < count && clear > 1e-4; n++) {
        const struct interval *interval = &intervals[first + direction * n];
        if (!(interval->depth > 0))
            continue;
        double left = clear * exp(-interval->depth / count);
        for (int c = 0; c < 3; c++)
            rgb[c] += (clear - left) * interval->rgb[c] / interval->depth;
        clear = left;
    }
}

static void write_entry(u32 *words, double depth, const double rgb[3], double weight) {
    float value = (float)depth;
    memcpy(words, &value, sizeof value);
    words[1] = 0;
    for (int c = 0; c < 3 && weight > 0; c++)
        words[1] |= (u32)lrint(fmin(fmax(rgb[c] / weight, 0), 1) * 1023) << (10 * c);
}

// `sums` are those of all intervals before each value.
static void write_pair(u32 *words, const struct interval *intervals, const struct interval *sums,
                       int front, int back) {
    int low = front < back ? front : back, count = front < back ? back - front : front - back;
    struct interval mean = {0};
    add(&mean, &sums[low + count], 1.0 / count);
    add(&mean, &sums[low], -1.0 / count);
    // Differences of sums may leave a trace of nothing.
    if (mean.depth <= 1e-12 * sums[LAST].depth)
        mean.depth = 0;
    double rgb[3] = {0};
    if (mean.depth < thin) {
        write_entry(words, mean.depth, mean.rgb, mean.depth);
        return;
    }
    go_through(rgb, intervals, front < back ? front : front - 1, count, front < back ? 1 : -1);
    write_entry(words, mean.depth, rgb, -expm1(-mean.depth));
}

void pel_pairs_write(u32 *words, u32 along[][PEL_STRENGTH_WORDS], const struct pel_table *table,
                     const double range[2], const struct pel_strength_rule *rule) {
    const double apart = (range[1] - range[0]) / LAST;
    struct interval points[PAIR_ENTRIES], intervals[PAIR_ENTRIES] = {{0}}, sums[PAIR_ENTRIES];
    sums[0] = (struct interval){0};
    for (int j = 0; j < PAIR_ENTRIES; j++) {
        points[j] = look_up(range[0] + j * apart, table, rule);
        if (j == LAST)
            break;
        for (int n = 0; n < PIECES; n++) {
            struct interval piece =
                look_up(range[0] + (j + (n + 0.5) / PIECES) * apart, table, rule);
            add(&intervals[j], &piece, 1.0 / PIECES);
        }
        sums[j + 1] = sums[j];
        add(&sums[j + 1], &intervals[j], 1);
    }
    for (int f = 0; f < PAIR_ENTRIES; f++) {
        for (int b = 0; b < PAIR_ENTRIES; b++) {
            u32 *entry = &words[PEL_STRENGTH_WORDS * (f * PAIR_ENTRIES + b)];
            if (f == b)
                write_entry(entry, points[f].depth, points[f].rgb, points[f].depth);
            else
                write_pair(entry, intervals, sums, f, b);
        }
        double beside = points[f].depth + intervals[f].depth + (f > 0 ? intervals[f - 1].depth : 0);
        write_entry(along[f], beside, points[f].rgb, 0);
    }
}
