// math.c - double-precision vectors and affine matrices.
#include "base/math.h"

#include <math.h>
#include <string.h>

#include "base/error.h"

struct pel_matrix pel_matrix_identity(void) {
    return (struct pel_matrix){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

struct pel_matrix pel_matrix_scaling(const double scale[3]) {
    struct pel_matrix matrix = pel_matrix_identity();
    for (int i = 0; i < 3; i++)
        matrix.m[i][i] = scale[i];
    return matrix;
}

struct pel_matrix pel_matrix_translation(const double offset[3]) {
    struct pel_matrix matrix = pel_matrix_identity();
    for (int i = 0; i < 3; i++)
        matrix.m[i][3] = offset[i];
    return matrix;
}

struct pel_matrix pel_matrix_multiply(const struct pel_matrix *a, const struct pel_matrix *b) {
    struct pel_matrix product;
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) {
            double sum = 0;
            for (int i = 0; i < 4; i++)
                sum += a->m[row][i] * b->m[i][column];
            product.m[row][column] = sum;
        }
    }
    return product;
}

double pel_matrix_determinant(const struct pel_matrix *matrix) {
    double cross[3];
    pel_cross(cross, matrix->m[1], matrix->m[2]);
    return pel_dot(matrix->m[0], cross);
}

bool pel_matrix_invert(struct pel_matrix *inverse, const struct pel_matrix *matrix) {
    double determinant = pel_matrix_determinant(matrix);
    if (!isfinite(determinant) || fabs(determinant) < 1e-30)
        return pel_fail(PEL_ERROR_ARGUMENT, "matrix is singular");

    // The rows of the inverse's 3x3 are the cross products of the columns, over the determinant.
    double columns[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            columns[i][j] = matrix->m[j][i];
    struct pel_matrix result = pel_matrix_identity();
    for (int i = 0; i < 3; i++) {
        double row[3];
        pel_cross(row, columns[(i + 1) % 3], columns[(i + 2) % 3]);
        for (int j = 0; j < 3; j++)
            result.m[i][j] = row[j] / determinant;
    }
    double translation[3] = {matrix->m[0][3], matrix->m[1][3], matrix->m[2][3]};
    pel_matrix_direction(translation, &result, translation);
    for (int i = 0; i < 3; i++) {
        result.m[i][3] = -translation[i];
        if (!isfinite(pel_dot(result.m[i], result.m[i]) + translation[i]))
            return pel_fail(PEL_ERROR_ARGUMENT, "matrix is not finite");
    }
    *inverse = result;
    return true;
}

struct pel_matrix pel_matrix_from_quaternion(const double xyzw[4], const double translation[3]) {
    double x = xyzw[0], y = xyzw[1], z = xyzw[2], w = xyzw[3];
    double s = 2 / (x * x + y * y + z * z + w * w);
    return (struct pel_matrix){{
        {1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), translation[0]},
        {s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w), translation[1]},
        {s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y), translation[2]},
        {0, 0, 0, 1},
    }};
}

double pel_matrix_deviation(const struct pel_matrix *matrix) {
    double worst = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            double off = fabs(pel_dot(matrix->m[i], matrix->m[j]) - (i == j));
            worst = isnan(worst) || off <= worst ? worst : off;
        }
    return worst;
}

bool pel_matrix_is_rigid(const struct pel_matrix *matrix, double tolerance) {
    return pel_matrix_deviation(matrix) <= tolerance && pel_matrix_determinant(matrix) > 0;
}

void pel_matrix_direction(double out[3], const struct pel_matrix *matrix,
                          const double direction[3]) {
    double result[3];
    for (int i = 0; i < 3; i++)
        result[i] = pel_dot(matrix->m[i], direction);
    memcpy(out, result, sizeof result);
}

void pel_matrix_point(double out[3], const struct pel_matrix *matrix, const double point[3]) {
    pel_matrix_direction(out, matrix, point);
    for (int i = 0; i < 3; i++)
        out[i] += matrix->m[i][3];
}

double pel_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void pel_cross(double out[3], const double a[3], const double b[3]) {
    double result[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                        a[0] * b[1] - a[1] * b[0]};
    memcpy(out, result, sizeof result);
}

double pel_length(const double a[3]) {
    return sqrt(pel_dot(a, a));
}

bool pel_normalize(double a[3]) {
    double length = pel_length(a);
    if (!isfinite(length) || length == 0)
        return false;
    for (int i = 0; i < 3; i++)
        a[i] /= length;
    return true;
}
