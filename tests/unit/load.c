// load.c - a file is told by its content before its name, and every failure names the file once.
#include "support/file.h"

#include <sys/stat.h>
#include <unistd.h>

static const char *const extensions[] = {"nrrd", "nii", "nii.gz", "mha"};

static void test_content_goes_before_the_name(void **state) {
    (void)state;
    struct pel_volume *volume = test_small_volume(PEL_VOXEL_I16);
    for (int i = 0; i < 4; i++) {
        char right[32];
        snprintf(right, sizeof right, "content.%s", extensions[i]);
        assert_true(pel_volume_save(volume, test_temporary_path(right)));
        struct test_bytes file = test_read(test_temporary_path(right));
        static const char *const names[] = {"wrong.raw", "wrong.nrrd", "wrong.mhd", "wrong.pvm",
                                            "wrong",     "wrong.nii",  "wrong.tif"};
        for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
            struct pel_volume *again =
                pel_volume_load(test_write(names[n], file.bytes, file.count), NULL);
            if (!again)
                fail_msg("%s as %s: %s", extensions[i], names[n], pel_error_message());
            test_assert_same_volume(again, volume, 1e-14);
            assert_string_equal(again->name, names[n]);
            pel_volume_destroy(again);
        }
        test_release(&file);
    }
    pel_volume_destroy(volume);
}

static void test_unknown_content_goes_by_the_name(void **state) {
    (void)state;
    static const struct {
        const char *leaf;
        enum pel_error code;
        const char *fragment;
    } files[] = {
        {"a.nii", PEL_ERROR_FORMAT, "not a NIfTI header"},
        {"a.nrrd", PEL_ERROR_FORMAT, ""},
        {"a.mhd", PEL_ERROR_FORMAT, "not Key = value"},
        {"a.pvm", PEL_ERROR_FORMAT, "not a PVM file"},
        {"a.raw", PEL_ERROR_FORMAT, "a headerless file: give its dimensions"},
        {"a.img", PEL_ERROR_FORMAT, "a headerless file"},
        {"a.txt", PEL_ERROR_FORMAT, "neither its content nor its name"},
        {"a.par", PEL_ERROR_UNSUPPORTED, "PAR/REC is not read, dcm2niix"},
        {"a.mgz", PEL_ERROR_UNSUPPORTED, "mri_convert"},
    };
    char text[600];
    memset(text, 'q', sizeof text);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        test_assert_load_fails(test_write(files[i].leaf, text, sizeof text), NULL, files[i].code,
                               files[i].fragment);
    test_assert_load_fails(test_write("empty.nii", "", 0), NULL, PEL_ERROR_FORMAT, "");
    test_assert_load_fails(test_write("empty", "", 0), NULL, PEL_ERROR_FORMAT, "");
    test_assert_load_fails(test_temporary_path("missing.nrrd"), NULL, PEL_ERROR_FILE,
                           "No such file");
    test_assert_load_fails("/dev/null", NULL, PEL_ERROR_FILE, "not a regular file");
}

// Makes a script that stands in for a program.
static void with_program(const char *script, const char *leaf) {
    const char *path = test_write_text(leaf, script);
    assert_int_equal(chmod(path, 0700), 0);
}

static void test_dicom_needs_a_program(void **state) {
    (void)state;
    char head[400] = {0};
    memcpy(head + 128, "DICM", 4);
    assert_int_equal(mkdir(test_temporary_path("series"), 0700), 0);
    test_write("series/IM0001", head, sizeof head);
    char *old_path = strdup(getenv("PATH"));
    assert_int_equal(mkdir(test_temporary_path("programs"), 0700), 0);
    setenv("PATH", test_temporary_path("programs"), 1);
    test_assert_load_fails(test_temporary_path("series"), NULL, PEL_ERROR_UNSUPPORTED,
                           "package dcm2niix");
    test_assert_load_fails(test_temporary_path("series/IM0001"), NULL, PEL_ERROR_UNSUPPORTED,
                           "package dcm2niix");

    // A stand-in that copies a volume to where dcm2niix was told to write.
    struct pel_volume *volume = test_small_volume(PEL_VOXEL_U8);
    assert_true(pel_volume_save(volume, test_temporary_path("series.nii")));
    char script[1024], programs[512];
    snprintf(script, sizeof script,
             "#!/bin/sh\nwhile [ $# -gt 1 ]; do [ \"$1\" = -o ] && out=$2; shift; done\n"
             "cp '%s' \"$out/3_t1.nii\"\n",
             test_temporary_path("series.nii"));
    with_program(script, "programs/dcm2niix");
    snprintf(programs, sizeof programs, "%s:%s", test_temporary_path("programs"), old_path);
    setenv("PATH", programs, 1);
    struct pel_volume *again = pel_volume_load(test_temporary_path("series"), NULL);
    if (!again)
        fail_msg("%s", pel_error_message());
    test_assert_same_volume(again, volume, 0);
    assert_string_equal(again->name, "series");
    pel_volume_destroy(again);
    pel_volume_destroy(volume);

    // Two series, and none.
    strcat(script, "cp \"$out/3_t1.nii\" \"$out/10_t2.nii\"\n");
    with_program(script, "programs/dcm2niix");
    test_assert_load_fails(test_temporary_path("series"), NULL, PEL_ERROR_UNSUPPORTED,
                           "2 series where one is needed (3_t1, 10_t2)");
    with_program("#!/bin/sh\nexit 2\n", "programs/dcm2niix");
    test_assert_load_fails(test_temporary_path("series"), NULL, PEL_ERROR_FORMAT,
                           "finds no image in it");
    setenv("PATH", old_path, 1);
    free(old_path);
}

static void test_temporary_folders_are_removed(void **state) {
    (void)state;
    const char *folder = test_temporary_path("tmp");
    assert_int_equal(mkdir(folder, 0700), 0);
    setenv("TMPDIR", folder, 1);
    assert_null(pel_volume_load(test_temporary_path("series"), NULL));
    unsetenv("TMPDIR");
    assert_int_equal(rmdir(folder), 0);
}

static void test_saving(void **state) {
    (void)state;
    struct pel_volume *volume = test_small_volume(PEL_VOXEL_U8);
    assert_false(pel_volume_save(volume, test_temporary_path("a.xyz")));
    assert_int_equal(pel_error_code(), PEL_ERROR_ARGUMENT);
    assert_non_null(strstr(pel_error_message(), "no volume format has this extension"));
    static const char *const leaves[] = {"no/a.nrrd", "no/a.nhdr", "no/a.nii", "no/a.nii.gz",
                                         "no/a.mha",  "no/a.mhd",  "no/a.raw"};
    for (size_t i = 0; i < sizeof leaves / sizeof *leaves; i++) {
        assert_false(pel_volume_save(volume, test_temporary_path(leaves[i])));
        assert_int_equal(pel_error_code(), PEL_ERROR_FILE);
    }
    pel_volume_destroy(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_content_goes_before_the_name),
        cmocka_unit_test(test_unknown_content_goes_by_the_name),
        cmocka_unit_test(test_dicom_needs_a_program),
        cmocka_unit_test(test_temporary_folders_are_removed),
        cmocka_unit_test(test_saving),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
