// transform_file.c - rigid transforms as ITK, FSL and everybody else write them.
//
// What a scene needs maps the world of the moving volume to that of the fixed one, in RAS.
// - ITK maps points of the fixed image to the moving one in LPS, which is what resampling needs. So
//   with D = diag(-1, -1, 1): world = inverse(D itk D).
// - FLIRT's matrix maps moving to fixed, each in its voxel indices times its spacing. Where the
//   volume's frame is right-handed (positive determinant), x runs backwards there:
//   world = W_fixed inverse(S_fixed) fsl S_moving inverse(W_moving), with W the volume's
//   world_from_voxel. See "flirt -usesqform" and the FSL wiki's FLIRT FAQ.
// - A plain 4x4 is the world matrix itself.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/file.h"
#include "base/locale.h"
#include "base/math.h"
#include "pellucid.h"
#include "world/itk_transform.h"

// Files of a few numbers.
enum { file_limit = 1 << 20 };

// A matrix whose rows are further than this from orthonormal is no rotation. What six printed
// digits explain is mended without a word.
static const double rigid_tolerance = 1e-4, quiet_tolerance = 1e-5;

// The nearest rotation: the orthogonal factor of the polar decomposition, by Newton's iteration
// R <- (R + R^-T) / 2 (Higham 1986), which squares the error each time.
static bool orthonormalise(struct pel_matrix *matrix) {
    for (int round = 0; round < 4; round++) {
        struct pel_matrix inverse;
        if (!pel_matrix_invert(&inverse, matrix))
            return false;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                matrix->m[i][j] = (matrix->m[i][j] + inverse.m[j][i]) / 2;
    }
    return true;
}

static bool make_rigid(struct pel_matrix *matrix) {
    for (int i = 0; i < 12; i++)
        if (!isfinite(matrix->m[i / 4][i % 4]))
            return pel_fail(PEL_ERROR_FORMAT, "the matrix is not finite");
    double deviation = pel_matrix_deviation(matrix);
    if (!(deviation <= rigid_tolerance))
        return pel_fail(PEL_ERROR_FORMAT,
                        "not a rotation and translation: it scales or shears by %.3g", deviation);
    if (pel_matrix_determinant(matrix) < 0)
        return pel_fail(PEL_ERROR_FORMAT, "not a rotation and translation: it mirrors");
    if (deviation > quiet_tolerance)
        pel_warn("the transform is %.3g off a rotation, and the nearest one is taken", deviation);
    return orthonormalise(matrix);
}

// Sixteen numbers row by row, with spaces, commas, semicolons or brackets between, and comments
// from # to the end of the line.
static bool parse_plain(struct pel_matrix *matrix, const char *text, size_t bytes) {
    if (strlen(text) != bytes)
        return pel_fail(PEL_ERROR_FORMAT, "not text; a binary transform must be converted first");
    int count = 0;
    for (;;) {
        text += strspn(text, " \t\r\n,;[]");
        if (*text == '#') {
            text += strcspn(text, "\n");
            continue;
        }
        if (!*text)
            break;
        char *after;
        double number = strtod(text, &after);
        if (after == text) {
            size_t length = strcspn(text, " \t\r\n,;[]");
            return pel_fail(PEL_ERROR_FORMAT, "'%.*s' is not a number",
                            length > 32 ? 32 : (int)length, text);
        }
        if (count < 16)
            matrix->m[count / 4][count % 4] = number;
        count++;
        text = after;
    }
    if (count != 16)
        return pel_fail(PEL_ERROR_FORMAT, "%d numbers, not the 16 of a 4x4 matrix", count);
    for (int i = 0; i < 4; i++)
        if (!(fabs(matrix->m[3][i] - (i == 3)) <= 1e-6))
            return pel_fail(PEL_ERROR_FORMAT, "the last row is %g %g %g %g, not 0 0 0 1",
                            matrix->m[3][0], matrix->m[3][1], matrix->m[3][2], matrix->m[3][3]);
    for (int i = 0; i < 4; i++)
        matrix->m[3][i] = i == 3;
    return true;
}

// FLIRT's coordinates of a volume, from its voxel indices.
static struct pel_matrix flirt_from_voxel(const struct pel_volume *volume) {
    double spacing[3];
    pel_volume_spacing(volume, spacing);
    struct pel_matrix matrix = pel_matrix_scaling(spacing);
    if (pel_matrix_determinant(&volume->world_from_voxel) > 0) {
        matrix.m[0][0] = -spacing[0];
        matrix.m[0][3] = (volume->dims[0] - 1) * spacing[0];
    }
    return matrix;
}

static bool flirt_from_world(struct pel_matrix *matrix, const struct pel_volume *volume) {
    struct pel_matrix flirt = flirt_from_voxel(volume), voxel_from_world;
    if (!pel_matrix_invert(&voxel_from_world, &volume->world_from_voxel))
        return pel_fail_in("%s", volume->name);
    *matrix = pel_matrix_multiply(&flirt, &voxel_from_world);
    return true;
}

static bool need_both(const struct pel_volume *moving, const struct pel_volume *fixed) {
    if (moving && fixed)
        return true;
    return pel_fail(PEL_ERROR_ARGUMENT,
                    "an FSL matrix needs its two volumes, and the %s one is not known; a 4x4 "
                    "between worlds is called .txt",
                    moving ? "fixed" : "moving");
}

// world <- fsl
static bool world_from_flirt(struct pel_matrix *matrix, const struct pel_volume *moving,
                             const struct pel_volume *fixed) {
    struct pel_matrix from_moving, to_fixed;
    if (!need_both(moving, fixed) || !flirt_from_world(&from_moving, moving) ||
        !flirt_from_world(&to_fixed, fixed) || !pel_matrix_invert(&to_fixed, &to_fixed))
        return false;
    *matrix = pel_matrix_multiply(matrix, &from_moving);
    *matrix = pel_matrix_multiply(&to_fixed, matrix);
    return true;
}

// fsl <- world
static bool flirt_from_transform(struct pel_matrix *matrix, const struct pel_volume *moving,
                                 const struct pel_volume *fixed) {
    struct pel_matrix from_moving, to_fixed;
    if (!need_both(moving, fixed) || !flirt_from_world(&from_moving, moving) ||
        !flirt_from_world(&to_fixed, fixed) || !pel_matrix_invert(&from_moving, &from_moving))
        return false;
    *matrix = pel_matrix_multiply(matrix, &from_moving);
    *matrix = pel_matrix_multiply(&to_fixed, matrix);
    return true;
}

// inverse(D matrix D) either way: it is its own inverse.
static bool exchange_itk(struct pel_matrix *matrix) {
    struct pel_matrix flip = pel_matrix_scaling((double[]){-1, -1, 1});
    *matrix = pel_matrix_multiply(matrix, &flip);
    *matrix = pel_matrix_multiply(&flip, matrix);
    return pel_matrix_invert(matrix, matrix);
}

static bool parse(struct pel_matrix *matrix, const char *path, const char *text, size_t bytes,
                  const struct pel_volume *moving, const struct pel_volume *fixed) {
    *matrix = pel_matrix_identity();
    if (pel_itk_transform_recognise(text, bytes)) {
        if (!pel_itk_transform_parse(matrix, text, bytes))
            return false;
        // Singular matrices have no inverse; the sentence about rigidity says more.
        struct pel_matrix rigid = *matrix;
        return make_rigid(&rigid) && exchange_itk(matrix);
    }
    if (!parse_plain(matrix, text, bytes))
        return false;
    if (!pel_path_has_extension(path, ".mat"))
        return true;
    if (!moving && !fixed) {
        pel_warn("%s: taken as a plain matrix between worlds, as no volumes are given", path);
        return true;
    }
    return world_from_flirt(matrix, moving, fixed);
}

bool pel_transform_load(struct pel_matrix *world_from_world, const char *path,
                        const struct pel_volume *moving, const struct pel_volume *fixed) {
    size_t bytes;
    char *text = pel_file_read(path, file_limit, &bytes);
    if (!text)
        return false;
    struct pel_matrix matrix;
    struct pel_locale locale;
    pel_locale_begin(&locale);
    bool good = parse(&matrix, path, text, bytes, moving, fixed) && make_rigid(&matrix);
    pel_locale_finish(&locale);
    free(text);
    if (!good)
        return pel_fail_in("%s", path);
    *world_from_world = matrix;
    return true;
}

static void write_itk(FILE *stream, const struct pel_matrix *matrix) {
    double angles[3];
    pel_itk_transform_angles(matrix, angles);
    fprintf(stream,
            "#Insight Transform File V1.0\n#Transform 0\n"
            "Transform: Euler3DTransform_double_3_3\n"
            "Parameters: %.17g %.17g %.17g %.17g %.17g %.17g\n"
            "FixedParameters: 0 0 0\n",
            angles[0], angles[1], angles[2], matrix->m[0][3], matrix->m[1][3], matrix->m[2][3]);
}

static void write_plain(FILE *stream, const struct pel_matrix *matrix) {
    for (int i = 0; i < 4; i++)
        fprintf(stream, "%.17g %.17g %.17g %.17g\n", matrix->m[i][0], matrix->m[i][1],
                matrix->m[i][2], matrix->m[i][3]);
}

bool pel_transform_save(const struct pel_matrix *world_from_world, const char *path,
                        const struct pel_volume *moving, const struct pel_volume *fixed) {
    struct pel_matrix matrix = *world_from_world;
    if (!pel_matrix_is_rigid(&matrix, rigid_tolerance))
        return pel_fail(PEL_ERROR_ARGUMENT, "%s: not a rotation and translation", path);
    bool itk = pel_path_has_extension(path, ".tfm");
    bool fsl = pel_path_has_extension(path, ".mat");
    if (!itk && !fsl && !pel_path_has_extension(path, ".txt"))
        return pel_fail(PEL_ERROR_ARGUMENT, "%s: a transform is written as .tfm, .mat or .txt",
                        path);
    if ((itk && !exchange_itk(&matrix)) || (fsl && !flirt_from_transform(&matrix, moving, fixed)))
        return pel_fail_in("%s", path);

    struct pel_output output;
    if (!pel_output_open(&output, path))
        return false;
    struct pel_locale locale;
    pel_locale_begin(&locale);
    if (itk)
        write_itk(output.stream, &matrix);
    else
        write_plain(output.stream, &matrix);
    pel_locale_finish(&locale);
    return pel_output_commit(&output);
}
