// stereo.c - anaglyphs, matrix by matrix.
#include "reference/stereo.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define Y 0.299, 0.587, 0.114
#define O 0, 0, 0

// Rows of red, green and blue; the left eye's three columns, then the right eye's.
static const struct {
    const char *name;
    double matrix[3][6];
} anaglyphs[] = {
    {"true-red-cyan", {{Y, O}, {O, O}, {O, Y}}},
    {"true-green-magenta", {{O, Y}, {Y, O}, {O, O}}},
    {"true-amber-blue", {{Y, O}, {O, O}, {O, Y}}},
    {"grey-red-cyan", {{Y, O}, {O, Y}, {O, Y}}},
    {"grey-green-magenta", {{O, Y}, {Y, O}, {O, Y}}},
    {"grey-amber-blue", {{Y, O}, {Y, O}, {O, Y}}},
    {"colour-red-cyan", {{1, 0, 0, O}, {O, 0, 1, 0}, {O, 0, 0, 1}}},
    {"colour-green-magenta", {{O, 1, 0, 0}, {0, 1, 0, O}, {O, 0, 0, 1}}},
    {"colour-amber-blue", {{1, 0, 0, O}, {0, 1, 0, O}, {O, 0, 0, 1}}},
    {"half-colour-red-cyan", {{Y, O}, {O, 0, 1, 0}, {O, 0, 0, 1}}},
    {"half-colour-green-magenta", {{O, 1, 0, 0}, {Y, O}, {O, 0, 0, 1}}},
    {"half-colour-amber-blue", {{1, 0, 0, O}, {0, 1, 0, O}, {O, Y}}},
    {"optimised-red-cyan", {{0, 0.7, 0.3, O}, {O, 0, 1, 0}, {O, 0, 0, 1}}},
    {"optimised-green-magenta", {{O, 1, 0, 0}, {0.7, 0, 0.3, O}, {O, 0, 0, 1}}},
    {"optimised-amber-blue", {{1, 0, 0, O}, {0, 1, 0, O}, {O, 0.3, 0.7, 0}}},
    {"dubois-red-cyan",
     {{0.437, 0.449, 0.164, -0.011, -0.032, -0.007},
      {-0.062, -0.062, -0.024, 0.377, 0.761, 0.009},
      {-0.048, -0.050, -0.017, -0.026, -0.093, 1.234}}},
    {"dubois-green-magenta",
     {{-0.062, -0.158, -0.039, 0.529, 0.705, 0.024},
      {0.284, 0.668, 0.143, -0.016, -0.015, -0.065},
      {-0.015, -0.027, 0.021, 0.009, 0.075, 0.937}}},
    {"dubois-amber-blue",
     {{1.062, -0.205, 0.299, -0.016, -0.123, -0.017},
      {-0.026, 0.908, 0.068, 0.006, 0.062, -0.017},
      {-0.038, -0.173, 0.022, 0.094, 0.185, 0.911}}},
    {"red-blue", {{Y, O}, {O, O}, {O, Y}}},
    {"red-green", {{Y, O}, {O, Y}, {O, O}}},
    {"thesis", {{O, 0.5, 0, 0}, {0, 0.5, 0, O}, {0, 0, 0.5, O}}},
};

static double decode(double value) {
    value = fmin(fmax(value, 0), 1);
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static double encode(double light) {
    light = fmin(fmax(light, 0), 1);
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
}

static const double (*find_matrix(const struct pel_stereo *stereo))[6] {
    if (stereo->kind == PEL_STEREO_MATRIX)
        return stereo->matrix;
    const char *name = pel_stereo_names()[stereo->kind];
    for (size_t i = 0; i < sizeof anaglyphs / sizeof *anaglyphs; i++)
        if (strcmp(anaglyphs[i].name, name) == 0)
            return anaglyphs[i].matrix;
    abort();
}

void reference_anaglyph(double rgba[4], const struct pel_stereo *stereo, const double left[4],
                        const double right[4]) {
    const double(*matrix)[6] = find_matrix(stereo);
    bool linear = stereo->kind != PEL_STEREO_THESIS;
    double alpha = fmax(left[3], right[3]);
    for (int row = 0; row < 3; row++) {
        double sum = 0;
        for (int column = 0; column < 6; column++) {
            const double *eye = column < 3 ? left : right;
            double straight = eye[3] > 0 ? eye[column % 3] / eye[3] : 0;
            sum += matrix[row][column] * eye[3] * (linear ? decode(straight) : straight);
        }
        double straight = alpha > 0 ? sum / alpha : 0;
        rgba[row] = alpha * (linear ? encode(straight) : fmin(fmax(straight, 0), 1));
    }
    rgba[3] = alpha;
}
