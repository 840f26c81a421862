// vtk_curve.c - mixing colours as vtkColorTransferFunction does and opacities as
// vtkPiecewiseFunction does.
//
// CIELAB has the white point (0.9505, 1, 1.089). Diverging is Moreland 2009, "Diverging color maps
// for scientific visualization": Msh is Lab in polar form (M the length, s the saturation as an
// angle from the grey axis, h the hue), and between two saturated colours of different hue lies a
// white.
#include "transfer/vtk_curve.h"

#include <math.h>
#include <stdbool.h>

#include "base/math.h"

static const double white[3] = {0.9505, 1, 1.089};

static const double xyz_from_rgb[3][3] = {
    {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};

static const double rgb_from_xyz[3][3] = {
    {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};

static double linear_from_srgb(double c) {
    return c > 0.04045 ? pow((c + 0.055) / 1.055, 2.4) : c / 12.92;
}

static double srgb_from_linear(double c) {
    return c > 0.0031308 ? 1.055 * pow(c, 1 / 2.4) - 0.055 : 12.92 * c;
}

static void lab_from_rgb(double lab[3], const double rgb[3]) {
    double linear[3], f[3];
    for (int i = 0; i < 3; i++)
        linear[i] = linear_from_srgb(rgb[i]);
    for (int i = 0; i < 3; i++) {
        double t = pel_dot(xyz_from_rgb[i], linear) / white[i];
        f[i] = t > 0.008856 ? cbrt(t) : 7.787 * t + 16 / 116.0;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

// Colours outside the gamut are dimmed until no channel exceeds 1, and then clamped.
static void rgb_from_lab(double rgb[3], const double lab[3]) {
    double middle = (lab[0] + 16) / 116;
    double f[3] = {lab[1] / 500 + middle, middle, middle - lab[2] / 200}, xyz[3];
    for (int i = 0; i < 3; i++) {
        double cube = f[i] * f[i] * f[i];
        xyz[i] = white[i] * (cube > 0.008856 ? cube : (f[i] - 16 / 116.0) / 7.787);
    }
    double greatest = 1;
    for (int i = 0; i < 3; i++) {
        rgb[i] = srgb_from_linear(pel_dot(rgb_from_xyz[i], xyz));
        greatest = fmax(greatest, rgb[i]);
    }
    for (int i = 0; i < 3; i++)
        rgb[i] = fmax(0, rgb[i] / greatest);
}

static void msh_from_lab(double msh[3], const double lab[3]) {
    double length = pel_length(lab);
    double saturation = length > 0.001 ? acos(fmin(1, lab[0] / length)) : 0;
    msh[0] = length;
    msh[1] = saturation;
    msh[2] = saturation > 0.001 ? atan2(lab[2], lab[1]) : 0;
}

static void lab_from_msh(double lab[3], const double msh[3]) {
    lab[0] = msh[0] * cos(msh[1]);
    lab[1] = msh[0] * sin(msh[1]) * cos(msh[2]);
    lab[2] = msh[0] * sin(msh[1]) * sin(msh[2]);
}

static double hue_difference(double a, double b) {
    double difference = fmod(fabs(a - b), 2 * PEL_PI);
    return difference > PEL_PI ? 2 * PEL_PI - difference : difference;
}

// The hue an unsaturated colour of length `grey` should have beside a saturated one: turned a
// little, so that the path between them stays even.
static double hue_beside(const double msh[3], double grey) {
    if (msh[0] >= grey - 0.1)
        return msh[2];
    double turn = msh[1] * sqrt(grey * grey - msh[0] * msh[0]) / (msh[0] * sin(msh[1]));
    return msh[2] > -0.3 * PEL_PI ? msh[2] + turn : msh[2] - turn;
}

static void mix(double out[3], const double a[3], const double b[3], double share) {
    for (int i = 0; i < 3; i++)
        out[i] = (1 - share) * a[i] + share * b[i];
}

static void mix_diverging(double rgb[3], const double a[3], const double b[3], double share) {
    const double grey = 0.05;
    double lab[3], msh_a[3], msh_b[3], msh[3];
    lab_from_rgb(lab, a);
    msh_from_lab(msh_a, lab);
    lab_from_rgb(lab, b);
    msh_from_lab(msh_b, lab);

    // Put white in the middle, and look at the half that `share` is in.
    if (msh_a[1] > grey && msh_b[1] > grey && hue_difference(msh_a[2], msh_b[2]) > 0.33 * PEL_PI) {
        double *far = share < 0.5 ? msh_b : msh_a;
        far[0] = fmax(88, fmax(msh_a[0], msh_b[0]));
        far[1] = far[2] = 0;
        share = share < 0.5 ? 2 * share : 2 * share - 1;
    }
    if (msh_a[1] < grey && msh_b[1] > grey)
        msh_a[2] = hue_beside(msh_b, msh_a[0]);
    else if (msh_b[1] < grey && msh_a[1] > grey)
        msh_b[2] = hue_beside(msh_a, msh_b[0]);

    mix(msh, msh_a, msh_b, share);
    lab_from_msh(lab, msh);
    rgb_from_lab(rgb, lab);
}

static void mix_lab(double rgb[3], const double a[3], const double b[3], double share) {
    double lab_a[3], lab_b[3], lab[3];
    lab_from_rgb(lab_a, a);
    lab_from_rgb(lab_b, b);
    mix(lab, lab_a, lab_b, share);
    rgb_from_lab(rgb, lab);
}

static void hsv_from_rgb(double hsv[3], const double rgb[3]) {
    double most = fmax(rgb[0], fmax(rgb[1], rgb[2]));
    double least = fmin(rgb[0], fmin(rgb[1], rgb[2]));
    double range = most - least, sixths = 0;
    if (range > 0)
        sixths = most == rgb[0]   ? (rgb[1] - rgb[2]) / range
                 : most == rgb[1] ? 2 + (rgb[2] - rgb[0]) / range
                                  : 4 + (rgb[0] - rgb[1]) / range;
    hsv[0] = (sixths < 0 ? sixths + 6 : sixths) / 6;
    hsv[1] = most > 0 ? range / most : 0;
    hsv[2] = most;
}

static void rgb_from_hsv(double rgb[3], const double hsv[3]) {
    for (int i = 0; i < 3; i++) {
        // Each channel is full for two sixths round its hue, and falls to nothing over one more.
        double away = fabs(fmod(6 * hsv[0] + 9 - 2 * i, 6) - 3);
        double part = fmin(fmax(2 - away, 0), 1);
        rgb[i] = hsv[2] * (1 - hsv[1] * (1 - part));
    }
}

static void mix_hsv(double rgb[3], const double a[3], const double b[3], double share, bool wrap) {
    double hsv_a[3], hsv_b[3], hsv[3];
    hsv_from_rgb(hsv_a, a);
    hsv_from_rgb(hsv_b, b);
    if (wrap && fabs(hsv_a[0] - hsv_b[0]) > 0.5)
        *(hsv_a[0] > hsv_b[0] ? hsv_a : hsv_b) -= 1;
    mix(hsv, hsv_a, hsv_b, share);
    hsv[0] += hsv[0] < 0 ? 1 : 0;
    rgb_from_hsv(rgb, hsv);
}

void pel_vtk_colour(double rgb[3], enum pel_vtk_space space, const double a[3], const double b[3],
                    double share) {
    switch (space) {
    case PEL_VTK_RGB:
        mix(rgb, a, b, share);
        break;
    case PEL_VTK_HSV:
    case PEL_VTK_HSV_WRAP:
        mix_hsv(rgb, a, b, share, space == PEL_VTK_HSV_WRAP);
        break;
    case PEL_VTK_LAB:
        mix_lab(rgb, a, b, share);
        break;
    case PEL_VTK_DIVERGING:
        mix_diverging(rgb, a, b, share);
        break;
    case PEL_VTK_STEP:
        mix(rgb, b, b, 0);
        break;
    }
    for (int i = 0; i < 3; i++)
        rgb[i] = fmin(fmax(rgb[i], 0), 1);
}

double pel_vtk_opacity(double a, double b, double midpoint, double sharpness, double share) {
    // Move the midpoint to one half.
    midpoint = fmin(fmax(midpoint, 1e-5), 1 - 1e-5);
    double s =
        share < midpoint ? 0.5 * share / midpoint : 0.5 + 0.5 * (share - midpoint) / (1 - midpoint);
    if (sharpness > 0.99)
        return s < 0.5 ? a : b;
    if (sharpness < 0.01)
        return (1 - s) * a + s * b;

    // Squeeze the curve towards the middle, then take a Hermite curve with flatter and flatter
    // ends.
    double power = 1 + 10 * sharpness;
    s = s < 0.5 ? 0.5 * pow(2 * s, power) : 1 - 0.5 * pow(2 * (1 - s), power);
    double ss = s * s, sss = ss * s;
    double tangent = (1 - sharpness) * (b - a);
    double y = (2 * sss - 3 * ss + 1) * a + (3 * ss - 2 * sss) * b + (sss - 2 * ss + s) * tangent +
               (sss - ss) * tangent;
    return fmin(fmax(y, fmin(a, b)), fmax(a, b));
}
