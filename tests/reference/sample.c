// sample.c - docs/picture.md, "Values".
#include "reference/sample.h"

#include <math.h>

#include "reference/recipe.h"

// No hypertexture that is compared rises faster than this from one voxel of its grid to the next.
static const double steepest_density = 8;

// What is interpolated: the value as stored, and the voxel's own colour in 0..255.
enum { RAW, RED, GREEN, BLUE, CHANNELS };

static void read_voxel(double channels[CHANNELS], const struct pel_volume *volume,
                       const int voxel[3]) {
    size_t width = (size_t)volume->dims[0], height = (size_t)volume->dims[1];
    size_t index = ((size_t)voxel[2] * height + (size_t)voxel[1]) * width + (size_t)voxel[0];
    const uint8_t *bytes = volume->voxels;

    for (int c = 0; c < CHANNELS; c++)
        channels[c] = 0;
    switch (volume->type) {
    case PEL_VOXEL_U8:
        channels[RAW] = bytes[index];
        break;
    case PEL_VOXEL_I8:
        channels[RAW] = ((const int8_t *)volume->voxels)[index];
        break;
    case PEL_VOXEL_U16:
        channels[RAW] = ((const uint16_t *)volume->voxels)[index];
        break;
    case PEL_VOXEL_I16:
        channels[RAW] = ((const int16_t *)volume->voxels)[index];
        break;
    case PEL_VOXEL_F32:
        channels[RAW] = ((const float *)volume->voxels)[index];
        break;
    case PEL_VOXEL_RGB8:
        for (int c = 0; c < 3; c++)
            channels[RED + c] = bytes[3 * index + (size_t)c];
        // Luminance in whole numbers, so that a half is seen as a half and rounded up.
        channels[RAW] = (2126 * bytes[3 * index] + 7152 * bytes[3 * index + 1] +
                         722 * bytes[3 * index + 2] + 5000) /
                        10000;
        break;
    case PEL_VOXEL_RGBA8:
        for (int c = 0; c < 3; c++)
            channels[RED + c] = bytes[4 * index + (size_t)c];
        channels[RAW] = bytes[4 * index + 3];
        break;
    }
}

static int clamp(double index, int dims) {
    return (int)fmin(fmax(index, 0), dims - 1);
}

static void read_nearest(double channels[CHANNELS], const struct pel_volume *volume,
                         const double p_voxel[3]) {
    int voxel[3];
    for (int c = 0; c < 3; c++)
        voxel[c] = clamp(floor(p_voxel[c] + 0.5), volume->dims[c]);
    read_voxel(channels, volume, voxel);
}

// Corner number n lies at the upper end of axis c if bit c of n is set.
static void read_linear(double channels[CHANNELS], double *spread, const struct pel_volume *volume,
                        const double p_voxel[3]) {
    double corners[8][CHANNELS];
    for (int c = 0; c < CHANNELS; c++)
        channels[c] = 0;
    for (int n = 0; n < 8; n++) {
        int voxel[3];
        double product = 1;
        for (int c = 0; c < 3; c++) {
            bool upper = n >> c & 1;
            double lower = floor(p_voxel[c]), weight = p_voxel[c] - lower;
            voxel[c] = clamp(upper ? lower + 1 : lower, volume->dims[c]);
            product *= upper ? weight : 1 - weight;
        }
        // An absent corner (NaN) makes the sum absent, also where its weight is zero.
        read_voxel(corners[n], volume, voxel);
        for (int c = 0; c < CHANNELS; c++)
            channels[c] += product * corners[n][c];
    }

    *spread = 0;
    for (int c = 0; c < 3; c++) {
        double greatest = 0;
        for (int n = 0; n < 8; n++)
            greatest = fmax(greatest, fabs(corners[n][RAW] - corners[n ^ 1 << c][RAW]));
        *spread += greatest;
    }
}

// The weights of the four voxels around a place that is a share f of the way from the second one to
// the third.
static void cubic_weights(double weights[4], enum pel_filter filter, double f) {
    double g = 1 - f;
    if (filter == PEL_FILTER_CUBIC_B_SPLINE) {
        weights[0] = g * g * g / 6;
        weights[1] = (4 - 6 * f * f + 3 * f * f * f) / 6;
        weights[2] = (4 - 6 * g * g + 3 * g * g * g) / 6;
        weights[3] = f * f * f / 6;
    } else {
        weights[0] = (-f + 2 * f * f - f * f * f) / 2;
        weights[1] = (2 - 5 * f * f + 3 * f * f * f) / 2;
        weights[2] = (f + 4 * f * f - 3 * f * f * f) / 2;
        weights[3] = (-f * f + f * f * f) / 2;
    }
}

// Voxel number n of the 4^3, its place along axis c in bits 2 c and 2 c + 1.
static void read_cubic(double channels[CHANNELS], double *spread, const struct pel_volume *volume,
                       enum pel_filter filter, const double p_voxel[3]) {
    double weights[3][4], raw[64];
    for (int c = 0; c < 3; c++)
        cubic_weights(weights[c], filter, p_voxel[c] - floor(p_voxel[c]));
    for (int c = 0; c < CHANNELS; c++)
        channels[c] = 0;
    for (int n = 0; n < 64; n++) {
        int voxel[3];
        double product = 1, own[CHANNELS];
        for (int c = 0; c < 3; c++) {
            int tap = n >> (2 * c) & 3;
            voxel[c] = clamp(floor(p_voxel[c]) + tap - 1, volume->dims[c]);
            product *= weights[c][tap];
        }
        read_voxel(own, volume, voxel);
        raw[n] = own[RAW];
        for (int c = 0; c < CHANNELS; c++)
            channels[c] += product * own[c];
    }
    for (int c = RED; c < CHANNELS; c++)
        channels[c] = fmin(fmax(channels[c], 0), 255);

    // The absolute weights of Catmull and Rom's spline add up to at most 1.25^3 < 2.
    *spread = 0;
    for (int c = 0; c < 3; c++) {
        double greatest = 0;
        for (int n = 0; n < 64; n++)
            if ((n >> (2 * c) & 3) < 3)
                greatest = fmax(greatest, fabs(raw[n] - raw[n + (1 << 2 * c)]));
        *spread += filter == PEL_FILTER_CATMULL_ROM ? 2 * greatest : greatest;
    }
}

bool reference_sample_volume(struct reference_sample *sample, const struct pel_volume *volume,
                             enum pel_filter filter, const double p_voxel[3]) {
    double channels[CHANNELS] = {0}, spread = 0;
    // Without voxels there is nothing to interpolate: docs/hypertexture.md, "In a scene".
    if (volume->hypertexture) {
        channels[RAW] = reference_hypertexture(volume, p_voxel);
        spread = steepest_density;
    } else if (filter == PEL_FILTER_NEAREST)
        read_nearest(channels, volume, p_voxel);
    else if (filter != PEL_FILTER_LINEAR)
        read_cubic(channels, &spread, volume, filter, p_voxel);
    else
        read_linear(channels, &spread, volume, p_voxel);
    if (!isfinite(channels[RAW]))
        return false;

    *sample = (struct reference_sample){
        .value = volume->slope * channels[RAW] + volume->intercept,
        .coloured = volume->type == PEL_VOXEL_RGB8 || volume->type == PEL_VOXEL_RGBA8,
        .rgb = {channels[RED] / 255, channels[GREEN] / 255, channels[BLUE] / 255},
        .spread = fabs(volume->slope) * spread,
    };
    return true;
}
