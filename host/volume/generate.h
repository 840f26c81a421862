// generate.h - inside the volume module: what a kind of synthetic volume has to tell.
//
// A kind is a field over millimetres around the origin and one function that samples a row of it.
// generate.c makes the grid, asks for the rows one after the other and stores them in the type
// that was asked for.
#ifndef PEL_VOLUME_GENERATE_H
#define PEL_VOLUME_GENERATE_H

#include "pellucid.h"

// `count` samples at start + i * (spacing[0], 0, 0), which are centres of cells of that spacing.
struct pel_generate_row {
    double start[3], spacing[3]; // millimetres
    int count;
};

// Each writes `row->count` values.
void pel_generate_sphere(const struct pel_generate_row *row, float *values);
void pel_generate_box(const struct pel_generate_row *row, float *values);
void pel_generate_shells(const struct pel_generate_row *row, float *values);
void pel_generate_marschner_lobb(const struct pel_generate_row *row, float *values);
void pel_generate_c60(const struct pel_generate_row *row, float *values);
void pel_generate_hydrogen(const struct pel_generate_row *row, float *values);
void pel_generate_shepp_logan(const struct pel_generate_row *row, float *values);
void pel_generate_head_ct(const struct pel_generate_row *row, float *values);
void pel_generate_head_labels(const struct pel_generate_row *row, float *values);
void pel_generate_head_mri(const struct pel_generate_row *row, float *values);

// Sizes that the fields have in millimetres, where others need them.
#define PEL_SPHERE_RADIUS_MM 24.0
#define PEL_MARSCHNER_LOBB_UNIT_MM 32.0
#define PEL_SHEPP_LOGAN_UNIT_MM 100.0
#define PEL_C60_ANGSTROM_MM 10.0
#define PEL_C60_BOND_ANGSTROM 1.4
#define PEL_HYDROGEN_BOHR_MM 2.0

// The centres of the carbon atoms, in millimetres.
#define PEL_C60_ATOMS 60
void pel_generate_c60_atoms(double atoms[PEL_C60_ATOMS][3]);

// The rigid transform, world from world, that moves "head-mri" onto "head-ct".
struct pel_matrix pel_generate_head_pair_truth(void);

#endif
