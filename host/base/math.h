// math.h - the few double-precision vectors and affine matrices the host needs. cglm has floats
// only, and a NIfTI sform rounded to float puts a 512-voxel volume off by a hundredth of a voxel.
#ifndef PEL_BASE_MATH_H
#define PEL_BASE_MATH_H

#include "pellucid.h"

#define PEL_PI 3.14159265358979323846

struct pel_matrix pel_matrix_identity(void);
struct pel_matrix pel_matrix_scaling(const double scale[3]);
struct pel_matrix pel_matrix_translation(const double offset[3]);

// a * b: first b, then a.
struct pel_matrix pel_matrix_multiply(const struct pel_matrix *a, const struct pel_matrix *b);

// The inverse of an affine matrix; false (ARGUMENT) when it is singular or not finite.
bool pel_matrix_invert(struct pel_matrix *inverse, const struct pel_matrix *matrix);

// The rotation of a quaternion x, y, z, w (any length but zero) followed by a translation.
struct pel_matrix pel_matrix_from_quaternion(const double xyzw[4], const double translation[3]);

// Determinant of the upper left 3x3.
double pel_matrix_determinant(const struct pel_matrix *matrix);

// How far the upper left 3x3 is from a rotation, which may mirror: the greatest element of
// R R^T - 1. NaN when it is not finite.
double pel_matrix_deviation(const struct pel_matrix *matrix);

// True when the upper left 3x3 is a proper rotation within `tolerance` per element of R R^T.
bool pel_matrix_is_rigid(const struct pel_matrix *matrix, double tolerance);

// p = matrix * point, and d = matrix * direction (no translation). `out` may be the input.
void pel_matrix_point(double out[3], const struct pel_matrix *matrix, const double point[3]);
void pel_matrix_direction(double out[3], const struct pel_matrix *matrix,
                          const double direction[3]);

double pel_dot(const double a[3], const double b[3]);
void pel_cross(double out[3], const double a[3], const double b[3]);
double pel_length(const double a[3]);

// Makes a unit vector of `a` in place; false when its length is zero or not finite.
bool pel_normalize(double a[3]);

#endif
