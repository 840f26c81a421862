// vector.h - the double-precision vectors, quaternions and affine matrices the viewer's arithmetic
// needs. Everything is inline: the viewer is a client of the library and sees nothing of its
// inside.
//
// Results come first, as in `a = b + c`, and may be one of the arguments. Quaternions are x, y, z,
// w.
#ifndef PEL_VIEWER_VECTOR_H
#define PEL_VIEWER_VECTOR_H

#include <math.h>
#include <stdbool.h>

#include "pellucid.h"

#define VECTOR_PI 3.14159265358979323846

static inline double radians(double degrees) {
    return degrees * VECTOR_PI / 180;
}

static inline void vector_set(double out[3], const double a[3]) {
    double x = a[0], y = a[1], z = a[2];
    out[0] = x, out[1] = y, out[2] = z;
}

static inline void vector_add(double out[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[i] + b[i];
}

static inline void vector_subtract(double out[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

// out = a + scale * b
static inline void vector_add_scaled(double out[3], const double a[3], double scale,
                                     const double b[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[i] + scale * b[i];
}

static inline void vector_scale(double out[3], const double a[3], double scale) {
    for (int i = 0; i < 3; i++)
        out[i] = scale * a[i];
}

static inline double vector_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vector_cross(double out[3], const double a[3], const double b[3]) {
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    double z = a[0] * b[1] - a[1] * b[0];
    out[0] = x, out[1] = y, out[2] = z;
}

static inline double vector_length(const double a[3]) {
    return hypot(hypot(a[0], a[1]), a[2]);
}

static inline double vector_distance(const double a[3], const double b[3]) {
    return vector_length((double[]){a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

// Makes a unit vector of `a`; false, with `a` as it was, when it has no length.
static inline bool vector_normalize(double a[3]) {
    double length = vector_length(a);
    if (!(length > 0) || !isfinite(length))
        return false;
    vector_scale(a, a, 1 / length);
    return true;
}

// A turn by an angle about a unit vector, counter-clockwise when it points to the viewer.
static inline void quaternion_turn(double out[4], const double axis[3], double angle_rad) {
    double sine = sin(angle_rad / 2);
    for (int i = 0; i < 3; i++)
        out[i] = sine * axis[i];
    out[3] = cos(angle_rad / 2);
}

// v turned by the unit quaternion q: v + 2 w (q x v) + 2 q x (q x v).
static inline void quaternion_rotate(double out[3], const double q[4], const double v[3]) {
    double once[3], twice[3];
    vector_cross(once, q, v);
    vector_cross(twice, q, once);
    for (int i = 0; i < 3; i++)
        out[i] = v[i] + 2 * (q[3] * once[i] + twice[i]);
}

static inline void matrix_point(double out[3], const struct pel_matrix *matrix, const double p[3]) {
    double result[3];
    for (int i = 0; i < 3; i++)
        result[i] = vector_dot(matrix->m[i], p) + matrix->m[i][3];
    vector_set(out, result);
}

static inline void matrix_direction(double out[3], const struct pel_matrix *matrix,
                                    const double d[3]) {
    double result[3];
    for (int i = 0; i < 3; i++)
        result[i] = vector_dot(matrix->m[i], d);
    vector_set(out, result);
}

// a * b: first b, then a.
static inline struct pel_matrix matrix_multiply(const struct pel_matrix *a,
                                                const struct pel_matrix *b) {
    struct pel_matrix product = {.m[3] = {0, 0, 0, 1}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 4; j++) {
            product.m[i][j] = j == 3 ? a->m[i][3] : 0;
            for (int k = 0; k < 3; k++)
                product.m[i][j] += a->m[i][k] * b->m[k][j];
        }
    }
    return product;
}

// The inverse of an affine matrix by its cofactors; false when it is singular.
static inline bool matrix_invert(struct pel_matrix *inverse, const struct pel_matrix *matrix) {
    const double(*m)[4] = matrix->m;
    double columns[3][3], rows[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            columns[j][i] = m[i][j];
    vector_cross(rows[0], columns[1], columns[2]);
    vector_cross(rows[1], columns[2], columns[0]);
    vector_cross(rows[2], columns[0], columns[1]);
    double determinant = vector_dot(columns[0], rows[0]);
    if (determinant == 0 || !isfinite(determinant))
        return false;
    double offset[3] = {m[0][3], m[1][3], m[2][3]};
    *inverse = (struct pel_matrix){.m[3] = {0, 0, 0, 1}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            inverse->m[i][j] = rows[i][j] / determinant;
        inverse->m[i][3] = -vector_dot(inverse->m[i], offset);
    }
    return true;
}

#endif
