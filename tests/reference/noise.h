// noise.h - the noises of hypertextures in double precision, written to be read beside their
// sources.
//
// Tables come from pel_recipe_seed. docs/hypertexture.md has the formulae.
#ifndef REFERENCE_NOISE_H
#define REFERENCE_NOISE_H

#include "shared/recipe.h"

// Perlin 2002 ("Improving Noise") and Perlin 1985 ("An Image Synthesizer").
double reference_noise_2002(const struct recipe *tables, const double p[3]);
double reference_noise_1985(const struct recipe *tables, const double p[3]);

// Sums of the former: of noise, of its absolute value, and of squared ridges as a share of the
// most.
double reference_fbm(const struct recipe *tables, const double p[3], int octaves);
double reference_turbulence(const struct recipe *tables, const double p[3], int octaves);
double reference_ridged(const struct recipe *tables, const double p[3], int octaves);

// The distance to the `nth` nearest of the random points in the 27 cells around (Worley 1996).
double reference_worley(const struct recipe *tables, const double p[3], int nth);

#endif
