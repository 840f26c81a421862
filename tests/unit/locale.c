// locale.c - in a language with a decimal comma files hold, and are read with, decimal points.
#include <locale.h>

#include "support/near.h"
#include "support/test.h"

#include "base/math.h"

// Compiles a locale with a decimal comma into a folder of this test and takes it; skips where the
// system has no sources of locales.
static int take_comma(void **state) {
    (void)state;
    char folder[512], command[1200];
    snprintf(folder, sizeof folder, "%s", test_temporary_path(""));
    snprintf(command, sizeof command,
             "localedef -i de_DE -f UTF-8 --no-archive '%s/de_DE.UTF-8' >/dev/null 2>&1", folder);
    int status = system(command);
    setenv("LOCPATH", folder, 1);
    char comma[16] = "";
    if (setlocale(LC_ALL, "de_DE.UTF-8"))
        snprintf(comma, sizeof comma, "%.1f", 0.5);
    if (strcmp(comma, "0,5") != 0) {
        print_message("skipped: localedef (%d) made no locale with a decimal comma\n", status);
        exit(77);
    }
    return 0;
}

static void check_volume(const char *leaf) {
    struct pel_volume *volume = pel_volume_create("v", (int[]){2, 3, 4}, PEL_VOXEL_U8);
    memset(volume->voxels, 7, pel_volume_bytes(volume));
    volume->slope = 0.25;
    volume->world_from_voxel = pel_matrix_scaling((double[]){0.5, 1.25, 2.75});
    volume->world_from_voxel.m[0][3] = -10.5;
    const char *path = test_temporary_path(leaf);
    if (!pel_volume_save(volume, path))
        fail_msg("%s: %s", leaf, pel_error_message());
    pel_volume_destroy(volume);
    volume = pel_volume_load(path, NULL);
    if (!volume)
        fail_msg("%s: %s", leaf, pel_error_message());
    double spacing[3];
    pel_volume_spacing(volume, spacing);
    assert_near(spacing[0], 0.5, 1e-6);
    assert_near(spacing[1], 1.25, 1e-6);
    assert_near(spacing[2], 2.75, 1e-6);
    pel_volume_destroy(volume);
}

static void test_volumes(void **state) {
    (void)state;
    static const char *const leaves[] = {"a.nrrd", "b.nhdr", "c.mha", "d.mhd",
                                         "e.nii",  "f.tif",  "g.raw"};
    for (size_t i = 0; i < sizeof leaves / sizeof *leaves; i++)
        check_volume(leaves[i]);
}

// The text itself, as another program reads it.
static void test_points_in_text(void **state) {
    (void)state;
    const char *path = test_temporary_path("m.txt");
    struct pel_matrix matrix = pel_matrix_translation((double[]){0.5, 1.25, -2.75}), read;
    assert_true(pel_transform_save(&matrix, path, NULL, NULL));
    FILE *stream = fopen(path, "r");
    char line[128];
    assert_non_null(stream);
    assert_non_null(fgets(line, sizeof line, stream));
    fclose(stream);
    assert_string_equal(line, "1 0 0 0.5\n");
    assert_true(pel_transform_load(&read, path, NULL, NULL));
    assert_near(read.m[1][3], 1.25, 0);
    assert_near(read.m[2][3], -2.75, 0);
}

// Only for the length of a call: the program's own numbers stay as its user reads them.
static void test_comes_back(void **state) {
    (void)state;
    char text[16];
    snprintf(text, sizeof text, "%.1f", 0.5);
    assert_string_equal(text, "0,5");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volumes),
        cmocka_unit_test(test_points_in_text),
        cmocka_unit_test(test_comes_back),
    };
    return cmocka_run_group_tests(tests, take_comma, NULL);
}
