// quaternion.h - rotations as unit quaternions x, y, z, w, for what turns gradually.
#ifndef PEL_BASE_QUATERNION_H
#define PEL_BASE_QUATERNION_H

#include "pellucid.h"

// The rotation about an axis of any length but zero.
void pel_quaternion_from_axis(double xyzw[4], const double axis[3], double radians);

// The rotation in the upper left 3x3 of a rigid matrix.
void pel_quaternion_from_matrix(double xyzw[4], const struct pel_matrix *matrix);

// The rotation at `share` of the way from a to b, at constant speed along the shorter way
// (Shoemake 1985, "Animating rotation with quaternion curves"). All are of length 1.
void pel_quaternion_slerp(double xyzw[4], const double a[4], const double b[4], double share);

#endif
