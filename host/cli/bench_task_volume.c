// bench_task_volume.c - a volume with the character of the reference task's, for machines without
// its file: smooth blobs within a noisy shell, in a cube that is two thirds empty.
//
//     value = shell(r) + max over blobs of a * exp(-d^2 / (2 s^2)),  0 where that is below 12
//
// It is made of integers hashed to floats, so it is the same at every call.
#include <math.h>
#include <stdint.h>

#include "cli/bench.h"
#include "cli/options.h"

// Lengths in halves of the cube's side.
static const double shell_radius = 0.8, shell_width = 0.075, shell_roughness = 0.055;
static const double noise_cell = 0.09;

enum { BLOB_COUNT = 12, LEAST_VALUE = 12 };

struct blob {
    double centre[3], deviation, height;
};

// The finaliser of splitmix64 (Steele et al. 2014): any two neighbouring numbers give unrelated
// ones.
static double hash_unit(uint64_t number) {
    number += 0x9e3779b97f4a7c15u;
    number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9u;
    number = (number ^ (number >> 27)) * 0x94d049bb133111ebu;
    number ^= number >> 31;
    return (double)(number >> 11) * 0x1p-53;
}

static double corner(const int64_t cell[3], int i) {
    uint64_t key = 0;
    for (int axis = 0; axis < 3; axis++)
        key = key << 20 | (uint64_t)(cell[axis] + (i >> axis & 1) + 512);
    return hash_unit(key);
}

// Value noise in 0..1: random numbers at the corners of cells, smoothly between them.
static double noise(const double p[3]) {
    int64_t cell[3];
    double f[3];
    for (int axis = 0; axis < 3; axis++) {
        double place = floor(p[axis] / noise_cell);
        cell[axis] = (int64_t)place;
        f[axis] = p[axis] / noise_cell - place;
        f[axis] *= f[axis] * (3 - 2 * f[axis]);
    }
    double sum = 0;
    for (int i = 0; i < 8; i++) {
        double weight = 1;
        for (int axis = 0; axis < 3; axis++)
            weight *= i >> axis & 1 ? f[axis] : 1 - f[axis];
        sum += weight * corner(cell, i);
    }
    return sum;
}

static void place_blobs(struct blob blobs[BLOB_COUNT]) {
    for (int i = 0; i < BLOB_COUNT; i++) {
        uint64_t seed = (uint64_t)(i + 1) << 40;
        for (int axis = 0; axis < 3; axis++)
            blobs[i].centre[axis] = 0.9 * (hash_unit(seed + (uint64_t)axis) - 0.5);
        blobs[i].deviation = 0.09 + 0.14 * hash_unit(seed + 3);
        blobs[i].height = 70 + 120 * hash_unit(seed + 4);
    }
}

static double value_at(const double p[3], const struct blob blobs[BLOB_COUNT]) {
    double value = 0;
    for (int i = 0; i < BLOB_COUNT; i++) {
        double squared = 0, variance = blobs[i].deviation * blobs[i].deviation;
        for (int axis = 0; axis < 3; axis++)
            squared += (p[axis] - blobs[i].centre[axis]) * (p[axis] - blobs[i].centre[axis]);
        if (squared < 6 * variance)
            value = fmax(value, blobs[i].height * exp(-squared / (2 * variance)));
    }
    double radius = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    double reach = 2 * shell_width + shell_roughness;
    if (fabs(radius - shell_radius) < reach) {
        double rough = noise(p);
        double away = (radius - shell_radius - shell_roughness * (rough - 0.5)) / shell_width;
        value += (40 + 140 * rough) * exp(-away * away);
    }
    return value < LEAST_VALUE ? 0 : fmin(value, 255);
}

struct pel_volume *bench_task_volume(int size) {
    struct pel_volume *volume = pel_volume_create("task", (int[3]){size, size, size}, PEL_VOXEL_U8);
    if (!volume) {
        cli_fail_library();
        return NULL;
    }
    struct blob blobs[BLOB_COUNT];
    place_blobs(blobs);
    uint8_t *voxel = volume->voxels;
    double half = (size - 1) / 2.0;
    for (int k = 0; k < size; k++)
        for (int j = 0; j < size; j++)
            for (int i = 0; i < size; i++) {
                double p[3] = {(i - half) / half, (j - half) / half, (k - half) / half};
                *voxel++ = (uint8_t)(value_at(p, blobs) + 0.5);
            }
    return volume;
}
