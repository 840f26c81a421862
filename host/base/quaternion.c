// quaternion.c - rotations as unit quaternions.
#include "base/quaternion.h"

#include <math.h>

#include "base/math.h"

// Closer together than this, two rotations are mixed along the chord: the sines below vanish.
static const double nearly_same = 1 - 1e-12;

static void make_unit(double xyzw[4]) {
    double length = sqrt(pel_dot(xyzw, xyzw) + xyzw[3] * xyzw[3]);
    for (int i = 0; i < 4; i++)
        xyzw[i] /= length;
}

void pel_quaternion_from_axis(double xyzw[4], const double axis[3], double radians) {
    double length = pel_length(axis);
    for (int i = 0; i < 3; i++)
        xyzw[i] = axis[i] / length * sin(radians / 2);
    xyzw[3] = cos(radians / 2);
}

// 4 q_a q_b are sums and differences of the matrix's elements; of the four rows of such products
// the one with the greatest square divides best (Shepperd 1978).
void pel_quaternion_from_matrix(double xyzw[4], const struct pel_matrix *matrix) {
    const double(*m)[4] = matrix->m;
    double squares[4] = {1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                         1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2]};
    double xy = m[0][1] + m[1][0], xz = m[0][2] + m[2][0], yz = m[1][2] + m[2][1];
    double xw = m[2][1] - m[1][2], yw = m[0][2] - m[2][0], zw = m[1][0] - m[0][1];
    const double rows[4][4] = {{squares[0], xy, xz, xw},
                               {xy, squares[1], yz, yw},
                               {xz, yz, squares[2], zw},
                               {xw, yw, zw, squares[3]}};
    int best = 0;
    for (int i = 1; i < 4; i++)
        if (squares[i] > squares[best])
            best = i;
    for (int i = 0; i < 4; i++)
        xyzw[i] = rows[best][i];
    make_unit(xyzw);
}

void pel_quaternion_slerp(double xyzw[4], const double a[4], const double b[4], double share) {
    double cosine = pel_dot(a, b) + a[3] * b[3];
    // A quaternion and its negative are one rotation; the nearer of the two is meant.
    double sign = cosine < 0 ? -1 : 1, along_a = 1 - share, along_b = share;
    if (sign * cosine < nearly_same) {
        double angle = acos(sign * cosine);
        along_a = sin((1 - share) * angle) / sin(angle);
        along_b = sin(share * angle) / sin(angle);
    }
    double mixed[4];
    for (int i = 0; i < 4; i++)
        mixed[i] = along_a * a[i] + along_b * sign * b[i];
    make_unit(mixed);
    for (int i = 0; i < 4; i++)
        xyzw[i] = mixed[i];
}
