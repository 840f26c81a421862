// itk_transform.c - ITK's files of transforms, as text and as ANTs writes them.
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
//
// The binary kind is MATLAB 4: for each variable five 32-bit numbers (type, rows, columns, whether
// imaginary, bytes of the name), the name, and the values. One variable named after the transform
// holds the parameters, the next, "fixed", the fixed ones. Only little-endian files are about.
#include "world/itk_transform.h"

#include <math.h>
#include <stdint.h>
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
    int kind; // index into kinds
    double parameters[number_max], fixed[number_max];
    int parameter_count, fixed_count;
};

// A file half read: `product` of the finished stages, and the one being read.
struct reading {
    struct pel_matrix product;
    struct stage stage;
    int stage_count;
    bool composite;
};

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
static bool versor_matrix(struct pel_matrix *matrix, const double xyz[3]) {
    double rest = 1 - pel_dot(xyz, xyz);
    if (rest < -1e-9)
        return pel_fail(PEL_ERROR_FORMAT, "a versor of length %g exceeds 1", pel_length(xyz));
    *matrix = pel_matrix_from_quaternion((double[]){xyz[0], xyz[1], xyz[2], sqrt(fmax(rest, 0))},
                                         (double[]){0, 0, 0});
    return true;
}

// Gets M, t and c out of a stage's numbers and joins them.
static bool stage_matrix(struct pel_matrix *matrix, const struct stage *stage) {
    const double *p = stage->parameters;
    int count = kinds[stage->kind].parameter_count;
    if (stage->parameter_count != count)
        return pel_fail(PEL_ERROR_FORMAT, "%s has %d parameters, not %d", kinds[stage->kind].name,
                        stage->parameter_count, count);
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
        if (!versor_matrix(matrix, p))
            return false;
        break;
    case VERSOR_RIGID:
        if (!versor_matrix(matrix, p))
            return false;
        break;
    case QUATERNION: {
        double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]);
        if (!(fabs(length - 1) <= 1e-4))
            return pel_fail(PEL_ERROR_FORMAT, "a quaternion of length %g, not 1", length);
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

// Joins the stage that has been read to those before it.
static bool end_stage(struct reading *reading) {
    struct pel_matrix matrix;
    if (reading->stage_count == 0)
        return true;
    if (!stage_matrix(&matrix, &reading->stage))
        return false;
    reading->product = pel_matrix_multiply(&reading->product, &matrix);
    return true;
}

// Begins the stage named as in "Euler3DTransform_double_3_3".
static bool begin_stage(struct reading *reading, const char *name, int length) {
    if (!end_stage(reading))
        return false;
    int kind = 0, shown = length > 64 ? 64 : length;
    for (; kind < kind_count; kind++) {
        int known = (int)strlen(kinds[kind].name);
        if (known <= length && strncmp(name, kinds[kind].name, (size_t)known) == 0 &&
            (known == length || name[known] == '_'))
            break;
    }
    if (kind == kind_count)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "'%.*s' is not a rigid transform", shown, name);
    if (memchr(name, '_', (size_t)length) && strncmp(name + length - 4, "_3_3", 4) != 0)
        return pel_fail(PEL_ERROR_UNSUPPORTED, "'%.*s' is not for three dimensions", shown, name);
    if (reading->stage_count > 0 && !reading->composite)
        return pel_fail(PEL_ERROR_FORMAT, "a second transform, and no composite");
    if (reading->stage_count++ == 0)
        reading->composite = kinds[kind].kind == COMPOSITE;
    reading->stage = (struct stage){.kind = kind};
    return true;
}

static bool end_reading(struct reading *reading, struct pel_matrix *matrix) {
    if (reading->stage_count == (reading->composite ? 1 : 0))
        return pel_fail(PEL_ERROR_FORMAT, "no transform in it");
    if (!end_stage(reading))
        return false;
    *matrix = reading->product;
    return true;
}

static bool parse_numbers(double numbers[number_max], int *count, const char *text,
                          const char *end) {
    *count = 0;
    for (;;) {
        text += strspn(text, " \t\r");
        if (text >= end)
            return true;
        if (*count == number_max)
            return pel_fail(PEL_ERROR_FORMAT, "more than %d numbers", number_max);
        char *after;
        numbers[*count] = strtod(text, &after);
        if (after == text || after > end || !isfinite(numbers[*count]))
            return pel_fail(PEL_ERROR_FORMAT, "'%.*s' is not a finite number",
                            end - text > 16 ? 16 : (int)(end - text), text);
        text = after;
        ++*count;
    }
}

// One line without its white space at both ends.
static bool parse_line(struct reading *reading, const char *line, int length) {
    const char *end = line + length, *colon = memchr(line, ':', (size_t)length);
    size_t key = colon ? (size_t)(colon - line) : 0;
    const char *value = colon ? colon + 1 : line;
    while (value < end && strchr(" \t", *value))
        value++;
    struct stage *stage = &reading->stage;
    if (key == 9 && strncmp(line, "Transform", key) == 0)
        return begin_stage(reading, value, (int)(end - value));
    if (reading->stage_count > 0 && key == 10 && strncmp(line, "Parameters", key) == 0)
        return parse_numbers(stage->parameters, &stage->parameter_count, value, end);
    if (reading->stage_count > 0 && key == 15 && strncmp(line, "FixedParameters", key) == 0)
        return parse_numbers(stage->fixed, &stage->fixed_count, value, end);
    return pel_fail(PEL_ERROR_FORMAT, "unexpected '%.*s'", length > 32 ? 32 : length, line);
}

static bool parse_text(struct reading *reading, const char *text) {
    for (int line = 1; *text; line++) {
        const char *start = text + strspn(text, " \t\r");
        const char *end = start + strcspn(start, "\n");
        text = *end ? end + 1 : end;
        while (end > start && strchr(" \t\r", end[-1]))
            end--;
        if (start < end && *start != '#' && !parse_line(reading, start, (int)(end - start)))
            return pel_fail_in("line %d", line);
    }
    return true;
}

// The head of a MATLAB 4 variable, and what follows it.
struct variable {
    int32_t type, rows, columns, imaginary, name_bytes;
};

enum { SINGLE = 10, ROW_WISE = 100, name_limit = 128 };

static bool variable_is_sound(const struct variable *variable) {
    return (variable->type == 0 || variable->type == SINGLE || variable->type == ROW_WISE ||
            variable->type == ROW_WISE + SINGLE) &&
           variable->rows >= 0 && variable->columns >= 0 && variable->columns <= 1 &&
           variable->imaginary == 0 && variable->name_bytes > 1 &&
           variable->name_bytes <= name_limit;
}

static bool parse_variable(struct reading *reading, const char **data, size_t *bytes) {
    struct variable variable;
    if (*bytes < sizeof variable)
        return pel_fail(PEL_ERROR_FORMAT, "the file ends early");
    memcpy(&variable, *data, sizeof variable);
    if (!variable_is_sound(&variable))
        return pel_fail(PEL_ERROR_FORMAT, "not a vector of numbers");
    int count = variable.rows * variable.columns;
    size_t number_bytes = variable.type % ROW_WISE == SINGLE ? sizeof(float) : sizeof(double);
    size_t name_bytes = (size_t)variable.name_bytes;
    const char *name = *data + sizeof variable, *numbers = name + name_bytes;
    if (*bytes - sizeof variable < name_bytes ||
        (*bytes - sizeof variable - name_bytes) / number_bytes < (size_t)count)
        return pel_fail(PEL_ERROR_FORMAT, "the file ends early");
    *data = numbers + (size_t)count * number_bytes;
    *bytes -= sizeof variable + name_bytes + (size_t)count * number_bytes;

    bool fixed = reading->stage_count > 0 && name_bytes == 6 && memcmp(name, "fixed", 6) == 0;
    if (!fixed && !begin_stage(reading, name, (int)strnlen(name, name_bytes)))
        return false;
    // What a composite itself holds repeats its parts.
    if (kinds[reading->stage.kind].kind == COMPOSITE)
        return true;
    if (count > number_max)
        return pel_fail(PEL_ERROR_FORMAT, "%d numbers, more than %d", count, number_max);
    double *out = fixed ? reading->stage.fixed : reading->stage.parameters;
    *(fixed ? &reading->stage.fixed_count : &reading->stage.parameter_count) = count;
    for (int i = 0; i < count; i++) {
        double number;
        if (number_bytes == sizeof(float)) {
            float single;
            memcpy(&single, numbers + (size_t)i * sizeof single, sizeof single);
            number = (double)single;
        } else {
            memcpy(&number, numbers + (size_t)i * sizeof number, sizeof number);
        }
        if (!isfinite(number))
            return pel_fail(PEL_ERROR_FORMAT, "a number is not finite");
        out[i] = number;
    }
    return true;
}

static bool parse_binary(struct reading *reading, const char *data, size_t bytes) {
    for (int i = 1; bytes > 0; i++)
        if (!parse_variable(reading, &data, &bytes))
            return pel_fail_in("variable %d", i);
    return true;
}

static bool is_text(const char *data, size_t bytes) {
    static const char head[] = "#Insight Transform File";
    return bytes >= sizeof head && memcmp(data, head, sizeof head - 1) == 0;
}

bool pel_itk_transform_recognise(const char *data, size_t bytes) {
    if (is_text(data, bytes))
        return true;
    struct variable variable;
    if (bytes < sizeof variable)
        return false;
    memcpy(&variable, data, sizeof variable);
    return variable_is_sound(&variable);
}

bool pel_itk_transform_parse(struct pel_matrix *moving_from_fixed, const char *data, size_t bytes) {
    struct reading reading = {.product = pel_matrix_identity()};
    bool good =
        is_text(data, bytes) ? parse_text(&reading, data) : parse_binary(&reading, data, bytes);
    return good && end_reading(&reading, moving_from_fixed);
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
