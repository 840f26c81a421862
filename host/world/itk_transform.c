// itk_transform.c - ITK's text files of transforms.
//
//     #Insight Transform File V1.0
//     #Transform 0
//     Transform: Euler3DTransform_double_3_3
//     Parameters: 0.1 0 0 5 6 7
//     FixedParameters: 10 20 30
//
// Each kind gives a 3x3 matrix M, a translation t and a centre c: y = M (x - c) + c + t. A
// CompositeTransform has no parameters; those that follow are its parts, of which the last is
// applied first.
#include "world/itk_transform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"

// More than any kind here has.
enum { number_max = 16 };

enum kind { AFFINE, EULER, VERSOR, VERSOR_RIGID, QUATERNION, TRANSLATION, IDENTITY, COMPOSITE };

static const struct {
    const char *name;
    enum kind kind;
    int parameter_count;
} kinds[] = {
    {"AffineTransform", AFFINE, 12},
    {"MatrixOffsetTransformBase", AFFINE, 12},
    {"Rigid3DTransform", AFFINE, 12},
    {"Euler3DTransform", EULER, 6},
    {"CenteredEuler3DTransform", EULER, 9},
    {"VersorTransform", VERSOR, 3},
    {"VersorRigid3DTransform", VERSOR_RIGID, 6},
    {"QuaternionRigidTransform", QUATERNION, 7},
    {"TranslationTransform", TRANSLATION, 3},
    {"IdentityTransform", IDENTITY, 0},
    {"CompositeTransform", COMPOSITE, 0},
};

enum { kind_count = sizeof kinds / sizeof *kinds };

// One transform of a file.
struct stage {
    int kind, line; // index into kinds; -1 before the first
    double parameters[number_max], fixed[number_max];
    int parameter_count, fixed_count;
};

// Finds the kind in "Euler3DTransform_double_3_3".
static bool parse_kind(struct stage *stage, const char *text, int length, int line) {
    *stage = (struct stage){.kind = -1, .line = line};
    int name_length = (int)strcspn(text, "_ \t\r\n");
    for (int i = 0; i < kind_count; i++)
        if ((int)strlen(kinds[i].name) == name_length &&
            strncmp(text, kinds[i].name, (size_t)name_length) == 0)
            stage->kind = i;
    if (stage->kind < 0)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "line %d: '%.*s' is not a rigid transform", line,
                        length > 64 ? 64 : length, text);
    if (length > name_length && (length < 4 || strncmp(text + length - 4, "_3_3", 4) != 0))
        return pel_fail(PEL_ERROR_UNSUPPORTED, "line %d: '%.*s' is not for three dimensions", line,
                        length > 64 ? 64 : length, text);
    return true;
}

static bool parse_numbers(double numbers[number_max], int *count, const char *text, const char *end,
                          int line) {
    *count = 0;
    for (;;) {
        text += strspn(text, " \t\r");
        if (text >= end)
            return true;
        if (*count == number_max)
            return pel_fail(PEL_ERROR_FORMAT, "line %d: more than %d numbers", line, number_max);
        char *after;
        numbers[*count] = strtod(text, &after);
        if (after == text || after > end || !isfinite(numbers[*count]))
            return pel_fail(PEL_ERROR_FORMAT, "line %d: '%.*s' is not a finite number", line,
                            end - text > 16 ? 16 : (int)(end - text), text);
        text = after;
        ++*count;
    }
}

static struct pel_matrix rotation_about(int axis, double angle) {
    struct pel_matrix matrix = pel_matrix_identity();
    int a = (axis + 1) % 3, b = (axis + 2) % 3;
    matrix.m[a][a] = matrix.m[b][b] = cos(angle);
    matrix.m[b][a] = sin(angle);
    matrix.m[a][b] = -sin(angle);
    return matrix;
}

static struct pel_matrix euler_matrix(const double angles[3], bool zyx) {
    struct pel_matrix x = rotation_about(0, angles[0]), y = rotation_about(1, angles[1]);
    struct pel_matrix z = rotation_about(2, angles[2]);
    struct pel_matrix right = zyx ? pel_matrix_multiply(&y, &x) : pel_matrix_multiply(&x, &y);
    return pel_matrix_multiply(&z, &right);
}

// A versor's fourth component is what makes its length one.
static bool versor_matrix(struct pel_matrix *matrix, const double xyz[3], int line) {
    double rest = 1 - pel_dot(xyz, xyz);
    if (rest < -1e-9)
        return pel_fail(PEL_ERROR_FORMAT, "line %d: a versor of length %g exceeds 1", line,
                        pel_length(xyz));
    *matrix = pel_matrix_from_quaternion((double[]){xyz[0], xyz[1], xyz[2], sqrt(fmax(rest, 0))},
                                         (double[]){0, 0, 0});
    return true;
}

// Gets M, t and c out of a stage's numbers and joins them.
static bool stage_matrix(struct pel_matrix *matrix, const struct stage *stage) {
    const double *p = stage->parameters;
    int count = kinds[stage->kind].parameter_count;
    if (stage->parameter_count != count)
        return pel_fail(PEL_ERROR_FORMAT, "line %d: %s has %d parameters, not %d", stage->line,
                        kinds[stage->kind].name, stage->parameter_count, count);
    const double *translation = p + count - 3, *centre = stage->fixed;
    static const double none[3] = {0, 0, 0};
    *matrix = pel_matrix_identity();
    switch (kinds[stage->kind].kind) {
    case AFFINE:
        for (int i = 0; i < 9; i++)
            matrix->m[i / 3][i % 3] = p[i];
        break;
    case EULER:
        // The centred kind has its centre before the translation.
        if (count == 9)
            centre = p + 3;
        *matrix = euler_matrix(p, stage->fixed_count == 4 && stage->fixed[3] != 0);
        break;
    case VERSOR:
        translation = none;
        if (!versor_matrix(matrix, p, stage->line))
            return false;
        break;
    case VERSOR_RIGID:
        if (!versor_matrix(matrix, p, stage->line))
            return false;
        break;
    case QUATERNION: {
        double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]);
        if (!(fabs(length - 1) <= 1e-4))
            return pel_fail(PEL_ERROR_FORMAT, "line %d: a quaternion of length %g, not 1",
                            stage->line, length);
        *matrix = pel_matrix_from_quaternion(p, none);
        break;
    }
    case TRANSLATION:
        break;
    case IDENTITY:
    case COMPOSITE:
        translation = none;
        break;
    }
    double turned[3];
    pel_matrix_direction(turned, matrix, centre);
    for (int i = 0; i < 3; i++)
        matrix->m[i][3] = centre[i] + translation[i] - turned[i];
    return true;
}

bool pel_itk_transform_recognise(const char *text) {
    return strncmp(text, "#Insight Transform File", 23) == 0;
}

bool pel_itk_transform_parse(struct pel_matrix *moving_from_fixed, const char *text) {
    struct pel_matrix product = pel_matrix_identity(), matrix;
    struct stage stage = {.kind = -1};
    int stages = 0;
    bool composite = false;
    for (int line = 1; *text; line++) {
        const char *start = text + strspn(text, " \t\r");
        const char *end = start + strcspn(start, "\n");
        text = *end ? end + 1 : end;
        int length = (int)(end - start);
        while (length > 0 && strchr(" \t\r", start[length - 1]))
            length--;
        if (length == 0 || *start == '#')
            continue;

        const char *colon = memchr(start, ':', (size_t)length);
        int key = colon ? (int)(colon - start) : 0;
        const char *value = colon ? colon + 1 : start;
        while (value < start + length && strchr(" \t", *value))
            value++;
        bool good;
        if (key == 9 && strncmp(start, "Transform", 9) == 0) {
            if (stage.kind >= 0 && !stage_matrix(&matrix, &stage))
                return false;
            if (stage.kind >= 0)
                product = pel_matrix_multiply(&product, &matrix);
            good = parse_kind(&stage, value, (int)(start + length - value), line);
            bool first = stages++ == 0;
            if (good && first)
                composite = kinds[stage.kind].kind == COMPOSITE;
            else if (good && !composite)
                good = pel_fail(PEL_ERROR_FORMAT, "line %d: a second transform, and no composite",
                                line);
        } else if (stage.kind >= 0 && key == 10 && strncmp(start, "Parameters", 10) == 0) {
            good = parse_numbers(stage.parameters, &stage.parameter_count, value, start + length,
                                 line);
        } else if (stage.kind >= 0 && key == 15 && strncmp(start, "FixedParameters", 15) == 0) {
            good = parse_numbers(stage.fixed, &stage.fixed_count, value, start + length, line);
        } else {
            good = pel_fail(PEL_ERROR_FORMAT, "line %d: unexpected '%.*s'", line,
                            length > 32 ? 32 : length, start);
        }
        if (!good)
            return false;
    }
    if (stage.kind < 0 || (composite && stages == 1))
        return pel_fail(PEL_ERROR_FORMAT, "no transform in it");
    if (!stage_matrix(&matrix, &stage))
        return false;
    *moving_from_fixed = pel_matrix_multiply(&product, &matrix);
    return true;
}

// The angle about x is taken from both its sine and cosine, and the one about z from what remains
// once y is undone: both stay exact where x is near a right angle and y and z turn alike.
void pel_itk_transform_angles(const struct pel_matrix *rotation, double angles[3]) {
    const double(*m)[4] = rotation->m;
    double cosine = hypot(m[2][0], m[2][2]);
    angles[0] = atan2(m[2][1], cosine);
    angles[1] = cosine > 1e-12 ? atan2(-m[2][0], m[2][2]) : 0;
    struct pel_matrix back = rotation_about(1, -angles[1]);
    struct pel_matrix rest = pel_matrix_multiply(rotation, &back);
    angles[2] = atan2(rest.m[1][0], rest.m[0][0]);
}
