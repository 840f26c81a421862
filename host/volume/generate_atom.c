// generate_atom.c - electrons: a buckyball of 60 atoms, and a hydrogen orbital.
//
// The atoms of C60 are the vertices of a truncated icosahedron. With g the golden ratio and edge
// length 2 they are the even permutations of
//
//     (0, +-1, +-3g)     12 vertices
//     (+-1, +-(2 + g), +-2g)     24
//     (+-g, +-2, +-(2g + 1))     24
//
// All edges are drawn 1.4 Angstrom long; in the molecule the two kinds of bond are 1.40 and 1.45.
// Each atom is a Gaussian that holds 6 electrons, so a voxel is electrons per cubic Angstrom and
// the volume's integral is 360. This is the simulated buckyball of Romero, "CUDA accelerated
// volume ray casting" (2009).
#include "volume/generate.h"

#include <math.h>

#include "base/math.h"

static const double golden = 1.61803398874989484820;

// Writes all sign variants of the three even permutations of `vertex`; zeros have one sign.
static int signed_permutations(const double vertex[3], double scale, double (*out)[3]) {
    int count = 0;
    for (int turn = 0; turn < 3; turn++) {
        for (int signs = 0; signs < 8; signs++) {
            if (vertex[0] == 0 && signs & 1)
                continue;
            for (int c = 0; c < 3; c++)
                out[count][(c + turn) % 3] = (signs >> c & 1 ? -scale : scale) * vertex[c];
            count++;
        }
    }
    return count;
}

void pel_generate_c60_atoms(double atoms[PEL_C60_ATOMS][3]) {
    const double vertices[3][3] = {
        {0, 1, 3 * golden}, {1, 2 + golden, 2 * golden}, {golden, 2, 2 * golden + 1}};
    const double scale = PEL_C60_BOND_ANGSTROM / 2 * PEL_C60_ANGSTROM_MM;
    int count = 0;
    for (int i = 0; i < 3; i++)
        count += signed_permutations(vertices[i], scale, atoms + count);
}

// Adds height * exp(-(x_i - centre)^2 / (2 deviation^2)) for the samples within `reach` of the
// centre. Along a row the ratio of neighbouring samples is itself a geometric sequence, which
// costs two multiplications a sample instead of an exponential.
static void add_gaussian(const struct pel_generate_row *row, double centre, double deviation,
                         double reach, double height, double *sums) {
    double h = row->spacing[0];
    int first = (int)fmax(ceil((centre - reach - row->start[0]) / h), 0);
    int last = (int)fmin(floor((centre + reach - row->start[0]) / h), row->count - 1);
    double s2 = deviation * deviation, x = row->start[0] + first * h - centre;
    double value = height * exp(-x * x / (2 * s2));
    double ratio = exp(-(2 * x * h + h * h) / (2 * s2)), ratio_ratio = exp(-h * h / s2);
    for (int i = first; i <= last; i++) {
        sums[i] += value;
        value *= ratio;
        ratio *= ratio_ratio;
    }
}

void pel_generate_c60(const struct pel_generate_row *row, float *values) {
    const double deviation_angstrom = 0.5, electrons = 6;
    const double deviation = deviation_angstrom * PEL_C60_ANGSTROM_MM, reach = 5 * deviation;
    const double peak = electrons / pow(deviation_angstrom * sqrt(2 * PEL_PI), 3);
    double atoms[PEL_C60_ATOMS][3];
    pel_generate_c60_atoms(atoms);

    enum { CHUNK = 256 };
    for (int done = 0; done < row->count; done += CHUNK) {
        struct pel_generate_row part = *row;
        part.start[0] += done * row->spacing[0];
        part.count = row->count - done < CHUNK ? row->count - done : CHUNK;
        double sums[CHUNK] = {0};
        for (int atom = 0; atom < PEL_C60_ATOMS; atom++) {
            double y = row->start[1] - atoms[atom][1], z = row->start[2] - atoms[atom][2];
            double d2 = y * y + z * z;
            if (d2 > reach * reach)
                continue;
            add_gaussian(&part, atoms[atom][0], deviation, reach,
                         peak * exp(-d2 / (2 * deviation * deviation)), sums);
        }
        for (int i = 0; i < part.count; i++)
            values[done + i] = (float)sums[i];
    }
}

// |psi|^2 of hydrogen's orbital 3d_z2 (n = 3, l = 2, m = 0), per cubic Bohr radius: a ring around
// two lobes. With r in Bohr radii, psi = (3 z^2 - r^2) exp(-r / 3) / (81 sqrt(6 pi)).
void pel_generate_hydrogen(const struct pel_generate_row *row, float *values) {
    const double norm = 1 / (81.0 * 81.0 * 6 * PEL_PI);
    double y = row->start[1] / PEL_HYDROGEN_BOHR_MM, z = row->start[2] / PEL_HYDROGEN_BOHR_MM;
    for (int i = 0; i < row->count; i++) {
        double x = (row->start[0] + i * row->spacing[0]) / PEL_HYDROGEN_BOHR_MM;
        double r2 = x * x + y * y + z * z, angular = 3 * z * z - r2;
        values[i] = (float)(norm * angular * angular * exp(-2.0 / 3 * sqrt(r2)));
    }
}
