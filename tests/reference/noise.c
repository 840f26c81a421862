// noise.c - the noises of hypertextures, slow and plain.
#include "reference/noise.h"

#include <math.h>
#include <stdlib.h>

// ---- Perlin's two lattices
// -----------------------------------------------------------------------

static double lerp(double t, double a, double b) {
    return a + t * (b - a);
}

// The gradients of 2002 as he lists them: the first 12, and four of them again.
static const double edges[16][3] = {
    {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
    {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {0, -1, 1}, {-1, 1, 0}, {0, -1, -1},
};

static int permuted(const struct recipe *tables, int index) {
    return (int)tables->permutation[index & 255];
}

static double lattice(const struct recipe *tables, const double p[3], int year) {
    int cell[3];
    double d[3], fade[3];
    for (int axis = 0; axis < 3; axis++) {
        cell[axis] = (int)floor(p[axis]);
        double t = d[axis] = p[axis] - cell[axis];
        fade[axis] = year == 2002 ? 6 * pow(t, 5) - 15 * pow(t, 4) + 10 * pow(t, 3)
                                  : 3 * pow(t, 2) - 2 * pow(t, 3);
    }
    double value[2][2][2];
    for (int x = 0; x < 2; x++)
        for (int y = 0; y < 2; y++)
            for (int z = 0; z < 2; z++) {
                int hash = permuted(tables, cell[0] + x) + cell[1] + y;
                hash = permuted(tables, hash) + cell[2] + z;
                double from[3] = {d[0] - x, d[1] - y, d[2] - z};
                double sum = 0;
                float4 unit = tables->gradients[hash & 255];
                double units[3] = {unit.x, unit.y, unit.z};
                const double *edge = edges[permuted(tables, hash) & 15];
                for (int axis = 0; axis < 3; axis++)
                    sum += from[axis] * (year == 2002 ? edge[axis] : units[axis]);
                value[x][y][z] = sum;
            }
    double plane[2];
    for (int z = 0; z < 2; z++)
        plane[z] = lerp(fade[1], lerp(fade[0], value[0][0][z], value[1][0][z]),
                        lerp(fade[0], value[0][1][z], value[1][1][z]));
    return lerp(fade[2], plane[0], plane[1]);
}

double reference_noise_2002(const struct recipe *tables, const double p[3]) {
    return lattice(tables, p, 2002);
}

double reference_noise_1985(const struct recipe *tables, const double p[3]) {
    return lattice(tables, p, 1985);
}

// ---- Sums
// ----------------------------------------------------------------------------------------

static double octave(const struct recipe *tables, const double p[3], int i) {
    double scaled[3] = {ldexp(p[0], i), ldexp(p[1], i), ldexp(p[2], i)};
    return lattice(tables, scaled, 2002);
}

double reference_fbm(const struct recipe *tables, const double p[3], int octaves) {
    double sum = 0;
    for (int i = 0; i < octaves; i++)
        sum += ldexp(octave(tables, p, i), -i);
    return sum;
}

double reference_turbulence(const struct recipe *tables, const double p[3], int octaves) {
    double sum = 0;
    for (int i = 0; i < octaves; i++)
        sum += ldexp(fabs(octave(tables, p, i)), -i);
    return sum;
}

double reference_ridged(const struct recipe *tables, const double p[3], int octaves) {
    double sum = 0, most = 0;
    for (int i = 0; i < octaves; i++) {
        sum += ldexp(pow(1 - fabs(octave(tables, p, i)), 2), -i);
        most += ldexp(1, -i);
    }
    return sum / most;
}

// ---- Worley's points
// -----------------------------------------------------------------------------

static uint32_t scramble(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

// Poisson's distribution with mean 4, in steps of 1/256, but at least one and at most nine.
static int points_in_cell(uint32_t hash) {
    double probability = exp(-4), sum = probability;
    for (int k = 1; k < 9; k++) {
        probability *= 4.0 / k;
        sum += probability;
        if ((hash >> 24) < round(256 * sum))
            return k;
    }
    return 9;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double reference_worley(const struct recipe *tables, const double p[3], int nth) {
    double distances[27 * 9];
    size_t count = 0;
    for (int c = 0; c < 27; c++) {
        int cell[3] = {(int)floor(p[0]) + c % 3 - 1, (int)floor(p[1]) + c / 3 % 3 - 1,
                       (int)floor(p[2]) + c / 9 - 1};
        uint32_t hash = scramble(tables->seed);
        for (int axis = 2; axis >= 0; axis--)
            hash = scramble((uint32_t)cell[axis] + hash);
        int points = points_in_cell(hash);
        for (int i = 0; i < points; i++) {
            double sum = 0;
            for (int axis = 0; axis < 3; axis++) {
                uint32_t random = scramble(hash + 3 * (uint32_t)i + (uint32_t)axis + 1) >> 8;
                sum += pow(cell[axis] + random / 16777216.0 - p[axis], 2);
            }
            distances[count++] = sqrt(sum);
        }
    }
    qsort(distances, count, sizeof *distances, ascending);
    return distances[nth - 1];
}
