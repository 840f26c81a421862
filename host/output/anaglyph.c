// anaglyph.c - two pictures through one pair of coloured glasses.
//
// A 3 x 6 matrix makes red, green and blue of those of both eyes: three columns for the left eye's,
// three for the right one's. It acts on linear light, so colours are decoded and encoded by the
// curve of sRGB (IEC 61966-2-1). But for Dubois's, which he fitted to measured filters and screens
// (Dubois 2001; values of his web page, 2009), the matrices follow from what the lenses let through
// and from a method (Wimmer, "Anaglyph methods comparison"; Woods & Harris 2010 for the glasses):
//
//     grey         each channel shows the luminance of the eye that sees it
//     true         so, but only one channel for each eye, which separates best; the third is dark
//     colour       each channel is that of the eye that sees it
//     half-colour  so, but the eye with one channel gets luminance, which is calmer in saturated
//                  red, green or blue
//     optimised    so, but the eye with one channel gets 0.7 and 0.3 of its own other two
//
// A channel's row sums to 1 over both eyes (unless it is dark), so white stays white.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "output/image.h"
#include "output/stereo.h"

enum { LEFT, RIGHT, RED = 0, GREEN, BLUE };

// Decoding is smooth; encoding bends sharply near black, but much less as a function of the square
// root of light. Straight lines between so many entries are within 1e-6 of both curves, and all of
// them stay in the first cache.
enum { DECODE_CELLS = 1024, ENCODE_CELLS = 2048 };

// The last entry of each is there twice, so that 1 needs no care.
struct curves {
    float decode[DECODE_CELLS + 2], encode[ENCODE_CELLS + 2];
};

// Weights of luminance in the cited methods (ITU-R BT.601).
static const double luminance[3] = {0.299, 0.587, 0.114};

static const struct glasses {
    int eye[3];        // which eye sees red, green, blue
    int single;        // the channel that is alone in its eye
    int dark;          // the channel that `true` leaves out
    int bright, faint; // the other two, for `optimised`: of 0.7 and of 0.3
} all_glasses[] = {
    {{LEFT, RIGHT, RIGHT}, RED, GREEN, GREEN, BLUE}, // red-cyan
    {{RIGHT, LEFT, RIGHT}, GREEN, BLUE, RED, BLUE},  // green-magenta
    {{LEFT, LEFT, RIGHT}, BLUE, GREEN, GREEN, RED},  // amber-blue
};
static const struct glasses red_green = {{LEFT, RIGHT, RIGHT}, RED, BLUE, GREEN, BLUE};

// In the order of the glasses.
static const double dubois[3][3][6] = {
    {{0.437, 0.449, 0.164, -0.011, -0.032, -0.007},
     {-0.062, -0.062, -0.024, 0.377, 0.761, 0.009},
     {-0.048, -0.050, -0.017, -0.026, -0.093, 1.234}},
    {{-0.062, -0.158, -0.039, 0.529, 0.705, 0.024},
     {0.284, 0.668, 0.143, -0.016, -0.015, -0.065},
     {-0.015, -0.027, 0.021, 0.009, 0.075, 0.937}},
    {{1.062, -0.205, 0.299, -0.016, -0.123, -0.017},
     {-0.026, 0.908, 0.068, 0.006, 0.062, -0.017},
     {-0.038, -0.173, 0.022, 0.094, 0.185, 0.911}},
};

// Romero's figure 5.16: the left eye's cyan and the right eye's red, averaged.
static const double thesis[3][6] = {
    {0, 0, 0, 0.5, 0, 0}, {0, 0.5, 0, 0, 0, 0}, {0, 0, 0.5, 0, 0, 0}};

enum method { TRUE, GREY, COLOUR, HALF_COLOUR, OPTIMISED };

static void make_matrix(double matrix[3][6], enum method method, const struct glasses *glasses) {
    memset(matrix, 0, 3 * sizeof *matrix);
    for (int channel = 0; channel < 3; channel++) {
        double *row = matrix[channel] + 3 * glasses->eye[channel];
        bool single = channel == glasses->single;
        if (method == TRUE && channel == glasses->dark)
            continue;
        if (method == TRUE || method == GREY || (method == HALF_COLOUR && single)) {
            memcpy(row, luminance, sizeof luminance);
        } else if (method == OPTIMISED && single) {
            row[glasses->bright] = 0.7;
            row[glasses->faint] = 0.3;
        } else {
            row[channel] = 1;
        }
    }
}

static struct curves *make_curves(void) {
    struct curves *curves = pel_allocate(1, sizeof *curves);
    if (!curves)
        return NULL;
    for (int i = 0; i <= DECODE_CELLS; i++) {
        double value = (double)i / DECODE_CELLS;
        curves->decode[i] =
            (float)(value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4));
    }
    for (int i = 0; i <= ENCODE_CELLS; i++) {
        double root = (double)i / ENCODE_CELLS, light = root * root;
        curves->encode[i] =
            (float)(light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055);
    }
    curves->decode[DECODE_CELLS + 1] = curves->encode[ENCODE_CELLS + 1] = 1;
    return curves;
}

// fmaxf and fminf without their care for NaN, which costs a call.
static inline float greater(float a, float b) {
    return a > b ? a : b;
}

static inline float lesser(float a, float b) {
    return a < b ? a : b;
}

// The curve at a value that is clamped to 0..1; NaN counts as 0.
static inline float read_curve(const float *curve, int cells, float value) {
    float x = lesser(greater(value, 0), 1) * (float)cells;
    int cell = (int)x;
    return curve[cell] + (x - (float)cell) * (curve[cell + 1] - curve[cell]);
}

// Linear light of a premultiplied pixel, multiplied by its alpha.
static inline void decode(float light[3], const float rgba[4], const struct curves *curves) {
    float alpha = rgba[3], straighten = alpha > 0 ? 1 / alpha : 0;
    for (int c = 0; c < 3; c++)
        light[c] = alpha * read_curve(curves->decode, DECODE_CELLS, rgba[c] * straighten);
}

static inline float multiply(const float row[6], const float eyes[6]) {
    return row[0] * eyes[0] + row[1] * eyes[1] + row[2] * eyes[2] + row[3] * eyes[3] +
           row[4] * eyes[4] + row[5] * eyes[5];
}

// One pixel in linear light. The picture covers what either eye's does.
static inline void compose_linear(float out[4], const float left[4], const float right[4],
                                  const float matrix[3][6], const struct curves *curves) {
    float eyes[6], alpha = greater(left[3], right[3]), straighten = alpha > 0 ? 1 / alpha : 0;
    decode(eyes, left, curves);
    decode(eyes + 3, right, curves);
    for (int c = 0; c < 3; c++) {
        float root = sqrtf(greater(multiply(matrix[c], eyes) * straighten, 0));
        out[c] = alpha * read_curve(curves->encode, ENCODE_CELLS, root);
    }
    out[3] = alpha;
}

// One pixel of values as they are stored.
static inline void compose_stored(float out[4], const float left[4], const float right[4],
                                  const float matrix[3][6]) {
    const float eyes[6] = {left[0], left[1], left[2], right[0], right[1], right[2]};
    float alpha = greater(left[3], right[3]);
    for (int c = 0; c < 3; c++)
        out[c] = lesser(greater(multiply(matrix[c], eyes), 0), alpha);
    out[3] = alpha;
}

static inline bool same_as_last(const float *pixel) {
    return memcmp(pixel, pixel - 4, 4 * sizeof *pixel) == 0;
}

static bool check_matrix(const double matrix[3][6]) {
    static const char *const channels[] = {"red", "green", "blue"};
    for (int row = 0; row < 3; row++) {
        double sum = 0;
        for (int column = 0; column < 6; column++)
            sum += matrix[row][column];
        if (!isfinite(sum))
            return pel_fail(PEL_ERROR_ARGUMENT, "the stereo matrix's row of %s is not finite",
                            channels[row]);
        if (fabs(sum - 1) > 0.005)
            pel_warn("the stereo matrix's row of %s sums to %g, not 1: white does not stay white",
                     channels[row], sum);
    }
    return true;
}

bool pel_stereo_is_anaglyph(enum pel_stereo_kind kind) {
    return kind >= PEL_STEREO_TRUE_RED_CYAN && kind <= PEL_STEREO_MATRIX;
}

bool pel_anaglyph_matrix(const struct pel_stereo *stereo, double matrix[3][6]) {
    enum pel_stereo_kind kind = stereo->kind;
    int glasses = (int)(kind - PEL_STEREO_TRUE_RED_CYAN) % 3;
    int method = (int)(kind - PEL_STEREO_TRUE_RED_CYAN) / 3;
    if (kind == PEL_STEREO_RED_BLUE)
        make_matrix(matrix, TRUE, &all_glasses[0]);
    else if (kind == PEL_STEREO_RED_GREEN)
        make_matrix(matrix, TRUE, &red_green);
    else if (kind == PEL_STEREO_THESIS)
        memcpy(matrix, thesis, sizeof thesis);
    else if (kind == PEL_STEREO_MATRIX)
        memcpy(matrix, stereo->matrix, sizeof stereo->matrix);
    else if (kind >= PEL_STEREO_DUBOIS_RED_CYAN)
        memcpy(matrix, dubois[glasses], sizeof dubois[glasses]);
    else
        make_matrix(matrix, (enum method)method, &all_glasses[glasses]);
    return kind != PEL_STEREO_THESIS;
}

struct pel_image *pel_anaglyph_compose(const struct pel_stereo *stereo,
                                       const struct pel_image *left,
                                       const struct pel_image *right) {
    double matrix[3][6];
    bool linear = pel_anaglyph_matrix(stereo, matrix);
    if (stereo->kind == PEL_STEREO_MATRIX && !check_matrix(stereo->matrix))
        return NULL;
    float rounded[3][6];
    for (int i = 0; i < 18; i++)
        rounded[i / 6][i % 6] = (float)matrix[i / 6][i % 6];

    struct curves *curves = linear ? make_curves() : NULL;
    struct pel_image *image =
        linear && !curves ? NULL : pel_image_create_undefined(left->width, left->height);
    size_t pixels = image ? (size_t)image->width * (size_t)image->height : 0;
    for (size_t i = 0; i < 4 * pixels; i += 4) {
        float *out = &image->rgba[i];
        // Runs of one colour, as in a background, are worked out once.
        if (i > 0 && same_as_last(&left->rgba[i]) && same_as_last(&right->rgba[i]))
            memcpy(out, out - 4, 4 * sizeof *out);
        else if (linear)
            compose_linear(out, &left->rgba[i], &right->rgba[i], rounded, curves);
        else
            compose_stored(out, &left->rgba[i], &right->rgba[i], rounded);
    }
    free(curves);
    return image;
}
